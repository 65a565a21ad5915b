from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from sklearn.linear_model import Ridge
from sklearn.model_selection import GridSearchCV, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler
from sklearn.utils.estimator_checks import parametrize_with_checks

from towtank.core.errors import FitError
from towtank.identify.lssvm import LSSVMRegressor

RNG = np.random.default_rng(1)
N = 60
X = RNG.uniform(-1.0, 1.0, (N, 2))
Y = np.sin(3.0 * X[:, 0]) + X[:, 1] ** 2 + 0.1 * RNG.standard_normal(N)
W = RNG.uniform(0.3, 2.0, N)
RUN = np.repeat(np.arange(12), 5)
SETTINGS = {
    "rbf": {"kernel": "rbf", "gamma": 50.0, "sigma": 0.8},
    "rbf, two sigma squared": {"kernel": "rbf", "gamma": 50.0, "sigma": 0.8, "sigma_convention": "2sigma2"},
    "poly": {"kernel": "poly", "gamma": 50.0},
    "linear": {"kernel": "linear", "gamma": 50.0},
    "linear dual": {"kernel": "linear", "gamma": 50.0, "solver": "dual"},
    "fixed size": {"kernel": "rbf", "gamma": 50.0, "sigma": 0.8, "solver": "fixed_size"},
}
each_setting = pytest.mark.parametrize("settings", SETTINGS.values(), ids=SETTINGS)


def bordered(kernel: np.ndarray, y: np.ndarray, weights: np.ndarray, gamma: float) -> np.ndarray:
    """The system of Suykens et al. (2002), solved as it is printed: (b, alpha)."""
    n = len(y)
    system = np.zeros((n + 1, n + 1))
    system[0, 1:] = system[1:, 0] = 1.0
    system[1:, 1:] = kernel + np.diag(1.0 / (gamma * weights))
    return np.linalg.solve(system, np.concatenate([[0.0], y]))


def weight_is_not_repetition(estimator: LSSVMRegressor) -> dict[str, str]:
    # GCV counts samples: one of weight 2 is not two samples to it.
    if estimator.criterion == "gcv":
        return {"check_sample_weight_equivalence_on_dense_data": "GCV counts samples"}
    return {}


@parametrize_with_checks(
    [
        LSSVMRegressor(),
        LSSVMRegressor("linear"),
        LSSVMRegressor("poly", criterion="gcv"),
        LSSVMRegressor(solver="fixed_size", gamma=30.0, sigma=2.0),
    ],
    expected_failed_checks=weight_is_not_repetition,
)
def test_scikit_learn_contract(estimator, check) -> None:
    check(estimator)


@pytest.mark.parametrize("convention", ["sigma2", "2sigma2"])
def test_solution_of_the_printed_system(convention) -> None:
    d2 = ((X[:, None] - X) ** 2).sum(axis=2)
    length2 = 0.8**2 * (1.0 if convention == "sigma2" else 2.0)
    expected = bordered(np.exp(-d2 / length2), Y, W, 50.0)
    model = LSSVMRegressor(gamma=50.0, sigma=0.8, sigma_convention=convention).fit(X, Y, W)
    assert model.intercept_ == pytest.approx(expected[0], rel=1e-10)
    np.testing.assert_allclose(model.dual_coef_, expected[1:], rtol=1e-9, atol=1e-10)
    poly = LSSVMRegressor("poly", gamma=50.0, degree=4, offset=0.5).fit(X, Y, W)
    expected = bordered((X @ X.T + 0.5) ** 4, Y, W, 50.0)
    np.testing.assert_allclose(poly.dual_coef_, expected[1:], rtol=1e-7, atol=1e-9)


def test_linear_kernel_is_ridge_with_a_free_intercept() -> None:
    model = LSSVMRegressor("linear", gamma=3.0).fit(X, Y, W)
    ridge = Ridge(alpha=1.0 / 3.0, solver="cholesky").fit(X, Y, W)
    np.testing.assert_allclose(model.coef_, ridge.coef_, rtol=1e-10)
    assert model.intercept_ == pytest.approx(ridge.intercept_, rel=1e-10)
    np.testing.assert_allclose(model.predict(X), ridge.predict(X), rtol=1e-10)


def test_primal_is_dual() -> None:
    primal = LSSVMRegressor("linear", gamma=3.0).fit(X, Y, W)
    dual = LSSVMRegressor("linear", gamma=3.0, solver="dual").fit(X, Y, W)
    for name in ("coef_", "intercept_", "dual_coef_", "leverage_", "loo_residuals_", "noise_variance_"):
        np.testing.assert_allclose(getattr(dual, name), getattr(primal, name), rtol=1e-9, err_msg=name)
    for a, b in zip(primal.predict(X, return_std=True), dual.predict(X, return_std=True)):
        np.testing.assert_allclose(b, a, rtol=1e-9)


def test_covariance_of_the_coefficients_follows_the_definition() -> None:
    model = LSSVMRegressor("linear", gamma=3.0).fit(X, Y, W)
    rows = np.column_stack([X, np.ones(N)])
    gram = rows.T @ (W[:, None] * rows)
    shrunk = np.linalg.inv(gram + np.diag([1.0 / 3.0, 1.0 / 3.0, 0.0]))
    table = model.coefficients_
    assert table.names == ("x0", "x1", "bias")
    np.testing.assert_allclose(table.cov, model.noise_variance_ * shrunk @ gram @ shrunk, rtol=1e-9)
    np.testing.assert_allclose(table.params, shrunk @ (rows.T @ (W * Y)), rtol=1e-9)
    # One standard deviation of the function: the posterior, in which the penalty is knowledge.
    at = np.array([[0.3, -0.2], [2.0, 1.0]])
    full = np.column_stack([at, np.ones(2)])
    expected = np.sqrt(model.noise_variance_ * np.einsum("ij,jk,ik->i", full, shrunk, full))
    np.testing.assert_allclose(model.predict(at, return_std=True)[1], expected, rtol=1e-9)


@each_setting
def test_leave_one_out_is_that_of_refits(settings) -> None:
    model = LSSVMRegressor(**settings).fit(X, Y, W)
    for i in (0, 7, 23, 41, 59):
        kept = np.arange(N) != i
        refit = LSSVMRegressor(**settings).fit(X[kept], Y[kept], W[kept])
        # The landmarks of 60 samples span all of them to 1e-11, so that leaving one out moves nothing else.
        assert Y[i] - refit.predict(X[i : i + 1])[0] == pytest.approx(model.loo_residuals_[i], abs=2e-12)
    assert model.loo_rmse_ == pytest.approx(np.sqrt(np.average(model.loo_residuals_**2, weights=W)), rel=1e-12)


@each_setting
def test_derivatives_are_those_of_finite_differences(settings) -> None:
    model = LSSVMRegressor(**settings).fit(X, Y)
    at, h = X[:6], 1e-5
    steps = h * np.eye(2)
    gradient = np.stack([(model.predict(at + d) - model.predict(at - d)) / (2 * h) for d in steps], axis=1)
    hessian = np.stack([(model.gradient(at + d) - model.gradient(at - d)) / (2 * h) for d in steps], axis=2)
    np.testing.assert_allclose(model.gradient(at), gradient, atol=5e-8)
    np.testing.assert_allclose(model.hessian(at), hessian, atol=5e-8)


@each_setting
def test_leverage_is_the_diagonal_of_the_hat_matrix(settings) -> None:
    model = LSSVMRegressor(**settings).fit(X, Y, W)
    moved = Y.copy()
    moved[11] += 1.0
    change = LSSVMRegressor(**settings).fit(X, moved, W).predict(X) - model.predict(X)
    assert model.leverage_[11] == pytest.approx(change[11], abs=1e-10)
    np.testing.assert_allclose(model.dual_coef_, 50.0 * W * (Y - model.predict(X)), atol=1e-9)
    assert model.dual_coef_.sum() == pytest.approx(0.0, abs=1e-9)
    # At a sample the posterior variance of the function is leverage over weight.
    std = model.predict(X, return_std=True)[1]
    np.testing.assert_allclose(std**2, model.noise_variance_ * model.leverage_ / W, rtol=1e-8)


@pytest.mark.parametrize("kernel", ["rbf", "poly"])
def test_fixed_size_with_enough_landmarks_is_the_dense_solution(kernel) -> None:
    dense = LSSVMRegressor(kernel, gamma=20.0, sigma=0.8).fit(X, Y, W)
    sparse = LSSVMRegressor(kernel, gamma=20.0, sigma=0.8, solver="fixed_size").fit(X, Y, W)
    far = np.array([[0.1, 0.2], [4.0, -3.0]])
    for a, b in zip(dense.predict(far, return_std=True), sparse.predict(far, return_std=True)):
        np.testing.assert_allclose(b, a, rtol=1e-6)
    np.testing.assert_allclose(sparse.loo_residuals_, dense.loo_residuals_, atol=1e-8)


def test_fixed_size_is_sparse_and_close() -> None:
    rng = np.random.default_rng(3)
    x = rng.uniform(-1.0, 1.0, (3000, 2))
    y = np.sin(3.0 * x[:, 0]) * x[:, 1] + 0.05 * rng.standard_normal(3000)
    model = LSSVMRegressor(solver="fixed_size", n_landmarks=40, sigma=1.0).fit(x, y)
    assert model.solution_.function.centres.shape == (40, 2)
    at = rng.uniform(-0.9, 0.9, (200, 2))
    assert np.sqrt(np.mean((model.predict(at) - np.sin(3.0 * at[:, 0]) * at[:, 1]) ** 2)) < 0.01
    # Far from all landmarks the function is unknown by the whole prior, not by what the landmarks span of it.
    far = model.predict(np.array([[50.0, 50.0]]), return_std=True)[1][0]
    assert far == pytest.approx(np.sqrt(model.noise_variance_ * model.gamma_), rel=0.2)
    assert far > 100.0 * model.predict(at, return_std=True)[1].max()


@pytest.mark.parametrize("criterion", ["loo", "gcv"])
@pytest.mark.parametrize("kernel", ["rbf", "poly", "linear"])
def test_choice_is_the_best_of_what_was_tried(kernel, criterion) -> None:
    model = LSSVMRegressor(kernel, criterion=criterion).fit(X, Y, W)
    assert model.choice_.score == pytest.approx(model.choice_.tried["score"].min(), rel=2e-6)
    if criterion == "loo":
        assert model.choice_.score == pytest.approx(model.loo_rmse_, rel=1e-8)
    else:
        residual = model.dual_coef_ / (model.gamma_ * W)
        gcv = np.sqrt(np.average(residual**2, weights=W)) / (1.0 - model.effective_dof_ / N)
        assert model.choice_.score == pytest.approx(gcv, rel=1e-8)
    coarse = LSSVMRegressor(kernel, criterion=criterion, refine=False).fit(X, Y, W)
    assert model.choice_.score <= coarse.choice_.score


@pytest.mark.parametrize("kernel", ["rbf", "linear"])
def test_choice_over_runs_is_that_of_refits(kernel) -> None:
    drift = 0.3 * np.repeat(np.random.default_rng(2).standard_normal(12), 5)
    model = LSSVMRegressor(kernel, gammas=[0.1, 10.0, 1e3], sigmas=[0.5], refine=False)
    model.fit(X, Y + drift, W, groups=RUN)
    for row in model.choice_.tried.itertuples():
        missed = np.empty(N)
        for run in range(12):
            kept = run != RUN
            part = LSSVMRegressor(kernel, gamma=row.gamma, sigma=0.5).fit(X[kept], (Y + drift)[kept], W[kept])
            missed[~kept] = (Y + drift)[~kept] - part.predict(X[~kept])
        assert row.score == pytest.approx(np.sqrt(np.average(missed**2, weights=W)), rel=1e-9)
    plain = LSSVMRegressor(kernel, gammas=[0.1, 10.0, 1e3], sigmas=[0.5], refine=False).fit(X, Y + drift, W)
    assert plain.choice_.score < model.choice_.score


def test_repeated_measurements_do_not_vouch_for_themselves() -> None:
    x, y = np.repeat(X, 2, axis=0), np.repeat(Y, 2)
    doubled = LSSVMRegressor().fit(x, y)
    weighted = LSSVMRegressor().fit(X, Y, np.full(N, 2.0))
    assert (doubled.gamma_, doubled.sigma_) == pytest.approx((weighted.gamma_, weighted.sigma_), rel=1e-12)
    np.testing.assert_allclose(doubled.predict(X), weighted.predict(X), rtol=1e-7)


def test_reweighting_resists_outliers() -> None:
    rng = np.random.default_rng(4)
    x = np.linspace(-1.0, 1.0, 120)[:, None]
    truth = np.sin(4.0 * x[:, 0])
    y = truth + 0.05 * rng.standard_normal(120)
    bad = rng.choice(120, 12, replace=False)
    y[bad] += 3.0
    error = {}
    for rounds in (0, 1, 3):
        model = LSSVMRegressor(reweightings=rounds, solver="dual").fit(x, y)
        error[rounds] = np.sqrt(np.mean((model.predict(x) - truth) ** 2))
    assert np.all(model.row_weights_[bad] == 1e-4)
    assert np.count_nonzero(model.row_weights_ < 0.5) <= 16
    assert error[3] < 0.1 * error[0]
    assert error[1] < 0.5 * error[0]
    clean = np.delete(np.arange(120), bad)
    assert error[3] < 1.5 * np.sqrt(
        np.mean((LSSVMRegressor(solver="dual").fit(x[clean], y[clean]).predict(x) - truth) ** 2)
    )


def test_intervals_cover() -> None:
    rng = np.random.default_rng(5)
    inside: dict[bool, list[float]] = {True: [], False: []}
    for _ in range(80):
        x, new = rng.uniform(-1.0, 1.0, (100, 1)), rng.uniform(-1.0, 1.0, (60, 1))
        truth = np.sin(4.0 * new[:, 0])
        model = LSSVMRegressor(gamma=10.0, sigma=0.8).fit(
            x, np.sin(4.0 * x[:, 0]) + 0.2 * rng.standard_normal(100)
        )
        seen = {True: truth + 0.2 * rng.standard_normal(60), False: truth}
        for observation, values in seen.items():
            lower, upper = model.predict_interval(new, observation=observation)
            inside[observation].append(float(np.mean((values > lower) & (values < upper))))
    assert 0.94 < np.mean(inside[True]) < 0.965
    assert 0.91 < np.mean(inside[False]) < 0.97


def test_long_uniform_record_goes_the_fast_way_to_the_same_function() -> None:
    rng = np.random.default_rng(6)
    t = np.arange(600) * 0.1
    y = np.exp(-0.03 * t) * np.cos(t) + 0.02 * rng.standard_normal(600)
    fast = LSSVMRegressor(gamma=100.0, sigma=2.0).fit(t[:, None], y)
    dense = LSSVMRegressor(gamma=100.0, sigma=2.0, solver="dual").fit(t[:, None], y)
    assert (fast.solver_, dense.solver_) == ("toeplitz", "dual")
    at = np.array([[3.21], [59.0], [61.0]])
    for method in ("predict", "gradient", "hessian"):
        np.testing.assert_allclose(getattr(fast, method)(at), getattr(dense, method)(at), atol=1e-9)
    for a, b in zip(fast.predict_interval(at), dense.predict_interval(at)):
        np.testing.assert_allclose(a, b, rtol=1e-8)
    np.testing.assert_allclose(fast.loo_residuals_, dense.loo_residuals_, atol=1e-10)
    jittered = t + 0.01 * rng.uniform(size=600)
    assert LSSVMRegressor(gamma=100.0, sigma=2.0).fit(jittered[:, None], y).solver_ == "dual"


def test_works_in_a_pipeline_and_in_searches() -> None:
    frame = pd.DataFrame(X * [1.0, 100.0], columns=["drift", "speed"])
    model = make_pipeline(StandardScaler(), LSSVMRegressor())
    assert cross_val_score(model, frame, Y).min() > 0.9
    assert GridSearchCV(LSSVMRegressor(sigma=1.0), {"gamma": [1e-3, 10.0]}).fit(X, Y).best_params_["gamma"] == 10.0
    assert LSSVMRegressor("linear").fit(frame, Y).coefficients_.names == ("drift", "speed", "bias")


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"gamma": 0.0}, "gamma is not positive: 0"),
        ({"gamma": -3.0}, "gamma is not positive: -3"),
        ({"gammas": [1.0, np.inf]}, "gamma is not positive: inf"),
        ({"sigma": 0.0}, "sigma 0 is not positive"),
        ({"kernel": "cubic"}, "no kernel 'cubic'"),
        ({"criterion": "aic"}, "no criterion 'aic'"),
        ({"sigma_convention": "half"}, "no convention 'half'"),
        ({"solver": "smo"}, "no solver 'smo'"),
        ({"solver": "primal"}, "needs the linear kernel"),
        ({"solver": "toeplitz"}, "uniformly sampled"),
        ({"kernel": "linear", "solver": "fixed_size"}, "needs the rbf or poly kernel"),
        ({"kernel": "poly", "degree": 0}, "degree 0"),
        ({"kernel": "poly", "offset": -1.0}, "offset -1"),
        ({"reweightings": -1}, "-1 reweightings"),
        ({"gamma": 1e300, "sigma": 5.0}, "drowns|leaves no ridge"),
    ],
)
def test_bad_settings_are_named(settings, message: str) -> None:
    with pytest.raises(FitError, match=message):
        LSSVMRegressor(**settings).fit(X, Y)


def test_bad_data_are_named() -> None:
    with pytest.raises(ValueError, match="NaN"):
        LSSVMRegressor().fit(np.where(X > 0.9, np.nan, X), Y)
    with pytest.raises(ValueError, match="minimum of 2"):
        LSSVMRegressor().fit(X[:1], Y[:1])
    flat = np.column_stack([X[:, 0], np.ones(N)])
    with pytest.raises(FitError, match="column 'x1' does not vary"):
        LSSVMRegressor("linear").fit(flat, Y)
    with pytest.raises(FitError, match="column 'x0' does not vary"):
        LSSVMRegressor().fit(np.ones((N, 2)), Y)
    with pytest.raises(FitError, match="sample weight is negative"):
        LSSVMRegressor().fit(X, Y, -W)
    with pytest.raises(FitError, match="fewer than two samples have weight"):
        LSSVMRegressor().fit(X, Y, np.eye(N)[0])
    with pytest.raises(FitError, match="3 group labels for 60 rows"):
        LSSVMRegressor().fit(X, Y, groups=[1, 2, 3])
    with pytest.raises(FitError, match="at least two"):
        LSSVMRegressor().fit(X, Y, groups=np.zeros(N))
    with pytest.raises(FitError, match=r"16000 samples make a dense system of 2.0 GB"):
        LSSVMRegressor().fit(np.random.default_rng(0).uniform(size=(16000, 2)), np.zeros(16000))
