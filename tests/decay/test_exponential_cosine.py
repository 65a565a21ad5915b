import numpy as np
import pytest

from towtank.decay.damping_models import damping_model
from towtank.decay.exponential_cosine import fit_exponential_cosine

LINEAR = (0.06, 0.0, 0.0, 0.36, 0.0, 0.0)


def test_linear_decay_is_found(make_decay):
    result = fit_exponential_cosine(make_decay(LINEAR))
    np.testing.assert_allclose(result.values, [0.06, 0.36], rtol=1e-5)


def test_its_interval_is_narrower_than_that_of_the_decrement(make_decay):
    from towtank.decay.logarithmic_decrement import fit_logarithmic_decrement

    record = make_decay(LINEAR, noise=0.3, seed=2)
    cosine, decrement = fit_exponential_cosine(record), fit_logarithmic_decrement(record)
    assert cosine.bse[0] < decrement.bse[0]
    assert abs(cosine["b1"] - 0.06) < 3.0 * cosine.bse[0]


def test_several_amplitudes_give_the_quadratic_term(make_decay):
    runs = [make_decay((0.04, 0.2, 0.0, 0.36, 0.0, 0.0), degrees=a, duration=32.0) for a in (4.0, 9.0, 20.0)]
    result = fit_exponential_cosine(runs, damping_model())
    assert result["b2"] == pytest.approx(0.2, rel=0.15)
    at = result.equivalent(0.1)
    assert at.alpha[0] == pytest.approx(0.02 + 4.0 / (3.0 * np.pi) * 0.06 * 0.2, rel=0.02)
