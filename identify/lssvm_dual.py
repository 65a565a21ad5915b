"""Dense LS-SVM: the dual system of all samples, for any kernel."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, eigh
from scipy.linalg.lapack import dpotri

from ..core.errors import FitError
from .lssvm_kernels import Kernel, row_chunks
from .lssvm_spectrum import CentredSpectrum


@dataclass(frozen=True, eq=False)
class KernelExpansion:
    """f(x) = sum_j coef_j k(x, centres_j) + bias.

    Attributes
    ----------
    kernel : Kernel
    centres : ndarray, shape (m, d)
    coef : ndarray, shape (m,)
    bias : float
    """

    kernel: Kernel
    centres: np.ndarray
    coef: np.ndarray
    bias: float

    def value(self, x: np.ndarray) -> np.ndarray:
        """f at the rows of x (k, d), shape (k,)."""
        parts = [self.kernel.matrix(x[rows], self.centres) @ self.coef for rows in self._chunks(x)]
        return np.concatenate(parts) + self.bias

    def gradient(self, x: np.ndarray) -> np.ndarray:
        """First derivatives, shape (k, d)."""
        return np.concatenate([self.kernel.gradient(x[rows], self.centres, self.coef) for rows in self._chunks(x)])

    def hessian(self, x: np.ndarray) -> np.ndarray:
        """Second derivatives, shape (k, d, d)."""
        return np.concatenate([self.kernel.hessian(x[rows], self.centres, self.coef) for rows in self._chunks(x)])

    def _chunks(self, x: np.ndarray) -> list[slice]:
        return row_chunks(len(x), len(self.centres))


@dataclass(frozen=True, eq=False)
class DualFit:
    """Solution of [0 1'; 1 K + diag(1/(gamma v))] [b; alpha] = [0; y] (Suykens et al. 2002, equation 3.7).

    Attributes
    ----------
    gamma : float
    function : KernelExpansion
    fitted : ndarray, shape (n,)
    open : ndarray, shape (n,)
        1 - leverage: residual over left-out residual.
    factor : ndarray, shape (n, n)
        Lower Cholesky factor of K + diag(1/(gamma v)).
    ones_solved : ndarray, shape (n,)
        (K + diag(1/(gamma v)))^-1 1.
    """

    gamma: float
    function: KernelExpansion
    fitted: np.ndarray
    open: np.ndarray
    factor: np.ndarray
    ones_solved: np.ndarray

    def unit_variance(self, x: np.ndarray) -> np.ndarray:
        """Posterior variance of f at x (k, d) over the noise variance, shape (k,)."""
        kernel, centres = self.function.kernel, self.function.centres
        out = kernel.diagonal(x)
        for rows in row_chunks(len(x), len(centres)):
            cross = kernel.matrix(centres, x[rows])
            out[rows] -= np.einsum("ij,ij->j", cross, cho_solve((self.factor, True), cross))
            out[rows] += (1.0 - self.ones_solved @ cross) ** 2 / self.ones_solved.sum()
        return self.gamma * np.maximum(out, 0.0)


def dual_spectrum(kernel: Kernel, x: np.ndarray, weights: np.ndarray) -> CentredSpectrum:
    """Spectrum of the weighted centred kernel matrix of x (n, d)."""
    root = np.sqrt(weights)
    total = float(weights.sum())
    q = root / np.sqrt(total)
    # A reflection that takes q to the first axis: its other columns are a basis of what is orthogonal to q.
    mirror = q.copy()
    mirror[0] += 1.0 if q[0] >= 0.0 else -1.0
    mirror /= np.linalg.norm(mirror)
    matrix = kernel.matrix(x, x) * np.outer(root, root)
    through = 2.0 * (matrix @ mirror)
    through -= mirror * (mirror @ through)
    matrix -= np.outer(mirror, through) + np.outer(through, mirror)
    squares, inner = eigh(matrix[1:, 1:], check_finite=False)
    vectors = np.vstack([np.zeros((1, len(x) - 1)), inner])
    vectors -= np.outer(2.0 * mirror, mirror[1:] @ inner)
    return CentredSpectrum(q, vectors, np.maximum(squares, 0.0), total, complete=True)


def solve_dual(kernel: Kernel, x: np.ndarray, y: np.ndarray, weights: np.ndarray, gamma: float) -> DualFit:
    """Solve for y (n,) at x (n, d) by Cholesky factorisation, with the diagonal of the inverse.

    Raises
    ------
    FitError
        If gamma is so large that the ridge 1/gamma drowns in the rounding of the kernel matrix.
    """
    ridge = 1.0 / (gamma * weights)
    matrix = kernel.matrix(x, x)
    matrix[np.diag_indices_from(matrix)] += ridge
    try:
        factor, _ = cho_factor(matrix, lower=True, overwrite_a=True, check_finite=False)
    except LinAlgError:
        raise FitError(
            f"gamma {gamma:.3g} leaves no ridge above the rounding of the kernel matrix",
            cure="use a smaller gamma or a narrower kernel",
        ) from None
    ones, raw = cho_solve((factor, True), np.column_stack([np.ones(len(y)), y])).T
    bias = float(raw.sum() / ones.sum())
    alpha = raw - bias * ones
    inverse, _ = dpotri(factor, lower=1)
    return DualFit(
        gamma=gamma,
        function=KernelExpansion(kernel, x, alpha, bias),
        fitted=y - ridge * alpha,
        open=ridge * (np.diagonal(inverse) - ones**2 / ones.sum()),
        factor=factor,
        ones_solved=ones.copy(),
    )
