"""Propeller rate that keeps a speed on a straight course, as a compiled function (arrays: ``parameters``)."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .equations import derivative
from .parameters import STATES, Control, Drive, Parameter, Shape, State, Thrust

_LARGEST_SLIP = 64


@compiled
def surge_acceleration(
    n: float,
    speed: float,
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    p: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    control: np.ndarray,
    state: np.ndarray,
    value: np.ndarray,
    rate: np.ndarray,
) -> float:
    """Surge acceleration on a straight course at a propeller rate, m/s2."""
    for i in range(STATES):
        state[i] = 0.0
    state[State.U] = speed
    state[State.N] = n
    derivative(state, control, shape, products, nodes, p, tables, environment, value, rate)
    return rate[State.U]


@compiled
def balanced_rate(
    speed: float,
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    p: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    control: np.ndarray,
    state: np.ndarray,
    value: np.ndarray,
    rate: np.ndarray,
) -> float:
    """Propeller rate at which thrust and resistance balance, 1/s, by the Illinois method; NaN where there is none."""
    control[Control.ENGINE] = Drive.CONSTANT
    unit = speed / p[Parameter.DIAMETER]
    if shape[Shape.THRUST] == Thrust.SURFACE:
        unit = speed / p[Parameter.LENGTH]
    low, high = 0.0, 0.5 * unit
    at_low = at_high = -1.0
    for _ in range(_LARGEST_SLIP):
        at_high = surge_acceleration(
            high, speed, shape, products, nodes, p, tables, environment, control, state, value, rate
        )
        if at_high >= 0.0:
            break
        low, at_low = high, at_high
        high *= 1.25
    if not at_high >= 0.0:
        return math.nan
    if low == 0.0:
        at_low = surge_acceleration(
            low, speed, shape, products, nodes, p, tables, environment, control, state, value, rate
        )
        if at_low > 0.0:
            return math.nan
    last = 0
    middle = high
    for _ in range(80):
        if at_high == at_low:
            break
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        if middle in (low, high):
            break
        there = surge_acceleration(
            middle, speed, shape, products, nodes, p, tables, environment, control, state, value, rate
        )
        if there >= 0.0:
            high, at_high = middle, there
            if last == 1:
                at_low *= 0.5
            last = 1
        else:
            low, at_low = middle, there
            if last == -1:
                at_high *= 0.5
            last = -1
        if high - low < 1e-14 * high:
            break
    return middle
