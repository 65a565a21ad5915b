from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_curve import fit_lssvm_curve, is_uniform
from towtank.identify.lssvm_dual import solve_dual
from towtank.identify.lssvm_kernels import GaussianKernel


def decay(count: int, step: float, noise: float = 0.05, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Roll angle in degrees of a decay with a period of 20 s."""
    t = np.arange(count) * step
    roll = 7.0 * np.exp(-0.02 * t) * np.cos(2.0 * np.pi * t / 20.0)
    return t, roll + noise * np.random.default_rng(seed).standard_normal(count)


@pytest.mark.parametrize(
    ("sigma", "route"), [(0.4, "banded"), (1.2, "banded"), (4.0, "fourier"), (15.0, "fourier")]
)
@pytest.mark.parametrize("weighted", [False, True], ids=["plain", "weighted"])
@pytest.mark.parametrize("gamma", [0.1, 1e4])
def test_same_solution_as_the_dense_system(sigma: float, route: str, weighted: bool, gamma: float) -> None:
    t, y = decay(500, 0.2)
    weights = np.random.default_rng(1).uniform(0.2, 2.0, 500) if weighted else np.ones(500)
    curve = fit_lssvm_curve(t, y, gamma=gamma, sigma=sigma, weights=weights if weighted else None)
    dense = solve_dual(GaussianKernel(sigma**2), t[:, None], y, weights, gamma)
    # Rounding of either solution grows with the condition number, about gamma times the number of samples in sigma.
    digits = 1e-12 * max(gamma * sigma / 0.2, 10.0)
    assert curve.route == route
    size = np.abs(dense.function.coef).max()
    np.testing.assert_allclose(curve.alpha, dense.function.coef, atol=digits * size)
    np.testing.assert_allclose(curve.solution.open, dense.open, atol=digits)
    np.testing.assert_allclose(curve.loo_residuals, (y - dense.fitted) / dense.open, atol=10 * digits)
    at = np.array([-0.7, 3.3, 50.0, 99.1, 100.4])
    np.testing.assert_allclose(curve(at), dense.function.value(at[:, None]), atol=10 * digits)
    np.testing.assert_allclose(curve(at, 1), dense.function.gradient(at[:, None])[:, 0], atol=10 * digits)
    np.testing.assert_allclose(curve(at, 2), dense.function.hessian(at[:, None])[:, 0, 0], atol=100 * digits)
    unit = curve.std(at) ** 2 / curve.noise_variance
    np.testing.assert_allclose(unit, dense.unit_variance(at[:, None]), rtol=1e4 * digits)


def test_two_thousand_samples_have_the_coefficients_of_the_dense_system() -> None:
    t, y = decay(2000, 0.1)
    for sigma, gamma in ((0.5, 1e3), (4.0, 1e4)):
        curve = fit_lssvm_curve(t, y, gamma=gamma, sigma=sigma)
        dense = solve_dual(GaussianKernel(sigma**2), t[:, None], y, np.ones(2000), gamma)
        size = np.abs(dense.function.coef).max()
        assert np.abs(curve.alpha - dense.function.coef).max() < 1e-8 * size
        assert np.abs(curve.loo_residuals - (y - dense.fitted) / dense.open).max() < 1e-8


@pytest.mark.parametrize("sigma", [0.8, 4.0])
def test_leave_one_out_is_that_of_refits(sigma: float) -> None:
    t, y = decay(200, 0.2)
    curve = fit_lssvm_curve(t, y, gamma=30.0, sigma=sigma)
    for i in (0, 1, 77, 199):
        kept = np.arange(200) != i
        refit = solve_dual(GaussianKernel(sigma**2), t[kept, None], y[kept], np.ones(199), 30.0)
        assert y[i] - refit.function.value(t[i : i + 1, None])[0] == pytest.approx(
            curve.loo_residuals[i], abs=2e-12
        )


@pytest.mark.parametrize(("sigma", "route"), [(0.8, "banded"), (4.0, "fourier")])
def test_derivatives_are_those_of_finite_differences(sigma: float, route: str) -> None:
    t, y = decay(400, 0.2)
    curve = fit_lssvm_curve(t, y, gamma=100.0, sigma=sigma)
    assert curve.route == route
    at, h = np.linspace(0.0, 79.0, 23), 1e-5
    np.testing.assert_allclose(curve(at, 1), (curve(at + h) - curve(at - h)) / (2 * h), atol=1e-8)
    np.testing.assert_allclose(curve(at, 2), (curve(at + h, 1) - curve(at - h, 1)) / (2 * h), atol=1e-8)
    for order in range(3):
        np.testing.assert_allclose(curve.on_samples(order), curve(t, order), atol=1e-10)
    np.testing.assert_allclose(curve.on_samples(), curve.fitted, atol=1e-10)
    assert curve(5.0).shape == ()
    assert curve(at.reshape(1, -1), 2).shape == (1, 23)


def test_smooth_record_gives_its_derivatives() -> None:
    t, y = decay(1000, 0.2, noise=0.0)
    rate, frequency = 0.02, 2.0 * np.pi / 20.0
    curve = fit_lssvm_curve(t, y, gamma=1e7, sigma=5.0)
    inside = slice(50, -50)
    grown = 7.0 * np.exp((-rate + 1j * frequency) * t)
    first, second = (((-rate + 1j * frequency) ** order * grown).real for order in (1, 2))
    np.testing.assert_allclose(curve.on_samples(1)[inside], first[inside], atol=1e-4)
    np.testing.assert_allclose(curve.on_samples(2)[inside], second[inside], atol=1e-3)


def test_conventions_of_sigma() -> None:
    t, y = decay(300, 0.2)
    one = fit_lssvm_curve(t, y, gamma=10.0, sigma=3.0)
    other = fit_lssvm_curve(t, y, gamma=10.0, sigma=3.0 / np.sqrt(2.0), convention="2sigma2")
    np.testing.assert_allclose(one.fitted, other.fitted, atol=1e-11)
    assert (one.convention, other.convention) == ("sigma2", "2sigma2")


@pytest.mark.parametrize("criterion", ["loo", "gcv"])
def test_choice_agrees_with_the_dense_criterion(criterion) -> None:
    t, y = decay(300, 0.2)
    curve = fit_lssvm_curve(t, y, sigmas=[0.6, 2.0, 5.0, 12.0], gammas=[1.0, 100.0, 1e4], criterion=criterion)
    for row in curve.choice.tried.iloc[::5].itertuples():
        dense = solve_dual(GaussianKernel(row.sigma**2), t[:, None], y, np.ones(300), row.gamma)
        open_ = dense.open if criterion == "loo" else dense.open.mean()
        assert row.score == pytest.approx(np.sqrt(np.mean(((y - dense.fitted) / open_) ** 2)), rel=1e-6)
    assert curve.choice.score == pytest.approx(curve.choice.tried["score"].min(), rel=2e-6)
    if criterion == "loo":
        assert curve.loo_rmse == pytest.approx(curve.choice.score, rel=1e-9)


def test_chosen_curve_is_better_than_its_data() -> None:
    t, y = decay(2000, 0.05)
    truth = decay(2000, 0.05, noise=0.0)[1]
    curve = fit_lssvm_curve(t, y)
    assert curve.choice.edges == ()
    assert np.sqrt(np.mean((curve.fitted - truth) ** 2)) < 0.2 * 0.05
    assert np.sqrt(curve.noise_variance) == pytest.approx(0.05, rel=0.05)
    assert curve.loo_rmse == pytest.approx(0.05, rel=0.06)
    narrow = fit_lssvm_curve(t, y, sigmas=[0.2, 0.4])
    assert narrow.choice.edges == ("sigma",)


def test_bands_cover() -> None:
    t, truth = decay(400, 0.25, noise=0.0)
    exact = 7.0 * np.exp(-0.02 * t)
    frequency = 2.0 * np.pi / 20.0
    slope = exact * (-0.02 * np.cos(frequency * t) - frequency * np.sin(frequency * t))
    inside = np.zeros(2)
    new = 0.0
    for seed in range(12):
        y = decay(400, 0.25, noise=0.1, seed=seed)[1]
        curve = fit_lssvm_curve(t, y, sigma=6.0)
        for order, values in enumerate((truth, slope)):
            lower, upper = curve.interval(t, order)
            inside[order] += np.mean((values > lower) & (values < upper)) / 12
        lower, upper = curve.interval(t, observation=True)
        again = decay(400, 0.25, noise=0.1, seed=1000 + seed)[1]
        new += np.mean((again > lower) & (again < upper)) / 12
    assert 0.92 < inside[0] < 0.985
    assert 0.90 < inside[1] < 0.985
    assert 0.94 < new < 0.96


@pytest.mark.parametrize(("sigma", "route", "gain"), [(1.4, "banded", 0.1), (4.0, "fourier", 0.1)])
def test_reweighting_resists_outliers(sigma: float, route: str, gain: float) -> None:
    t, y = decay(600, 0.2)
    truth = decay(600, 0.2, noise=0.0)[1]
    bad = np.random.default_rng(2).choice(600, 20, replace=False)
    y[bad] += 4.0
    plain = fit_lssvm_curve(t, y, gamma=100.0, sigma=sigma)
    robust = fit_lssvm_curve(t, y, gamma=100.0, sigma=sigma, reweightings=2)
    assert robust.route == route
    assert np.all(robust.row_weights[bad] == 1e-4)
    assert np.count_nonzero(robust.row_weights < 0.5) < 40
    error = [np.sqrt(np.mean((curve.fitted - truth) ** 2)) for curve in (plain, robust)]
    assert error[1] < gain * error[0]
    dense = solve_dual(GaussianKernel(sigma**2), t[:, None], y, robust.row_weights, 100.0)
    np.testing.assert_allclose(robust.alpha, dense.function.coef, atol=1e-7)
    np.testing.assert_allclose(robust.leverage, 1.0 - dense.open, atol=1e-9)


def test_uniform_grids() -> None:
    t = np.linspace(3.0, 4.0, 50)
    assert is_uniform(t)
    assert is_uniform(np.round(t, 9))
    assert not is_uniform(np.round(t, 3))
    assert not is_uniform(t[::-1])
    assert not is_uniform(t[:1])


T, Y = decay(100, 0.2)


@pytest.mark.parametrize(
    ("time", "response", "options", "message"),
    [
        (
            T,
            np.where(T > 10.0, np.nan, Y),
            {},
            "the response holds values that are not finite, the first at sample 51",
        ),
        (np.where(T > 10.0, np.inf, T), Y, {}, "the time holds values that are not finite"),
        (T[:1], Y[:1], {}, "1 samples make no curve"),
        (T, Y[:-1], {}, "times of shape"),
        (T**1.01, Y, {}, "not uniform in time"),
        (T[::-1], Y, {}, "not uniform in time"),
        (np.zeros(100), Y, {}, "not uniform in time"),
        (T, Y, {"gamma": 0.0}, "gamma is not positive: 0"),
        (T, Y, {"gamma": -2.0}, "gamma is not positive: -2"),
        (T, Y, {"sigma": -1.0}, "sigma -1 is not positive"),
        (T, Y, {"sigmas": []}, "a sigma is not positive"),
        (T, Y, {"gammas": []}, "gamma is not positive: none"),
        (T, Y, {"criterion": "aic"}, "no criterion 'aic'"),
        (T, Y, {"convention": "half"}, "no convention 'half'"),
        (T, Y, {"reweightings": -1}, "-1 reweightings"),
        (T, Y, {"weights": np.zeros(100)}, "a weight is not positive"),
        (T, Y, {"weights": np.ones(3)}, "3 weights for 100 samples"),
        (T, Y, {"gamma": 1e300, "sigma": 4.0}, "leaves no ridge"),
        (T, Y, {"gamma": 1e300, "sigma": 1.0}, "leaves no ridge"),
    ],
)
def test_bad_records_are_named(time, response, options, message: str) -> None:
    with pytest.raises(FitError, match=message):
        fit_lssvm_curve(time, response, **options)


def test_derivatives_stop_at_the_second() -> None:
    curve = fit_lssvm_curve(T, Y, gamma=1.0, sigma=4.0)
    for call in (curve, curve.std):
        with pytest.raises(FitError, match="no derivative of order 3"):
            call(T, 3)
