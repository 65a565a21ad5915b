"""Fixed steps of Euler's method, as textbook programs take them, with the forces of the compiled kernel."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..simulate.equations import derivative
from ..simulate.packing import pack
from ..simulate.parameters import CONTROLS, NODES, STATES, Control, Drive, Order, State
from ..simulate.trajectory import Trajectory
from ..simulate.vessel import Vessel

CALM = np.zeros(4)
"""No current, no wind, no waves."""


def euler_run(
    vessel: Vessel, order: Callable[[float], float], duration: float, step: float, name: str = ""
) -> Trajectory:
    """A run with constant steps.

    Parameters
    ----------
    vessel : Vessel
        With a steering gear that lags: the gear is integrated like the motion.
    order : callable
        Rudder order in rad, positive to starboard, of the time in s.
    duration, step : float
        In s.
    name : str
        Manoeuvre.
    """
    packed = pack(vessel)
    control = np.zeros(CONTROLS)
    control[Control.KIND], control[Control.ENGINE] = Order.ANGLE, Drive.CONSTANT
    value = np.zeros(NODES + len(packed.products))
    rate = np.zeros(STATES)
    state = np.zeros(STATES)
    state[State.U] = vessel.speed
    samples = round(duration / step) + 1
    rows = np.zeros((samples, 1 + State.N + 1))
    for sample in range(samples):
        time = sample * step
        rows[sample, 0], rows[sample, 1:] = time, state[: State.N + 1]
        control[Control.TARGET] = order(time)
        derivative(
            state,
            control,
            packed.shape,
            packed.products,
            packed.nodes,
            packed.parameters[0],
            packed.tables,
            CALM,
            value,
            rate,
        )
        state = state + step * rate
    names = ("time", "x", "y", "psi", "u", "v", "r", "phi", "p", "delta", "n")
    return Trajectory.from_columns(dict(zip(names, rows.T, strict=True)), vessel.ship, name, source=vessel.name)
