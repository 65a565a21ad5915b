"""Noise of a record as an autoregressive process: spectral density at low frequency, and how sure it is.

Force noise in a towing tank is never white: the flow, the carriage and the rails remember. What decides the
standard error of a mean or of a harmonic is the noise density at that one low frequency. It is estimated
here from block means (which keep the low frequencies and drop the electrical noise that would hide a slow
component from a short autoregression) by Burg's recursion with the order chosen by AICc.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .burg import burg_recursion

TARGET_BLOCKS = 512
MAX_ORDER = 20
# Lines of the periodogram averaged to replace one that a fit emptied.
NEIGHBOURS = 6
# Lengths without prime factors above 5, at which a Fourier transform is fast.
FAST_LENGTHS = sorted(2**a * 3**b * 5**c for a in range(15) for b in range(10) for c in range(7))
GOLDEN_ANGLE = 2.399963
# Block means distort the spectrum above this many cycles a block.
MAX_CYCLES_PER_BLOCK = 0.125


@dataclass(frozen=True, eq=False)
class AutoregressiveNoise:
    """Autoregressions of several channels, a_0 x_t + a_1 x_(t-1) + ... = e_t with a_0 = 1.

    Attributes
    ----------
    coefficients : ndarray, shape (k, p + 1)
        Prediction-error filters of the block means; zero beyond each channel's order.
    innovation : ndarray, shape (k,)
        Variance of e_t; zero for a constant channel.
    order : ndarray of int, shape (k,)
        Order chosen for each channel.
    variance : ndarray, shape (k,)
        Variance of the samples themselves.
    samples, blocks, block : int
        Samples in the record, block means used, samples in a block.
    """

    coefficients: np.ndarray
    innovation: np.ndarray
    order: np.ndarray
    variance: np.ndarray
    samples: int
    blocks: int
    block: int

    def density(self, frequencies: np.ndarray | Sequence[float]) -> np.ndarray:
        """Two-sided noise density S, shape (m, k), at `frequencies` (m,) in cycles a sample.

        Normalised so that white noise has S = variance, var(mean) = S(0)/n, and the coefficient of a cosine
        at f has variance 2 S(f)/n. Corrected for the downward bias of an autoregression fitted to a short
        record (Kendall 1954), which is about two effective samples' worth.
        """
        raw = self._raw_density(np.asarray(frequencies, dtype=float))
        # Beyond a factor e the record is too short to say anything; the degrees of freedom tell that.
        share = 2.0 * raw / np.maximum(self.variance * self.samples, 1e-300)
        return raw * np.exp(np.minimum(share, 1.0))

    def dof(self, frequencies: np.ndarray | Sequence[float]) -> np.ndarray:
        """Chi-square degrees of freedom of :meth:`density`, shape (m, k).

        From the large-sample variance of ln S by the delta method, var = (2 + g' sigma^2 Gamma^-1 g)/blocks,
        g the gradient by the coefficients, with Gamma inverted by the formula of Gohberg and Semencul.
        """
        f = np.asarray(frequencies, dtype=float) * self.block
        result = np.full((f.size, self.order.size), float(self.blocks - 1))
        for channel, order in enumerate(self.order):
            if order == 0:
                continue
            a = self.coefficients[channel, : order + 1]
            phasors = np.exp(-2j * np.pi * np.outer(f, np.arange(order + 1)))
            gradient = -2.0 * np.real(phasors[:, 1:] / (phasors @ a)[:, None])
            lag = np.subtract.outer(np.arange(order), np.arange(order))
            ahead = gradient @ np.where(lag >= 0, a[lag], 0.0)
            back = gradient @ np.where(lag >= 0, a[order - lag.clip(0)], 0.0)
            spread = (ahead**2 - back**2).sum(axis=1)
            # Never negative but by rounding, near a unit root.
            result[:, channel] = 2.0 * self.blocks / (2.0 + np.maximum(spread, 0.0))
        # Fewer than two degrees of freedom give an interval without a finite variance: no more can be said.
        return np.clip(result, 2.0, max(self.blocks - 1.0, 2.0))

    def _raw_density(self, frequencies: np.ndarray) -> np.ndarray:
        lags = np.arange(self.coefficients.shape[1])
        transfer = np.exp(-2j * np.pi * self.block * np.outer(frequencies, lags)) @ self.coefficients.T
        density = self.block * self.innovation / np.maximum(np.abs(transfer) ** 2, 1e-300)
        if self.block > 1:
            attenuation = np.sinc(self.block * frequencies) / np.sinc(frequencies)
            density = density / attenuation[:, None] ** 2
        return density


def fit_autoregression(
    noise: np.ndarray,
    *,
    highest_frequency: float = 0.0,
    fitted: Sequence[tuple[float, int]] = ((0.0, 1),),
) -> AutoregressiveNoise:
    """Fit an autoregression to each column of `noise`.

    Parameters
    ----------
    noise : ndarray, shape (n,) or (n, k)
        Residuals, uniformly sampled. The mean is removed here.
    highest_frequency : float
        Highest frequency, cycles a sample, at which the density will be asked; limits the block length.
    fitted : sequence of (float, int)
        What was fitted and removed before: frequency in cycles a sample, and number of regressors there;
        the mean is ``(0, 1)``, a cosine and a sine are ``(f, 2)``.

    Raises
    ------
    FitError
        If there is no sample or a value is not finite.
    """
    x = np.asarray(noise, dtype=float)
    x = x[None, :] if x.ndim == 1 else np.ascontiguousarray(x.T)
    n = x.shape[1]
    if n == 0:
        raise FitError("there is no sample to estimate noise from", cure="widen the window")
    centre = x.mean(axis=1, keepdims=True)
    if not np.isfinite(centre).all():
        raise FitError("the channel holds values that are not finite", cure="fill or cut the gaps first")
    x = x - centre
    variance = np.einsum("ij,ij->i", x, x) / max(n - 1, 1)
    # A constant channel leaves only the rounding of its own mean behind.
    constant = variance <= (4.0 * np.finfo(float).eps * np.abs(centre[:, 0])) ** 2 * n
    variance = np.where(constant, 0.0, variance)

    block = max(n // TARGET_BLOCKS, 1)
    if highest_frequency > 0.0:
        block = min(block, max(int(MAX_CYCLES_PER_BLOCK / highest_frequency), 1))
    blocks = n // block
    if block > 1:
        x = x[:, n - blocks * block :].reshape(-1, blocks, block) @ np.full(block, 1.0 / block)
        x -= x.mean(axis=1, keepdims=True)
    if fitted and blocks > 4:
        x = x + _power_taken_by_fit(x, [(f * block, count) for f, count in fitted])
    fits = [burg_recursion(row, min(MAX_ORDER, blocks // 5)) for row in x]
    order = np.array([0 if flat else filter_.size - 1 for (filter_, _), flat in zip(fits, constant)])
    coefficients = np.zeros((len(fits), int(order.max()) + 1))
    for row, (filter_, _), p in zip(coefficients, fits, order):
        row[: p + 1] = filter_[: p + 1]
    innovation = np.array([power for _, power in fits])
    return AutoregressiveNoise(
        coefficients=coefficients,
        innovation=np.where(constant, 0.0, innovation),
        order=order,
        variance=variance,
        samples=n,
        blocks=blocks,
        block=block,
    )


def _power_taken_by_fit(rows: np.ndarray, fitted: Sequence[tuple[float, int]]) -> np.ndarray:
    """Series that put the expected power back into the lines that a fit emptied, shape (k, m).

    A regression with q regressors at a frequency takes q times the noise density out of that line. Left
    empty, these lines pull the autoregression down exactly where its density is wanted. The density is read
    from the nearest lines of the periodogram that no regressor touched.
    """
    k, m = rows.shape
    # A transform of a length with small factors is several times faster; a few blocks less do not matter.
    length = FAST_LENGTHS[bisect_right(FAST_LENGTHS, m) - 1]
    spectrum = np.fft.rfft(rows[:, :length], axis=1)
    power = (spectrum.real**2 + spectrum.imag**2) / length
    untouched = np.ones(power.shape[1], dtype=bool)
    for f, _ in fitted:
        untouched[max(math.ceil(f * length - 0.75), 0) : math.floor(f * length + 0.75) + 1] = False
    clean = np.flatnonzero(untouched)
    back = np.zeros((k, m))
    if clean.size == 0:
        return back
    steps = np.arange(m)
    for turn, (f, count) in enumerate(fitted):
        first = int(np.searchsorted(clean, f * length)) - NEIGHBOURS // 2
        first = max(min(first, clean.size - NEIGHBOURS), 0)
        near = power[:, clean[first : first + NEIGHBOURS]]
        density = near.sum(axis=1) / near.shape[1]
        # A constant of c carries m c^2, a cosine of amplitude A carries m A^2 / 2; any phase will do.
        shape = math.sqrt(2.0) * np.cos(2.0 * math.pi * f * steps + GOLDEN_ANGLE * turn) if f > 0.0 else 1.0
        back += np.sqrt(count * density / m)[:, None] * shape
    return back
