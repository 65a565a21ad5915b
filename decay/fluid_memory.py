"""Free decay with radiation memory, simulated.

Cummins' equation, divided by the inertia ``I + A_inf``::

    x'' + b1 x' + b2 |x'|x' + b3 x'^3 + c1 x + c3 x^3 + c5 x^5 + mu / (I + A_inf) = 0,   mu = int K(t - s) x'(s) ds

with the ship at rest before the release. K comes from :mod:`.transfer_function`, so that mu is the output of a small
linear system that is integrated beside the motion. b1, b2, b3 are what viscosity adds to the radiation.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numba import njit

from ..core.errors import FitError
from .equation import DIVERGED, STEPS_A_PERIOD
from .term_values import rising_times, term_values
from .transfer_function import TransferFunction

# Runge-Kutta of fourth order resolves a pole when its product with the step is below this.
_POLE_STEP = 0.2


@njit(cache=True, error_model="numpy", nogil=True)
def _rates(
    y: np.ndarray, k: np.ndarray, c: np.ndarray, top: np.ndarray, bottom: np.ndarray, inertia: float
) -> None:
    """Right-hand side: position, velocity, and the memory in controllable canonical form."""
    x, v = y[0], y[1]
    n = top.size
    force = 0.0
    chain = v
    for j in range(n):
        force += top[j] * y[2 + j]
        chain -= bottom[j + 1] * y[2 + j]
    x2 = x * x
    k[0] = v
    k[1] = -(c[0] + c[1] * abs(v) + c[2] * v * v) * v - (c[3] + c[4] * x2 + c[5] * x2 * x2) * x - force / inertia
    k[2] = chain
    for j in range(1, n):
        k[2 + j] = y[1 + j]


@njit(cache=True, error_model="numpy", nogil=True)
def integrate_memory_decay(
    time: np.ndarray,
    start: np.ndarray,
    coefficients: np.ndarray,
    top: np.ndarray,
    bottom: np.ndarray,
    inertia: float,
    longest: float,
) -> np.ndarray:
    """Position and velocity at the times, shape (n, 2); rows after a divergence are nan.

    Parameters
    ----------
    time : ndarray, shape (n,)
    start : ndarray, shape (2,)
    coefficients : ndarray, shape (6,)
    top, bottom : ndarray, shapes (m,) and (m + 1,)
        Numerator and denominator of the memory, highest power first.
    inertia : float
        I + A_inf.
    longest : float
        Longest step in s.
    """
    width = 2 + top.size
    path = np.full((time.size, 2), np.nan)
    y, trial = np.zeros(width), np.zeros(width)
    k1, k2, k3, k4 = np.zeros(width), np.zeros(width), np.zeros(width), np.zeros(width)
    y[0], y[1] = start[0], start[1]
    path[0] = start
    for i in range(1, time.size):
        interval = time[i] - time[i - 1]
        steps = max(math.ceil(interval / longest), 1)
        h = interval / steps
        for _ in range(steps):
            _rates(y, k1, coefficients, top, bottom, inertia)
            for j in range(width):
                trial[j] = y[j] + 0.5 * h * k1[j]
            _rates(trial, k2, coefficients, top, bottom, inertia)
            for j in range(width):
                trial[j] = y[j] + 0.5 * h * k2[j]
            _rates(trial, k3, coefficients, top, bottom, inertia)
            for j in range(width):
                trial[j] = y[j] + h * k3[j]
            _rates(trial, k4, coefficients, top, bottom, inertia)
            for j in range(width):
                y[j] += h / 6.0 * (k1[j] + 2.0 * k2[j] + 2.0 * k3[j] + k4[j])
        if not abs(y[0]) < DIVERGED:
            break
        path[i, 0], path[i, 1] = y[0], y[1]
    return path


def simulate_memory_decay(
    time: np.ndarray,
    start: tuple[float, float],
    coefficients: Mapping[str, float],
    memory: TransferFunction,
    inertia: float,
) -> np.ndarray:
    """Free decay with radiation memory.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s; the ship was held at rest before the first.
    start : tuple of float
        Coordinate in rad or m, and velocity, at the first time.
    coefficients : mapping of str to float
        Some of b1, b2, b3, c1, c3, c5 per unit of `inertia`; the others are zero.
    memory : TransferFunction
        K of the same motion, SI.
    inertia : float
        I + A_inf in kg m2 (heave: kg).

    Returns
    -------
    ndarray, shape (n, 2)
        Coordinate and velocity.

    Raises
    ------
    FitError
        For times that do not rise, an unknown term, c1 or an inertia that is not positive.
    """
    instants, values = rising_times(time), term_values(coefficients)
    if not (values[3] > 0.0 and inertia > 0.0):
        raise FitError("a decay needs a positive c1 and inertia", cure="check their signs and units")
    fastest = max(float(np.abs(memory.poles).max()), 1e-12)
    longest = min(2.0 * math.pi / math.sqrt(values[3]) / STEPS_A_PERIOD, _POLE_STEP / fastest)
    with np.errstate(over="ignore", invalid="ignore"):
        return integrate_memory_decay(
            instants,
            np.array(start, dtype=float),
            values,
            memory.numerator,
            memory.denominator,
            float(inertia),
            longest,
        )
