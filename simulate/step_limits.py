"""Limits of an integration: the error of a step, a steady state, a motion that diverges."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .parameters import Parameter, Phase, State
from .runge_kutta import STAGES

_LARGEST_SPEED = 5.0
_LARGEST_YAW_RATE = 20.0


@compiled
def error_weights(p: np.ndarray, start: np.ndarray, tolerance: float, weight: np.ndarray) -> None:
    """One over the error that a step may make in each component: the tolerance in units of L, U0, and rad."""
    length, speed = p[Parameter.LENGTH], p[Parameter.SPEED]
    turn = speed / length
    weight[State.X] = weight[State.Y] = 1.0 / (tolerance * length)
    weight[State.PSI] = weight[State.PHI] = weight[State.DELTA] = 1.0 / tolerance
    weight[State.U] = weight[State.V] = 1.0 / (tolerance * speed)
    weight[State.R] = weight[State.P] = 1.0 / (tolerance * turn)
    weight[State.N] = 1.0 / (tolerance * max(abs(start[State.N]), turn))
    weight[State.INTEGRAL] = weight[State.SPARE] = 0.0


@compiled
def unsteadiness(p: np.ndarray, state: np.ndarray, slopes: np.ndarray) -> float:
    """Largest acceleration at the end of a step, in units of U0 and L; the rate of the rudder included."""
    tick = p[Parameter.LENGTH] / p[Parameter.SPEED]
    last = slopes[STAGES - 1]
    linear = max(abs(last[State.U]), abs(last[State.V])) * tick / p[Parameter.SPEED]
    angular = max(abs(last[State.R]), abs(last[State.P])) * tick * tick
    return max(linear, angular, abs(last[State.DELTA]) * tick)


@compiled
def diverges(p: np.ndarray, state: np.ndarray) -> bool:
    """True for a state that no ship reaches."""
    largest = _LARGEST_SPEED * p[Parameter.SPEED]
    turn = _LARGEST_YAW_RATE * p[Parameter.SPEED] / p[Parameter.LENGTH]
    calm = abs(state[State.U]) < largest and abs(state[State.V]) < largest and abs(state[State.R]) < turn
    return not (calm and abs(state[State.PHI]) < math.pi)


@compiled
def goes_astern(phases: np.ndarray) -> bool:
    """True when the programme orders the propeller astern."""
    lowest = 0.0
    for phase in range(phases.shape[0]):
        lowest = min(lowest, phases[phase, Phase.RATE])
    return lowest < 0.0
