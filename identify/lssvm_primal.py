"""LS-SVM in the primal, on explicit features: the linear kernel, and the fixed-size variant.

With p features the problem is ridge regression with a free intercept and penalty 1/gamma, of size p whatever the
number of samples. The linear kernel has its inputs as features. For the others a few samples stand for all: the
kernels of m landmarks span the function (Nystroem; Suykens et al. 2002, chapter 6), so that the model is sparse
from the start and nothing is pruned.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from .lssvm_dual import KernelExpansion
from .lssvm_kernels import Kernel, PolynomialKernel, row_chunks
from .lssvm_spectrum import CentredSpectrum

# Landmarks are taken until no sample's kernel is further than this from their span, relative to the largest.
LANDMARK_TOLERANCE = 1e-11


@dataclass(frozen=True, eq=False)
class LinearFeatures:
    """The inputs themselves.

    Attributes
    ----------
    columns : int
    """

    columns: int

    def matrix(self, x: np.ndarray) -> np.ndarray:
        """Features of x (k, d), shape (k, d)."""
        return x

    def left_over(self, x: np.ndarray, features: np.ndarray) -> np.ndarray:
        """Kernel of each row with itself that the features do not hold, shape (k,)."""
        return np.zeros(len(x))

    def function(self, coef: np.ndarray, bias: float) -> KernelExpansion:
        """x . coef + bias, as linear kernels of the unit vectors."""
        return KernelExpansion(PolynomialKernel(1, 0.0), np.eye(self.columns), coef, bias)


@dataclass(frozen=True, eq=False)
class LandmarkFeatures:
    """Coordinates in the span of the landmarks' kernels, orthonormal in the norm of the kernel.

    Attributes
    ----------
    kernel : Kernel
    landmarks : ndarray, shape (m, d)
    factor : ndarray, shape (m, m)
        Lower Cholesky factor of the landmarks' kernel matrix.
    """

    kernel: Kernel
    landmarks: np.ndarray
    factor: np.ndarray

    def matrix(self, x: np.ndarray) -> np.ndarray:
        """Features of x (k, d), shape (k, m)."""
        return solve_triangular(self.factor, self.kernel.matrix(self.landmarks, x), lower=True).T

    def left_over(self, x: np.ndarray, features: np.ndarray) -> np.ndarray:
        """Kernel of each row with itself that the features do not hold, shape (k,)."""
        return np.maximum(self.kernel.diagonal(x) - np.einsum("ij,ij->i", features, features), 0.0)

    def function(self, coef: np.ndarray, bias: float) -> KernelExpansion:
        """The function as a sum of the landmarks' kernels."""
        weights = solve_triangular(self.factor, coef, lower=True, trans="T")
        return KernelExpansion(self.kernel, self.landmarks, weights, bias)


Features = LinearFeatures | LandmarkFeatures


def landmark_features(kernel: Kernel, x: np.ndarray, most: int) -> tuple[LandmarkFeatures, np.ndarray]:
    """Landmarks by pivoted Cholesky factorisation, and the features of x (n, d), shape (n, m).

    Each landmark is the sample whose kernel is worst represented by those before it, which spreads them over the
    data without chance. The features times their transpose are the Nystroem approximation of the kernel matrix.
    """
    missing = kernel.diagonal(x)
    largest = float(missing.max())
    features = np.zeros((len(x), min(most, len(x))))
    chosen: list[int] = []
    for j in range(features.shape[1]):
        pivot = int(np.argmax(missing))
        if missing[pivot] <= LANDMARK_TOLERANCE * largest:
            break
        column = kernel.matrix(x, x[pivot : pivot + 1])[:, 0]
        features[:, j] = (column - features[:, :j] @ features[pivot, :j]) / np.sqrt(missing[pivot])
        missing = np.maximum(missing - features[:, j] ** 2, 0.0)
        chosen.append(pivot)
        missing[chosen] = 0.0
    features = features[:, : len(chosen)]
    return LandmarkFeatures(kernel, x[chosen].copy(), np.tril(features[chosen])), features


@dataclass(frozen=True, eq=False)
class PrimalFit:
    """Solution on features.

    Attributes
    ----------
    gamma : float
    features : LinearFeatures or LandmarkFeatures
    function : KernelExpansion
    fitted : ndarray, shape (n,)
    open : ndarray, shape (n,)
        1 - leverage: residual over left-out residual.
    coef : ndarray, shape (p,)
        Coefficients of the features.
    mean : ndarray, shape (p,)
        Weighted mean of the features.
    posterior, scatter : ndarray, shape (p, p)
        Covariance of `coef` over the noise variance: of what remains unknown, bias of shrinking included on
        average (Gaussian process), and of the scatter by noise alone.
    total : float
        Sum of the weights.
    """

    gamma: float
    features: Features
    function: KernelExpansion
    fitted: np.ndarray
    open: np.ndarray
    coef: np.ndarray
    mean: np.ndarray
    posterior: np.ndarray
    scatter: np.ndarray
    total: float

    def unit_variance(self, x: np.ndarray) -> np.ndarray:
        """Posterior variance of f at x (k, d) over the noise variance, shape (k,)."""
        out = np.empty(len(x))
        for rows in row_chunks(len(x), self.mean.size):
            raw = self.features.matrix(x[rows])
            away = raw - self.mean
            out[rows] = np.einsum("ij,ij->i", away @ self.posterior, away) + 1.0 / self.total
            out[rows] += self.gamma * self.features.left_over(x[rows], raw)
        return out


class PrimalSystem:
    """Features of the samples with the bias projected out, factorised once for all gammas.

    Parameters
    ----------
    features : LinearFeatures or LandmarkFeatures
    matrix : ndarray, shape (n, p)
        Features of the samples.
    weights : ndarray, shape (n,)
    """

    def __init__(self, features: Features, matrix: np.ndarray, weights: np.ndarray) -> None:
        self.features, self.matrix, self.weights = features, matrix, weights
        self.total = float(weights.sum())
        self.mean = weights @ matrix / self.total
        root = np.sqrt(weights)
        vectors, self.singular, right = np.linalg.svd((matrix - self.mean) * root[:, None], full_matrices=False)
        self.right = right.T
        kept = self.singular > 0.0
        self.spectrum = CentredSpectrum(
            root / np.sqrt(self.total), vectors[:, kept], self.singular[kept] ** 2, self.total, complete=False
        )

    def solve(self, y: np.ndarray, gamma: float) -> PrimalFit:
        """LS-SVM of y (n,)."""
        root = np.sqrt(self.weights)
        level = float(self.weights @ y) / self.total
        kept = self.singular > 0.0
        right, square = self.right[:, kept], self.spectrum.squares
        along = self.spectrum.vectors.T @ ((y - level) * root)
        ridged = square + 1.0 / gamma
        coef = right @ (self.singular[kept] * along / ridged)
        bias = level - float(self.mean @ coef)
        unseen = np.eye(self.mean.size) - right @ right.T
        return PrimalFit(
            gamma=gamma,
            features=self.features,
            function=self.features.function(coef, bias),
            fitted=level + (self.spectrum.vectors @ (square / ridged * along)) / root,
            open=1.0 - self.spectrum.constant**2 - self.spectrum.vectors**2 @ (square / ridged),
            coef=coef,
            mean=self.mean,
            posterior=(right / ridged) @ right.T + gamma * unseen,
            scatter=(right * (square / ridged**2)) @ right.T,
            total=self.total,
        )
