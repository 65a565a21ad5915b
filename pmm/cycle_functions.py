"""Functions of a periodic motion over a window, from one cycle.

What depends on a periodic motion alone repeats itself every cycle, so that its Fourier series tells it at all samples
of the window. The sums over the samples, which a projection needs, are geometric series. Both are the same as sample
by sample, to rounding; functions with corners, whose series is long, are refused.
"""

from __future__ import annotations

import math

import numpy as np

from ..identify.harmonics import HarmonicProjector

NODES = 64
"""Phases of a cycle at which a function is asked."""

_RESOLVED = 1e-13
"""Largest size of the upper quarter of a series, relative to its largest coefficient."""

_NEGLIGIBLE = 1e-16
"""Coefficients below this part of the largest do not change a double."""


class CycleFunctions:
    """Projection and values over a window of functions given on one cycle.

    Parameters
    ----------
    projector : HarmonicProjector
        Of the window; its sampling is uniform.
    start, step : float
        Time of the first sample and sampling interval in s.

    Attributes
    ----------
    times : ndarray, shape (NODES,)
        Where functions are to be given, in s.
    """

    def __init__(self, projector: HarmonicProjector, start: float, step: float) -> None:
        self._projector = projector
        self._start, self._turn = start, projector.omega * step
        self.times = start + 2.0 * math.pi / projector.omega * np.arange(NODES) / NODES

    def series(self, values: np.ndarray) -> np.ndarray | None:
        """Fourier coefficients of functions given at `times`, shape (NODES, m); None when 64 phases are too few."""
        coefficients = np.fft.rfft(values, axis=0) / NODES
        coefficients[1:] *= 2.0
        size = np.abs(coefficients)
        tail = size[3 * len(size) // 4 :].max(axis=0)
        largest = size.max(axis=0)
        # What is small beside the other functions is rounding, e.g. the sway velocity in pure yaw.
        if (tail > np.maximum(_RESOLVED * largest, _NEGLIGIBLE * largest.max())).any():
            return None
        return coefficients

    def project(self, values: np.ndarray) -> np.ndarray | None:
        """Mean and harmonics over the window of functions given at `times`.

        Parameters
        ----------
        values : ndarray, shape (NODES, m)

        Returns
        -------
        ndarray, shape (2 order + 1, m), or None
            None when the functions are not resolved.
        """
        projector = self._projector
        coefficients = self.series(values)
        if coefficients is None or not projector.has_normal_equations:
            return None
        # The series is about the first sample, the basis about time zero and the phase of the projector.
        products = self._products(len(coefficients))
        return projector.inverse_gram @ np.real(products @ coefficients)

    def _products(self, lines: int) -> np.ndarray:
        """Sums over the samples of each row of the basis times exp(i h a), a = 0 at the first sample."""
        order, size = self._projector.order, self._projector.size
        number = np.arange(-order, lines + order)
        half = 0.5 * self._turn * number
        sine = np.sin(half)
        turning = np.abs(sine) > 1e-12
        ratio = np.full(len(number), float(size))
        ratio[turning] = np.sin(size * half[turning]) / sine[turning]
        sums = ratio * np.exp(1j * (size - 1) * half)
        first = self._projector.omega * self._start + self._projector.phase
        result = np.empty((2 * order + 1, lines), dtype=complex)
        result[0] = sums[order : order + lines]
        for k in range(1, order + 1):
            ahead = np.exp(1j * k * first) * sums[order + k : order + k + lines]
            back = np.exp(-1j * k * first) * sums[order - k : order - k + lines]
            result[2 * k - 1] = 0.5 * (ahead + back)
            result[2 * k] = -0.5j * (ahead - back)
        return result

    def at_samples(self, values: np.ndarray) -> np.ndarray | None:
        """A function given at `times`, shape (NODES,), at every sample of the window; None when not resolved."""
        coefficients = self.series(values[:, None])
        if coefficients is None:
            return None
        c = coefficients[:, 0]
        lines = np.flatnonzero(np.abs(c) > _NEGLIGIBLE * np.abs(c).max())
        last = int(lines[-1]) if len(lines) else 0
        phasor = self._projector.phasor * np.exp(
            -1j * (self._projector.omega * self._start + self._projector.phase)
        )
        total = np.full(self._projector.size, c[last], dtype=complex)
        for k in range(last - 1, -1, -1):
            total *= phasor
            total += c[k]
        return total.real
