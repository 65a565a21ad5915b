from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.stationarity import is_stationary, remaining_drift, stationarity

Noise = Callable[..., np.ndarray]
N = 3000
T = 0.02 * np.arange(N)


def test_slow_noise_is_not_called_drift(ar1: Noise) -> None:
    alarms = [not is_stationary(T, 10.0 + ar1(np.random.default_rng(s), 0.95, N, 2)) for s in range(100)]
    assert np.mean(alarms) <= 0.05


def test_drift_error_matches_the_scatter(ar1: Noise) -> None:
    verdict = stationarity(T[:1000], ar1(np.random.default_rng(1), 0.8, 1000, 400))
    assert np.mean(verdict.drift_se) == pytest.approx(np.std(verdict.drift), rel=0.12)


def test_exact_trend_and_exact_constant() -> None:
    assert not stationarity(T[:100], T[:100]).stationary
    verdict = stationarity(T[:100], np.full(100, 2.0))
    assert verdict.stationary
    assert verdict.p_value == (1.0,)


def test_remaining_drift_of_an_exponential_approach(ar1: Noise) -> None:
    """Truth: level less mean of the window; the claimed error matches the scatter of 100 records."""
    truth = -3.0 * np.exp(-T / 25.0).mean()
    found = [
        remaining_drift(T, 7.0 + 0.1 * ar1(np.random.default_rng(s), 0.8, N, 1)[:, 0] + 3.0 * np.exp(-T / 25.0))
        for s in range(100)
    ]
    values, errors = np.array([f.value for f in found]), np.array([f.se for f in found])
    assert np.median(values) == pytest.approx(truth, rel=0.1)
    within = np.mean(np.abs(values - truth) < 2.0 * errors)
    assert within > 0.85
    assert np.median([f.time_constant for f in found]) == pytest.approx(25.0, rel=0.2)


def test_remaining_drift_without_noise_is_exact() -> None:
    found = remaining_drift(T, 7.0 + 3.0 * np.exp(-T / 20.0))
    assert found.value == pytest.approx(-3.0 * np.exp(-T / 20.0).mean(), rel=1e-3)
    assert found.time_constant == pytest.approx(20.0, rel=1e-3)


def test_a_line_has_no_bend() -> None:
    x = 1.0 + 0.05 * T + 0.01 * np.random.default_rng(0).standard_normal(N)
    found = remaining_drift(T, x)
    assert np.isinf(found.time_constant)
    assert found.value == pytest.approx(0.05 * (T[-1] - T[0]), rel=0.01)
    assert found.significance > 50.0


def test_noise_has_no_significant_remaining_drift(ar1: Noise) -> None:
    found = [remaining_drift(T, ar1(np.random.default_rng(s), 0.9, N, 1)[:, 0]) for s in range(60)]
    assert np.mean([f.significance > 3.0 and f.gain > 16.0 for f in found]) < 0.05


def test_constant_record_drifts_nowhere() -> None:
    found = remaining_drift(T, np.full(N, 4.0))
    assert (found.value, found.se, found.significance) == (0.0, 0.0, 0.0)
    with pytest.raises(FitError, match="too few"):
        remaining_drift(T[:5], T[:5])
