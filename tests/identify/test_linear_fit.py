from __future__ import annotations

import numpy as np
import pytest
import statsmodels.api as sm
from statsmodels.stats.outliers_influence import variance_inflation_factor

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(3)
NAMES = ("Y0", "Yv", "Yr", "Yvvr")
GROUPS = np.arange(60) // 5
N = GROUPS.size
X = np.insert(RNG.standard_normal((N, 3)) * [1.0, 5.0, 0.01], 0, 1.0, axis=1)
W = 1.0 / RNG.uniform(0.5, 2.0, N)
Y = RNG.normal(X @ [1.0, 2.0, 0.3, 40.0] + RNG.normal(0.0, 0.2, 12)[GROUPS], 0.3)


@pytest.mark.parametrize("weights", [None, W], ids=["ols", "wls"])
def test_influence_agrees_with_statsmodels(weights) -> None:
    fit = fit_linear(X, Y, NAMES, weights=weights)
    root = np.ones(N) if weights is None else np.sqrt(weights)
    influence = sm.OLS(Y * root, X * root[:, None]).fit().get_influence()
    np.testing.assert_allclose(fit.leverage, influence.hat_matrix_diag, rtol=1e-9)
    np.testing.assert_allclose(fit.standardised_residuals, influence.resid_studentized_internal, rtol=1e-9)
    np.testing.assert_allclose(fit.studentized_residuals, influence.resid_studentized_external, rtol=1e-9)
    np.testing.assert_allclose(fit.cooks_distance, influence.cooks_distance[0], rtol=1e-9)


def test_variance_inflation_agrees_with_statsmodels() -> None:
    fit = fit_linear(X, Y, NAMES)
    np.testing.assert_allclose(fit.vif[1:], [variance_inflation_factor(X, j) for j in (1, 2, 3)], rtol=1e-10)


def test_outlying_rows_and_runs_are_named() -> None:
    clean = X @ [1.0, 2.0, 0.3, 40.0] + 0.1 * np.random.default_rng(1).standard_normal(N)
    spoiled = clean.copy()
    spoiled[17] += 2.0
    assert fit_linear(X, clean, NAMES).outlying(5.0) == []
    assert fit_linear(X, spoiled, NAMES).outlying() == [17]
    shifted = clean.copy()
    shifted[GROUPS == 4] += 2.0
    labels = np.array([f"run{g:02d}" for g in range(12)])[GROUPS]
    assert fit_linear(X, shifted, NAMES, groups=labels).outlying() == ["run04"]
    assert fit_linear(X, X @ np.ones(4), NAMES, groups=labels).outlying() == []


def test_influence_table_of_runs() -> None:
    fit = fit_linear(X, Y, NAMES, groups=GROUPS)
    table = fit.influence()
    assert table["leverage"].sum() == pytest.approx(4.0)
    kept = GROUPS != 3
    refit = fit_linear(X[kept], Y[kept], NAMES)
    shift = refit.params - fit.params
    cook = shift @ X.T @ X @ shift / (4 * fit.scale)
    assert table.loc[3, "cooks_distance"] == pytest.approx(cook, rel=1e-9)


def test_influence_of_single_rows_needs_no_groups() -> None:
    fit = fit_linear(X, Y, NAMES)
    table = fit.influence()
    kept = np.arange(N) != 8
    params = np.linalg.lstsq(X[kept], Y[kept], rcond=None)[0]
    assert table.loc[8, "deleted_rms"] == pytest.approx(abs(Y[8] - X[8] @ params), rel=1e-9)
    np.testing.assert_allclose(table["cooks_distance"], fit.cooks_distance)
    with pytest.raises(FitError, match="run of each row"):
        _ = fit.geometry


def test_row_that_alone_determines_a_term_is_marked() -> None:
    design = np.column_stack([X, np.eye(N)[5]])
    fit = fit_linear(design, Y, (*NAMES, "Yx"))
    assert np.flatnonzero(fit.determined_alone).tolist() == [5]
    assert fit.deleted_residuals[5] == pytest.approx(0.0, abs=1e-10)


def test_zero_response_is_fitted_without_a_word() -> None:
    fit = fit_linear(X, np.zeros(N), NAMES)
    np.testing.assert_array_equal(fit.params, 0.0)
    assert np.isnan(fit.r2)
    assert fit.loglik == np.inf
    assert fit.outlying() == []
    assert "nan" in fit.summary()


def test_prediction_and_its_error() -> None:
    fit = fit_linear(X, Y, NAMES)
    expected = sm.OLS(Y, X).fit().get_prediction(X[:5])
    np.testing.assert_allclose(fit.predict(X[:5]), expected.predicted_mean)
    np.testing.assert_allclose(fit.predict_se(X[:5]), expected.se_mean)


def test_near_dependent_terms_are_told() -> None:
    close = np.column_stack([X, X[:, 1] + 1e-4 * RNG.standard_normal(N)])
    fit = fit_linear(close, Y, (*NAMES, "Yb"))
    assert fit.inseparable() == [{"Yv", "Yb"}]
    assert fit.vif[1] > 1e6
    assert fit_linear(X, Y, NAMES).inseparable() == []
