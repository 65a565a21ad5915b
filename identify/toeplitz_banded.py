"""Gaussian-kernel LS-SVM of a uniformly sampled record whose kernel is narrow: a banded system.

Kernel values beyond the reach of the Gaussian lie below the rounding of the arithmetic, so that the matrix is
banded. The diagonal of its inverse, which exact leave-one-out needs, follows from the first column of the inverse
when the matrix is Toeplitz (Gohberg and Semencul 1972), and from its block-tridiagonal form when weights break that.

Times are counted in steps from the first sample; the kernel is exp(-(i - j)^2 / width^2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from scipy.linalg import LinAlgError, cho_factor, cho_solve, cho_solve_banded, cholesky_banded, toeplitz

from ..core.errors import FitError
from .lssvm_kernels import gaussian_derivative, gaussian_prior_variance, row_chunks
from .toeplitz_fourier import REACH

LARGEST_BAND = 100_000_000


def band_of(count: int, width: float) -> int:
    """Diagonals beside the main one that hold kernel values above rounding."""
    return min(count - 1, math.ceil(REACH * width))


def banded_cost(count: int, width: float) -> float:
    """Multiplications of one solution; inf where the band would not fit into memory."""
    band = band_of(count, width)
    return 1.0 * count * (band + 1) ** 2 if count * (band + 1) <= LARGEST_BAND else math.inf


@dataclass(frozen=True, eq=False)
class BandedFit:
    """Solution for one gamma.

    Attributes
    ----------
    gamma : float
    smoother : BandedSmoother
    fitted : ndarray, shape (n,)
    open : ndarray, shape (n,)
        1 - leverage: residual over left-out residual.
    bias : float
    alpha : ndarray, shape (n,)
        Coefficients of the kernels.
    factor : ndarray
        Banded Cholesky factor of K + diag(1/(gamma v)).
    ones_solved : ndarray, shape (n,)
        (K + diag(1/(gamma v)))^-1 1.
    """

    gamma: float
    smoother: BandedSmoother
    fitted: np.ndarray
    open: np.ndarray
    bias: float
    alpha: np.ndarray
    factor: np.ndarray
    ones_solved: np.ndarray

    def value(self, position: np.ndarray, order: int = 0) -> np.ndarray:
        """Fitted function or its derivative of `order` per step at `position` (m,) in steps, shape (m,)."""
        band = self.smoother.band + 1
        padded = np.concatenate([np.zeros(band), self.alpha, np.zeros(band)])
        offsets = np.arange(-band, band + 1)
        out = np.empty(len(position))
        for rows in row_chunks(len(position), offsets.size):
            nearest = np.clip(np.rint(position[rows]).astype(int), 0, self.smoother.count - 1)[:, None] + offsets
            kernel = gaussian_derivative(position[rows, None] - nearest, self.smoother.width**2, order)
            out[rows] = np.einsum("ij,ij->i", kernel, padded[nearest + band])
        return out + self.bias if order == 0 else out

    def on_samples(self, order: int) -> np.ndarray:
        """The same at the samples, shape (n,)."""
        return self.value(np.arange(self.smoother.count, dtype=float), order)

    def unit_variance(self, position: np.ndarray, order: int = 0) -> np.ndarray:
        """Variance of `value` over the noise variance, shape (m,)."""
        s = self.smoother
        samples = np.arange(s.count)
        unit = 1.0 if order == 0 else 0.0
        out = np.full(len(position), gaussian_prior_variance(s.width**2, order))
        for rows in row_chunks(len(position), s.count):
            cross = gaussian_derivative(position[rows] - samples[:, None], s.width**2, order)
            solved = cho_solve_banded((self.factor, True), cross)
            out[rows] -= np.einsum("ij,ij->j", cross, solved)
            out[rows] += (unit - self.ones_solved @ cross) ** 2 / self.ones_solved.sum()
        return self.gamma * np.maximum(out, 0.0)


class BandedSmoother:
    """The record's grid, weights and kernel width; solves for any response and gamma.

    Parameters
    ----------
    count : int
        Samples n.
    width : float
        Kernel width in steps.
    weights : ndarray, shape (n,), optional
        Weight of each sample's squared error, positive.
    """

    def __init__(self, count: int, width: float, weights: np.ndarray | None = None) -> None:
        self.count, self.width, self.weights = count, width, weights
        self.band = band_of(count, width)
        self.column = np.exp(-((np.arange(self.band + 1) / width) ** 2))

    def solve(self, response: np.ndarray, gamma: float) -> BandedFit:
        """LS-SVM of response (n,).

        Raises
        ------
        FitError
            If gamma is so large that the ridge 1/gamma drowns in the rounding of the kernel matrix.
        """
        ridge = np.full(self.count, 1.0 / gamma)
        if self.weights is not None:
            ridge /= self.weights
        lower = np.empty((self.band + 1, self.count), order="F")
        lower[:] = self.column[:, None]
        lower[0] += ridge
        try:
            factor = cholesky_banded(lower, overwrite_ab=True, lower=True, check_finite=False)
        except LinAlgError:
            raise FitError(
                f"gamma {gamma:.3g} leaves no ridge above the rounding of the kernel matrix",
                cure="use a smaller gamma or a narrower kernel",
            ) from None
        sides = np.zeros((self.count, 3))
        sides[0, 0], sides[:, 1], sides[:, 2] = 1.0, 1.0, response
        first, ones, raw = cho_solve_banded((factor, True), sides, check_finite=False).T
        bias = float(raw.sum() / ones.sum())
        alpha = raw - bias * ones
        if self.weights is None:
            diagonal = toeplitz_inverse_diagonal(first)
        else:
            diagonal = banded_inverse_diagonal(self.column, ridge)
        return BandedFit(
            gamma=gamma,
            smoother=self,
            fitted=response - ridge * alpha,
            open=ridge * (diagonal - ones**2 / ones.sum()),
            bias=bias,
            alpha=alpha,
            factor=factor,
            ones_solved=ones.copy(),
        )


def toeplitz_inverse_diagonal(first: np.ndarray) -> np.ndarray:
    """Diagonal of the inverse of a symmetric Toeplitz matrix from the first column of that inverse (n,)."""
    steps = first**2
    steps[1:] -= first[:0:-1] ** 2
    return np.cumsum(steps) / first[0]


def banded_inverse_diagonal(column: np.ndarray, ridge: np.ndarray) -> np.ndarray:
    """Diagonal of (T + diag(ridge))^-1, T the banded symmetric Toeplitz matrix of `column` (m + 1,), shape (n,).

    Block elimination of the block-tridiagonal form, then the inverse's diagonal blocks from the last to the first.
    """
    count, size = ridge.size, max(column.size - 1, 1)
    whole = np.zeros(2 * size)
    whole[: column.size] = column
    diagonal_block = toeplitz(whole[:size])
    lower_block = toeplitz(whole[size:], np.concatenate([whole[size:0:-1]]))
    starts = range(0, count, size)
    factors: list[tuple[np.ndarray, bool]] = []
    links: list[np.ndarray] = []
    for start in starts:
        length = min(size, count - start)
        block = diagonal_block[:length, :length] + np.diag(ridge[start : start + length])
        if factors:
            below = lower_block[:length]
            links.append(cho_solve(factors[-1], below.T))
            block -= below @ links[-1]
        factors.append(cho_factor(block, lower=True))
    out = np.empty(count)
    inverse = np.zeros((0, 0))
    for number in reversed(range(len(factors))):
        length = len(factors[number][0])
        own = cho_solve(factors[number], np.eye(length))
        if number < len(links):
            own += links[number] @ inverse @ links[number].T
        inverse = own
        out[starts[number] : starts[number] + length] = np.diagonal(inverse)
    return out
