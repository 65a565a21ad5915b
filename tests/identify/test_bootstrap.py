from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.bootstrap import BootstrapResult, block_bootstrap
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(0)
G = 30
GROUPS = np.repeat(np.arange(G), 6)
N = GROUPS.size
X = np.column_stack([np.ones(N), RNG.uniform(-0.3, 0.3, G)[GROUPS], RNG.standard_normal(N)])
Y = X @ [0.1, -0.3, 0.05] + 0.05 * RNG.standard_normal(G)[GROUPS] + 0.02 * RNG.standard_normal(N)
W = RNG.uniform(0.5, 2.0, N)


def ols(design: np.ndarray, response: np.ndarray) -> np.ndarray:
    return np.linalg.lstsq(design, response, rcond=None)[0]


@pytest.mark.parametrize("weights", [None, W], ids=["plain", "weighted"])
def test_sums_of_runs_equal_refitting_the_drawn_rows(weights) -> None:
    fast = block_bootstrap(X, Y, GROUPS, n=50, seed=3, weights=weights)
    slow = block_bootstrap(X, Y, GROUPS, fit=ols, n=50, seed=3, weights=weights)
    np.testing.assert_allclose(fast.replicates, slow.replicates, rtol=1e-8, atol=1e-11)
    np.testing.assert_allclose(fast.jackknife, slow.jackknife, rtol=1e-8, atol=1e-11)
    np.testing.assert_allclose(fast.params, slow.params, rtol=1e-10)


def test_errors_agree_with_clustered_ones_and_exceed_independent_ones() -> None:
    result = block_bootstrap(X, Y, GROUPS, n=2000, seed=1, names=["a", "b", "c"])
    clustered = fit_linear(X, Y, ["a", "b", "c"], groups=GROUPS, covariance="cluster")
    np.testing.assert_allclose(result.bse[:2], clustered.bse[:2], rtol=0.2)
    assert result.bse[0] > 1.5 * fit_linear(X, Y, ["a", "b", "c"]).bse[0]


def test_same_seed_same_replicates() -> None:
    first, second, other = (block_bootstrap(X, Y, GROUPS, n=20, seed=s).replicates for s in (5, 5, 6))
    np.testing.assert_array_equal(first, second)
    assert not np.array_equal(first, other)


def test_intervals_of_a_normal_statistic_agree() -> None:
    result = block_bootstrap(X, Y, GROUPS, n=4000, seed=2)
    normal = np.column_stack([result.params - 1.96 * result.bse, result.params + 1.96 * result.bse])
    width = normal[:, 1] - normal[:, 0]
    for limits in (result.percentile(), result.bca()):
        assert np.all(np.abs(limits - normal) < 0.15 * width[:, None])


def test_bca_agrees_with_scipy() -> None:
    from scipy.stats import bootstrap

    skewed = np.random.default_rng(4).exponential(size=40)
    groups = np.arange(40)
    ours = block_bootstrap(np.ones((40, 1)), skewed, groups, n=6000, seed=0)
    theirs = bootstrap((skewed,), np.mean, n_resamples=6000, method="BCa", rng=np.random.default_rng(0))
    limits = [theirs.confidence_interval.low, theirs.confidence_interval.high]
    np.testing.assert_allclose(ours.bca()[0], limits, atol=0.05 * (limits[1] - limits[0]))
    assert ours.bca()[0, 1] > ours.percentile()[0, 1]


def test_replicates_that_lack_a_term_are_dropped_and_counted() -> None:
    rare = np.column_stack([X, np.isin(GROUPS, [1, 7, 11, 20]) * RNG.standard_normal(N)])
    result = block_bootstrap(rare, Y, GROUPS, n=500, seed=0)
    assert 0 < result.singular < 50
    assert result.replicates.shape == (500 - result.singular, 4)
    alone = np.column_stack([X, (GROUPS == 1) * RNG.standard_normal(N)])
    with pytest.raises(FitError, match="cannot separate"):
        block_bootstrap(alone, Y, GROUPS, n=100)


def test_too_few_runs_are_refused() -> None:
    with pytest.raises(FitError, match="2 runs"):
        block_bootstrap(X, Y, GROUPS % 2, n=10)


def test_result_is_plain_data() -> None:
    result = BootstrapResult(("a",), np.zeros(1), np.arange(11.0)[:, None] - 5.0, np.zeros((3, 1)), 0)
    np.testing.assert_allclose(result.percentile(0.8), [[-4.0, 4.0]])
    np.testing.assert_allclose(result.bca(0.8), [[-4.4, 4.4]], atol=0.2)
