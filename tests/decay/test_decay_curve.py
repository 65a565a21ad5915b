import numpy as np
import pytest

from towtank.decay.decay_curve import DecayCurve, fit_decay_curve


def test_linear_decay_is_one_damped_cosine(make_decay):
    record = make_decay((0.06, 0.0, 0.0, 0.36, 0.0, 0.0), offset=0.02)
    curve = fit_decay_curve(record)
    value, rate, acceleration, _ = curve.evaluate(record.time)
    np.testing.assert_allclose(value + curve.offset, record.value, atol=1e-6)
    assert curve.offset == pytest.approx(0.02, abs=1e-6)
    np.testing.assert_allclose(acceleration + 0.06 * rate + 0.36 * value, 0.0, atol=1e-6)


def test_derivatives_and_gradient():
    parameters = np.array([-1.0, -0.5, 0.1, 10.0, 9.0, 0.2, 0.05, 0.01, -0.02, 0.03, 0.01])
    curve = DecayCurve(0.0, 30.0, 2, True, parameters)
    time = np.linspace(0.0, 30.0, 301)
    value, rate, acceleration, gradient = curve.evaluate(time)
    step = 1e-4
    ahead, behind = curve.evaluate(time + step), curve.evaluate(time - step)
    np.testing.assert_allclose(rate, (ahead[0] - behind[0]) / (2.0 * step), atol=1e-7)
    np.testing.assert_allclose(acceleration, (ahead[1] - behind[1]) / (2.0 * step), atol=1e-7)
    for k in range(parameters.size):
        moved = parameters.copy()
        moved[k] += 1e-6
        other = DecayCurve(0.0, 30.0, 2, True, moved)
        change = (other.evaluate(time)[0] + other.offset - value - curve.offset) / 1e-6
        np.testing.assert_allclose(gradient[:, k], change, atol=2e-6)


def test_a_third_harmonic_helps(make_decay, literature):
    record = make_decay(literature)
    left = []
    for harmonics in (False, True):
        curve = fit_decay_curve(record, 5, harmonics=harmonics)
        left.append(np.std(record.value - curve.evaluate(record.time)[0] - curve.offset))
    assert left[1] < 0.5 * left[0]
    assert left[1] < 1e-4
