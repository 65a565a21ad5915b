from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from towtank.core.errors import FitError
from towtank.identify.constrained import fit_constrained
from towtank.identify.regression import fit_linear

RNG = np.random.default_rng(0)
N = 50
X = np.column_stack([np.ones(N), RNG.standard_normal((N, 4)) * [1.0, 10.0, 0.1, 1.0]])
NAMES = ("Y0", "Yv", "Yr", "Yvvv", "Yvvr")
Y = X @ [0.1, -0.3, 0.02, 1.0, -0.05] + 0.2 * RNG.standard_normal(N)
W = RNG.uniform(0.5, 2.0, N)


@pytest.mark.parametrize("weights", [None, W], ids=["plain", "weighted"])
def test_without_constraints_it_is_least_squares(weights) -> None:
    fit = fit_constrained(X, Y, NAMES, weights=weights)
    expected = fit_linear(X, Y, NAMES, weights=weights)
    np.testing.assert_allclose(fit.params, expected.params, rtol=1e-10)
    np.testing.assert_allclose(fit.cov, expected.cov, rtol=1e-9)
    np.testing.assert_array_equal(fit.t_dof, expected.t_dof)
    assert fit.active == ()


def test_bounds_agree_with_scipy_to_rounding() -> None:
    lower = np.array([-np.inf, -0.1, -np.inf, -np.inf, 0.2])
    upper = np.array([np.inf, 0.5, 0.01, 5.0, np.inf])
    bounds = {name: (low, high) for name, low, high in zip(NAMES, lower, upper)}
    fit = fit_constrained(X, Y, NAMES, bounds=bounds)
    expected = lsq_linear(X, Y, (lower, upper), tol=1e-14, lsmr_tol=1e-14)
    np.testing.assert_allclose(fit.params, expected.x, atol=1e-8)
    assert fit["Yv"] == -0.1
    assert fit["Yvvr"] == 0.2
    assert "Yv >= -0.1" in fit.active
    held = [NAMES.index(text.split()[0]) for text in fit.active]
    assert np.all(fit.bse[held] == 0.0)
    free = [j for j in range(5) if j not in held]
    reduced = np.linalg.inv(X[:, free].T @ X[:, free]) * fit.scale
    np.testing.assert_allclose(fit.cov[np.ix_(free, free)], reduced, rtol=1e-9)
    assert fit.free_directions == len(free)


@pytest.mark.parametrize("seed", range(6))
def test_optimality_conditions_hold_for_random_boxes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    middle = fit_linear(X, Y, NAMES).params + rng.standard_normal(5) * [0.05, 0.05, 0.005, 0.5, 0.05]
    half = rng.uniform(0.0, 0.1, 5)
    bounds = {n: (m - h, m + h) for n, m, h in zip(NAMES, middle, half)}
    fit = fit_constrained(X, Y, NAMES, bounds=bounds)
    slope = X.T @ (X @ fit.params - Y)
    at_lower = fit.params <= middle - half
    at_upper = fit.params >= middle + half
    assert np.all(slope[at_lower] >= -1e-8)
    assert np.all(slope[at_upper] <= 1e-8)
    np.testing.assert_allclose(slope[~at_lower & ~at_upper], 0.0, atol=1e-8)


def test_signs_hold_back_only_what_would_cross() -> None:
    fit = fit_constrained(X, Y, NAMES, signs={"Yv": "+", "Yr": "+"})
    assert fit["Yv"] == 0.0
    assert fit.active == ("Yv >= 0",)
    assert fit["Yr"] > 0.0


@pytest.mark.parametrize("boxed", [False, True])
def test_equalities_hold_exactly(boxed: bool) -> None:
    equalities = [({"Yv": 1.0, "Yvvv": -0.5}, 0.0), ({"Yr": 1.0}, 0.03)]
    fit = fit_constrained(X, Y, NAMES, equalities=equalities, signs={"Yvvr": "-"} if boxed else None)
    assert fit["Yv"] == pytest.approx(0.5 * fit["Yvvv"], rel=1e-12)
    assert fit["Yr"] == pytest.approx(0.03, rel=1e-12)
    merged = np.column_stack([X[:, 0], 0.5 * X[:, 1] + X[:, 3], X[:, 4]])
    target = Y - 0.03 * X[:, 2]
    if boxed:
        merged = merged[:, :2]
    expected = np.linalg.lstsq(merged, target, rcond=None)[0]
    assert fit["Yvvv"] == pytest.approx(expected[1], rel=1e-9)
    assert fit.bse[2] == pytest.approx(0.0, abs=1e-12)
    assert fit.bse[1] == pytest.approx(0.5 * fit.bse[3], rel=1e-9)


def test_prior_is_the_gaussian_posterior() -> None:
    fit = fit_constrained(X, Y, NAMES, prior={"Yvvv": (2.0, 0.3), "Yv": (-0.4, 0.05)}, noise_sd=0.2)
    precision = np.diag([0.0, 1 / 0.05**2, 0.0, 1 / 0.3**2, 0.0])
    mean = np.array([0.0, -0.4, 0.0, 2.0, 0.0])
    posterior = np.linalg.inv(X.T @ X / 0.04 + precision)
    np.testing.assert_allclose(fit.params, posterior @ (X.T @ Y / 0.04 + precision @ mean), rtol=1e-9)
    np.testing.assert_allclose(fit.cov, posterior, rtol=1e-9)
    assert fit.prior_pull[3] == pytest.approx((fit["Yvvv"] - 2.0) / 0.3)
    assert np.isnan(fit.prior_pull[0])


def test_prior_settles_what_the_data_leave_open() -> None:
    design = np.column_stack([X, X[:, 1]])
    names = (*NAMES, "Yb")
    with pytest.raises(FitError, match="combination of Yv, Yb open"):
        fit_constrained(design, Y, names)
    fit = fit_constrained(design, Y, names, prior={"Yb": (0.1, 0.01)})
    assert fit["Yb"] == pytest.approx(0.1, abs=0.02)
    assert fit["Yv"] + fit["Yb"] == pytest.approx(fit_linear(X, Y, NAMES)["Yv"], abs=1e-6)


def test_noise_free_data_outweigh_the_prior() -> None:
    truth = np.array([0.1, -0.3, 0.02, 1.0, -0.05])
    fit = fit_constrained(X, X @ truth, NAMES, prior={"Yv": (-0.5, 0.1)}, signs={"Yv": "-"})
    np.testing.assert_allclose(fit.params, truth, rtol=1e-8)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"signs": {"Nv": "+"}}, "no term"),
        ({"signs": {"Yv": "positive"}}, "the sign of 'Yv'"),
        ({"bounds": {"Yv": (1.0, 0.0)}}, "crossed"),
        ({"bounds": {"Yv": (1.0, 2.0)}, "signs": {"Yv": "-"}}, "crossed"),
        ({"prior": {"Yv": (0.0, 0.0)}}, "no positive standard deviation"),
        ({"noise_sd": -1.0}, "not positive"),
        ({"equalities": [({"Yv": 1.0}, 0.0), ({"Yv": 1.0}, 1.0)]}, "contradict"),
        ({"equalities": [({"Yv": 1.0}, 3.0)], "bounds": {"Yv": (0.0, 1.0)}}, "no coefficients satisfy"),
    ],
)
def test_contradictions_are_refused(options: dict, message: str) -> None:
    with pytest.raises(FitError, match=message):
        fit_constrained(X, Y, NAMES, **options)
