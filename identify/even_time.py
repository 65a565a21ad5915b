"""Records with a varying time step on an even grid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.errors import FitError

# Largest departure from an even grid, in steps, that counts as even: printed times are rounded.
UNEVENNESS = 0.02
# A solver that starts with tiny steps must not make the grid endless.
MOST_SAMPLES = 200_000


class EvenRecord(NamedTuple):
    """Time (n,), channels (n, m), and whether they were interpolated."""

    time: np.ndarray
    channels: np.ndarray
    interpolated: bool


def even_record(t: np.ndarray, x: np.ndarray) -> EvenRecord:
    """Channels on an even time grid; unchanged when the time step is even already.

    A solver with a Courant limit changes its time step. The mean over time is then not the mean over samples, and
    autocorrelation has no meaning in samples. Linear interpolation on the median step.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time or iteration number, increasing.
    x : ndarray, shape (n, m)
        Channels.

    Raises
    ------
    FitError
        If time does not increase.
    """
    time, channels = np.asarray(t, dtype=float), np.asarray(x, dtype=float)
    steps = np.diff(time)
    if time.size < 2 or not float(steps.min()) > 0.0:
        raise FitError("time does not increase at every sample", cure="drop repeated time stamps")
    length = float(time[-1] - time[0])
    mean = length / (time.size - 1)
    away = np.abs(time - (time[0] + mean * np.arange(time.size))).max()
    if away <= max(UNEVENNESS * mean, 1e-9 * abs(float(time[-1]))):
        return EvenRecord(time, channels, False)
    step = max(float(np.median(steps)), length / MOST_SAMPLES)
    count = max(round(length / step), 1) + 1
    grid = np.linspace(float(time[0]), float(time[-1]), count)
    resampled = np.column_stack([np.interp(grid, time, column) for column in channels.T])
    return EvenRecord(grid, resampled, True)
