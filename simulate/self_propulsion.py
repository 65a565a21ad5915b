"""Self-propulsion point: the propeller rate at which the ship keeps its approach speed on a straight course."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .compilation import compiled
from .equations import derivative
from .packing import Packed
from .parameters import CONTROLS, NODES, STATES, Control, Drive, Parameter, Shape, State, Thrust
from .propulsion import propeller_flow, propeller_torque

_CALM = np.zeros(4)
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


@njit(
    "void(f8, i8[::1], i8[:, ::1], i8[::1], f8[:, ::1], f8[::1], f8[::1], f8[::1])",
    cache=True,
    error_model="numpy",
    nogil=True,
)
def balance_rates(
    speed: float,
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    parameters: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    rates: np.ndarray,
) -> None:
    """Write the self-propulsion rate of each draw to `rates`; NaN where there is none."""
    control = np.zeros(CONTROLS)
    control[Control.ENGINE] = Drive.CONSTANT
    state = np.zeros(STATES)
    rate = np.zeros(STATES)
    value = np.zeros(NODES + products.shape[0])
    for draw in range(parameters.shape[0]):
        p = parameters[draw]
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
        rates[draw] = math.nan
        if not at_high >= 0.0:
            continue
        if low == 0.0:
            at_low = surge_acceleration(
                low, speed, shape, products, nodes, p, tables, environment, control, state, value, rate
            )
            if at_low > 0.0:
                continue
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
        rates[draw] = middle


def self_propulsion_rates(packed: Packed, speed: float) -> np.ndarray:
    """Propeller rate in 1/s at which each draw keeps `speed` in m/s in calm water; NaN where there is none.

    The rudder is amidships. Without a propeller the rates are 0.
    """
    rates = np.zeros(packed.draws)
    if packed.shape[Shape.THRUST] != Thrust.NONE:
        balance_rates(
            float(speed),
            packed.shape,
            packed.products,
            packed.nodes,
            packed.parameters,
            packed.tables,
            _CALM.copy(),
            rates,
        )
    return rates


def keep_torque(packed: Packed, speed: float, rates: np.ndarray) -> None:
    """Note the torque of the approach at `rates`, which an engine of constant torque keeps."""
    for p, n in zip(packed.parameters, rates, strict=True):
        flow = propeller_flow(packed.shape, p, speed, 0.0, 0.0, speed, 0.0)
        p[Parameter.TORQUE] = propeller_torque(p, n, flow)
