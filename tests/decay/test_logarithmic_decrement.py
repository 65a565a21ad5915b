import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.logarithmic_decrement import damping_ratio, decrement_points, fit_logarithmic_decrement

LINEAR = (0.06, 0.0, 0.0, 0.36, 0.0, 0.0)


def test_exact_and_light_form_differ_by_half_a_per_cent_at_a_tenth():
    decrement = 2.0 * np.pi * 0.1 / np.sqrt(1.0 - 0.01)
    assert damping_ratio(decrement) == pytest.approx(0.1, rel=1e-12)
    assert damping_ratio(decrement, "light") / 0.1 == pytest.approx(1.005, abs=1e-4)
    with pytest.raises(FitError, match="unknown"):
        damping_ratio(0.1, "heavy")


def test_linear_decay_is_exact_whatever_its_offset(make_decay):
    result = fit_logarithmic_decrement(make_decay(LINEAR, offset=0.05, step=0.05))
    np.testing.assert_allclose(result.values, [0.06, 0.36], rtol=2e-4)
    assert result.zeta == pytest.approx(0.05, rel=1e-3)


def test_light_form_takes_the_damped_for_the_natural_frequency(make_decay):
    record = make_decay((0.12, 0.0, 0.0, 0.36, 0.0, 0.0), step=0.05)
    exact, light = fit_logarithmic_decrement(record), fit_logarithmic_decrement(record, form="light")
    assert exact["c1"] == pytest.approx(0.36, rel=1e-3)
    assert light["c1"] == pytest.approx(0.36 - 0.06**2, rel=1e-3)


def test_run_with_amplitude_gives_the_quadratic_term(make_decay):
    record = make_decay((0.04, 0.2, 0.0, 0.36, 0.0, 0.0), step=0.05)
    result = fit_logarithmic_decrement(record, damping_model())
    np.testing.assert_allclose(result.values, [0.04, 0.2, 0.36], rtol=0.03)
    points = decrement_points(record)
    assert (np.diff(points.alpha) < 0.0).all()


def test_points_scatter_as_their_influence_says(make_decay):
    base = make_decay(LINEAR)
    sd = np.sqrt((decrement_points(base).alpha_influence[4] ** 2).sum()) * np.radians(0.2)
    alphas = [decrement_points(make_decay(LINEAR, noise=0.2, correlation=0.0, seed=s)).alpha[4] for s in range(40)]
    assert np.std(alphas) == pytest.approx(sd, rel=0.35)
