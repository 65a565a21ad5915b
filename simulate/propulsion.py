"""Wake, thrust and torque of the propeller, as compiled functions (arrays: ``parameters``)."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .parameters import Parameter, Shape, Thrust, Wake


@compiled
def propeller_flow(
    shape: np.ndarray, p: np.ndarray, u: float, v: float, r: float, speed: float, drift: float
) -> float:
    """Axial inflow of the propeller, ``u (1 - wP)``, m/s; `drift` is the drift angle at midship."""
    wake = shape[Shape.WAKE]
    straight = p[Parameter.WP0]
    if wake == Wake.CONSTANT:
        return u * (1.0 - straight)
    if speed == 0.0:
        return 0.0
    if wake == Wake.SWAY_AND_YAW:
        sway, yaw = v / speed, r * p[Parameter.LENGTH] / speed
        cross = sway + p[Parameter.XP] / p[Parameter.LENGTH] * yaw
        change = cross * cross + p[Parameter.CPV] * sway + p[Parameter.CPR] * yaw
        return u * (1.0 - straight + p[Parameter.TAU] * change)
    there = drift - p[Parameter.XP] * r / speed
    if wake == Wake.C1C2:
        c2 = p[Parameter.C2_POSITIVE] if there > 0.0 else p[Parameter.C2_NEGATIVE]
        bracket = 1.0 + (1.0 - math.exp(-p[Parameter.C1] * abs(there))) * (c2 - 1.0)
        return u * (1.0 - straight) * bracket
    return u * (1.0 - straight * math.exp(-p[Parameter.C1] * there * there))


@compiled
def propeller_thrust(
    shape: np.ndarray, p: np.ndarray, tables: np.ndarray, u: float, n: float, flow: float
) -> float:
    """Thrust of all propellers, N."""
    model = shape[Shape.THRUST]
    if model == Thrust.NONE:
        return 0.0
    if model == Thrust.SURFACE:
        length = p[Parameter.LENGTH]
        quadratic = p[Parameter.TUU] * u * u / length + p[Parameter.TUN] * u * n
        return p[Parameter.PROPELLER_MASS] * (quadratic + p[Parameter.TNN] * length * n * abs(n))
    tip = n * p[Parameter.DIAMETER]
    if n < 0.0:
        drag = min(p[Parameter.KT2], 0.0) * flow * flow
        return p[Parameter.THRUST_UNIT] * (drag - p[Parameter.KT_ASTERN] * tip * tip)
    if model == Thrust.PARABOLA:
        # without division by n: a propeller that stands still has drag
        form = p[Parameter.KT0] * tip * tip + p[Parameter.KT1] * tip * flow + p[Parameter.KT2] * flow * flow
        return p[Parameter.THRUST_UNIT] * form
    if tip == 0.0:
        return 0.0
    ratio = flow / tip
    if model == Thrust.POLYNOMIAL:
        higher = p[Parameter.KT2] + ratio * (p[Parameter.KT3] + ratio * p[Parameter.KT4])
        coefficient = p[Parameter.KT0] + ratio * (p[Parameter.KT1] + ratio * higher)
    else:
        coefficient = open_water(tables, shape[Shape.TABLE], shape[Shape.TABLE_ROWS], ratio)
    return p[Parameter.THRUST_UNIT] * coefficient * tip * tip


@compiled
def propeller_torque(p: np.ndarray, n: float, flow: float) -> float:
    """Torque of one propeller, N m."""
    tip = n * p[Parameter.DIAMETER]
    form = p[Parameter.KQ0] * tip * tip + p[Parameter.KQ1] * tip * flow + p[Parameter.KQ2] * flow * flow
    return p[Parameter.TORQUE_UNIT] * form


@compiled
def open_water(tables: np.ndarray, at: int, rows: int, ratio: float) -> float:
    """KT by cubic Hermite interpolation of rows (J, KT, slope); straight on beyond the ends."""
    last = at + 3 * (rows - 1)
    if ratio <= tables[at]:
        return tables[at + 1] + (ratio - tables[at]) * tables[at + 2]
    if ratio >= tables[last]:
        return tables[last + 1] + (ratio - tables[last]) * tables[last + 2]
    row = at
    while tables[row + 3] < ratio:
        row += 3
    width = tables[row + 3] - tables[row]
    t = (ratio - tables[row]) / width
    left, right = tables[row + 1], tables[row + 4]
    a = width * tables[row + 2] - (right - left)
    b = right - left - width * tables[row + 5]
    return left + t * (right - left) + t * (1.0 - t) * (a * (1.0 - t) + b * t)
