"""Joint fit at sea: twin record, noise, the refusal of single oscillations, what is not identified."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.at_sea import SHIP_TERMS, fit_roll_at_sea
from towtank.decay.excited_roll import Excitation, simulate_excited_roll

SHIP = {"b1": 0.080, "b3": 0.256, "c1": 11.88, "c3": 1.758, "c5": -18.624}


def oscillations_at_sea(count: int, *, seed: int = 0, size: float = 1.2) -> tuple[np.ndarray, np.ndarray]:
    """Time and angle of so many oscillations from upward crossing to upward crossing."""
    rng = np.random.default_rng(seed)
    rate = math.sqrt(SHIP["c1"])
    state = (0.001, 1.0)
    times, angles = [np.zeros(1)], [np.array([state[0]])]
    local = np.arange(0.0, 6.0 * math.pi / rate, 0.02)
    for _ in range(count):
        wave = Excitation(
            size * rng.uniform(0.5, 1.5), rate * rng.uniform(0.7, 1.3), rng.uniform(0.0, 6.28), 0.1 * rng.normal()
        )
        path = simulate_excited_roll(local, state, SHIP, wave)
        upward = np.flatnonzero((path[:-1, 0] < 0.0) & (path[1:, 0] >= 0.0)) + 1
        last = int(upward[upward > 3][0])
        times.append(times[-1][-1] + local[1 : last + 1])
        angles.append(path[1 : last + 1, 0])
        state = (float(path[last, 0]), float(path[last, 1]))
    return np.concatenate(times), np.concatenate(angles)


GUESS = {name: SHIP[name] * factor for name, factor in zip(SHIP, (1.5, 0.6, 1.05, 0.5, 0.7))}


@pytest.fixture(scope="module")
def record():
    return oscillations_at_sea(12)


@pytest.fixture(scope="module")
def clean(record):
    return fit_roll_at_sea(*record, guess=GUESS, level=0.0)


def test_all_five_terms_come_back_from_a_clean_record(clean):
    assert clean.converged
    assert dict(zip(clean.names, clean.params)) == pytest.approx(SHIP, rel=1e-5)
    assert clean.r2 > 1.0 - 1e-12
    assert np.abs(clean.amplitude_error).max() < 1e-8
    assert clean.findings == ()
    assert clean.names == SHIP_TERMS


def test_excitations_come_back_too(record, clean):
    assert len(clean.excitations) == len(clean.amplitude_error) == 11
    rng = np.random.default_rng(0)
    draws = [(1.2 * rng.uniform(0.5, 1.5), rng.uniform(0.7, 1.3), rng.uniform(), rng.normal()) for _ in range(12)]
    # The first oscillation starts at the first crossing after the first sample.
    assert clean.excitations["f"].to_numpy() == pytest.approx([draw[0] for draw in draws[1:]], rel=1e-3)
    frequency = math.sqrt(SHIP["c1"]) * np.array([draw[1] for draw in draws[1:]])
    assert clean.excitations["we"].to_numpy() == pytest.approx(frequency, rel=1e-3)


def test_excitations_imitate_nearly_all_of_each_term(clean):
    """Why one oscillation does not do: a thousandth of each effect is the ship's own."""
    assert all(1e-5 < share < 0.01 for share in clean.own_share.values())


def test_intervals_of_a_noisy_record_hold_the_truth(record):
    time, angle = record
    noise = math.radians(0.02)
    noisy = angle + noise * np.random.default_rng(3).standard_normal(angle.size)
    fit = fit_roll_at_sea(time, noisy, guess=GUESS, noise=noise, level=0.0)
    limits = fit.conf_int(0.999)
    assert all(low < SHIP[name] < high for name, (low, high) in zip(fit.names, limits))
    assert fit.bse[2] / fit.params[2] < 0.01
    assert fit.r2 > 0.9999


def test_terms_below_the_noise_are_flagged(record):
    time, angle = record
    noise = math.radians(0.2)
    noisy = angle + noise * np.random.default_rng(3).standard_normal(angle.size)
    fit = fit_roll_at_sea(time, noisy, guess=GUESS, noise=0.0, level=0.0)
    assert "c3" in [finding.place for finding in fit.findings if finding.rule == "not-identified"]


def test_nine_parameters_of_one_near_harmonic_oscillation_are_refused():
    time = np.arange(0.0, 200.0, 0.02)
    angle = simulate_excited_roll(time, (0.0, 0.0), SHIP, Excitation(0.3, 3.0))[:, 0]
    late = angle[-400:]
    up = np.flatnonzero((late[:-1] < 0.0) & (late[1:] >= 0.0)) + 1
    one = slice(up[0] - 2, up[1] + 3)
    with pytest.raises(
        FitError, match=r"9 parameters .* one near-harmonic oscillation determines 3 numbers.*c1 trades"
    ):
        fit_roll_at_sea(time[-400:][one], late[one], guess=GUESS, level=0.0)


def test_many_near_harmonic_oscillations_are_refused_too():
    time = np.arange(0.0, 200.0, 0.02)
    angle = simulate_excited_roll(time, (0.0, 0.0), SHIP, Excitation(0.3, 3.0))[:, 0]
    with pytest.raises(FitError, match=r"parameters are asked of a record in which \d+ oscillations determine"):
        fit_roll_at_sea(time[-4000:], angle[-4000:], guess=GUESS, level=0.0)


def test_known_terms_can_be_held(record):
    fit = fit_roll_at_sea(*record, guess={**SHIP, "b1": 0.15, "c1": 11.0}, terms=("b1", "c1"), level=0.0)
    assert fit.names == ("b1", "c1")
    # The bold search ends in a hollow with many times the damping.
    assert fit.params == pytest.approx([SHIP["b1"], SHIP["c1"]], rel=1e-5)


def test_one_search_alone_is_not_trusted(record, monkeypatch):
    monkeypatch.setattr("towtank.decay.at_sea._CAUTION", (1e-3,))
    time, angle = record
    noisy = angle + math.radians(0.02) * np.random.default_rng(3).standard_normal(angle.size)
    fit = fit_roll_at_sea(time, noisy, guess=GUESS, level=0.0)
    assert "several-minima" in [finding.rule for finding in fit.findings]


def test_a_bad_guess_does_not_end_in_silence(record):
    time, angle = record
    noisy = angle + math.radians(0.02) * np.random.default_rng(3).standard_normal(angle.size)
    fit = fit_roll_at_sea(time, noisy, guess={**SHIP, "b1": 0.5, "c1": 14.0}, terms=("b1", "c1"), level=0.0)
    astray = abs(fit["c1"] / SHIP["c1"] - 1.0) > 0.01
    assert not astray or {"no-convergence", "several-minima"} & {finding.rule for finding in fit.findings}


def test_bad_requests_are_refused(record):
    with pytest.raises(FitError, match="no term 'b7'"):
        fit_roll_at_sea(*record, guess={**GUESS, "b7": 1.0})
    with pytest.raises(FitError, match="rough c1"):
        fit_roll_at_sea(*record, guess={"b1": 0.1})
