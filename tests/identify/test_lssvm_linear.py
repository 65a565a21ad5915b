from __future__ import annotations

import numpy as np
import pytest
from sklearn.linear_model import Ridge

from towtank.core.errors import FitError
from towtank.identify.lssvm import LSSVMRegressor
from towtank.identify.lssvm_linear import fit_lssvm
from towtank.identify.ridge import fit_ridge

RNG = np.random.default_rng(0)
N = 60
RUN = np.repeat(np.arange(12), 5)
V = RNG.uniform(-0.3, 0.3, N)
R = RNG.uniform(-0.4, 0.4, N)
X = np.column_stack([V, R, V**3, V**2 * R, V * R**2])
NAMES = ("Yv", "Yr", "Yvvv", "Yvvr", "Yvrr")
TRUTH = np.array([-0.3, 0.08, -1.6, 0.4, -0.4])
Y = 0.01 + X @ TRUTH + 0.005 * RNG.standard_normal(N)
W = RNG.uniform(0.5, 2.0, N)


def test_is_ridge_with_a_free_intercept_and_the_ls_svm() -> None:
    fit = fit_lssvm(X, Y, NAMES, gamma=250.0, weights=W, standardise=False)
    ridge = Ridge(alpha=1.0 / 250.0, solver="cholesky").fit(X, Y, W)
    np.testing.assert_allclose(fit.params, ridge.coef_, rtol=1e-10)
    assert fit.bias == pytest.approx(ridge.intercept_, rel=1e-10)
    machine = LSSVMRegressor("linear", gamma=250.0).fit(X, Y, W)
    np.testing.assert_allclose(fit.params, machine.coef_, rtol=1e-10)
    np.testing.assert_allclose(fit.cov, machine.coefficients_.cov[:-1, :-1], rtol=1e-8)
    assert fit.bias_std == pytest.approx(np.sqrt(machine.coefficients_.cov[-1, -1]), rel=1e-8)
    assert fit.effective_dof == pytest.approx(machine.effective_dof_, rel=1e-10)
    assert fit.gamma == 250.0


def test_gamma_is_chosen_by_runs_that_are_left_out() -> None:
    drift = 0.02 * np.repeat(RNG.standard_normal(12), 5)
    fit = fit_lssvm(X, Y + drift, NAMES, groups=RUN, standardise=False, gammas=[1e-2, 1.0, 1e2, 1e4])
    assert list(fit.curve.columns) == ["gamma", "loo_rmse", "effective_dof"]
    assert fit.curve["gamma"].is_monotonic_increasing
    for row in fit.curve.itertuples():
        missed = np.empty(N)
        for run in range(12):
            kept = run != RUN
            ridge = Ridge(alpha=1.0 / row.gamma, solver="cholesky").fit(X[kept], (Y + drift)[kept])
            missed[~kept] = (Y + drift)[~kept] - ridge.predict(X[~kept])
        assert row.loo_rmse == pytest.approx(np.sqrt(np.mean(missed**2)), rel=1e-12)
    assert fit.loo_rmse == fit.curve["loo_rmse"].min()
    best = fit.curve.loc[fit.curve["loo_rmse"].idxmin(), "gamma"]
    assert fit.gamma == pytest.approx(best)


def test_coefficients_come_near_the_truth() -> None:
    fit = fit_lssvm(X, Y, NAMES, groups=RUN)
    assert fit.edges == ()
    assert np.all(np.abs(fit.params - TRUTH) < 4.0 * np.sqrt(np.diag(fit.cov)) + 0.05 * np.abs(TRUTH))
    assert fit.bias == pytest.approx(0.01, abs=4.0 * fit.bias_std)
    assert fit.to_frame().index.tolist() == list(NAMES)


@pytest.mark.parametrize("standardise", [False, True])
@pytest.mark.parametrize("weights", [None, W], ids=["plain", "weighted"])
@pytest.mark.parametrize("bias", [False, True])
def test_influence_maps_data_to_coefficients(standardise, weights, bias) -> None:
    fit = fit_lssvm(X, Y, NAMES, gamma=3.0, bias=bias, weights=weights, standardise=standardise)
    np.testing.assert_allclose(fit.influence @ Y, fit.params, rtol=1e-9)
    variances = np.ones(N) if weights is None else 1.0 / weights
    np.testing.assert_allclose((fit.influence * variances) @ fit.influence.T * fit.scale, fit.cov, rtol=1e-7)
    moved = Y.copy()
    moved[7] += 0.1
    again = fit_lssvm(X, moved, NAMES, gamma=3.0, bias=bias, weights=weights, standardise=standardise)
    np.testing.assert_allclose(again.params - fit.params, 0.1 * fit.influence[:, 7], atol=1e-10)


def test_a_bias_of_some_rows_only() -> None:
    means = (np.arange(N) % 5 == 0).astype(float)
    truth = X @ TRUTH + 0.2 * means
    fit = fit_lssvm(X, truth, NAMES, gamma=1e9, bias=means)
    np.testing.assert_allclose(fit.params, TRUTH, rtol=1e-4)
    assert fit.bias == pytest.approx(0.2, rel=1e-6)
    # It is the model's own constant term, left free.
    term = fit_lssvm(
        np.column_stack([means, X]), truth, ("Y0", *NAMES), gamma=1e9, bias=False, free=["Y0"], weights=W
    )
    other = fit_lssvm(X, truth, NAMES, gamma=1e9, bias=means, weights=W)
    np.testing.assert_allclose(term.params, [other.bias, *other.params], rtol=1e-9)
    assert (term.bias, term.bias_std) == (0.0, 0.0)


def test_without_bias_it_is_plain_ridge() -> None:
    fit = fit_lssvm(X, Y, NAMES, bias=False, groups=RUN)
    ridge = fit_ridge(X, Y, NAMES, groups=RUN)
    np.testing.assert_array_equal(fit.params, ridge.params)
    assert fit.gamma == pytest.approx(1.0 / ridge.penalty)


def test_reweighting_resists_outliers() -> None:
    bad = np.array([3, 17, 30, 31, 55])
    y = Y.copy()
    y[bad] += 0.4
    plain = fit_lssvm(X, y, NAMES)
    robust = fit_lssvm(X, y, NAMES, reweightings=5)
    assert np.all(robust.row_weights[bad] < 0.01)
    clean = fit_lssvm(X, Y, NAMES)
    assert np.abs(robust.params - TRUTH).max() < 0.25 * np.abs(plain.params - TRUTH).max()
    assert np.abs(robust.params - clean.params).max() < 0.1 * np.abs(plain.params - clean.params).max()


def test_edges_are_told() -> None:
    assert fit_lssvm(X, X @ TRUTH, NAMES, gammas=[1.0, 10.0]).edges == ("gamma",)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"gamma": 0.0}, "gamma is not positive: 0"),
        ({"gammas": [1.0, -1.0]}, "gamma is not positive: -1"),
        ({"gammas": []}, "gamma is not positive: none"),
        ({"design": np.column_stack([X[:, :4], np.full(N, 2.0)])}, "column 'Yvrr' does not vary"),
        ({"design": np.where(X > 0.29, np.nan, X)}, "not finite"),
        ({"design": X[:0], "response": Y[:0]}, "nothing to fit"),
        ({"bias": np.ones(3)}, r"bias column of shape \(3,\)"),
        ({"bias": np.zeros(N)}, "bias column is zero"),
        ({"reweightings": -1}, "-1 reweightings"),
        ({"groups": np.zeros(N)}, "at least two"),
        ({"weights": -W}, "a weight is not positive"),
    ],
)
def test_bad_input_is_named(change, message: str) -> None:
    given = {"design": X, "response": Y, "names": NAMES, **change}
    with pytest.raises(FitError, match=message):
        fit_lssvm(**given)


def test_one_row_is_not_enough() -> None:
    with pytest.raises(FitError):
        fit_lssvm(X[:1], Y[:1], NAMES)
