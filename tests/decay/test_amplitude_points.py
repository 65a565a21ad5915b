import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.amplitude_points import AmplitudePoints, fit_points, solve_weighted
from towtank.decay.damping_models import damping_model
from towtank.decay.equivalent_damping import equivalent_linear


def exact_points(coefficients, samples):
    amplitude = np.linspace(0.05, 0.5, 9)
    alpha, omega, _ = equivalent_linear(np.array(coefficients), amplitude)
    influence = np.random.default_rng(3).standard_normal((9, samples))
    return AmplitudePoints(amplitude, alpha, omega, influence, 0.1 * influence)


def test_points_of_a_model_give_it_back(make_decay, literature):
    record = make_decay(literature)
    coefficients = (0.04, 0.15, 0.3, 0.36, 0.2, -0.3)
    model = damping_model("linear+quadratic+cubic", "quintic")
    values, influences = fit_points([record], [exact_points(coefficients, len(record))], model)
    np.testing.assert_allclose([values[name] for name in model.names], coefficients, rtol=1e-8)
    assert influences[0].shape == (6, len(record))


def test_speeds_are_separated(make_decay, literature):
    runs = [make_decay(literature, speed=speed) for speed in (0.0, 2.0)]
    points = [exact_points((0.04 + 0.01 * one.speed, 0.15, 0.0, 0.36, 0.0, 0.0), len(one)) for one in runs]
    values, _ = fit_points(runs, points, damping_model(speed=["b1*U"]))
    assert values["b1*U"] == pytest.approx(0.01)
    assert values["b1"] == pytest.approx(0.04)


def test_known_terms_are_taken_off(make_decay, literature):
    record = make_decay(literature)
    points = exact_points((0.04, 0.15, 0.0, 0.36, 0.0, 0.0), len(record))
    values, influences = fit_points([record], [points], damping_model(fixed={"b1": 0.04}))
    assert set(values) == {"b2", "c1"}
    assert values["b2"] == pytest.approx(0.15)
    assert influences[0].shape[0] == 2


def test_too_few_points():
    model = damping_model()
    with pytest.raises(FitError, match="cannot separate b1, b2"):
        solve_weighted(model, ["b1", "b2"], np.ones((1, 2)), np.ones(1), np.ones(1))
    with pytest.raises(FitError, match="cannot separate"):
        solve_weighted(model, ["b1", "b2"], np.ones((4, 2)), np.ones(4), np.ones(4))
