from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.autocorrelation import mean_with_error
from towtank.identify.transient import transient_cut, transient_ends

Noise = Callable[..., np.ndarray]


def stationary(ar1: Noise, rng: np.random.Generator, rho: float, n: int) -> np.ndarray:
    """AR(1) noise of unit standard deviation."""
    return np.sqrt(1.0 - rho**2) * ar1(rng, rho, n, 1)[:, 0]


def test_a_ramp_is_never_kept(ar1: Noise) -> None:
    """200 ramps of 2-50 % of the record, 3 to 1000 standard deviations high, in noise of every colour."""
    rng = np.random.default_rng(3)
    kept = []
    for _ in range(200):
        n, share = int(rng.integers(400, 4000)), rng.uniform(0.02, 0.5)
        height = 10.0 ** rng.uniform(np.log10(3.0), 3.0) * rng.choice([-1.0, 1.0])
        x = stationary(ar1, rng, rng.choice([0.0, 0.5, 0.8, 0.9]), n)
        length = int(share * n)
        x[:length] += height * (1.0 - np.arange(length) / length)
        if transient_cut(x).first < length:
            kept.append((n, length, height))
    assert kept == []


def test_little_is_cut_beyond_a_ramp(ar1: Noise) -> None:
    beyond = []
    for seed in range(40):
        x = 0.1 * stationary(ar1, np.random.default_rng(seed), 0.8, 2000)
        x[:600] += np.linspace(-5.0, 0.0, 600)
        beyond.append(transient_cut(x).first - 600)
    assert min(beyond) >= 0
    assert np.mean(beyond) < 60


@pytest.mark.parametrize(("n", "rho"), [(1000, 0.0), (1000, 0.9), (3000, 0.95)])
def test_interval_behind_the_cut_covers(ar1: Noise, n: int, rho: float) -> None:
    """500 series without a transient: what is cut by chance must not spoil the error of the mean."""
    covered = 0
    for x in ar1(np.random.default_rng(5), rho, n, 500).T:
        lower, upper = mean_with_error(x[transient_cut(x).first :]).conf_int()
        covered += bool(lower <= 0.0 <= upper)
    assert 0.92 <= covered / 500 <= 0.97


def test_interval_behind_a_ramp_covers(ar1: Noise) -> None:
    rng = np.random.default_rng(11)
    covered = 0
    for x in ar1(rng, 0.8, 2000, 500).T:
        length = int(rng.uniform(100, 700))
        x[:length] += rng.uniform(5.0, 100.0) * np.linspace(1.0, 0.0, length)
        lower, upper = mean_with_error(x[transient_cut(x).first :]).conf_int()
        covered += bool(lower <= 0.0 <= upper)
    assert 0.92 <= covered / 500 <= 0.97


def test_stationary_noise_is_hardly_ever_cut(ar1: Noise) -> None:
    cuts = [transient_cut(x).first for x in ar1(np.random.default_rng(1), 0.9, 2000, 200).T]
    assert np.mean(np.array(cuts) > 0) < 0.05


def test_the_slowest_channel_decides(ar1: Noise) -> None:
    x = 0.05 * ar1(np.random.default_rng(0), 0.5, 2000, 2)
    x[:300, 0] += np.linspace(5.0, 0.0, 300)
    x[:700, 1] += np.linspace(5.0, 0.0, 700)
    both = transient_cut(x)
    assert both.first >= 700 > transient_cut(x[:, 0]).first >= 300
    assert both.first == max(both.mser, both.ramp)


def test_oscillating_start_is_cut(ar1: Noise) -> None:
    t = np.arange(2000)
    x = 0.02 * ar1(np.random.default_rng(2), 0.5, 2000, 1)[:, 0] + 5.0 * np.exp(-t / 80.0) * np.cos(t / 12.0)
    first = transient_cut(x).first
    assert np.abs(x[first:]).max() < 0.2


def test_a_quiet_record_is_cut_where_the_rest_is_harmless() -> None:
    t = np.arange(2000)
    x = 10.0 + 5.0 * np.exp(-t / 100.0)
    strict, tolerant = transient_cut(x), transient_cut(x, tolerance=0.1)
    assert np.abs(x[tolerant.first :] - 10.0).max() < 0.1
    assert tolerant.first < 600 < strict.first


def test_a_transient_that_fills_the_record_is_at_the_limit() -> None:
    x = np.maximum(0.0, 1.0 - np.arange(1000) / 980.0)
    x += 1e-3 * np.random.default_rng(0).standard_normal(1000)
    assert transient_cut(x).at_limit


def test_constant_and_short_records() -> None:
    assert transient_cut(np.full(500, 2.5)).first == 0
    with pytest.raises(FitError, match="7 samples"):
        transient_cut(np.zeros(7))
    with pytest.raises(FitError, match="not finite"):
        transient_cut(np.array([1.0, np.nan] * 10))


def test_steady_noise_is_hardly_cut(ar1: Noise) -> None:
    kept = []
    for seed in range(20):
        first, last = transient_ends(ar1(np.random.default_rng(seed), 0.9, 2000, 2))
        kept.append((last - first) / 2000)
    assert np.mean(kept) > 0.95


def test_constant_record_is_kept_whole() -> None:
    assert transient_ends(np.ones((777, 2))) == (0, 777)
