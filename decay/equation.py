"""Free decay integrated: the equation of motion with or without radiation memory, and its sensitivities, compiled.

Classical Runge-Kutta from sample to sample, with so many equal steps in an interval that a period has at least
`STEPS_A_PERIOD` of them. The memory is a small linear system beside the motion, in controllable canonical form; without
one it has no states. With ``NUMBA_DISABLE_JIT=1`` the same source runs as plain Python.
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
# Gradients by the six terms and by both initial values; with a memory one more, by the inertia.
GRADIENTS = len(TERMS) + 2

STRAIGHT = np.zeros((0, 4))
"""Table of the restoring curve g(x) = x."""

_NO_MEMORY = np.zeros(0)


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
def _memory(y: np.ndarray, k: np.ndarray, place: int, top: np.ndarray, bottom: np.ndarray) -> float:
    """Memory force of the motion whose coordinate is at `place`; its own states' rates are written."""
    n = top.size
    force = 0.0
    chain = y[place + 1]
    first = place + 2
    for j in range(n):
        force += top[j] * y[first + j]
        chain -= bottom[j + 1] * y[first + j]
    if n > 0:
        k[first] = chain
    for j in range(1, n):
        k[first + j] = y[first + j - 1]
    return force


@njit(cache=True, error_model="numpy", nogil=True)
def _derivative(
    y: np.ndarray,
    k: np.ndarray,
    c: np.ndarray,
    last: float,
    cubic: np.ndarray,
    top: np.ndarray,
    bottom: np.ndarray,
    inertia: float,
    gradients: int,
) -> None:
    """Right-hand side of the state and of its gradients."""
    x, v = y[0], y[1]
    g, slope = _shape(x, last, cubic)
    size = abs(v)
    x2, v2 = x * x, v * v
    without = top.size == 0
    force = 0.0 if without else _memory(y, k, 0, top, bottom)
    k[0] = v
    k[1] = (
        -(c[0] * v + c[1] * size * v + c[2] * v2 * v + c[3] * g + c[4] * x2 * x + c[5] * x2 * x2 * x)
        - force / inertia
    )
    if gradients == 0:
        return
    by_x = -(c[3] * slope + 3.0 * c[4] * x2 + 5.0 * c[5] * x2 * x2)
    by_v = -(c[0] + 2.0 * c[1] * size + 3.0 * c[2] * v2)
    width = 2 + top.size
    for place in range(width, width * (gradients + 1), width):
        k[place] = y[place + 1]
        k[place + 1] = by_x * y[place] + by_v * y[place + 1]
        # a call for each gradient, though it found no memory, would double the time
        if not without:
            k[place + 1] -= _memory(y, k, place, top, bottom) / inertia
    k[width + 1] -= v
    k[2 * width + 1] -= size * v
    k[3 * width + 1] -= v2 * v
    k[4 * width + 1] -= g
    k[5 * width + 1] -= x2 * x
    k[6 * width + 1] -= x2 * x2 * x
    if gradients > 8:
        k[9 * width + 1] += force / inertia**2


@njit(cache=True, error_model="numpy", nogil=True)
def integrate_decay(
    time: np.ndarray,
    start: np.ndarray,
    coefficients: np.ndarray,
    last: float,
    cubic: np.ndarray,
    top: np.ndarray,
    bottom: np.ndarray,
    inertia: float,
    longest: float,
    gradients: int,
) -> np.ndarray:
    """Coordinate and velocity at the times, and their gradients behind them in pairs: shape (n, 2 + 2 gradients).

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s.
    start : ndarray, shape (2 + m,)
        Coordinate, velocity and states of the memory at the first time.
    coefficients : ndarray, shape (6,)
        b1, b2, b3, c1, c3, c5.
    last, cubic : float, ndarray of shape (k, 4)
        Table of a restoring curve; k = 0 for g(x) = x.
    top, bottom : ndarray, shapes (m,) and (m + 1,)
        Numerator and denominator of the memory, highest power first; m = 0 for none.
    inertia : float
        I + A_inf; any without memory.
    longest : float
        Longest step in s.
    gradients : int
        0, or 8: by b1, b2, b3, c1, c3, c5 and the initial coordinate and velocity; 9: by the inertia as well.

    Returns
    -------
    ndarray
        Rows after a divergence are nan.
    """
    n, width = time.size, 2 + top.size
    size = width * (1 + gradients)
    path = np.full((n, 2 + 2 * gradients), np.nan)
    y = np.zeros(size)
    y[:width] = start
    if gradients > 0:
        y[7 * width] = 1.0
        y[8 * width + 1] = 1.0
    k1, k2, k3, k4 = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    trial = np.zeros(size)
    for j in range(gradients + 1):
        path[0, 2 * j], path[0, 2 * j + 1] = y[j * width], y[j * width + 1]
    for i in range(1, n):
        interval = time[i] - time[i - 1]
        steps = max(math.ceil(interval / longest), 1)
        h = interval / steps
        for _ in range(steps):
            _derivative(y, k1, coefficients, last, cubic, top, bottom, inertia, gradients)
            for j in range(size):
                trial[j] = y[j] + 0.5 * h * k1[j]
            _derivative(trial, k2, coefficients, last, cubic, top, bottom, inertia, gradients)
            for j in range(size):
                trial[j] = y[j] + 0.5 * h * k2[j]
            _derivative(trial, k3, coefficients, last, cubic, top, bottom, inertia, gradients)
            for j in range(size):
                trial[j] = y[j] + h * k3[j]
            _derivative(trial, k4, coefficients, last, cubic, top, bottom, inertia, gradients)
            for j in range(size):
                y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j])
        if not abs(y[0]) < DIVERGED:
            break
        for j in range(gradients + 1):
            path[i, 2 * j], path[i, 2 * j + 1] = y[j * width], y[j * width + 1]
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
    last, cubic = (1.0, STRAIGHT) if curve is None else (curve.last, curve.cubic)
    longest = 2.0 * math.pi / math.sqrt(values[3]) / STEPS_A_PERIOD
    with np.errstate(over="ignore", invalid="ignore"):
        return integrate_decay(
            instants,
            np.array(start, dtype=float),
            values,
            float(last),
            cubic,
            _NO_MEMORY,
            _NO_MEMORY,
            1.0,
            longest,
            GRADIENTS if sensitivities else 0,
        )
