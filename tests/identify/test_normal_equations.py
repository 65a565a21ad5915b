from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.normal_equations import NormalEquations, fit_stacked
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(0)
NAMES = ("Y0", "Yv", "Yvvv")
run_of_row = np.repeat(np.arange(10), [7, 5, 9, 2, 6, 8, 3, 5, 4, 6])
N = run_of_row.size
V = RNG.uniform(-0.3, 0.3, N)
X = np.column_stack([np.ones(N), V, V**3])
W = RNG.uniform(0.5, 2.0, N)
Y = X @ [0.1, -0.3, -1.6] + 0.01 * RNG.standard_normal(N)


def blocks():
    return ((X[run_of_row == g], Y[run_of_row == g], W[run_of_row == g]) for g in range(10))


@pytest.mark.parametrize("covariance", ["model", "cluster"])
def test_run_by_run_equals_all_at_once(covariance) -> None:
    stacked = fit_stacked(blocks(), NAMES, covariance=covariance)
    together = fit_linear(X, Y, NAMES, weights=W, groups=run_of_row, covariance=covariance)
    np.testing.assert_allclose(stacked.params, together.params, rtol=1e-11)
    np.testing.assert_allclose(stacked.cov, together.cov, rtol=1e-8)
    np.testing.assert_allclose(stacked.t_dof, together.t_dof, rtol=1e-8)
    np.testing.assert_allclose(stacked.vif, together.vif, rtol=1e-9)
    assert stacked.r2 == pytest.approx(together.r2, rel=1e-10)
    assert stacked.scale == pytest.approx(together.scale, rel=1e-10)
    assert stacked.condition_number == pytest.approx(together.condition_number, rel=1e-9)
    assert (stacked.n, stacked.dof, stacked.n_groups) == (N, N - 3, 10 if covariance == "cluster" else 0)


def test_stays_accurate_where_normal_equations_would_not() -> None:
    # Condition number near 1e9: the square of it would leave no digit.
    t = np.linspace(0.0, 1.0, 4000)
    design = np.column_stack([np.ones(4000), t, t + 1e-9 * np.sin(40.0 * t)])
    truth = np.array([1.0, 2.0, -1.0])
    equations = NormalEquations(3)
    for rows in np.array_split(np.arange(4000), 40):
        equations.add(design[rows], design[rows] @ truth)
    np.testing.assert_allclose(equations.solve().params, truth, rtol=1e-5)


def test_accumulators_of_two_workers_merge() -> None:
    parts = [NormalEquations(3, NAMES), NormalEquations(3, NAMES)]
    for g, block in enumerate(blocks()):
        parts[g % 2].add(*block)
    merged = parts[0].merge(parts[1]).solve(covariance="cluster")
    expected = fit_stacked(blocks(), NAMES, covariance="cluster")
    np.testing.assert_allclose(merged.params, expected.params, rtol=1e-11)
    np.testing.assert_allclose(merged.cov, expected.cov, rtol=1e-8)
    assert merged.n_groups == 10
    np.testing.assert_allclose(merged.vif, expected.vif, rtol=1e-9)
    fresh = NormalEquations(3, NAMES).merge(parts[0]).solve(covariance="cluster")
    np.testing.assert_allclose(fresh.cov, expected.cov, rtol=1e-8)


def test_parts_of_one_run_join_under_its_label() -> None:
    equations = NormalEquations(3, NAMES)
    for g in range(10):
        for rows in np.array_split(np.flatnonzero(run_of_row == g), 2):
            equations.add(X[rows], Y[rows], W[rows], group=f"run{g}")
    fit = equations.solve(covariance="cluster")
    assert fit.n_groups == 10
    np.testing.assert_allclose(fit.cov, fit_stacked(blocks(), NAMES).cov, rtol=1e-8)


def test_intercept_is_recognised_only_when_constant_in_all_runs() -> None:
    equations = NormalEquations(2)
    equations.add(np.column_stack([np.ones(5), V[:5]]), 3.0 + V[:5])
    assert equations.solve().tss == pytest.approx(np.sum((V[:5] - V[:5].mean()) ** 2))
    equations.add(np.column_stack([np.full(5, 2.0), V[5:10]]), 6.0 + V[5:10])
    total = np.sum((3.0 + V[:5]) ** 2) + np.sum((6.0 + V[5:10]) ** 2)
    assert equations.solve().tss == pytest.approx(total)


def test_runs_shorter_than_the_terms_are_welcome() -> None:
    equations = NormalEquations(3, NAMES)
    for row in range(N):
        equations.add(X[row : row + 1], Y[row : row + 1])
    np.testing.assert_allclose(equations.solve().params, fit_linear(X, Y, NAMES).params, rtol=1e-11)


def test_what_cannot_be_solved_is_refused() -> None:
    with pytest.raises(FitError, match="nothing to fit"):
        NormalEquations(3).solve()
    with pytest.raises(FitError, match="2 names for 3"):
        NormalEquations(3, ["a", "b"])
    with pytest.raises(FitError, match="kept apart"):
        NormalEquations(3, keep_groups=False).add(X, Y).solve(covariance="cluster")
    with pytest.raises(FitError, match="different terms"):
        NormalEquations(3).merge(NormalEquations(2))
    doubled = np.column_stack([V, 2.0 * V])
    equations = NormalEquations(2, ["Yv", "Yb"]).add(doubled, Y)
    with pytest.raises(FitError, match="Yv, Yb"):
        equations.solve()
    fit = equations.solve(allow_singular=True)
    np.testing.assert_allclose(fit.params, np.linalg.pinv(doubled) @ Y, atol=1e-12)
    assert fit.inseparable() == [{"Yv", "Yb"}]
    with pytest.raises(FitError, match="no covariance"):
        NormalEquations(3).add(X, Y).solve(covariance="hac")
