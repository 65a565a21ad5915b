from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.autocorrelation import mean_with_error
from towtank.identify.batch_means import batch_means, running_mean

Noise = Callable[..., np.ndarray]


@pytest.mark.parametrize("rho", [0.0, 0.9])
def test_interval_of_batch_means_covers(ar1: Noise, rho: float) -> None:
    covered = 0
    for x in ar1(np.random.default_rng(4), rho, 3000, 500).T:
        lower, upper = batch_means(x).conf_int()
        covered += lower <= 0.0 <= upper
    assert 0.92 <= covered / 500 <= 0.97


def test_batch_means_agree_with_the_autocorrelation(ar1: Noise) -> None:
    x = ar1(np.random.default_rng(8), 0.8, 4000, 60)
    ratio = [batch_means(column).se / mean_with_error(column).se for column in x.T]
    assert np.mean(ratio) == pytest.approx(1.0, abs=0.08)


def test_batches_shorter_than_the_memory_show_in_the_lag(ar1: Noise) -> None:
    x = ar1(np.random.default_rng(2), 0.995, 2000, 1)[:, 0]
    assert batch_means(x, batches=100).lag_one > 0.4
    assert abs(batch_means(np.random.default_rng(2).standard_normal(2000)).lag_one) < 0.5


def test_known_batches() -> None:
    result = batch_means(np.repeat([1.0, 3.0], 10), batches=2)
    assert result.means.tolist() == [1.0, 3.0]
    assert (result.mean, result.se, result.dof) == (2.0, 1.0, 1)
    with pytest.raises(FitError, match="batch means"):
        batch_means(np.zeros(3))


def test_running_mean_ends_at_the_mean() -> None:
    x = np.random.default_rng(0).standard_normal((50, 2))
    result = running_mean(x)
    np.testing.assert_allclose(result[-1], x.mean(axis=0))
    np.testing.assert_allclose(running_mean(x[:, 0])[:3], [x[0, 0], x[:2, 0].mean(), x[:3, 0].mean()])
