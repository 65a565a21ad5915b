from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import fractional_matrix_power

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear
from towtank.identify.sandwich import cluster_covariance, group_geometry, hac_covariance, hc3_covariance

RNG = np.random.default_rng(0)
run_of_row = np.repeat(np.arange(9), [3, 5, 4, 6, 2, 7, 3, 5, 4])
N = run_of_row.size
X = np.column_stack([np.ones(N), RNG.standard_normal((N, 2)), RNG.standard_normal(9)[run_of_row]])
Y = X @ [1.0, -2.0, 0.5, 0.3] + RNG.standard_normal(N) + RNG.standard_normal(9)[run_of_row]
FIT = fit_linear(X, Y, list("abcd"), groups=run_of_row)


def direct_cluster(exponent: float) -> tuple[np.ndarray, np.ndarray]:
    """CR covariance and Satterthwaite degrees of freedom from the n x n matrices of the definition."""
    bread = np.linalg.inv(X.T @ X)
    hat = X @ bread @ X.T
    residual = (np.eye(N) - hat) @ Y
    meat = np.zeros((4, 4))
    adjust = np.zeros((N, N))
    for g in range(9):
        rows = np.flatnonzero(run_of_row == g)
        block = fractional_matrix_power(np.eye(rows.size) - hat[np.ix_(rows, rows)], exponent).real
        adjust[np.ix_(rows, rows)] = block
        score = X[rows].T @ block @ residual[rows]
        meat += np.outer(score, score)
    dof = []
    for j in range(4):
        columns = np.zeros((N, 9))
        for g in range(9):
            rows = run_of_row == g
            columns[rows, g] = (adjust[np.ix_(rows, rows)] @ X[rows] @ bread)[:, j]
        spread = columns.T @ (np.eye(N) - hat) @ columns
        dof.append(np.trace(spread) ** 2 / np.sum(spread**2))
    return bread @ meat @ bread, np.array(dof)


@pytest.mark.parametrize(("correction", "exponent"), [("cr2", -0.5), ("cr3", -1.0)])
def test_small_matrices_give_the_cluster_corrections_of_the_definition(correction: str, exponent: float) -> None:
    cov, dof = cluster_covariance(FIT.geometry, FIT.back, FIT.scale, FIT.dof, correction)
    expected, expected_dof = direct_cluster(exponent)
    np.testing.assert_allclose(cov, expected, rtol=1e-9)
    np.testing.assert_allclose(dof, expected_dof, rtol=1e-9)


def test_cr2_is_unbiased_for_alike_errors() -> None:
    y = np.random.default_rng(1).standard_normal((N, 1500))
    total = np.zeros((4, 4))
    for column in y.T:
        residual = column - FIT.q @ (FIT.q.T @ column)
        geometry = group_geometry(FIT.q, residual, run_of_row)
        total += cluster_covariance(geometry, FIT.back, 1.0, FIT.dof, "cr2")[0]
    expected = np.diagonal(np.linalg.inv(X.T @ X))
    np.testing.assert_allclose(np.diagonal(total) / 1500, expected, rtol=0.08)


def test_groups_need_not_be_in_order() -> None:
    order = np.random.default_rng(2).permutation(N)
    shuffled = fit_linear(X[order], Y[order], list("abcd"), groups=run_of_row[order], covariance="cluster")
    ordered = fit_linear(X, Y, list("abcd"), groups=run_of_row, covariance="cluster")
    np.testing.assert_allclose(shuffled.cov, ordered.cov, rtol=1e-10)
    np.testing.assert_allclose(shuffled.t_dof, ordered.t_dof, rtol=1e-10)


def test_deleted_residuals_are_those_of_a_refit() -> None:
    deleted = FIT.geometry.deleted_residuals(FIT.q, FIT.resid)
    for g in (0, 4):
        kept = run_of_row != g
        params = np.linalg.lstsq(X[kept], Y[kept], rcond=None)[0]
        np.testing.assert_allclose(deleted[~kept], Y[~kept] - X[~kept] @ params, atol=1e-10)


def test_term_that_one_run_alone_supports_keeps_its_model_error() -> None:
    design = np.column_stack([X, np.where(run_of_row == 3, RNG.standard_normal(N), 0.0)])
    clustered = fit_linear(design, Y, list("abcde"), groups=run_of_row, covariance="cluster")
    model = fit_linear(design, Y, list("abcde"))
    assert clustered.bse[4] > 0.3 * model.bse[4]


def test_hac_with_no_lags_is_white() -> None:
    cov, lags = hac_covariance(FIT.q, FIT.resid, FIT.back, 0, None)
    bread = np.linalg.inv(X.T @ X)
    scores = X * FIT.resid[:, None]
    np.testing.assert_allclose(cov, bread @ scores.T @ scores @ bread * N / (N - 4), rtol=1e-10)
    assert lags == 0


def test_automatic_lags_grow_with_the_memory(ar1) -> None:
    rng = np.random.default_rng(3)
    design = np.column_stack([np.ones(2000), np.linspace(-1.0, 1.0, 2000)])
    chosen = []
    for rho in (0.0, 0.5, 0.9):
        fit = fit_linear(design, ar1(rng, rho, 2000, 1)[:, 0], ["a", "b"], covariance="hac")
        chosen.append(int(fit.covariance_note.split()[0]))
    assert chosen[0] < chosen[1] < chosen[2]
    assert chosen[0] <= 6


def test_impossible_covariances_are_refused() -> None:
    lonely = group_geometry(FIT.q, FIT.resid, np.zeros(N))
    with pytest.raises(FitError, match="at least two groups"):
        cluster_covariance(lonely, FIT.back, 1.0, 10, "cr2")
    with pytest.raises(FitError, match="no cluster correction"):
        cluster_covariance(FIT.geometry, FIT.back, 1.0, 10, "cr9")
    with pytest.raises(FitError, match="negative"):
        hac_covariance(FIT.q, FIT.resid, FIT.back, -1, None)
    lever = np.linalg.qr(np.column_stack([np.eye(5)[0], np.ones(5)]))[0]
    with pytest.raises(FitError, match="row 0 alone"):
        hc3_covariance(lever, np.zeros(5), np.eye(2))
