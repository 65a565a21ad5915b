from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.decay_input import decay_from_table, read_decay
from towtank.decay.derivation_fit import derive, fit_derivation
from towtank.decay.equation import simulate_decay
from towtank.decay.equivalent_damping import equivalent_linear

DATA = Path(__file__).resolve().parents[3] / "shared" / "data" / "decay_kvlcc2"


def test_noise_free_record_gives_its_coefficients(make_decay, literature):
    result = fit_derivation(make_decay(literature, step=0.05), damping_model("linear+quadratic+cubic"))
    np.testing.assert_allclose(result.values, [0.04, 0.15, 0.3, 0.36], rtol=3e-3)
    assert result.equivalent(0.2).alpha[0] == pytest.approx(0.0292594, rel=1e-4)


def test_given_derivatives_are_used_as_they_are():
    coefficients = np.array([0.04, 0.15, 0.3, 0.36, 0.2, -0.3])
    time = np.arange(0.0, 40.0, 0.5)
    x, v = simulate_decay(time, (0.4, 0.0), coefficients).T
    model = damping_model("linear+quadratic+cubic", "quintic")
    a = -(model.columns(x, v) @ coefficients)
    table = {"time": time, "phi": x, "p": v, "pdot": a}
    record = decay_from_table(table, unit="rad", rate="p", acceleration="pdot")
    result = fit_derivation(record, model, offset=False)
    np.testing.assert_allclose(result.values, coefficients, rtol=1e-8)
    assert result.provenance.choices["derivatives"] == "given with the record"


def test_the_average_of_the_equation_narrows_the_intervals(make_decay):
    record = make_decay((0.04, 0.25, 0.0, 0.36, 0.0, 0.0), noise=0.1, seed=5)
    averaged, plain = fit_derivation(record), fit_derivation(record, average=0.0)
    assert averaged.equivalent(0.2).alpha_sd < 0.5 * plain.equivalent(0.2).alpha_sd


def test_bias_by_noise_is_told_and_instruments_take_it_away(make_decay):
    coefficients = (0.04, 0.25, 0.0, 0.36, 0.0, 0.0)
    plain, clean = [], []
    for seed in range(12):
        record = make_decay(coefficients, noise=1.0, correlation=0.3, seed=seed)
        plain.append(fit_derivation(record, average=0.0))
        clean.append(fit_derivation(record, average=0.0, instruments=True)["c1"])
    biased = np.array([one["c1"] for one in plain])
    assert np.abs(np.mean(biased) - 0.36) > 3.0 * np.abs(np.mean(clean) - 0.36)
    assert any(item.rule == "noise-in-regressors" for one in plain for item in one.findings)


@pytest.mark.slow
@pytest.mark.parametrize("noise", [0.05, 0.5])
def test_intervals_of_the_equivalent_damping_cover(make_decay, noise):
    """300 records: the 95 % intervals hold the truth in 92 to 97 %."""
    coefficients = (0.04, 0.25, 0.0, 0.36, 0.0, 0.0)
    amplitude = np.array([0.1, 0.2, 0.3])
    true = equivalent_linear(np.array(coefficients), amplitude)[0]
    hits = []
    for seed in range(300):
        at = fit_derivation(make_decay(coefficients, noise=noise, seed=seed)).equivalent(amplitude)
        hits.append((at.alpha_lower <= true) & (true <= at.alpha_upper))
    assert 0.92 <= np.mean(hits) <= 0.97


def test_a_rising_spring_is_refused(make_decay, literature):
    record = make_decay(literature)
    wrong = replace(record, rate=np.gradient(record.value, record.time), acceleration=record.value)
    with pytest.raises(FitError, match="does not restore"):
        fit_derivation(wrong)


def test_too_short_for_the_ends(make_decay, literature):
    record = make_decay(literature, duration=14.0)
    with pytest.raises(FitError, match="left between the ends"):
        derive(record, trim=0.6)


@pytest.fixture(scope="module")
def record():
    return read_decay(
        DATA / "fnpf_kvlcc2_rolldecay_0kn.csv", time="Time", unit="rad", rate="phi1d", acceleration="phi2d"
    )


@pytest.mark.skipif(not DATA.is_dir(), reason="open measurements are not here")
class TestKvlcc2PotentialFlow:
    """Simulation with its own derivatives: ordinary least squares of the cubic model."""

    EXPECTED = (
        ("b1", 0.0163, 0.014, 0.018, 3),
        ("b2", -0.0617, -0.076, -0.047, 3),
        ("b3", 0.0981, 0.072, 0.124, 3),
        ("c1", 6.1162, 6.114, 6.118, 3),
        ("c3", -5.5215, -5.807, -5.236, 3),
        ("c5", 254.09, 244.9, 263.3, 1),
    )

    def test_values_and_textbook_intervals(self, record):
        model = damping_model("linear+quadratic+cubic", "quintic")
        result = fit_derivation(record, model, offset=False, covariance="independent")
        table = result.table().set_index("name")
        for name, value, lower, upper, digits in self.EXPECTED:
            assert table["value"][name] == pytest.approx(value, abs=0.51e-4 if name != "c5" else 0.01)
            assert round(table["lower95"][name], digits) == pytest.approx(lower, abs=0.51 * 10.0**-digits)
            assert round(table["upper95"][name], digits) == pytest.approx(upper, abs=0.51 * 10.0**-digits)

    def test_autocorrelated_residuals_widen_them(self, record):
        model = damping_model("linear+quadratic+cubic", "quintic")
        honest = fit_derivation(record, model, offset=False)
        plain = fit_derivation(record, model, offset=False, covariance="independent")
        np.testing.assert_allclose(honest.values, plain.values)
        assert (honest.bse > 1.2 * plain.bse).all()
