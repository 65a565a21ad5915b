"""Split of a motion into its steady part, a centred mean over a minute, and the unsteady rest.

Source: full-scale measurements of container ships, 5th MASHCON 2019: the steady value at t is the mean from
t - 30 s to t + 30 s.
"""

from __future__ import annotations

import numpy as np

from ..core.errors import FitError
from .audit_sinkage import LONG_STEP

STEADY_WINDOW = 60.0
"""Length in s of the mean."""

FEWEST_IN_WINDOW = 10
"""Samples a window needs, that its mean may be called steady."""


def split_steady(
    time: np.ndarray, values: np.ndarray, window: float = STEADY_WINDOW
) -> tuple[np.ndarray, np.ndarray]:
    """Steady and unsteady part; their sum is the record.

    Parameters
    ----------
    time : ndarray, shape (n,)
        In s, increasing, with gaps or not.
    values : ndarray, shape (n,) or (n, k)
        Columns are split each.
    window : float
        Length in s of the centred mean, by the trapezoidal rule between its exact ends.

    Returns
    -------
    steady, unsteady : ndarray, shape of `values`
        nan within half a window of an end, of a gap or of a missing value: no mean is made of less than a window.

    Raises
    ------
    FitError
        When the time does not increase, the record is shorter than a window, or a window holds less than ten
        samples.
    """
    t, y = np.asarray(time, dtype=float), np.asarray(values, dtype=float)
    columns = y[:, None] if y.ndim == 1 else y
    steps = np.diff(t)
    if columns.shape[0] != t.size:
        raise FitError(f"{columns.shape[0]} values for {t.size} times", cure="cut both with the same window")
    if not np.isfinite(t).all() or np.any(steps <= 0.0):
        raise FitError("the time does not increase", cure="sort the record")
    if not window > 0.0 or t.size < 2 or t[-1] - t[0] < window:
        length = t[-1] - t[0] if t.size else 0.0
        raise FitError(f"a record of {length:.4g} s holds no mean over {window:g} s", cure="give the whole record")
    usual = float(np.median(steps))
    if window < FEWEST_IN_WINDOW * usual:
        raise FitError(
            f"a mean over {window:g} s holds less than {FEWEST_IN_WINDOW} samples of {usual:.4g} s",
            cure="widen the window",
        )
    early, late = t - 0.5 * window, t + 0.5 * window
    steady = np.column_stack([_mean_between(t, column, early, late, LONG_STEP * usual) for column in columns.T])
    steady = steady.reshape(y.shape)
    return steady, y - steady


def _mean_between(t: np.ndarray, y: np.ndarray, early: np.ndarray, late: np.ndarray, longest: float) -> np.ndarray:
    known = np.isfinite(y)
    steps = np.diff(t)
    area = np.where(known[1:] & known[:-1], 0.5 * steps * (y[1:] + y[:-1]), 0.0)
    broken = (steps > longest) | ~known[1:] | ~known[:-1]
    total = np.concatenate([[0.0], np.cumsum(area)])
    faults = np.concatenate([[0.0], np.cumsum(np.where(broken, steps, 0.0))])
    filled = np.where(known, y, 0.0)

    def integral(at: np.ndarray) -> np.ndarray:
        # Inside a step the value runs straight, its integral is a parabola.
        row = np.clip(np.searchsorted(t, at, side="right") - 1, 0, t.size - 2)
        part = at - t[row]
        slope = (filled[row + 1] - filled[row]) / steps[row]
        return np.asarray(total[row] + np.where(broken[row], 0.0, part * (filled[row] + 0.5 * slope * part)))

    mean = (integral(late) - integral(early)) / (late - early)
    whole = (early >= t[0]) & (late <= t[-1])
    whole &= np.interp(late, t, faults) - np.interp(early, t, faults) <= 1e-9 * (late - early)
    return np.where(whole & known, mean, np.nan)
