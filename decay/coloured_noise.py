"""Autocorrelated residuals of decay fits: what they do to anything that is linear in the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..identify.autoregression import MAX_CYCLES_PER_BLOCK, AutoregressiveNoise, fit_autoregression

# Harmonics of the decay up to which the noise density is wanted.
HARMONICS = 5.0


@dataclass(frozen=True, eq=False)
class ColouredNoise:
    """Noise of several records as autoregressions of their residuals.

    Attributes
    ----------
    parts : tuple of AutoregressiveNoise
        One a record.
    cycles : tuple of float
        Cycles of the decay in a sample, for each record.
    dof : float
        Degrees of freedom of the noise density at the frequency of the decay.
    """

    parts: tuple[AutoregressiveNoise, ...]
    cycles: tuple[float, ...]
    dof: float

    @classmethod
    def of_residuals(
        cls, residuals: Sequence[np.ndarray], cycles: Sequence[float], fitted: float
    ) -> ColouredNoise:
        """Noise from residuals.

        Parameters
        ----------
        residuals : sequence of ndarray
            Uniformly sampled residuals, one array a record.
        cycles : sequence of float
            Cycles of the decay in a sample: time step over period.
        fitted : float
            Number of fitted parameters of each record; the power that they took out of the line is put back.
        """
        parts = []
        dof = 0.0
        for residual, f in zip(residuals, cycles):
            part = fit_autoregression(
                residual,
                highest_frequency=min(HARMONICS * f, 0.5),
                fitted=[(0.0, 1), (f, max(round(fitted), 1))],
            )
            parts.append(part)
            dof += float(part.dof([f])[0, 0])
        return cls(tuple(parts), tuple(cycles), dof)

    def density(self, record: int, frequencies: np.ndarray) -> np.ndarray:
        """Two-sided density of one record at frequencies in cycles a sample; white has its variance everywhere."""
        part = self.parts[record]
        # Block means know nothing of higher frequencies; the density is continued as a constant.
        limit = 0.5 if part.block == 1 else MAX_CYCLES_PER_BLOCK / part.block
        return part.density(np.minimum(frequencies, limit))[:, 0]

    def covariance(self, influences: Sequence[np.ndarray]) -> np.ndarray:
        """Covariance of estimates whose errors are ``sum over records of influence @ noise``, shape (p, p).

        Parameters
        ----------
        influences : sequence of ndarray, shape (p, n)
            One a record: what a unit error of each sample does to the estimates.
        """
        total = np.zeros((influences[0].shape[0],) * 2)
        for record, rows in enumerate(influences):
            length = 2 * rows.shape[1]
            spectrum = np.fft.rfft(rows, length, axis=1)
            density = self.density(record, np.arange(spectrum.shape[1]) / length)
            weight = np.full(spectrum.shape[1], 2.0 / length)
            weight[0] = 1.0 / length
            weight[-1] = 1.0 / length
            weighted = spectrum * (weight * density)
            total += weighted.real @ spectrum.real.T + weighted.imag @ spectrum.imag.T
        return 0.5 * (total + total.T)

    def white_floor(self, influences: Sequence[np.ndarray]) -> np.ndarray:
        """Covariance for white noise of the same variance, shape (p, p)."""
        return sum(
            (float(part.variance[0]) * rows @ rows.T for part, rows in zip(self.parts, influences)),
            np.zeros((influences[0].shape[0],) * 2),
        )

    @property
    def correlation_samples(self) -> tuple[float, ...]:
        """Integrated autocorrelation time of each record in samples, at least 1."""
        times = []
        for part in self.parts:
            variance = float(part.variance[0])
            tau = float(part.density([0.0])[0, 0]) / variance if variance > 0.0 else 1.0
            times.append(max(tau, 1.0))
        return tuple(times)
