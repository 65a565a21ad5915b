from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.settling import VERDICTS, natural_frequency, settle

Noise = Callable[..., np.ndarray]
N = 2000
T = 0.01 * np.arange(N)


def noise(ar1: Noise, seed: int, size: float = 0.1, rho: float = 0.8) -> np.ndarray:
    return size * ar1(np.random.default_rng(seed), rho, N, 1)[:, 0]


def test_settled_mean_covers_the_truth(ar1: Noise) -> None:
    covered, verdicts = 0, []
    for seed in range(300):
        x = 10.0 + noise(ar1, seed, rho=0.9) + 5.0 * np.exp(-T)
        result = settle(T, x)
        assert result.cut_time > 2.0
        channel = result.channels[0]
        verdicts.append(channel.verdict)
        covered += abs(channel.mean - 10.0) <= channel.half_width()
    assert verdicts.count("settled") >= 294
    assert 0.92 <= covered / 300 <= 0.97


def test_slow_approach_is_still_drifting_and_says_where_to(ar1: Noise) -> None:
    for seed in range(10):
        x = 10.0 + noise(ar1, seed) + 5.0 * np.exp(-T / 10.0)
        channel = settle(T, x).channels[0]
        assert channel.verdict == "still drifting"
        assert channel.drift == pytest.approx(10.0 - channel.mean, abs=4.0 * channel.drift_se)
        assert channel.drift_se < 0.4 * abs(channel.drift)
        assert "would still change" in channel.note or "without a bend" in channel.note
        assert channel.standard_uncertainty > abs(channel.drift)


def test_straight_drift_has_no_bend(ar1: Noise) -> None:
    channel = settle(T, 10.0 + noise(ar1, 3) + 0.05 * T).channels[0]
    assert channel.verdict == "still drifting"
    assert "without a bend" in channel.note


def test_converged_series_without_noise_is_settled() -> None:
    result = settle(np.arange(N), 10.0 + 5.0 * np.exp(-np.arange(N) / 100.0))
    channel = result.channels[0]
    assert result.verdict == "settled"
    assert channel.mean == pytest.approx(10.0, abs=0.1)
    assert channel.standard_uncertainty >= 0.9 * abs(channel.mean - 10.0)


def test_natural_period_is_found_and_averaged_over_whole_cycles(ar1: Noise) -> None:
    x = 10.0 + noise(ar1, 1, 0.05) + 2.0 * np.cos(2.0 * np.pi * T / 1.7) + 5.0 * np.exp(-T)
    result = settle(T, x)
    channel = result.channels[0]
    assert result.verdict == "periodic"
    assert result.omega == pytest.approx(2.0 * np.pi / 1.7, rel=1e-3)
    assert channel.amplitude == pytest.approx(2.0, abs=0.05)
    assert channel.mean == pytest.approx(10.0, abs=0.05)
    assert channel.cycles is not None
    assert channel.cycles.drop >= 1


def test_forced_motion_whose_amplitude_still_grows() -> None:
    x = 2.0 * np.cos(np.pi * T) * (1.0 - np.exp(-T / 10.0))
    result = settle(T, x, omega=np.pi)
    assert result.verdict == "still drifting"
    assert result.channels[0].drift > 0.1


def test_periodic_run_whose_mean_drifts() -> None:
    x = 5.0 * np.cos(np.pi * T) + 0.1 * T + 0.02 * np.random.default_rng(0).standard_normal(N)
    channel = settle(T, x, omega=np.pi).channels[0]
    assert channel.verdict == "still drifting"
    assert "the mean of a cycle changed by" in channel.note


def test_steady_forces_of_a_forced_motion_are_converged_cycles(ar1: Noise) -> None:
    x = np.column_stack([10.0 + noise(ar1, 5), 5.0 * np.cos(np.pi * T) + noise(ar1, 6, 0.05), np.zeros(N)])
    result = settle(T, x, omega=np.pi)
    assert [channel.verdict for channel in result.channels] == ["periodic"] * 3
    assert result.channels[1].amplitude == pytest.approx(5.0, abs=0.05)


def test_noise_is_not_taken_for_a_period(ar1: Noise) -> None:
    found = [natural_frequency(T, noise(ar1, seed, 1.0, 0.95)) for seed in range(100)]
    assert sum(value is not None for value in found) <= 2


def test_diverged_run_gives_no_mean() -> None:
    x = np.column_stack([10.0 + np.exp(5.0 * (T - 18.0)), np.ones(N)])
    x[1950:, 0] = np.nan
    result = settle(T, x)
    assert result.verdict == "diverged"
    assert all(np.isnan(channel.mean) for channel in result.channels)
    assert "19.5" in result.channels[0].note
    assert "another channel" in result.channels[1].note


def test_short_runs(ar1: Noise) -> None:
    assert settle(T[:30], np.ones(30)).verdict == "too short"
    slow = 10.0 + 2.0 * np.random.default_rng(0).standard_normal(N).cumsum() / 10.0
    assert settle(T[:80], slow[:80]).verdict in ("too short", "still drifting")


def test_verdict_of_a_run_is_that_of_its_worst_channel(ar1: Noise) -> None:
    x = np.column_stack([10.0 + noise(ar1, 0), 10.0 + noise(ar1, 1) + 0.2 * T])
    result = settle(T, x)
    assert [channel.verdict for channel in result.channels] == ["settled", "still drifting"]
    assert result.verdict == "still drifting"
    assert set(VERDICTS) >= {channel.verdict for channel in result.channels}
    waived = settle(T, x, tolerance=[0.5, 50.0])
    assert waived.verdict == "settled"


def test_given_start_and_uneven_steps(ar1: Noise) -> None:
    x = 10.0 + noise(ar1, 2)
    result = settle(T, x, start=12.0)
    assert result.cut_time == pytest.approx(12.0)
    uneven = np.cumsum(np.random.default_rng(0).uniform(0.005, 0.02, N))
    assert settle(uneven, x).interpolated
    with pytest.raises(FitError, match="behind the cut"):
        settle(T, x, start=19.9)
    with pytest.raises(FitError, match="rows"):
        settle(T, x[:-1])
