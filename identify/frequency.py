"""Frequency of a forced motion by variable projection (Golub and Pereyra 1973).

The harmonics' coefficients are eliminated by projection, so that the misfit is a function of the frequency
alone: a padded periodogram finds the neighbourhood, a bounded search the minimum, and Gauss-Newton steps the
last digits.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from ..core.errors import FitError
from .autoregression import fit_autoregression
from .harmonic_projection import HarmonicProjector, checked_time

# A subharmonic of the strongest line is taken for the fundamental only if it leaves this much less misfit.
SUBHARMONIC_GAIN = 0.5


class FrequencyEstimate(NamedTuple):
    """Fundamental frequency and its standard error, rad/s."""

    omega: float
    se: float


def find_frequency(t: np.ndarray, y: np.ndarray, order: int = 3) -> FrequencyEstimate:
    """Fundamental frequency of a periodic record; the number of cycles need not be whole.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds, increasing.
    y : ndarray, shape (n,) or (n, m)
        Channels that share the frequency; each is weighed by its own noise.
    order : int
        Harmonics in the model.

    Returns
    -------
    FrequencyEstimate
        omega and its standard error in rad/s, autocorrelation of the noise included.

    Raises
    ------
    FitError
        If the record holds less than about one cycle, or nothing varies.
    """
    time, _, _ = checked_time(t)
    if order < 1:
        raise FitError("a frequency cannot be found without a harmonic", cure="use order 1 or more")
    channels = np.asarray(y, dtype=float)
    channels = channels[:, None] if channels.ndim == 1 else channels
    channels = channels - channels.mean(axis=0)
    spread = channels.std(axis=0)
    if not np.isfinite(spread).all():
        raise FitError("a channel holds values that are not finite", cure="fill or cut the gaps first")
    moving = spread > 0.0
    if not moving.any():
        raise FitError("no channel varies: there is no frequency to find", cure="give a moving channel")
    channels = channels[:, moving] / spread[moving]
    # Centred time keeps the frequency and the phases apart in the Gauss-Newton steps.
    time = time - 0.5 * (time[0] + time[-1])

    strongest = _strongest_line(time, channels)
    omega, misfit = _search(time, channels, order, strongest)
    for divisor in range(2, order + 1):
        if strongest / divisor * (time[-1] - time[0]) < 2.0 * math.pi * 0.9:
            break
        trial, left = _search(time, channels, order, strongest / divisor)
        if left < SUBHARMONIC_GAIN * misfit and misfit - left > 1e-9 * channels.size:
            omega, misfit = trial, left
    return _polish(time, channels, order, omega)


def _strongest_line(time: np.ndarray, channels: np.ndarray) -> float:
    n = time.size
    even = np.linspace(time[0], time[-1], n)
    resampled = np.column_stack([np.interp(even, time, column) for column in channels.T])
    length = 1 << (8 * n - 1).bit_length()
    power = (np.abs(np.fft.rfft(resampled, length, axis=0)) ** 2).sum(axis=1)
    step = float(time[-1] - time[0]) / (n - 1)
    lowest = max(int(0.8 * length / n), 1)
    peak = lowest + int(np.argmax(power[lowest:]))
    if peak == lowest:
        raise FitError(
            "the record holds less than one cycle, or drifts more than it oscillates",
            cure="give omega, or widen the window",
        )
    return 2.0 * math.pi * peak / (length * step)


def _misfit(time: np.ndarray, channels: np.ndarray, order: int, omega: float) -> float:
    projector = HarmonicProjector(time, omega, order)
    residual = channels - projector.reconstruct(projector.project(channels))
    return float(np.vdot(residual, residual))


def _search(time: np.ndarray, channels: np.ndarray, order: int, near: float) -> tuple[float, float]:
    from scipy.optimize import minimize_scalar

    # The main lobe of a periodogram is one line spacing wide to each side.
    spacing = 2.0 * math.pi / float(time[-1] - time[0])
    limit = 0.999 * math.pi * (time.size - 1) / float(time[-1] - time[0])
    usable = max(min(order, int(limit / (near + spacing))), 1)
    grid = near + spacing * np.linspace(-0.75, 0.75, 13)
    grid = grid[(grid > 0.5 * spacing) & (grid * usable < limit)]
    if grid.size == 0:
        raise FitError("the motion is too fast for the sampling rate", cure="give omega, or lower the order")
    values = [_misfit(time, channels, usable, omega) for omega in grid]
    best = float(grid[int(np.argmin(values))])
    width = 0.125 * spacing
    found = minimize_scalar(
        lambda omega: _misfit(time, channels, usable, omega),
        bounds=(best - width, best + width),
        method="bounded",
        options={"xatol": 1e-6 * spacing},
    )
    return float(found.x), float(found.fun)


def _polish(time: np.ndarray, channels: np.ndarray, order: int, omega: float) -> FrequencyEstimate:
    spacing = 2.0 * math.pi / float(time[-1] - time[0])
    k = np.arange(1, order + 1)[:, None]
    information = 0.0
    for _ in range(12):
        projector = HarmonicProjector(time, omega, order)
        solution = projector.project(channels)
        residual = channels - projector.reconstruct(solution)
        turned = np.zeros_like(solution)
        turned[1::2], turned[2::2] = k * solution[2::2], -k * solution[1::2]
        gradient = time[:, None] * projector.reconstruct(turned)
        gradient -= projector.reconstruct(projector.project(gradient))
        line = omega * projector.time_step / (2.0 * math.pi)
        fitted = [(0.0, 1), *((h * line, 2) for h in range(1, order + 1))]
        noise = fit_autoregression(residual, highest_frequency=line, fitted=fitted)
        density = np.maximum(noise.density([line])[0], 1e-30)
        information = float(np.sum(np.einsum("ij,ij->j", gradient, gradient) / density))
        step = float(np.sum(np.einsum("ij,ij->j", gradient, residual) / density)) / information
        if abs(step) > spacing:
            raise FitError("the frequency does not converge", cure="give omega")
        omega += step
        if abs(step) <= 1e-14 * omega:
            break
    return FrequencyEstimate(omega, 1.0 / math.sqrt(information))
