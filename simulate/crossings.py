"""When a watched condition is met within a step: a root on the dense output, not on the steps."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .environment_layout import CURRENT_X, CURRENT_Y
from .parameters import Condition, State
from .runge_kutta import dense_component, dense_output

_CLOSE = 1e-13
"""Share of a step within which an event is located."""


@compiled
def condition(
    kind: float, target: float, sign: float, state: np.ndarray, reference: np.ndarray, environment: np.ndarray
) -> float:
    """Function that rises through zero when the condition is met; `reference` is the state at execute."""
    if kind == Condition.TURNED:
        return sign * (state[State.PSI] - reference[State.PSI]) - target
    if kind == Condition.YAW_RATE:
        return -sign * (state[State.R] - target)
    if kind == Condition.SURGE:
        return sign * (state[State.U] - target * reference[State.U])
    if kind == Condition.ROLL_RATE:
        return sign * (state[State.P] - target)
    c, s = math.cos(state[State.PSI]), math.sin(state[State.PSI])
    along, across = math.cos(reference[State.PSI]), math.sin(reference[State.PSI])
    if kind == Condition.LATERAL:
        moved = (state[State.Y] - reference[State.Y]) * along - (state[State.X] - reference[State.X]) * across
        return sign * moved - target
    sway = state[State.V] * math.cos(state[State.PHI])
    x_rate = state[State.U] * c - sway * s + environment[CURRENT_X]
    y_rate = state[State.U] * s + sway * c + environment[CURRENT_Y]
    if kind == Condition.ADVANCE_RATE:
        return -sign * (x_rate * along + y_rate * across)
    return -sign * (y_rate * along - x_rate * across)


@compiled
def locate(
    kind: float,
    target: float,
    sign: float,
    reference: np.ndarray,
    environment: np.ndarray,
    state: np.ndarray,
    after: np.ndarray,
    h: float,
    slopes: np.ndarray,
    before: float,
    behind: float,
    room: np.ndarray,
) -> float:
    """Fraction of the step at which the condition is met, by the Illinois method.

    `before` < 0 and `behind` >= 0 are the condition at the two ends of the step.
    """
    low, high = 0.0, 1.0
    at_low, at_high = before, behind
    last = 0
    theta = 1.0
    for _ in range(60):
        if at_high == 0.0 or high - low < _CLOSE:
            return high
        theta = (low * at_high - high * at_low) / (at_high - at_low)
        if kind == Condition.TURNED:
            room[State.PSI] = dense_component(state, after, h, slopes, theta, State.PSI)
        elif kind == Condition.YAW_RATE:
            room[State.R] = dense_component(state, after, h, slopes, theta, State.R)
        else:
            dense_output(state, after, h, slopes, theta, room)
        there = condition(kind, target, sign, room, reference, environment)
        if there >= 0.0:
            if theta >= high - _CLOSE and last == 1:
                return theta
            high, at_high = theta, there
            if last == 1:
                at_low *= 0.5
            last = 1
        else:
            if -there < 1e-15:
                return theta
            low, at_low = theta, there
            if last == -1:
                at_high *= 0.5
            last = -1
    return theta
