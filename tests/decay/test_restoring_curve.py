import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.restoring_curve import RestoringCurve

ANGLE = np.radians(np.arange(0.0, 61.0, 5.0))


def test_levers_of_a_sine():
    curve = RestoringCurve.from_levers(ANGLE, 1.5 * np.sin(ANGLE))
    x = np.linspace(-1.0, 1.0, 41).reshape(1, -1)
    np.testing.assert_allclose(curve(x), np.sin(x), atol=2e-4)
    np.testing.assert_allclose(curve.slope(x), np.cos(x), atol=2e-3)
    np.testing.assert_allclose(curve.potential(x), 1.0 - np.cos(x), atol=1e-4)
    assert curve(x).shape == (1, 41)


def test_rows_and_columns_are_read_alike():
    curve = RestoringCurve.from_levers(ANGLE, np.sin(ANGLE))
    table = np.random.default_rng(1).uniform(-1.0, 1.0, (5, 7))
    np.testing.assert_allclose(curve(table), np.array([[float(curve(np.array(x))) for x in row] for row in table]))


def test_given_metacentric_height_scales_the_shape():
    curve = RestoringCurve.from_levers(ANGLE, 1.5 * np.sin(ANGLE), metacentric_height=3.0)
    assert float(curve(np.array(0.5))) == pytest.approx(0.5 * np.sin(0.5), rel=1e-4)


def test_the_tangent_continues_beyond_the_table():
    curve = RestoringCurve.from_levers(ANGLE, np.sin(ANGLE))
    beyond = curve(np.array([curve.last + 0.1]))[0]
    assert beyond == pytest.approx(np.sin(curve.last) + 0.1 * np.cos(curve.last), abs=2e-3)


@pytest.mark.parametrize(
    ("angle", "lever", "message"),
    [
        ([0.0, 0.1], [0.0], "do not pair"),
        ([0.0, 0.1], [0.0, 0.1], "at least two"),
        ([0.0, 0.2, 0.1], [0.0, 0.2, 0.1], "at least two"),
        ([0.0, 10.0, 20.0], [0.0, 0.2, 0.4], "radians"),
        ([0.0, 0.1, 0.2], [0.0, -0.1, -0.2], "slope"),
    ],
)
def test_bad_tables_are_named(angle, lever, message):
    with pytest.raises(FitError, match=message):
        RestoringCurve.from_levers(np.array(angle), np.array(lever))
