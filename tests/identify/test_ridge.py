from __future__ import annotations

import numpy as np
import pytest
from sklearn.linear_model import Ridge

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear
from towtank.identify.ridge import fit_ridge, fit_truncated_svd

RNG = np.random.default_rng(0)
N = 60
run_of_row = np.repeat(np.arange(12), 5)
V = RNG.uniform(-0.3, 0.3, N)
R = -1.2 * V + 0.02 * RNG.standard_normal(N)
X = np.column_stack([np.ones(N), V, R, V**3, V**2 * R, V * R**2])
NAMES = ("Y0", "Yv", "Yr", "Yvvv", "Yvvr", "Yvrr")
Y = X @ [0.01, -0.3, 0.08, -1.6, 0.4, -0.4] + 0.01 * RNG.standard_normal(N)
W = RNG.uniform(0.5, 2.0, N)


def refit(kept: np.ndarray, penalty: float) -> np.ndarray:
    """Ridge on the scaled columns of the whole data, by its definition, with a free intercept."""
    size = np.sqrt(np.mean((X[:, 1:] - X[:, 1:].mean(axis=0)) ** 2, axis=0))
    rows = np.column_stack([X[:, :1], X[:, 1:] / size])[kept]
    gram = rows.T @ rows + penalty * np.diag([0.0, 1.0, 1.0, 1.0, 1.0, 1.0])
    return np.linalg.solve(gram, rows.T @ Y[kept]) / np.concatenate([[1.0], size])


def test_agrees_with_sklearn_and_the_linear_ls_svm() -> None:
    gamma = 250.0
    fit = fit_ridge(X, Y, NAMES, penalty=1.0 / gamma, free=["Y0"], standardise=False)
    expected = Ridge(alpha=1.0 / gamma, solver="cholesky").fit(X[:, 1:], Y)
    np.testing.assert_allclose(fit.params[1:], expected.coef_, rtol=1e-9)
    assert fit["Y0"] == pytest.approx(expected.intercept_, rel=1e-9)
    # Dual of the LS-SVM with linear kernel: [0 1'; 1 K + I/gamma] [b; alpha] = [0; y].
    dual = np.block([[np.zeros((1, 1)), np.ones((1, N))], [np.ones((N, 1)), X[:, 1:] @ X[:, 1:].T]])
    dual[1:, 1:] += np.eye(N) / gamma
    solution = np.linalg.solve(dual, np.concatenate([[0.0], Y]))
    np.testing.assert_allclose(fit.params[1:], X[:, 1:].T @ solution[1:], rtol=1e-7)
    assert fit["Y0"] == pytest.approx(solution[0], rel=1e-9)
    left_out = solution[1:] / np.diagonal(np.linalg.inv(dual))[1:]
    assert fit.loo_rmse == pytest.approx(np.sqrt(np.mean(left_out**2)), rel=1e-9)


@pytest.mark.parametrize("penalty", [1e-3, 1.0, 30.0])
def test_left_out_rows_and_runs_are_exact(penalty: float) -> None:
    rows = fit_ridge(X, Y, NAMES, penalty=penalty, free=["Y0"])
    np.testing.assert_allclose(rows.params, refit(np.ones(N, dtype=bool), penalty), rtol=1e-8)
    errors = [Y[i] - X[i] @ refit(np.arange(N) != i, penalty) for i in range(N)]
    assert rows.loo_rmse == pytest.approx(np.sqrt(np.mean(np.square(errors))), rel=1e-9)
    runs = fit_ridge(X, Y, NAMES, penalty=penalty, free=["Y0"], groups=run_of_row)
    errors = [Y[run_of_row == g] - X[run_of_row == g] @ refit(run_of_row != g, penalty) for g in range(12)]
    assert runs.loo_rmse == pytest.approx(np.sqrt(np.mean(np.square(errors))), rel=1e-9)


def test_covariance_and_dof_follow_the_definition() -> None:
    penalty = 0.5
    fit = fit_ridge(X, Y, NAMES, penalty=penalty, free=["Y0"], standardise=False)
    shrunk = np.linalg.inv(X.T @ X + penalty * np.diag([0.0, 1, 1, 1, 1, 1]))
    hat = X @ shrunk @ X.T
    assert fit.effective_dof == pytest.approx(np.trace(hat), rel=1e-10)
    residual = Y - hat @ Y
    assert fit.scale == pytest.approx(residual @ residual / (N - np.trace(hat)), rel=1e-10)
    np.testing.assert_allclose(fit.cov, fit.scale * shrunk @ X.T @ X @ shrunk, rtol=1e-7, atol=1e-18)


@pytest.mark.parametrize("weights", [None, W], ids=["plain", "weighted"])
def test_no_penalty_is_least_squares(weights) -> None:
    expected = fit_linear(X, Y, NAMES, weights=weights)
    for free in ([], ["Y0"], ["Y0", "Yv"]):
        fit = fit_ridge(X, Y, NAMES, penalty=0.0, free=free, weights=weights)
        np.testing.assert_allclose(fit.params, expected.params, rtol=1e-7)
        np.testing.assert_allclose(fit.cov, expected.cov, rtol=1e-6)
    all_kept = fit_truncated_svd(X, Y, NAMES, kept=5, free=["Y0"], weights=weights)
    np.testing.assert_allclose(all_kept.params, expected.params, rtol=1e-7)
    np.testing.assert_allclose(all_kept.resid, expected.resid, atol=1e-10)


def test_chosen_penalty_is_the_best_of_the_curve() -> None:
    fit = fit_ridge(X, Y, NAMES, free=["Y0"], groups=run_of_row)
    assert list(fit.curve.columns) == ["penalty", "loo_rmse", "effective_dof"]
    best = fit.curve.loc[fit.curve["loo_rmse"].idxmin()]
    assert (fit.penalty, fit.loo_rmse) == (best["penalty"], best["loo_rmse"])
    assert np.all(np.diff(fit.curve["effective_dof"]) < 0.0)
    few = fit_ridge(X, Y, NAMES, penalties=[0.1, 10.0])
    assert few.penalty in (0.1, 10.0)


def test_regularisation_tames_what_the_data_cannot_separate() -> None:
    rng = np.random.default_rng(5)
    truth = np.array([0.1, -0.3, 0.25])
    missed = {"plain": 0.0, "ridge": 0.0, "truncated": 0.0}
    for _ in range(60):
        v = rng.uniform(-0.3, 0.3, 20)
        design = np.column_stack([np.ones(20), v, -v + 0.005 * rng.standard_normal(20)])
        response = design @ truth + 0.02 * rng.standard_normal(20)
        fits = {
            "plain": fit_linear(design, response, NAMES[:3]),
            "ridge": fit_ridge(design, response, NAMES[:3], free=["Y0"]),
            "truncated": fit_truncated_svd(design, response, NAMES[:3], free=["Y0"]),
        }
        for kind, fit in fits.items():
            missed[kind] += float(np.sum((fit.params - truth) ** 2))
    assert missed["ridge"] < 0.5 * missed["plain"]
    assert missed["truncated"] < 0.7 * missed["plain"]


def test_truncated_svd_left_out_error_refits_in_the_kept_space() -> None:
    fit = fit_truncated_svd(X, Y, NAMES, kept=3, free=["Y0"], groups=run_of_row)
    apart = X[:, 1:] - X[:, 1:].mean(axis=0)
    size = np.sqrt(np.mean(apart**2, axis=0))
    scores = np.column_stack([np.ones(N), apart / size @ np.linalg.svd(apart / size)[2][:3].T])
    errors = []
    for g in range(12):
        kept = run_of_row != g
        params = np.linalg.lstsq(scores[kept], Y[kept], rcond=None)[0]
        errors.append(Y[~kept] - scores[~kept] @ params)
    assert fit.loo_rmse == pytest.approx(np.sqrt(np.mean(np.square(errors))), rel=1e-9)
    assert fit.effective_dof == 4.0
    assert fit.kept == 3


def test_exactly_dependent_columns_are_allowed() -> None:
    design = np.column_stack([X, X[:, 1]])
    names = (*NAMES, "Yb")
    for fit in (fit_ridge(design, Y, names, free=["Y0"]), fit_truncated_svd(design, Y, names, free=["Y0"])):
        assert fit["Yb"] == pytest.approx(fit["Yv"], rel=1e-6)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: fit_ridge(X, Y, NAMES, penalty=-1.0), "negative"),
        (lambda: fit_ridge(X, Y, NAMES, penalties=[]), "missing"),
        (lambda: fit_ridge(X, Y, NAMES, free=["Nv"]), "no column 'Nv'"),
        (lambda: fit_ridge(X, Y, NAMES, free=NAMES), "nothing to penalise"),
        (lambda: fit_ridge(X, Y, NAMES, groups=run_of_row[:5]), "5 group labels"),
        (lambda: fit_ridge(X, Y, NAMES, groups=np.zeros(N)), "at least two"),
        (lambda: fit_truncated_svd(X, Y, NAMES, kept=9), "cannot be kept"),
        (
            lambda: fit_ridge(np.column_stack([X, 2 * X[:, 0]]), Y, (*NAMES, "b"), free=["Y0", "b"]),
            "dependent",
        ),
        (
            lambda: fit_ridge(
                np.column_stack([X, run_of_row == 3]), Y, (*NAMES, "b"), free=["Y0", "b"], groups=run_of_row
            ),
            "single row or run",
        ),
    ],
)
def test_impossible_requests_are_refused(call, message: str) -> None:
    with pytest.raises(FitError, match=message):
        call()
