from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import toeplitz
from scipy.signal import lfilter
from statsmodels.regression.linear_model import burg

from towtank.core.errors import FitError
from towtank.identify.autoregression import AutoregressiveNoise, fit_autoregression
from towtank.identify.burg import burg_recursion


def ar2(n: int, seed: int) -> np.ndarray:
    x = lfilter([1.0], [1.0, -1.2, 0.5], np.random.default_rng(seed).standard_normal(n + 200))[200:]
    return x - x.mean()


def ar2_density(f: np.ndarray) -> np.ndarray:
    z = np.exp(-2j * np.pi * np.asarray(f))
    return 1.0 / np.abs(1.0 - 1.2 * z + 0.5 * z**2) ** 2


def test_burg_recursion_agrees_with_statsmodels() -> None:
    x = ar2(700, 0)
    coefficients, innovation = burg_recursion(x, 20)
    assert coefficients.size == 3
    expected, variance = burg(x, order=2, demean=False)
    np.testing.assert_allclose(-coefficients[1:], expected, atol=1e-12)
    assert innovation == pytest.approx(variance, rel=5e-3)


def test_white_noise_keeps_order_zero_mostly() -> None:
    rng = np.random.default_rng(1)
    orders = [burg_recursion(rng.standard_normal(500), 20)[0].size - 1 for _ in range(100)]
    assert np.mean(np.array(orders) == 0) > 0.6


def test_burg_stops_at_a_perfectly_predictable_series() -> None:
    coefficients, innovation = burg_recursion(np.cos(np.pi * np.arange(100)), 10)
    assert np.all(np.isfinite(coefficients))
    assert innovation >= 0.0


@pytest.mark.parametrize("n", [900, 6000])
def test_density_of_a_known_process_without_and_with_block_means(n: int) -> None:
    frequencies = np.array([0.0, 0.002, 0.005])
    x = np.column_stack([ar2(n, seed) for seed in range(60)])
    noise = fit_autoregression(x, highest_frequency=0.005)
    assert noise.block == n // 512
    mean_log = np.log(noise.density(frequencies)).mean(axis=1)
    np.testing.assert_allclose(mean_log, np.log(ar2_density(frequencies)), atol=0.06)


def test_block_length_respects_the_highest_frequency() -> None:
    noise = fit_autoregression(ar2(6000, 0), highest_frequency=0.1)
    assert noise.block == 1
    assert noise.density([0.1])[0, 0] == pytest.approx(ar2_density(np.array([0.1]))[0], rel=0.3)


def test_slow_component_below_white_noise_is_seen() -> None:
    # A tenth of the variance in a slow component carries nearly all of the density at zero.
    rng = np.random.default_rng(4)
    n, rho = 6000, 0.98
    slow = lfilter([1.0], [1.0, -rho], rng.standard_normal((n + 500, 40)), axis=0)[500:]
    slow *= np.sqrt(0.1 * (1.0 - rho**2))
    x = slow + np.sqrt(0.9) * rng.standard_normal((n, 40))
    expected = 0.1 * (1.0 + rho) / (1.0 - rho) + 0.9
    assert np.median(fit_autoregression(x).density([0.0])[0]) == pytest.approx(expected, rel=0.25)


def test_dof_agrees_with_the_delta_method_solved_directly() -> None:
    noise = fit_autoregression(ar2(700, 3))
    a = noise.coefficients[0]
    p = a.size - 1
    impulse = lfilter([1.0], a, np.concatenate([[1.0], np.zeros(4000)]))
    gamma = toeplitz([impulse[: impulse.size - lag] @ impulse[lag:] for lag in range(p)])
    for f in (0.0, 0.01, 0.2):
        z = np.exp(-2j * np.pi * f * np.arange(p + 1))
        gradient = -2.0 * np.real(z[1:] / (z @ a))
        expected = 2.0 * 700 / (2.0 + gradient @ np.linalg.solve(gamma, gradient))
        assert noise.dof([f])[0, 0] == pytest.approx(expected, rel=1e-8)


def test_power_taken_by_fitted_harmonics_is_put_back() -> None:
    rng = np.random.default_rng(5)
    n, cycles = 600, 3
    x = rng.standard_normal((n, 400))
    a = 2.0 * np.pi * cycles / n * np.arange(n)
    basis = np.column_stack([np.ones(n), *[g(k * a) for k in (1, 2, 3) for g in (np.cos, np.sin)]])
    residual = x - basis @ np.linalg.lstsq(basis, x, rcond=None)[0]
    lines = [(0.0, 1), *((k * cycles / n, 2) for k in (1, 2, 3))]
    known = np.log(fit_autoregression(residual, fitted=lines).density([0.0])[0]).mean()
    unknown = np.log(fit_autoregression(residual, fitted=()).density([0.0])[0]).mean()
    assert abs(known) < 0.02
    assert unknown < -0.03


def test_constant_channel_has_no_noise() -> None:
    noise = fit_autoregression(np.column_stack([np.full(300, 0.1), np.arange(300.0)]))
    assert isinstance(noise, AutoregressiveNoise)
    assert noise.density([0.0])[0, 0] == 0.0
    assert noise.density([0.0])[0, 1] > 0.0


@pytest.mark.parametrize("n", [1, 2, 3, 7, 12])
def test_short_series_give_finite_numbers(n: int) -> None:
    noise = fit_autoregression(np.random.default_rng(n).standard_normal(n))
    assert np.isfinite(noise.density([0.0, 0.1])).all()
    assert (noise.dof([0.0]) >= 2.0).all()


@pytest.mark.parametrize("bad", [np.array([]), np.array([1.0, np.nan, 2.0]), np.array([1.0, np.inf])])
def test_unusable_records_are_refused(bad: np.ndarray) -> None:
    with pytest.raises(FitError):
        fit_autoregression(bad)
