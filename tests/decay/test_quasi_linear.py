import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.equivalent_damping import equivalent_linear
from towtank.decay.quasi_linear import fit_quasi_linear, quasi_linear_points

QUADRATIC = (0.04, 0.2, 0.0, 0.36, 0.0, 0.0)


def test_windows_follow_the_equivalent_damping(make_decay):
    points = quasi_linear_points(make_decay(QUADRATIC))
    expected = equivalent_linear(np.array(QUADRATIC), points.amplitude)[0]
    np.testing.assert_allclose(points.alpha, expected, rtol=0.05)
    assert (np.diff(points.amplitude) < 0.0).all()


def test_coefficients(make_decay):
    result = fit_quasi_linear(make_decay(QUADRATIC))
    np.testing.assert_allclose(
        result.equivalent([0.1, 0.2]).alpha,
        equivalent_linear(np.array(QUADRATIC), np.array([0.1, 0.2]))[0],
        rtol=0.03,
    )


def test_windows_longer_than_the_record(make_decay):
    with pytest.raises(FitError, match="do not fit into"):
        quasi_linear_points(make_decay(QUADRATIC, duration=20.0), 9)
