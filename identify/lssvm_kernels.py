"""Kernels of the LS-SVM, with the derivatives of a sum of them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

from ..core.errors import FitError

SigmaConvention = Literal["sigma2", "2sigma2"]
_CHUNK = 4_000_000


def squared_length(sigma: float, convention: SigmaConvention) -> float:
    """l^2 of exp(-d^2/l^2): sigma^2 (``"sigma2"``, as in the toolbox of Suykens) or 2 sigma^2 (``"2sigma2"``).

    Raises
    ------
    FitError
        If sigma is not a positive number or the convention is unknown.
    """
    if not (math.isfinite(sigma) and sigma > 0.0):
        raise FitError(f"sigma {sigma:g} is not positive", cure="use a sigma above 0")
    if convention not in ("sigma2", "2sigma2"):
        raise FitError(
            f"there is no convention '{convention}' of sigma",
            cure="use sigma2 for exp(-d^2/sigma^2) or 2sigma2 for exp(-d^2/(2 sigma^2))",
        )
    return sigma**2 if convention == "sigma2" else 2.0 * sigma**2


def gaussian_derivative(distance: np.ndarray, length2: float, order: int) -> np.ndarray:
    """Derivative of `order` 0, 1 or 2 of exp(-d^2/length2) with respect to d.

    Raises
    ------
    FitError
        For another order.
    """
    value = np.exp(-(distance**2) / length2)
    if order == 0:
        return value
    if order == 1:
        return -2.0 * distance / length2 * value
    if order == 2:
        return (4.0 * distance**2 / length2 - 2.0) / length2 * value
    raise FitError(f"there is no derivative of order {order} here", cure="use 0, 1 or 2")


def gaussian_prior_variance(length2: float, order: int) -> float:
    """Variance of the derivative of `order` of a Gaussian process with covariance exp(-d^2/length2)."""
    return (1.0, 2.0 / length2, 12.0 / length2**2)[order]


class Kernel(Protocol):
    """A positive definite function of two points, and its derivatives by the first."""

    def matrix(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Values between the rows of a (m, d) and b (n, d), shape (m, n)."""
        ...

    def diagonal(self, a: np.ndarray) -> np.ndarray:
        """Value of each row of a (m, d) with itself, shape (m,)."""
        ...

    def gradient(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Gradient of sum_j coef_j k(x, centres_j) at the rows of a (m, d), shape (m, d)."""
        ...

    def hessian(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Second derivatives of the same, shape (m, d, d)."""
        ...


@dataclass(frozen=True)
class PolynomialKernel:
    """(x . z + offset)^degree; degree 1 without offset is the linear kernel.

    Attributes
    ----------
    degree : int
    offset : float
    """

    degree: int = 3
    offset: float = 1.0

    def __post_init__(self) -> None:
        if self.degree < 1 or self.degree != int(self.degree):
            raise FitError(f"degree {self.degree} of the polynomial kernel", cure="use a whole number from 1")
        if not (math.isfinite(self.offset) and self.offset >= 0.0):
            raise FitError(f"offset {self.offset:g} makes the kernel indefinite", cure="use 0 or more")

    def matrix(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Values between the rows of a (m, d) and b (n, d), shape (m, n)."""
        return (a @ b.T + self.offset) ** self.degree

    def diagonal(self, a: np.ndarray) -> np.ndarray:
        """Value of each row with itself, shape (m,)."""
        return (np.einsum("ij,ij->i", a, a) + self.offset) ** self.degree

    def gradient(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Gradient of sum_j coef_j k(x, centres_j), shape (m, d)."""
        slope = self.degree * (a @ centres.T + self.offset) ** (self.degree - 1)
        return (slope * coef) @ centres

    def hessian(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Second derivatives of the same, shape (m, d, d)."""
        if self.degree == 1:
            return np.zeros((len(a), a.shape[1], a.shape[1]))
        bend = self.degree * (self.degree - 1) * (a @ centres.T + self.offset) ** (self.degree - 2)
        return np.einsum("mj,ji,jk->mik", bend * coef, centres, centres, optimize=True)


@dataclass(frozen=True)
class GaussianKernel:
    """exp(-|x - z|^2/length2).

    Attributes
    ----------
    length2 : float
        See :func:`squared_length`.
    """

    length2: float

    def matrix(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        """Values between the rows of a (m, d) and b (n, d), shape (m, n)."""
        if a.shape[1] == 1:
            return np.exp(-((a - b.T) ** 2) / self.length2)
        from scipy.spatial.distance import cdist

        return np.exp(-cdist(a, b, "sqeuclidean") / self.length2)

    def diagonal(self, a: np.ndarray) -> np.ndarray:
        """One for each row, shape (m,)."""
        return np.ones(len(a))

    def gradient(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Gradient of sum_j coef_j k(x, centres_j), shape (m, d)."""
        weighted = self.matrix(a, centres) * coef
        return -2.0 / self.length2 * (a * weighted.sum(axis=1)[:, None] - weighted @ centres)

    def hessian(self, a: np.ndarray, centres: np.ndarray, coef: np.ndarray) -> np.ndarray:
        """Second derivatives of the same, shape (m, d, d)."""
        weighted = self.matrix(a, centres) * coef
        total, moment = weighted.sum(axis=1), weighted @ centres
        square = np.einsum("mj,ji,jk->mik", weighted, centres, centres, optimize=True)
        cross = a[:, :, None] * moment[:, None, :]
        outer = a[:, :, None] * a[:, None, :] * total[:, None, None]
        spread = square - cross - cross.transpose(0, 2, 1) + outer
        return 4.0 / self.length2**2 * spread - 2.0 / self.length2 * total[:, None, None] * np.eye(a.shape[1])


def row_chunks(rows: int, columns: int) -> list[slice]:
    """Slices of `rows` whose products with `columns` stay small in memory."""
    step = max(_CHUNK // max(columns, 1), 1)
    return [slice(start, start + step) for start in range(0, rows, step)]
