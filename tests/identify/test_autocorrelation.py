from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.autocorrelation import (
    effective_size,
    integrated_time,
    long_run_variance,
    long_run_variances,
    mean_with_error,
)

Noise = Callable[..., np.ndarray]


@pytest.mark.parametrize(("n", "rho"), [(500, 0.0), (500, 0.8), (500, 0.95), (1500, 0.5), (6000, 0.95)])
def test_interval_of_the_mean_covers(ar1: Noise, n: int, rho: float) -> None:
    x = ar1(np.random.default_rng(3), rho, n, 1200)
    lower, upper = mean_with_error(x).conf_int()
    coverage = np.mean((lower <= 0.0) & (upper >= 0.0))
    assert 0.93 <= coverage <= 0.97


@pytest.mark.parametrize("rho", [0.0, 0.5, 0.9])
def test_integrated_time_of_ar1(ar1: Noise, rho: float) -> None:
    x = ar1(np.random.default_rng(0), rho, 4000, 30)
    times = [integrated_time(column) for column in x.T]
    assert np.median(times) == pytest.approx((1.0 + rho) / (1.0 - rho), rel=0.12)
    assert min(times) >= 1.0
    assert effective_size(x[:, 0]) == pytest.approx(4000 / times[0], rel=1e-12)


def test_alternating_noise_is_not_given_more_samples_than_it_has(ar1: Noise) -> None:
    x = ar1(np.random.default_rng(1), -0.7, 1000, 1)[:, 0]
    assert integrated_time(x) == 1.0
    assert mean_with_error(x).se == pytest.approx(x.std(ddof=1) / np.sqrt(1000))


def test_many_channels_agree_with_one_at_a_time(ar1: Noise) -> None:
    x = ar1(np.random.default_rng(2), 0.7, 900, 3)
    together = mean_with_error(x)
    for j in range(3):
        alone = mean_with_error(x[:, j])
        for field in ("mean", "se", "n_eff", "tau", "dof"):
            assert getattr(together, field)[j] == pytest.approx(getattr(alone, field), rel=1e-9)
    densities = long_run_variances(x, [0.0, 0.01])
    assert densities.shape == (2, 3)
    # The block length follows the highest frequency asked; here one sample a block either way.
    assert densities[1, 2] == pytest.approx(long_run_variance(x[:, 2], 0.01), rel=1e-9)


def test_constant_channel_is_flagged() -> None:
    estimate = mean_with_error(np.full(50, 3.1))
    assert (estimate.mean, estimate.se, estimate.n_eff, estimate.constant) == (3.1, 0.0, 1.0, True)


def test_long_run_variance_predicts_the_scatter_of_a_harmonic(ar1: Noise) -> None:
    n, rho, f = 1000, 0.8, 0.01
    x = ar1(np.random.default_rng(7), rho, n, 800)
    cosine = np.cos(2.0 * np.pi * f * np.arange(n))
    scatter = (2.0 / n * cosine @ x).var()
    density = np.mean([long_run_variance(column, f) for column in x.T[:60]])
    assert 2.0 * density / n == pytest.approx(scatter, rel=0.15)
    assert density == pytest.approx(1.0 / np.abs(1.0 - rho * np.exp(-2j * np.pi * f)) ** 2, rel=0.1)


def test_one_sample_has_a_mean_without_error() -> None:
    estimate = mean_with_error(np.array([2.0]))
    assert estimate.mean == 2.0
    assert np.isnan(estimate.se)


def test_gaps_are_refused() -> None:
    with pytest.raises(FitError, match="not finite"):
        mean_with_error(np.array([1.0, np.nan]))
