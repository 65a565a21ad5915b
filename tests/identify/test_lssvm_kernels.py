from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_kernels import (
    GaussianKernel,
    PolynomialKernel,
    gaussian_derivative,
    gaussian_prior_variance,
    row_chunks,
    squared_length,
)

RNG = np.random.default_rng(0)
A, B = RNG.standard_normal((5, 3)), RNG.standard_normal((7, 3))
COEF = RNG.standard_normal(7)
KERNELS = [GaussianKernel(2.3), PolynomialKernel(1, 0.0), PolynomialKernel(2, 0.5), PolynomialKernel(5, 1.0)]


def test_two_conventions_of_sigma() -> None:
    assert squared_length(3.0, "sigma2") == 9.0
    assert squared_length(3.0, "2sigma2") == 18.0
    for sigma in (0.0, -1.0, math.nan, math.inf):
        with pytest.raises(FitError, match="is not positive"):
            squared_length(sigma, "sigma2")
    with pytest.raises(FitError, match="no convention"):
        squared_length(1.0, "toolbox")  # type: ignore[arg-type]


def test_values() -> None:
    assert GaussianKernel(2.0).matrix(A[:1], B[:1])[0, 0] == pytest.approx(
        math.exp(-np.sum((A[0] - B[0]) ** 2) / 2)
    )
    assert PolynomialKernel(3, 0.5).matrix(A[:1], B[:1])[0, 0] == pytest.approx((A[0] @ B[0] + 0.5) ** 3)
    column = GaussianKernel(2.0).matrix(A[:, :1], B[:, :1])
    np.testing.assert_allclose(column, np.exp(-((A[:, :1] - B[:, 0]) ** 2) / 2.0))


@pytest.mark.parametrize("kernel", KERNELS, ids=str)
def test_kernels_are_positive_definite_and_know_their_diagonal(kernel) -> None:
    matrix = kernel.matrix(B, B)
    np.testing.assert_allclose(np.diagonal(matrix), kernel.diagonal(B))
    assert np.linalg.eigvalsh(matrix).min() > -1e-9 * np.abs(matrix).max()


@pytest.mark.parametrize("kernel", KERNELS, ids=str)
def test_derivatives_are_those_of_finite_differences(kernel) -> None:
    h = 1e-5

    def value(x: np.ndarray) -> np.ndarray:
        return kernel.matrix(x, B) @ COEF

    def gradient(x: np.ndarray) -> np.ndarray:
        return kernel.gradient(x, B, COEF)

    steps = h * np.eye(3)
    size = np.abs(value(A)).max()
    expected = np.stack([(value(A + d) - value(A - d)) / (2 * h) for d in steps], axis=1)
    np.testing.assert_allclose(gradient(A), expected, atol=1e-8 * size + 1e-9)
    expected = np.stack([(gradient(A + d) - gradient(A - d)) / (2 * h) for d in steps], axis=2)
    np.testing.assert_allclose(kernel.hessian(A, B, COEF), expected, atol=1e-7 * size + 1e-8)


def test_gaussian_in_one_variable() -> None:
    d, h = np.linspace(-4.0, 4.0, 17), 1e-5
    for order in (1, 2):
        up, down = (gaussian_derivative(d + s * h, 2.3, order - 1) for s in (1.0, -1.0))
        np.testing.assert_allclose(gaussian_derivative(d, 2.3, order), (up - down) / (2 * h), atol=1e-9)
    with pytest.raises(FitError, match="order 3"):
        gaussian_derivative(d, 2.3, 3)
    # The variance of a derivative is the mixed derivative of the covariance at no distance.
    assert gaussian_prior_variance(2.3, 0) == 1.0
    assert gaussian_prior_variance(2.3, 1) == pytest.approx(-gaussian_derivative(np.zeros(1), 2.3, 2)[0])
    fourth = (gaussian_derivative(np.array([1e-3, 0.0, -1e-3]), 2.3, 2) @ [1.0, -2.0, 1.0]) / 1e-6
    assert gaussian_prior_variance(2.3, 2) == pytest.approx(fourth, rel=1e-4)


@pytest.mark.parametrize(
    ("kernel", "cause"), [((0, 1.0), "degree 0"), ((2.5, 1.0), "degree 2.5"), ((2, -1.0), "-1")]
)
def test_bad_polynomials_are_named(kernel, cause: str) -> None:
    with pytest.raises(FitError, match=cause):
        PolynomialKernel(*kernel)


def test_chunks_cover_all_rows() -> None:
    parts = row_chunks(10_000_001, 3)
    assert parts[0].start == 0
    assert len(parts) > 2
    assert sum(len(range(*part.indices(10_000_001))) for part in parts) == 10_000_001
    assert len(row_chunks(5, 10**9)) == 5
