"""Free decay integrated: the equation of motion and its sensitivities, as compiled kernels.

Classical Runge-Kutta from sample to sample, with so many equal steps in an interval that a period has at least
`STEPS_A_PERIOD` of them. With ``NUMBA_DISABLE_JIT=1`` the same source runs as plain Python.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from ..core.errors import FitError
from .damping_models import TERMS
from .restoring_curve import RestoringCurve

# The error of the phase is then below 1e-6 of a period in a hundred periods.
STEPS_A_PERIOD = 160
# A coordinate beyond this (rad or m) is a diverged trial of the search, not a motion.
DIVERGED = 1.0e4
# Coordinate and velocity, and their gradients by the six terms and by both initial values.
STATES = 2 + 2 * (len(TERMS) + 2)

_STRAIGHT = np.zeros((0, 4))


@njit(cache=True, error_model="numpy", nogil=True)
def _shape(x: float, last: float, cubic: np.ndarray) -> tuple[float, float]:
    """Shape of the restoring moment and its slope."""
    count = cubic.shape[0]
    if count == 0:
        return x, 1.0
    size = abs(x)
    step = last / count
    row = min(int(min(size, last) / step), count - 1)
    s = min(size, last) - row * step
    value = cubic[row, 0] + s * (cubic[row, 1] + s * (cubic[row, 2] + s * cubic[row, 3]))
    slope = cubic[row, 1] + s * (2.0 * cubic[row, 2] + 3.0 * s * cubic[row, 3])
    if size > last:
        value += slope * (size - last)
    return (value if x >= 0.0 else -value), slope


@njit(cache=True, error_model="numpy", nogil=True)
def _derivative(y: np.ndarray, k: np.ndarray, c: np.ndarray, last: float, cubic: np.ndarray, width: int) -> None:
    """Right-hand side of the state and, when `width` asks for them, of the sensitivities."""
    x, v = y[0], y[1]
    g, slope = _shape(x, last, cubic)
    size = abs(v)
    x2, v2 = x * x, v * v
    k[0] = v
    k[1] = -(c[0] * v + c[1] * size * v + c[2] * v2 * v + c[3] * g + c[4] * x2 * x + c[5] * x2 * x2 * x)
    if width == 2:
        return
    by_x = -(c[3] * slope + 3.0 * c[4] * x2 + 5.0 * c[5] * x2 * x2)
    by_v = -(c[0] + 2.0 * c[1] * size + 3.0 * c[2] * v2)
    for j in range(2, width, 2):
        k[j] = y[j + 1]
        k[j + 1] = by_x * y[j] + by_v * y[j + 1]
    k[3] -= v
    k[5] -= size * v
    k[7] -= v2 * v
    k[9] -= g
    k[11] -= x2 * x
    k[13] -= x2 * x2 * x


@njit(cache=True, error_model="numpy", nogil=True)
def integrate_decay(
    time: np.ndarray,
    start: np.ndarray,
    coefficients: np.ndarray,
    last: float,
    cubic: np.ndarray,
    longest: float,
    width: int,
) -> np.ndarray:
    """States at the times, shape (n, width).

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s.
    start : ndarray, shape (2,)
        Coordinate and velocity at the first time.
    coefficients : ndarray, shape (6,)
        b1, b2, b3, c1, c3, c5.
    last, cubic : float, ndarray of shape (m, 4)
        Table of a restoring curve; m = 0 for g(x) = x.
    longest : float
        Longest step in s.
    width : int
        2 for coordinate and velocity; `STATES` for their gradients by b1, b2, b3, c1, c3, c5 and the initial
        coordinate and velocity behind them, in pairs.

    Returns
    -------
    ndarray
        Rows after a divergence are nan.
    """
    n = time.size
    path = np.full((n, width), np.nan)
    y = np.zeros(width)
    y[0], y[1] = start[0], start[1]
    if width > 2:
        y[width - 4] = 1.0
        y[width - 1] = 1.0
    k1, k2, k3, k4 = np.zeros(width), np.zeros(width), np.zeros(width), np.zeros(width)
    trial = np.zeros(width)
    path[0] = y
    for i in range(1, n):
        interval = time[i] - time[i - 1]
        steps = max(math.ceil(interval / longest), 1)
        h = interval / steps
        for _ in range(steps):
            _derivative(y, k1, coefficients, last, cubic, width)
            for j in range(width):
                trial[j] = y[j] + 0.5 * h * k1[j]
            _derivative(trial, k2, coefficients, last, cubic, width)
            for j in range(width):
                trial[j] = y[j] + 0.5 * h * k2[j]
            _derivative(trial, k3, coefficients, last, cubic, width)
            for j in range(width):
                trial[j] = y[j] + h * k3[j]
            _derivative(trial, k4, coefficients, last, cubic, width)
            for j in range(width):
                y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j])
        if not abs(y[0]) < DIVERGED:
            break
        for j in range(width):
            path[i, j] = y[j]
    return path


def simulate_decay(
    time: np.ndarray,
    start: tuple[float, float],
    coefficients: np.ndarray,
    *,
    curve: RestoringCurve | None = None,
    sensitivities: bool = False,
) -> np.ndarray:
    """Free decay at given times.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s.
    start : tuple of float
        Coordinate in rad or m and velocity at the first time.
    coefficients : ndarray, shape (6,)
        b1, b2, b3, c1, c3, c5 of the home equation.
    curve : RestoringCurve, optional
    sensitivities : bool
        Also the gradients of coordinate and velocity by the six coefficients and the two initial values.

    Returns
    -------
    ndarray, shape (n, 2) or (n, 18)
        Coordinate and velocity, then pairs of their gradients. Rows after a divergence are nan.

    Raises
    ------
    FitError
        If the times do not rise or c1 is not positive.
    """
    instants = np.ascontiguousarray(time, dtype=float)
    values = np.ascontiguousarray(coefficients, dtype=float)
    if instants.ndim != 1 or instants.size == 0 or not (np.diff(instants) > 0.0).all():
        raise FitError("the times of a decay do not rise", cure="give rising times in s")
    if values.shape != (len(TERMS),) or not np.isfinite(values).all() or not values[3] > 0.0:
        raise FitError("a decay needs six finite coefficients with c1 > 0", cure="give b1, b2, b3, c1, c3, c5")
    last, cubic = (1.0, _STRAIGHT) if curve is None else (curve.last, curve.cubic)
    longest = 2.0 * math.pi / math.sqrt(values[3]) / STEPS_A_PERIOD
    width = STATES if sensitivities else 2
    with np.errstate(over="ignore", invalid="ignore"):
        return integrate_decay(instants, np.array(start, dtype=float), values, float(last), cubic, longest, width)
