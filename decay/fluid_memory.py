"""Free decay with radiation memory, simulated.

Cummins' equation, divided by the inertia ``I + A_inf``::

    x'' + b1 x' + b2 |x'|x' + b3 x'^3 + c1 x + c3 x^3 + c5 x^5 + mu / (I + A_inf) = 0,   mu = int K(t - s) x'(s) ds

K comes from :mod:`.transfer_function`, so that mu is the output of a small linear system that is integrated beside the
motion. b1, b2, b3 are what viscosity adds to the radiation. The memory is empty when the ship was at rest before the
first time; waves of an earlier motion are put in as the state that :func:`memory_state` finds from its record.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from ..core.errors import FitError
from .equation import GRADIENTS, STEPS_A_PERIOD, STRAIGHT, integrate_decay
from .restoring_curve import RestoringCurve
from .term_values import rising_times, term_values
from .transfer_function import TransferFunction

# Runge-Kutta of fourth order resolves a pole when its product with the step is below this.
_POLE_STEP = 0.2


def simulate_memory_decay(
    time: np.ndarray,
    start: tuple[float, float],
    coefficients: Mapping[str, float],
    memory: TransferFunction,
    inertia: float,
    *,
    state: np.ndarray | None = None,
    curve: RestoringCurve | None = None,
    sensitivities: bool = False,
) -> np.ndarray:
    """Free decay with radiation memory.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s.
    start : tuple of float
        Coordinate in rad or m, and velocity, at the first time.
    coefficients : mapping of str to float
        Some of b1, b2, b3, c1, c3, c5 per unit of `inertia`; the others are zero.
    memory : TransferFunction
        K of the same motion, SI, of order m.
    inertia : float
        I + A_inf in kg m2 (heave: kg).
    state : ndarray, shape (m,), optional
        States of the memory at the first time; zero, for a ship that was held at rest, when not given.
    curve : RestoringCurve, optional
    sensitivities : bool
        Also the gradients of coordinate and velocity by b1, b2, b3, c1, c3, c5, the two initial values, the inertia.

    Returns
    -------
    ndarray, shape (n, 2) or (n, 20)
        Coordinate and velocity, then pairs of their gradients. Rows after a divergence are nan.

    Raises
    ------
    FitError
        For times that do not rise, an unknown term, c1 or an inertia that is not positive.
    """
    instants, values = rising_times(time), term_values(coefficients)
    if not (values[3] > 0.0 and inertia > 0.0):
        raise FitError("a decay needs a positive c1 and inertia", cure="check their signs and units")
    begin = np.concatenate([start, np.zeros(memory.order) if state is None else state])
    last, cubic = (1.0, STRAIGHT) if curve is None else (curve.last, curve.cubic)
    fastest = max(float(np.abs(memory.poles).max()), 1e-12)
    longest = min(2.0 * math.pi / math.sqrt(values[3]) / STEPS_A_PERIOD, _POLE_STEP / fastest)
    with np.errstate(over="ignore", invalid="ignore"):
        return integrate_decay(
            instants,
            begin,
            values,
            float(last),
            cubic,
            memory.numerator,
            memory.denominator,
            float(inertia),
            longest,
            GRADIENTS + 1 if sensitivities else 0,
        )


def memory_state(time: np.ndarray, value: np.ndarray, memory: TransferFunction) -> np.ndarray:
    """States of the memory at the last time of a motion that began at rest, shape (m,).

    The velocity is not needed: with ``z = w + b x`` the system ``z' = A z + b x'`` becomes ``w' = A w + A b x``, which
    is solved exactly for a coordinate that is straight between its samples.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Uniform, s.
    value : ndarray, shape (n,)
        Coordinate in rad or m; a constant rest position does not matter.
    memory : TransferFunction
    """
    from scipy.linalg import expm

    t, x = np.asarray(time, dtype=float), np.asarray(value, dtype=float)
    a, b, _ = memory.state_space()
    n = memory.order
    if t.size < 2:
        return np.zeros(n)
    step = float((t[-1] - t[0]) / (t.size - 1))
    # Exponential of the system with its input and the input's slope as further states.
    wide = np.zeros((n + 2, n + 2))
    wide[:n, :n], wide[:n, n] = a * step, a @ b * step
    wide[n, n + 1] = 1.0
    whole = expm(wide)
    keep, by_value, by_change = whole[:n, :n], whole[:n, n], whole[:n, n + 1]
    w = -b * x[0]
    for before, after in pairwise(x):
        w = keep @ w + by_value * before + by_change * (after - before)
    return np.asarray(w + b * x[-1])
