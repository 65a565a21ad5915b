from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.linalg import toeplitz

from towtank.core.errors import FitError
from towtank.identify.toeplitz_banded import (
    BandedSmoother,
    band_of,
    banded_cost,
    banded_inverse_diagonal,
    toeplitz_inverse_diagonal,
)


def gaussian(count: int, width: float) -> np.ndarray:
    """First column of the kernel matrix."""
    return np.exp(-((np.arange(count) / width) ** 2))


@pytest.mark.parametrize(
    ("count", "width", "ridge"), [(50, 3.0, 0.1), (51, 8.0, 1e-3), (2, 1.0, 0.5), (1, 1.0, 2.0)]
)
def test_diagonal_of_the_inverse_by_gohberg_and_semencul(count: int, width: float, ridge: float) -> None:
    inverse = np.linalg.inv(toeplitz(gaussian(count, width)) + ridge * np.eye(count))
    np.testing.assert_allclose(toeplitz_inverse_diagonal(inverse[:, 0]), np.diagonal(inverse), rtol=1e-9)


@pytest.mark.parametrize(("count", "band"), [(40, 1), (40, 3), (41, 10), (40, 39), (12, 5), (3, 0), (1, 0)])
def test_diagonal_of_the_inverse_by_blocks(count: int, band: int) -> None:
    column = gaussian(band + 1, 0.4 * band + 1.0)
    ridge = np.random.default_rng(count).uniform(1.0, 3.0, count)
    whole = np.zeros(count)
    whole[: band + 1] = column
    inverse = np.linalg.inv(toeplitz(whole) + np.diag(ridge))
    np.testing.assert_allclose(banded_inverse_diagonal(column, ridge), np.diagonal(inverse), rtol=1e-10)


def test_band_holds_all_above_rounding() -> None:
    assert band_of(1000, 10.0) == 61
    assert band_of(30, 10.0) == 29
    assert math.exp(-((61 / 10.0) ** 2)) < 1e-16
    assert banded_cost(1000, 10.0) < banded_cost(1000, 20.0)
    assert math.isinf(banded_cost(200_000, 100.0))


@pytest.mark.parametrize("order", [0, 1, 2])
def test_function_is_the_sum_of_kernels(order: int) -> None:
    rng = np.random.default_rng(0)
    fit = BandedSmoother(80, 4.0, rng.uniform(0.5, 2.0, 80)).solve(rng.standard_normal(80), 10.0)
    at = np.array([-40.0, -3.3, 0.0, 17.5, 79.0, 90.0])
    d = at[:, None] - np.arange(80)
    kernel = np.exp(-(d**2) / 16.0) * (1.0, -d / 8.0, d**2 / 64.0 - 1.0 / 8.0)[order]
    np.testing.assert_allclose(fit.value(at, order), kernel @ fit.alpha + fit.bias * (order == 0), atol=1e-13)
    assert fit.alpha.sum() == pytest.approx(0.0, abs=1e-10)
    far = fit.unit_variance(np.array([500.0]), order)[0]
    prior = 10.0 * (1.0, 2.0 / 16.0, 12.0 / 256.0)[order] + 10.0 * (order == 0) / fit.ones_solved.sum()
    assert far == pytest.approx(prior, rel=1e-10)


def test_too_large_gamma_is_named() -> None:
    with pytest.raises(FitError, match="gamma 1e\\+300 leaves no ridge"):
        BandedSmoother(200, 10.0).solve(np.zeros(200), 1e300)
