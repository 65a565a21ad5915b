from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.cycle_convergence import cycle_convergence, phase_average

OMEGA = 2.0 * np.pi / 1.7
T = 0.01 * np.arange(2040)
PERIODIC = 3.0 + 2.0 * np.cos(OMEGA * T + 0.4) + 0.5 * np.sin(2.0 * OMEGA * T)


def test_harmonics_of_each_cycle() -> None:
    result = cycle_convergence(T, PERIODIC, OMEGA)
    assert result.cycles == 12
    np.testing.assert_allclose(result.coefficients[:, 0], 3.0, atol=1e-9)
    np.testing.assert_allclose(result.amplitude, np.tile([2.0, 0.5, 0.0], (12, 1)), atol=1e-9)
    np.testing.assert_allclose(result.phase[:, 0], 0.4, atol=1e-9)
    assert (result.drop, result.converged) == (0, True)
    assert abs(result.remaining) < 1e-9


@pytest.mark.parametrize("decay", [0.5, 1.5])
def test_cycles_of_a_transient_are_dropped(decay: float) -> None:
    noise = 0.01 * np.random.default_rng(0).standard_normal(T.size)
    result = cycle_convergence(T, PERIODIC + 4.0 * np.exp(-T / decay) + noise, OMEGA)
    left = 4.0 * np.exp(-result.start_time / decay)
    assert 1 <= result.drop <= 8
    assert left < 0.1
    assert result.converged
    frame = result.to_frame()
    assert frame["kept"].sum() == 12 - result.drop
    assert list(frame.columns[:4]) == ["cycle", "start", "kept", "mean"]


def test_an_amplitude_that_still_grows_is_told_with_its_rest() -> None:
    growing = 2.0 * (1.0 - np.exp(-T / 10.0)) * np.cos(OMEGA * T)
    result = cycle_convergence(T, growing, OMEGA)
    assert not result.converged
    # Rest after the middle of the last cycle.
    truth = 2.0 * np.exp(-(T[-1] - 0.85) / 10.0)
    assert result.remaining == pytest.approx(truth, rel=0.15)


@pytest.mark.parametrize("drift", [1.0, 3.0])
def test_a_mean_that_drifts_is_no_scatter(drift: float) -> None:
    noise = 0.01 * np.random.default_rng(0).standard_normal(T.size)
    result = cycle_convergence(T, PERIODIC + drift * T / T[-1] + noise, OMEGA)
    assert not result.converged
    assert result.trend[0] == pytest.approx(drift * 5.0 / 12.0, abs=0.05)
    assert result.trend[0] > 10.0 * result.trend_se[0]


def test_drift_is_found_in_a_few_cycles() -> None:
    noise = 0.01 * np.random.default_rng(0).standard_normal(850)
    few = slice(0, 850)
    steady = cycle_convergence(T[few], PERIODIC[few] + noise, OMEGA)
    moving = cycle_convergence(T[few], PERIODIC[few] + 0.05 * T[few] + noise, OMEGA)
    assert steady.cycles == 5
    assert steady.converged
    assert not moving.converged


def test_tolerance_decides_what_matters() -> None:
    growing = 3.0 + 2.0 * (1.0 - 0.5 * np.exp(-T / 2.0)) * np.cos(OMEGA * T)
    strict = cycle_convergence(T, growing, OMEGA, tolerance=1e-4)
    loose = cycle_convergence(T, growing, OMEGA, tolerance=0.2)
    assert loose.drop < strict.drop
    assert loose.converged


def test_phase_average_of_a_known_cycle() -> None:
    noise = 0.1 * np.random.default_rng(1).standard_normal(T.size)
    result = phase_average(T, PERIODIC + noise, OMEGA, drop=2)
    assert result.cycles == 10
    expected = 3.0 + 2.0 * np.cos(result.phase + 0.4) + 0.5 * np.sin(2.0 * result.phase)
    np.testing.assert_allclose(result.mean, expected, atol=0.12)
    assert 0.03 < np.median(result.sd) < 0.15


def test_phase_average_of_a_changing_time_step() -> None:
    steps = np.random.default_rng(2).uniform(0.002, 0.02, 1800)
    t = np.cumsum(steps)
    result = phase_average(t, np.cos(OMEGA * t), OMEGA)
    np.testing.assert_allclose(result.mean, np.cos(result.phase), atol=5e-3)


def test_too_little_to_judge_is_refused() -> None:
    with pytest.raises(FitError, match="less than two"):
        cycle_convergence(T[:200], PERIODIC[:200], OMEGA)
    with pytest.raises(FitError, match="too few for 3 harmonics"):
        cycle_convergence(T[::40], PERIODIC[::40], OMEGA)
    with pytest.raises(FitError, match="no whole cycle"):
        phase_average(T, PERIODIC, OMEGA, drop=12)
    with pytest.raises(FitError, match="not positive"):
        cycle_convergence(T, PERIODIC, 0.0)
