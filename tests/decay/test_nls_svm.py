"""NLS-SVM: the synthetic case of its paper, noise, trimmed ends, several records, bad requests."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.damping_models import damping_model
from towtank.decay.nls_svm import curve_of, fit_nls_svm, uniform
from towtank.decay.virtual_decay import VirtualDecay, virtual_decay

INERTIA = 8e10
PER_DEGREE = 180.0 / math.pi
PUBLISHED = {"sigma": 4.0, "average": 0.0, "instruments": False, "offset": False}
"""Kernel, trimming (a quarter of 20 s) and least squares of the paper."""


def synthetic(b1, b2):
    """Decay from 7 deg with a period of 20 s, sampled at 0.5 s for 200 s; b1, b2 in N m s and N m s2/rad2."""
    terms = {"b1": b1 / INERTIA, "b2": b2 / INERTIA, "c1": (2.0 * math.pi / 20.0) ** 2}
    return virtual_decay(VirtualDecay(terms, math.radians(7.0), cycles=10.0, samples_a_cycle=40.0)).record


def errors(fit, b1, b2):
    return fit["b1"] * INERTIA / b1 - 1.0, fit["b2"] * INERTIA / b2 - 1.0


@pytest.mark.parametrize("gamma", [1e6, 1e8])
@pytest.mark.parametrize(("b1", "b2"), [(6.0e8, 4.0e7), (3.38e8, 3.55e7)])
def test_published_method_in_degrees_is_as_good_as_its_paper(b1, b2, gamma):
    fit = fit_nls_svm(synthetic(b1, b2 * PER_DEGREE), gamma=gamma, **PUBLISHED)
    first, second = errors(fit, b1, b2 * PER_DEGREE)
    assert abs(first) < 0.003
    assert abs(second) < 0.01
    assert fit.method == "NLS-SVM, as published"


@pytest.mark.parametrize("unit", [1.0, PER_DEGREE])
@pytest.mark.parametrize(("b1", "b2"), [(6.0e8, 4.0e7), (3.38e8, 3.55e7)])
def test_averaged_method_finds_both_terms_in_radians_too(b1, b2, unit):
    fit = fit_nls_svm(synthetic(b1, b2 * unit))
    first, second = errors(fit, b1, b2 * unit)
    assert abs(first) < 1e-4
    assert abs(second) < 2e-3
    assert fit.omega_n == pytest.approx(math.pi / 10.0, rel=1e-6)
    assert fit.diagnostics.details["sigma"] == [pytest.approx(5.0, rel=0.01)]


def test_in_radians_the_published_method_loses_the_quadratic_term():
    fit = fit_nls_svm(synthetic(6.0e8, 4.0e7), gamma=1e6, **PUBLISHED)
    first, second = errors(fit, 6.0e8, 4.0e7)
    assert abs(first) < 0.003
    assert abs(second) > 0.1


def test_strong_smoothing_spoils_the_published_method():
    fit = fit_nls_svm(synthetic(6.0e8, 4.0e7 * PER_DEGREE), gamma=100.0, **PUBLISHED)
    assert abs(errors(fit, 6.0e8, 4.0e7 * PER_DEGREE)[1]) > 0.01


NOISY = VirtualDecay(
    {"b1": 0.0084, "b2": 0.11, "c1": 6.06},
    math.radians(15.0),
    cycles=16.0,
    samples_a_cycle=50.0,
    ar1=math.radians(0.2),
    correlation_time=0.2,
)


@pytest.fixture(scope="module")
def fits():
    records = [virtual_decay(replace(NOISY, seed=seed)).record for seed in range(12)]
    return [fit_nls_svm(record, gamma=3.0) for record in records]


def test_intervals_of_equivalent_damping_hold_the_truth(fits):
    amplitude = np.radians([4.0, 7.0, 11.0])
    truth = 0.0042 + 4.0 / (3.0 * math.pi) * math.sqrt(6.06) * amplitude * 0.11
    scores = np.array(
        [(one.equivalent(amplitude).alpha - truth) / one.equivalent(amplitude).alpha_sd for one in fits]
    )
    assert 0.6 < scores.std() < 1.5
    assert abs(scores.mean()) < 0.7


def test_terms_trade_against_each_other(fits):
    assert all(one.linear_quadratic_correlation < -0.95 for one in fits)
    assert all(one.diagnostics.r2 > 0.99 for one in fits)


def test_noise_biases_the_published_form(fits):
    records = [virtual_decay(replace(NOISY, seed=seed)).record for seed in range(12)]
    plain = [fit_nls_svm(one, gamma=3.0, average=0.0, instruments=False) for one in records]
    amplitude = math.radians(4.0)
    truth = 0.0042 + 4.0 / (3.0 * math.pi) * math.sqrt(6.06) * amplitude * 0.11
    off = [np.mean([one.equivalent(amplitude).alpha[0] for one in group]) / truth - 1.0 for group in (fits, plain)]
    assert abs(off[0]) < 0.05
    assert abs(off[1]) > 2.0 * abs(off[0])


def test_gamma_and_sigma_by_leave_one_out():
    record = virtual_decay(replace(NOISY, ar1=0.0, white=math.radians(0.1))).record
    curve = curve_of(record, sigma="loo")
    assert curve.choice is not None
    assert 0.03 * record.period < curve.sigma < 2.0 * record.period
    given = curve_of(record, gamma=5.0, sigma=0.5)
    assert (given.gamma, given.sigma) == (5.0, 0.5)
    assert given.choice is None


def test_several_records_share_their_terms():
    one = virtual_decay(replace(NOISY, ar1=0.0)).record
    two = virtual_decay(replace(NOISY, ar1=0.0, amplitude=math.radians(-8.0))).record
    fit = fit_nls_svm([one, two], gamma=1e6)
    assert len(fit.runs) == 2
    assert fit["b2"] == pytest.approx(0.11, rel=5e-3)


def test_other_models():
    plan = VirtualDecay({"b1": 0.02, "b3": 0.2, "c1": 6.0, "c3": -2.0}, math.radians(20.0))
    fit = fit_nls_svm(virtual_decay(plan).record, damping_model("linear+cubic", "cubic"))
    assert dict(zip(fit.names, fit.params)) == pytest.approx(dict(plan.coefficients), rel=0.01)


def test_uneven_times_are_resampled():
    record = virtual_decay(replace(NOISY, ar1=0.0)).record
    uneven = replace(record, time=record.time + 0.001 * np.sin(37.0 * record.time))
    even = uniform(uneven)
    assert np.diff(even.time) == pytest.approx(np.full(len(record) - 1, record.time_step), rel=1e-3)
    assert "resampled" in even.steps[-1]
    assert uniform(record) is record


def test_short_records_are_refused():
    record = virtual_decay(replace(NOISY, ar1=0.0, cycles=3.0)).record
    with pytest.raises(FitError, match="between the trimmed ends"):
        fit_nls_svm(record, trim=1.3, gamma=1e6)


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [0.05, 0.5])
def test_coverage_of_equivalent_damping_in_autocorrelated_noise(degrees):
    """300 records: the 95 % intervals hold the truth in 92 to 97 %."""
    amplitude = np.radians([3.0, 5.0, 8.0])
    truth = 0.0042 + 4.0 / (3.0 * math.pi) * math.sqrt(6.06) * amplitude * 0.11
    plan = replace(NOISY, cycles=14.0, samples_a_cycle=30.0, ar1=math.radians(degrees))
    held = []
    for seed in range(300):
        at = fit_nls_svm(virtual_decay(replace(plan, seed=seed)).record).equivalent(amplitude)
        held.append((at.alpha_lower < truth) & (truth < at.alpha_upper))
    assert 0.92 <= np.mean(held) <= 0.97
