from __future__ import annotations

import numpy as np
import pytest
import statsmodels.api as sm
from statsmodels.tools.eval_measures import aicc

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(0)
NAMES = ("Y0", "Yv", "Yr", "Yvvr")
N = 60
GROUPS = np.repeat(np.arange(12), 5)
X = np.column_stack([np.ones(N), RNG.standard_normal((N, 3)) * [1.0, 5.0, 0.01]])
W = RNG.uniform(0.5, 2.0, N)
Y = X @ [1.0, 2.0, 0.3, 40.0] + 0.3 * RNG.standard_normal(N) + 0.2 * RNG.standard_normal(12)[GROUPS]


@pytest.mark.parametrize("weights", [None, W], ids=["ols", "wls"])
@pytest.mark.parametrize("intercept", [True, False])
@pytest.mark.parametrize(
    ("covariance", "options", "oracle"),
    [
        ("model", {}, {}),
        ("hac", {"hac_lags": 3}, {"cov_type": "HAC", "cov_kwds": {"maxlags": 3, "use_correction": True}}),
        ("hc3", {}, {"cov_type": "HC3"}),
        (
            "cluster",
            {"groups": GROUPS, "cluster_correction": "cr1"},
            {"cov_type": "cluster", "cov_kwds": {"groups": GROUPS}},
        ),
    ],
)
def test_agrees_with_statsmodels(weights, intercept: bool, covariance, options, oracle) -> None:
    first = 0 if intercept else 1
    fit = fit_linear(X[:, first:], Y, NAMES[first:], weights=weights, covariance=covariance, **options)
    kwargs = {**oracle, "use_t": True} if oracle else {}
    model = sm.OLS(Y, X[:, first:]) if weights is None else sm.WLS(Y, X[:, first:], weights=weights)
    expected = model.fit(**kwargs)
    np.testing.assert_allclose(fit.params, expected.params, rtol=1e-10)
    np.testing.assert_allclose(fit.cov_params(), expected.cov_params(), rtol=1e-10)
    np.testing.assert_allclose(fit.conf_int(), expected.conf_int(), rtol=1e-9)
    np.testing.assert_allclose(fit.tvalues, expected.tvalues, rtol=1e-10)
    np.testing.assert_allclose(fit.pvalues, expected.pvalues, rtol=1e-7, atol=1e-300)
    np.testing.assert_allclose(fit.resid, expected.resid, atol=1e-12)
    assert fit.r2 == pytest.approx(expected.rsquared, rel=1e-12)
    assert fit.r2_adj == pytest.approx(expected.rsquared_adj, rel=1e-12)
    assert fit.loglik == pytest.approx(expected.llf, rel=1e-12)
    assert fit.aic == pytest.approx(expected.aic, rel=1e-12)
    assert fit.bic == pytest.approx(expected.bic, rel=1e-12)
    assert fit.aicc == pytest.approx(aicc(expected.llf, N, len(NAMES) - first + 1), rel=1e-12)
    assert fit.scale == pytest.approx(expected.scale, rel=1e-12)
    assert (fit.dof, fit.n) == (int(expected.df_resid), N)
    np.testing.assert_allclose(fit.as_statsmodels().bse, expected.bse, rtol=1e-10)


def test_hac_does_not_reach_across_runs() -> None:
    fit = fit_linear(X, Y, NAMES, groups=GROUPS, covariance="hac", hac_lags=2)
    np.testing.assert_allclose(fit.cov, fit.as_statsmodels().cov_params(), rtol=1e-10)
    blind = fit_linear(X, Y, NAMES, covariance="hac", hac_lags=2)
    assert not np.allclose(fit.cov, blind.cov, rtol=1e-3)


@pytest.mark.parametrize("weights", [None, W], ids=["ols", "wls"])
def test_closed_loop_is_exact(weights) -> None:
    truth = np.array([-0.02, -0.315, 0.083, -1.607])
    fit = fit_linear(X, X @ truth, NAMES, weights=weights)
    np.testing.assert_allclose(fit.params, truth, rtol=1e-12)
    assert fit["Yv"] == pytest.approx(-0.315, rel=1e-12)
    assert fit.r2 == pytest.approx(1.0, abs=1e-14)


@pytest.mark.parametrize("groups", [12, 20, 40])
def test_clustered_intervals_cover(groups: int) -> None:
    rng = np.random.default_rng(7)
    labels = np.repeat(np.arange(groups), 4)
    n = labels.size
    # Drift angle varies between runs, the second column within them; a run effect makes rows correlated.
    design = np.column_stack([np.ones(n), rng.uniform(-1.0, 1.0, groups)[labels], rng.standard_normal(n)])
    weights = rng.uniform(0.5, 2.0, n)
    truth = np.array([0.5, -0.3, 0.1])
    inside = np.zeros(3)
    for _ in range(400):
        noise = rng.standard_normal(groups)[labels] + rng.standard_normal(n) / np.sqrt(weights)
        fit = fit_linear(
            design, design @ truth + noise, ["a", "b", "c"], weights=weights, groups=labels, covariance="cluster"
        )
        limits = fit.conf_int()
        inside += (limits[:, 0] <= truth) & (truth <= limits[:, 1])
    coverage = inside / 400
    assert coverage.min() >= 0.92
    assert coverage.max() <= 0.98


def test_white_intervals_cover() -> None:
    rng = np.random.default_rng(8)
    truth = np.array([1.0, 2.0, 0.3, 40.0])
    inside = np.zeros(4)
    for _ in range(800):
        limits = fit_linear(X, X @ truth + rng.standard_normal(N), NAMES).conf_int()
        inside += (limits[:, 0] <= truth) & (truth <= limits[:, 1])
    assert np.all(np.abs(inside / 800 - 0.95) < 0.025)


def test_dependent_terms_stop_the_fit_or_are_flagged() -> None:
    design = np.column_stack([X, X[:, 1] + X[:, 2]])
    names = (*NAMES, "Yb")
    with pytest.raises(FitError, match="Yv, Yr, Yb"):
        fit_linear(design, Y, names)
    fit = fit_linear(design, Y, names, allow_singular=True)
    assert fit.flagged == ("Yv", "Yr", "Yb")
    assert fit.inseparable() == [{"Yv", "Yr", "Yb"}]
    assert np.all(np.isinf(fit.vif[[1, 2, 4]]))
    np.testing.assert_allclose(fit.params, np.linalg.pinv(design) @ Y, atol=1e-10)
    assert fit.dof == N - 4


def test_as_many_rows_as_terms_give_values_without_errors() -> None:
    fit = fit_linear(X[:4], Y[:4], NAMES)
    np.testing.assert_allclose(X[:4] @ fit.params, Y[:4], atol=1e-9)
    assert np.isnan(fit.scale)
    assert np.isnan(fit.bse).all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"covariance": "cluster"}, "run of each row"),
        ({"covariance": "magic"}, "no covariance 'magic'"),
        ({"groups": np.arange(3)}, "3 group labels"),
        ({"covariance": "cluster", "groups": np.zeros(N)}, "at least two groups"),
    ],
)
def test_impossible_requests_are_refused(options: dict, message: str) -> None:
    with pytest.raises(FitError, match=message):
        fit_linear(X, Y, NAMES, **options)
