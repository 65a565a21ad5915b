"""Orders of a phase to steering gear and engine, and when the rudder stops or the schedule bends."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .parameters import Control, Drive, Order, Parameter, Phase, Shape, State
from .propulsion import propeller_flow, propeller_torque


@compiled
def give_order(
    order: np.ndarray, shape: np.ndarray, p: np.ndarray, start: np.ndarray, state: np.ndarray, control: np.ndarray
) -> None:
    """Set the control at the beginning of a phase."""
    control[Control.KIND] = order[Phase.KIND]
    control[Control.TARGET] = order[Phase.TARGET]
    control[Control.PROPORTIONAL] = order[Phase.PROPORTIONAL]
    control[Control.DERIVATIVE] = order[Phase.DERIVATIVE]
    control[Control.INTEGRAL] = order[Phase.INTEGRAL]
    control[Control.SLEW] = 0.0
    state[State.INTEGRAL] = 0.0
    if order[Phase.KIND] == Order.ANGLE and p[Parameter.GEAR_LAG] == 0.0:
        missing = order[Phase.TARGET] - state[State.DELTA]
        if missing != 0.0:
            control[Control.SLEW] = math.copysign(p[Parameter.GEAR_RATE], missing)
    if not math.isnan(order[Phase.RATE]):
        wanted = order[Phase.RATE]
        if order[Phase.RATE_IS_FACTOR] == 1.0:
            wanted *= start[State.N]
        control[Control.RATE] = wanted
        if p[Parameter.RATE_LAG] > 0.0:
            control[Control.ENGINE] = Drive.LAGGED
        else:
            control[Control.ENGINE] = Drive.CONSTANT
            state[State.N] = wanted
    elif order[Phase.EXECUTE] == 1.0:
        # an order of an earlier manoeuvre with the same arrays does not stand
        control[Control.ENGINE] = Drive.TORQUE if shape[Shape.TORQUE] == 1 else Drive.CONSTANT


@compiled
def keep_torque(shape: np.ndarray, p: np.ndarray, start: np.ndarray) -> None:
    """Note the torque of the approach, which an engine of constant torque keeps."""
    u = start[State.U]
    p[Parameter.TORQUE] = propeller_torque(p, start[State.N], propeller_flow(shape, p, u, 0.0, 0.0, u, 0.0))


@compiled
def next_kink(
    order: np.ndarray,
    p: np.ndarray,
    state: np.ndarray,
    control: np.ndarray,
    schedule: np.ndarray,
    time: float,
    begin: float,
    row: int,
) -> float:
    """Time at which the rudder stops or leaves its largest rate, or the schedule bends; sets the schedule's slopes."""
    if order[Phase.KIND] == Order.ANGLE:
        if row > 0:
            return math.inf
        missing = abs(order[Phase.TARGET] - state[State.DELTA])
        if p[Parameter.GEAR_LAG] == 0.0:
            return time + missing / p[Parameter.GEAR_RATE] if control[Control.SLEW] != 0.0 else math.inf
        beyond = missing - p[Parameter.GEAR_RATE] * p[Parameter.GEAR_LAG]
        return time + beyond / p[Parameter.GEAR_RATE] if beyond > 0.0 else math.inf
    if order[Phase.KIND] == Order.SCHEDULE:
        if row + 1 >= schedule.shape[0]:
            control[Control.SLEW] = 0.0
            control[Control.ENGINE] = Drive.CONSTANT
            return math.inf
        span = schedule[row + 1, 0] - schedule[row, 0]
        control[Control.SLEW] = (schedule[row + 1, 1] - state[State.DELTA]) / span
        if math.isnan(schedule[row + 1, 2]):
            control[Control.ENGINE] = Drive.CONSTANT
        else:
            control[Control.ENGINE] = Drive.RAMP
            control[Control.RATE] = (schedule[row + 1, 2] - state[State.N]) / span
        return begin + schedule[row + 1, 0] - schedule[0, 0]
    return math.inf


@compiled
def land(order: np.ndarray, control: np.ndarray, p: np.ndarray, state: np.ndarray) -> None:
    """Stop the rudder at its order."""
    if order[Phase.KIND] == Order.ANGLE and p[Parameter.GEAR_LAG] == 0.0:
        state[State.DELTA] = order[Phase.TARGET]
        control[Control.SLEW] = 0.0
