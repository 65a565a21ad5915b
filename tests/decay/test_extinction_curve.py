import numpy as np
import pytest

from towtank.decay.damping_models import damping_model
from towtank.decay.extinction_curve import extinction_points, fit_extinction_curve


def test_coefficients_of_the_literature(make_decay, literature):
    # Least squares over the eight peaks of the literature: .10465, .20063, .2051.
    record = make_decay(literature, step=0.02, duration=42.0)
    result = fit_extinction_curve(record, damping_model("linear+quadratic+cubic"))
    fitted = result.diagnostics.details["polynomial"]
    assert fitted["a"] == pytest.approx(0.10465, rel=0.01)
    assert fitted["b"] == pytest.approx(0.20063, rel=0.03)
    assert fitted["c"] == pytest.approx(0.2051, rel=0.05)


def test_losses_of_the_listed_peaks(make_decay, literature):
    mean, loss = extinction_points(make_decay(literature, step=0.05))
    peaks = np.radians([25.0, 20.137, 16.640, 13.991, 11.912, 10.239, 8.865, 7.721])
    np.testing.assert_allclose(loss[:7], peaks[:-1] - peaks[1:], atol=1e-4)
    np.testing.assert_allclose(mean[:7], 0.5 * (peaks[:-1] + peaks[1:]), atol=1e-4)


def test_bertin_is_constant_for_quadratic_damping(make_decay):
    record = make_decay((0.0, 0.4, 0.0, 0.36, 0.0, 0.0), step=0.05)
    result = fit_extinction_curve(record, damping_model("quadratic"))
    coefficients = np.array(result.diagnostics.details["Bertin N [1/deg]"])
    np.testing.assert_allclose(coefficients, 4.0 / 3.0 * 0.4 * np.radians(1.0), rtol=0.02)
    assert result["b2"] == pytest.approx(0.4, rel=0.01)


def test_b_and_c_cannot_be_told_apart(make_decay, literature):
    result = fit_extinction_curve(make_decay(literature, noise=0.1), damping_model("linear+quadratic+cubic"))
    assert result.linear_quadratic_correlation < -0.97
    assert "inseparable" in [item.rule for item in result.findings]


def test_an_offset_does_not_matter(make_decay, literature):
    plain = fit_extinction_curve(make_decay(literature))
    moved = fit_extinction_curve(make_decay(literature, offset=0.03))
    np.testing.assert_allclose(moved.values, plain.values, rtol=1e-6)
