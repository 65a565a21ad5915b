"""Harmonic basis of a forced motion, and the projection of many channels on it.

The basis is [1, cos a, sin a, cos 2a, sin 2a, ...] with a = omega t + phase. For whole cycles sampled
uniformly its columns are orthogonal and the projection needs no equations to be solved.
"""

from __future__ import annotations

import math

import numpy as np

from ..core.errors import FitError

# Largest condition number of the Gram matrix that normal equations may have; above it an orthogonal
# factorisation keeps the coefficients exact to rounding.
MAX_GRAM_CONDITION = 1e3
# Largest distance of a sample from an even grid, in steps, that counts as uniform sampling.
UNEVENNESS = 1e-8
# Beyond this the columns are dependent in double precision.
MAX_CONDITION = 1e10


def harmonic_basis(t: np.ndarray, omega: float, order: int, *, phase: float = 0.0) -> np.ndarray:
    """Columns [1, cos a, sin a, cos 2a, sin 2a, ...] with a = omega t + phase.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds.
    omega : float
        Fundamental frequency in rad/s.
    order : int
        Highest harmonic.
    phase : float
        Phase of the motion at t = 0 in rad.

    Returns
    -------
    ndarray, shape (n, 2 order + 1)
    """
    time = np.asarray(t, dtype=float)
    return _basis_rows(np.exp(1j * (omega * time + phase)), order).T


def _uniform_phasor(start: float, step: float, size: int) -> np.ndarray:
    # exp(i (start + step j)) as an outer product of two short rows: the same to rounding, and much faster.
    block = math.isqrt(size - 1) + 1
    coarse = np.exp(1j * (start + step * block * np.arange(-(-size // block))))
    fine = np.exp(1j * (step * np.arange(block)))
    return np.outer(coarse, fine).ravel()[:size]


def _basis_rows(phasor: np.ndarray, order: int) -> np.ndarray:
    # One row a function: every row is then contiguous, which the projection's matrix product likes.
    rows = np.empty((2 * order + 1, phasor.size))
    rows[0] = 1.0
    if order > 0:
        power = phasor
        for k in range(1, order + 1):
            rows[2 * k - 1], rows[2 * k] = power.real, power.imag
            if k < order:
                power = power * phasor
    return rows


def checked_time(t: np.ndarray) -> tuple[np.ndarray, float, bool]:
    """Time as floats, its mean step, and whether every sample lies within 1e-8 of a step on an even grid.

    Raises
    ------
    FitError
        If there are fewer than two samples, or time does not increase everywhere.
    """
    time = np.asarray(t, dtype=float)
    if time.ndim != 1 or time.size < 2:
        raise FitError("a harmonic analysis needs at least two samples", cure="widen the window")
    steps = np.diff(time)
    if not (float(steps.min()) > 0.0 and math.isfinite(float(time[-1]))):
        raise FitError("time does not increase at every sample", cure="drop repeated or missing time stamps")
    mean_step = float(time[-1] - time[0]) / (time.size - 1)
    # The steps first: they tell most uneven records at once.
    even = abs(float(steps[0]) - mean_step) <= UNEVENNESS * mean_step
    if even:
        away = time - (time[0] + mean_step * np.arange(time.size))
        even = max(float(away.max()), -float(away.min())) <= UNEVENNESS * mean_step
    return time, mean_step, even


def require_positive_frequency(omega: float) -> None:
    """Raise :class:`FitError` unless `omega` is a positive number."""
    if not (omega > 0.0 and math.isfinite(omega)):
        raise FitError(f"the frequency {omega} rad/s is not positive", cure="give omega in rad/s")


class HarmonicProjector:
    """Least-squares projection on mean and harmonics, factorised once and used for many channels.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds, increasing.
    omega : float
        Fundamental frequency in rad/s.
    order : int
        Highest harmonic.
    phase : float
        Phase of the motion at t = 0 in rad.
    trend : bool
        Fit a straight line along with the harmonics; its coefficient, per second about the middle of the
        window, is the last row of every projection.

    Attributes
    ----------
    orthogonal : bool
        True when uniform sampling over whole cycles makes the columns orthogonal.
    phasor : ndarray of complex, shape (n,)
        exp(i (omega t + phase)).
    inverse_gram : ndarray, shape (p, p)
        (B' B)^-1 of the p = 2 order + 1 (+ 1 with trend) columns.

    Raises
    ------
    FitError
        If the window cannot separate the harmonics: too short, too few samples, or a harmonic beyond half
        the sampling rate.
    """

    def __init__(
        self, t: np.ndarray, omega: float, order: int, *, phase: float = 0.0, trend: bool = False
    ) -> None:
        time, self.time_step, self.uniform = checked_time(t)
        require_positive_frequency(omega)
        if order < 0:
            raise FitError(f"the harmonic order {order} is negative", cure="use 1 or more")
        self.omega, self.order, self.phase, self.trend = float(omega), int(order), float(phase), trend
        self.size = time.size
        self.middle = 0.5 * float(time[0] + time[-1])
        self.cycles = self.size * self.time_step * self.omega / (2.0 * math.pi)
        p = 2 * order + 1 + int(trend)
        if self.size < p:
            raise FitError(
                f"{self.size} samples cannot carry {order} harmonics and the mean",
                cure="widen the window or lower the order",
            )
        if order * omega * self.time_step >= math.pi * (1.0 - 1e-9):
            raise FitError(
                f"harmonic {order} of {omega:.4g} rad/s lies beyond half the sampling rate",
                cure="lower the order",
            )
        if self.uniform:
            start = self.omega * float(time[0]) + self.phase
            phasor = _uniform_phasor(start, self.omega * self.time_step, self.size)
        else:
            phasor = np.exp(1j * (self.omega * time + self.phase))
        rows = _basis_rows(phasor, order)
        if trend:
            rows = np.vstack([rows, time - self.middle])
        self.phasor = phasor
        self._rows = rows
        self._pseudo_inverse: np.ndarray | None = None
        whole = abs(self.cycles - round(self.cycles)) <= 1e-9 * self.cycles and round(self.cycles) >= 1
        self.orthogonal = bool(self.uniform and whole and not trend)
        if self.orthogonal:
            diagonal = np.full(p, 2.0 / self.size)
            diagonal[0] = 1.0 / self.size
            self.inverse_gram = np.diag(diagonal)
        else:
            self._factorise()

    def _factorise(self) -> None:
        gram = self._rows @ self._rows.T
        scale = np.sqrt(np.diagonal(gram))
        eigenvalues, vectors = np.linalg.eigh(gram / np.outer(scale, scale))
        if eigenvalues[0] * MAX_GRAM_CONDITION > eigenvalues[-1]:
            inverse = (vectors / eigenvalues) @ vectors.T
        else:
            q, r = np.linalg.qr((self._rows / scale[:, None]).T)
            if np.linalg.cond(r) > MAX_CONDITION:
                raise FitError(
                    f"a window of {self.cycles:.2f} cycles cannot separate {self.order} harmonics",
                    cure="widen the window or lower the order",
                )
            inner = np.linalg.inv(r)
            inverse = inner @ inner.T
            self._pseudo_inverse = (inner @ q.T) / scale[:, None]
        self.inverse_gram = inverse / np.outer(scale, scale)

    @property
    def has_normal_equations(self) -> bool:
        """True when a projection is `inverse_gram` times the products with the basis, exact to rounding."""
        return self._pseudo_inverse is None

    @property
    def basis(self) -> np.ndarray:
        """The basis, shape (n, p)."""
        return self._rows.T

    def project(self, y: np.ndarray) -> np.ndarray:
        """Coefficients of the channels in `y`.

        Parameters
        ----------
        y : ndarray, shape (n,) or (n, m)
            Channels in columns.

        Returns
        -------
        ndarray, shape (p,) or (p, m)
            Rows: mean, cos 1, sin 1, cos 2, sin 2, ... (and the slope with trend).

        Raises
        ------
        FitError
            If the number of rows differs from the time's, or a value is not finite.
        """
        channels = np.asarray(y, dtype=float)
        if channels.shape[0] != self.size:
            raise FitError(
                f"the channels have {channels.shape[0]} rows and the time {self.size}",
                cure="cut time and channels with the same window",
            )
        if self._pseudo_inverse is not None:
            result = self._pseudo_inverse @ channels
        else:
            products = self._rows @ channels
            if self.orthogonal:
                result = (products.T * np.diagonal(self.inverse_gram)).T
            else:
                result = self.inverse_gram @ products
        if not np.isfinite(result).all():
            raise FitError("a channel holds values that are not finite", cure="fill or cut the gaps first")
        return result

    def reconstruct(self, coefficients: np.ndarray) -> np.ndarray:
        """Series of shape (n,) or (n, m) with the given coefficients, shape (p,) or (p, m)."""
        return self._rows.T @ np.asarray(coefficients, dtype=float)

    def reconstruct_rows(self, coefficients: np.ndarray) -> np.ndarray:
        """Series of shape (m, n), one contiguous row a channel, with coefficients of shape (p, m)."""
        return coefficients.T @ self._rows
