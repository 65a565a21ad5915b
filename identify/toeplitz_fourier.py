"""Gaussian-kernel LS-SVM of a uniformly sampled record whose kernel is wide: a truncated Fourier series.

On uniform samples the kernel matrix is a Toeplitz matrix. Laid around a circle that is longer than the record by
the reach of the kernel, it becomes circulant, and its eigenvalues there fall off as a Gaussian: all but a few
modes lie below the rounding of the arithmetic and can be left out. What remains is a small primal problem in the
cosines and sines of the circle, whose Gram matrix is Toeplitz plus Hankel and comes from one Fourier transform of
the weights. Neither the kernel matrix nor the features are ever formed, and the cost of a further sample is that
of a Fourier transform.

Times are counted in steps from the first sample; the kernel is exp(-(i - j)^2 / width^2).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy import fft
from scipy.linalg import lapack

from ..core.errors import FitError
from .lssvm_kernels import row_chunks

# exp(-REACH^2) is the rounding of double precision: kernel values and spectral powers below it are left out.
REACH = 6.1
LARGEST_BLOCK = 5000


def fourier_size(count: int, width: float) -> tuple[int, int]:
    """Modes kept and samples around the circle, for `count` samples and a kernel of `width` steps."""
    period = int(fft.next_fast_len(count + math.ceil(REACH * width), real=True))
    return math.ceil(REACH / math.pi * period / width), period


def fourier_cost(count: int, width: float) -> float:
    """Multiplications of one solution; inf where the series would not be shorter than the record."""
    modes, period = fourier_size(count, width)
    return 2.0 * modes**3 if 4 * modes < period and modes <= LARGEST_BLOCK else math.inf


@dataclass(frozen=True, eq=False)
class FourierFit:
    """Solution for one gamma.

    Attributes
    ----------
    gamma : float
    smoother : FourierSmoother
    fitted : ndarray, shape (n,)
    open : ndarray, shape (n,)
        1 - leverage: residual over left-out residual.
    bias : float
    coef : ndarray, shape (2 K,)
        Coefficients of the cosines, then of the sines.
    blocks : tuple of (slice, ndarray)
        Posterior covariance of `coef` over the noise variance, in its diagonal blocks.
    """

    gamma: float
    smoother: FourierSmoother
    fitted: np.ndarray
    open: np.ndarray
    bias: float
    coef: np.ndarray
    blocks: tuple[tuple[slice, np.ndarray], ...]

    def value(self, position: np.ndarray, order: int = 0) -> np.ndarray:
        """Fitted function or its derivative of `order` per step at `position` (m,) in steps, shape (m,)."""
        s = self.smoother
        modes = s.modes
        series = (self.coef[:modes] - 1j * self.coef[modes:]) * (1j * s.angle) ** order
        out = np.empty(len(position))
        for rows in row_chunks(len(position), modes):
            turn = np.exp(1j * np.outer(position[rows] - s.middle, s.angle))
            out[rows] = (turn @ series).real
        return out + self.bias if order == 0 else out

    def on_samples(self, order: int) -> np.ndarray:
        """The same at the samples, by one Fourier transform, shape (n,)."""
        s = self.smoother
        modes = s.modes
        series = (self.coef[:modes] - 1j * self.coef[modes:]) * (1j * s.angle) ** order
        return s.series(np.concatenate([[self.bias if order == 0 else 0.0], series]))

    def unit_variance(self, position: np.ndarray, order: int = 0) -> np.ndarray:
        """Variance of `value` over the noise variance, shape (m,)."""
        s = self.smoother
        out = np.full(len(position), 1.0 / s.total if order == 0 else 0.0)
        for rows in row_chunks(len(position), s.modes):
            turn = np.exp(1j * np.outer(position[rows] - s.middle, s.angle)) * (1j * s.angle) ** order
            features = np.hstack([turn.real, turn.imag])
            if order == 0:
                features -= s.mean
            for part, inner in self.blocks:
                out[rows] += np.einsum("ij,ij->i", features[:, part] @ inner, features[:, part])
        return out


class FourierSmoother:
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
        self.count = count
        self.modes, self.period = fourier_size(count, width)
        self.middle = 0.5 * (count - 1)
        self.angle = 2.0 * np.pi / self.period * np.arange(1, self.modes + 1)
        # Power of each mode, by Poisson's sum; the constant mode is the bias's and drops out.
        power = 2.0 * math.sqrt(math.pi) * width / self.period * np.exp(-((0.5 * width * self.angle) ** 2))
        self.root = np.sqrt(np.concatenate([power, power]))
        self.weights = np.ones(count) if weights is None else weights
        self.total = float(self.weights.sum())
        self._phase = np.exp(0.5j * (count - 1) * 2.0 * np.pi / self.period * np.arange(2 * self.modes + 1))
        moments = self._transform(self.weights, 2 * self.modes)
        self.mean = np.concatenate([moments.real[1 : self.modes + 1], -moments.imag[1 : self.modes + 1]])
        self.mean /= self.total
        self._systems = self._scaled_grams(moments, weights is None)

    def _transform(self, values: np.ndarray, highest: int) -> np.ndarray:
        """Sums of values times exp(-i k angle) about the middle, k = 0 ... highest."""
        return fft.rfft(values, self.period)[: highest + 1] * self._phase[: highest + 1]

    def _project(self, values: np.ndarray) -> np.ndarray:
        """Scaled centred features transposed times values, shape (2 K,)."""
        sums = self._transform(values, self.modes)
        features = np.concatenate([sums.real[1:], -sums.imag[1:]]) - self.mean * sums.real[0]
        return self.root * features

    def series(self, coefficients: np.ndarray) -> np.ndarray:
        """Real part of the series of exp(i k angle), k = 0, 1, ..., about the middle, at the samples, shape (n,)."""
        spectrum = np.zeros(self.period // 2 + 1, dtype=complex)
        spectrum[: coefficients.size] = 0.5 * self.period * coefficients * self._phase[: coefficients.size].conj()
        spectrum[0] = self.period * coefficients[0].real
        return fft.irfft(spectrum, self.period)[: self.count]

    def _expand(self, coef: np.ndarray) -> np.ndarray:
        constant = -float(self.mean @ coef)
        return self.series(np.concatenate([[constant], coef[: self.modes] - 1j * coef[self.modes :]]))

    def _scaled_grams(self, moments: np.ndarray, even_weights: bool) -> list[tuple[slice, np.ndarray]]:
        k = self.modes
        cosine, sine = moments.real, -moments.imag
        sums = sliding_window_view(cosine[2:], k)[:k]
        differences = sliding_window_view(np.concatenate([cosine[k - 1 : 0 : -1], cosine[:k]]), k)[::-1]
        cos_cos, sin_sin = 0.5 * (differences + sums), 0.5 * (differences - sums)
        if even_weights:
            # About the middle of the record cosines are even and sines odd: two problems of half the size.
            parts = [(slice(0, k), cos_cos), (slice(k, 2 * k), sin_sin)]
        else:
            sums = sliding_window_view(sine[2:], k)[:k]
            differences = sliding_window_view(np.concatenate([-sine[k - 1 : 0 : -1], sine[:k]]), k)[::-1]
            cos_sin = 0.5 * (sums + differences)
            parts = [(slice(0, 2 * k), np.block([[cos_cos, cos_sin], [cos_sin.T, sin_sin]]))]
        for part, gram in parts:
            gram -= self.total * np.outer(self.mean[part], self.mean[part])
            gram *= self.root[part]
            gram *= self.root[part, None]
        return parts

    def solve(self, response: np.ndarray, gamma: float) -> FourierFit:
        """LS-SVM of response (n,).

        Raises
        ------
        FitError
            If gamma is so large that the ridge 1/gamma drowns in the rounding of the kernel matrix.
        """
        inverses = [(part, _ridge_inverse(gram, gamma)) for part, gram in self._systems]
        level = float(self.weights @ response) / self.total
        rest = response - level
        scaled, missed = np.zeros(2 * self.modes), rest
        # Normal equations lose digits; residuals taken on the record itself give them back (corrected
        # seminormal equations, Bjorck 1987).
        for _ in range(3):
            gradient = self._project(self.weights * missed) - scaled / gamma
            for part, inverse in inverses:
                scaled[part] += inverse @ gradient[part]
            fitted = self._expand(self.root * scaled)
            missed = rest - fitted
        for part, inverse in inverses:
            inverse *= self.root[part]
            inverse *= self.root[part, None]
        coef = self.root * scaled
        return FourierFit(
            gamma=gamma,
            smoother=self,
            fitted=fitted + level,
            open=1.0 - self._leverage(inverses),
            bias=level - float(self.mean @ coef),
            coef=coef,
            blocks=tuple(inverses),
        )

    def _leverage(self, blocks: list[tuple[slice, np.ndarray]]) -> np.ndarray:
        """Diagonal of the hat matrix: a trigonometric polynomial of twice the degree of the features."""
        k = self.modes
        coefficients = np.zeros(2 * k + 1, dtype=complex)
        pull = np.zeros(2 * k)
        for part, inner in blocks:
            pull[part] = inner @ self.mean[part]
            if part.stop - part.start == k:
                _add_products(coefficients, inner, 1.0 if part.start == 0 else -1.0)
            else:
                _add_products(coefficients, inner[:k, :k], 1.0)
                _add_products(coefficients, inner[k:, k:], -1.0)
                _add_products(coefficients, inner[:k, k:], -2.0j)
        coefficients[0] += 1.0 / self.total + float(self.mean @ pull)
        coefficients[1 : k + 1] -= 2.0 * (pull[:k] - 1j * pull[k:])
        return self.weights * self.series(coefficients)


def _add_products(coefficients: np.ndarray, inner: np.ndarray, sign: complex) -> None:
    """Add the series of a quadratic form in cosines (sign 1), sines (-1), or cosines with sines (-2j)."""
    k = len(inner)
    sums, differences = np.zeros(2 * k - 1), np.zeros(2 * k - 1)
    for row in range(k):
        sums[row : row + k] += inner[row]
        differences[k - 1 - row : 2 * k - 1 - row] += inner[row]
    upper, lower = differences[k - 1 :], differences[k - 1 :: -1]
    coefficients[2 : 2 * k + 1] += 0.5 * sign * sums
    if sign == -2.0j:
        # 2 cos(a) sin(b) = sin(a + b) + sin(b - a), and a sine is the real part of -i times the exponential.
        coefficients[1:k] += -1j * (upper - lower)[1:]
    else:
        coefficients[0] += 0.5 * upper[0]
        coefficients[1:k] += 0.5 * (upper + lower)[1:]


def _ridge_inverse(gram: np.ndarray, gamma: float) -> np.ndarray:
    ridged = gram.T.copy(order="F")
    ridged[np.diag_indices_from(ridged)] += 1.0 / gamma
    factor, failed = lapack.dpotrf(ridged, lower=1, overwrite_a=1)
    if failed:
        raise FitError(
            f"gamma {gamma:.3g} leaves no ridge above the rounding of the kernel matrix",
            cure="use a smaller gamma or a narrower kernel",
        )
    inverse, _ = lapack.dpotri(factor, lower=1, overwrite_c=1)
    for row in range(len(inverse)):
        inverse[row, row + 1 :] = inverse[row + 1 :, row]
    return inverse.T
