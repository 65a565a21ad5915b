from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_dual import KernelExpansion, dual_spectrum, solve_dual
from towtank.identify.lssvm_kernels import GaussianKernel

RNG = np.random.default_rng(0)
X = RNG.uniform(-1.0, 1.0, (30, 2))
Y = RNG.standard_normal(30)
W = RNG.uniform(0.5, 2.0, 30)
KERNEL = GaussianKernel(0.7)


def test_diagonal_of_the_bordered_inverse_gives_the_left_out_residual() -> None:
    """The closed form of the literature: alpha_i over the diagonal of the inverse of the whole system."""
    fit = solve_dual(KERNEL, X, Y, W, 20.0)
    system = np.zeros((31, 31))
    system[0, 1:] = system[1:, 0] = 1.0
    system[1:, 1:] = KERNEL.matrix(X, X) + np.diag(1.0 / (20.0 * W))
    inverse = np.linalg.inv(system)
    np.testing.assert_allclose(inverse[1:, 1:] @ Y, fit.function.coef, atol=1e-10)
    left_out = fit.function.coef / np.diagonal(inverse)[1:]
    np.testing.assert_allclose((Y - fit.fitted) / fit.open, left_out, atol=1e-11)
    # Prediction: the last pivot of the same system with one more sample.
    at = np.array([[0.2, 0.1], [3.0, 3.0]])
    border = np.vstack([np.ones(2), KERNEL.matrix(X, at)])
    unit = 20.0 * (1.0 - np.einsum("ij,ik,kj->j", border, inverse, border))
    np.testing.assert_allclose(fit.unit_variance(at), unit, rtol=1e-9)


def test_spectrum_rebuilds_the_centred_matrix() -> None:
    spectrum = dual_spectrum(KERNEL, X, W)
    root = np.sqrt(W)
    project = np.eye(30) - np.outer(root, root) / W.sum()
    centred = project @ (KERNEL.matrix(X, X) * np.outer(root, root)) @ project
    np.testing.assert_allclose((spectrum.vectors * spectrum.squares) @ spectrum.vectors.T, centred, atol=1e-12)
    np.testing.assert_allclose(spectrum.vectors.T @ spectrum.vectors, np.eye(29), atol=1e-12)
    np.testing.assert_allclose(spectrum.constant @ spectrum.vectors, 0.0, atol=1e-12)
    assert spectrum.total == pytest.approx(W.sum())


def test_expansion_works_in_pieces() -> None:
    expansion = KernelExpansion(KERNEL, X, Y, 0.3)
    at = np.tile(X[:7], (30_000, 1))
    np.testing.assert_allclose(expansion.value(at)[-7:], expansion.value(X[:7]), rtol=1e-12)
    assert expansion.gradient(X[:7]).shape == (7, 2)
    assert expansion.hessian(X[:7]).shape == (7, 2, 2)


def test_too_large_gamma_is_named() -> None:
    doubled = np.vstack([X, X])
    with pytest.raises(FitError, match="gamma 1e\\+300 leaves no ridge"):
        solve_dual(KERNEL, doubled, np.tile(Y, 2), np.ones(60), 1e300)
