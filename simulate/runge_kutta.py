"""Dormand and Prince's method of order 5(4) with its dense output of order 4 (Hairer, Noersett and Wanner 1993)."""

from __future__ import annotations

import numpy as np

from .compilation import compiled
from .equations import derivative
from .parameters import STATES

STAGES = 7

_DENSE = np.array(
    [
        -12715105075 / 11282082432,
        0.0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)


@compiled
def step(
    state: np.ndarray,
    h: float,
    control: np.ndarray,
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    p: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    value: np.ndarray,
    slopes: np.ndarray,
    after: np.ndarray,
    weight: np.ndarray,
) -> float:
    """One step of length `h`.

    Parameters
    ----------
    state : ndarray, shape (12,)
        At the start.
    slopes : ndarray, shape (7, 12)
        The first row holds the derivative at the start; the rest is written, the last row being the derivative at the
        end.
    after : ndarray, shape (12,)
        State at the end, written.
    weight : ndarray, shape (12,)
        One over the allowed error of each component; 0 leaves a component out.

    Returns
    -------
    float
        Largest error over its allowance; NaN when the state is not finite.
    """
    k = slopes
    for stage in range(1, STAGES):
        if stage == 1:
            for i in range(STATES):
                after[i] = state[i] + h * (1 / 5) * k[0, i]
        elif stage == 2:
            for i in range(STATES):
                after[i] = state[i] + h * (3 / 40 * k[0, i] + 9 / 40 * k[1, i])
        elif stage == 3:
            for i in range(STATES):
                after[i] = state[i] + h * (44 / 45 * k[0, i] - 56 / 15 * k[1, i] + 32 / 9 * k[2, i])
        elif stage == 4:
            for i in range(STATES):
                after[i] = state[i] + h * (
                    19372 / 6561 * k[0, i] - 25360 / 2187 * k[1, i] + 64448 / 6561 * k[2, i] - 212 / 729 * k[3, i]
                )
        elif stage == 5:
            for i in range(STATES):
                after[i] = state[i] + h * (
                    9017 / 3168 * k[0, i]
                    - 355 / 33 * k[1, i]
                    + 46732 / 5247 * k[2, i]
                    + 49 / 176 * k[3, i]
                    - 5103 / 18656 * k[4, i]
                )
        else:
            for i in range(STATES):
                after[i] = state[i] + h * (
                    35 / 384 * k[0, i]
                    + 500 / 1113 * k[2, i]
                    + 125 / 192 * k[3, i]
                    - 2187 / 6784 * k[4, i]
                    + 11 / 84 * k[5, i]
                )
        derivative(after, control, shape, products, nodes, p, tables, environment, value, k[stage])
    worst = 0.0
    for i in range(STATES):
        error = (
            71 / 57600 * k[0, i]
            - 71 / 16695 * k[2, i]
            + 71 / 1920 * k[3, i]
            - 17253 / 339200 * k[4, i]
            + 22 / 525 * k[5, i]
            - 1 / 40 * k[6, i]
        )
        ratio = abs(h * error) * weight[i]
        if not ratio <= worst:
            worst = ratio
    return worst


@compiled
def dense_output(
    state: np.ndarray, after: np.ndarray, h: float, slopes: np.ndarray, theta: float, out: np.ndarray
) -> None:
    """State at the fraction `theta` of a step, written to `out`."""
    for i in range(STATES):
        out[i] = dense_component(state, after, h, slopes, theta, i)


@compiled
def dense_component(
    state: np.ndarray, after: np.ndarray, h: float, slopes: np.ndarray, theta: float, i: int
) -> float:
    """One component of the state at the fraction `theta` of a step."""
    rise = after[i] - state[i]
    bend = h * slopes[0, i] - rise
    twist = rise - h * slopes[STAGES - 1, i] - bend
    rest = 0.0
    for j in range(STAGES):
        rest += _DENSE[j] * slopes[j, i]
    back = 1.0 - theta
    return state[i] + theta * (rise + back * (bend + theta * (twist + back * h * rest)))
