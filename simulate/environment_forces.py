"""Wind and wave-drift forces as compiled functions of a packed environment (see ``environment_layout``).

Home axes: x forward, y to starboard, z down, origin midship; radians, newtons, newton-metres. The same source runs
as plain Python with ``NUMBA_DISABLE_JIT=1``.
"""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled, compiled_for_python
from .environment_layout import (
    CURRENT_X,
    CURRENT_Y,
    HARMONIC_DRIFT,
    WAVE_DATA,
    WAVE_DIRECTION,
    WAVE_KIND,
    WAVES_AT,
    WIND_AT,
    WIND_TABLE,
)


@compiled_for_python
def current_velocity(environment: np.ndarray, psi: float) -> tuple[float, float]:
    """Velocity of the water over ground along the ship's x and y, m/s, at heading `psi`."""
    ahead, across = environment[CURRENT_X], environment[CURRENT_Y]
    c, s = math.cos(psi), math.sin(psi)
    return ahead * c + across * s, across * c - ahead * s


@compiled_for_python
def wind_forces(environment: np.ndarray, psi: float, u: float, v: float) -> tuple[float, float, float, float]:
    """Forces X, Y and moments K, N of the steady wind about midship.

    Parameters
    ----------
    environment : ndarray
        Packed environment.
    psi : float
        Heading from x0, rad.
    u, v : float
        Velocity of midship through the water, m/s; the current is added to find the velocity over ground.

    Returns
    -------
    X, Y, K, N : float
        Zero where no wind acts. K is positive when it heels the ship to starboard.
    """
    at = int(environment[WIND_AT])
    if at == 0:
        return 0.0, 0.0, 0.0, 0.0
    stream_x, stream_y = current_velocity(environment, psi)
    c, s = math.cos(psi), math.sin(psi)
    air_x, air_y = environment[at], environment[at + 1]
    # velocity of the ship through the air: the wind is felt from where this points
    ahead = u + stream_x - (air_x * c + air_y * s)
    across = v + stream_y - (air_y * c - air_x * s)
    squared = ahead * ahead + across * across
    if squared == 0.0:
        return 0.0, 0.0, 0.0, 0.0
    # A table holds wind from starboard; from port the lateral columns change sign.
    side = 1.0 if across >= 0.0 else -1.0
    angle = math.atan2(abs(across), ahead)
    table = at + WIND_TABLE
    count = int(environment[table])
    i = table_segment(environment, table, angle)
    column = table + 1 + count
    x = table_value(environment, table, column, i, angle)
    y = table_value(environment, table, column + 2 * count, i, angle)
    k = table_value(environment, table, column + 4 * count, i, angle)
    n = table_value(environment, table, column + 6 * count, i, angle)
    return squared * x, side * squared * y, side * squared * k, side * squared * n


@compiled_for_python
def wave_drift_forces(environment: np.ndarray, psi: float) -> tuple[float, float, float]:
    """Mean second-order wave forces X, Y and moment N about midship.

    Parameters
    ----------
    environment : ndarray
        Packed environment.
    psi : float
        Heading from x0, rad.

    Returns
    -------
    X, Y, N : float
        Zero where no waves act.
    """
    at = int(environment[WAVES_AT])
    if at == 0:
        return 0.0, 0.0, 0.0
    # 0 in a following sea, positive for waves that travel to starboard
    encounter = environment[at + WAVE_DIRECTION] - psi
    c, s = math.cos(encounter), math.sin(encounter)
    data = at + WAVE_DATA
    if environment[at + WAVE_KIND] == HARMONIC_DRIFT:
        x = environment[data] * c
        y = environment[data + 1] * s
        n = (environment[data + 2] + 2.0 * environment[data + 3] * c) * s
        return x, y, n
    side = 1.0 if s >= 0.0 else -1.0
    angle = math.atan2(abs(s), c)
    count = int(environment[data])
    i = table_segment(environment, data, angle)
    column = data + 1 + count
    x = table_value(environment, data, column, i, angle)
    y = table_value(environment, data, column + 2 * count, i, angle)
    n = table_value(environment, data, column + 4 * count, i, angle)
    return x, side * y, side * n


@compiled
def table_segment(packed: np.ndarray, table: int, angle: float) -> int:
    """Number of the interval of an angle table that holds `angle` (0 to pi)."""
    low, high = 0, int(packed[table]) - 1
    while high - low > 1:
        middle = (low + high) // 2
        if packed[table + 1 + middle] <= angle:
            low = middle
        else:
            high = middle
    return low


@compiled
def table_value(packed: np.ndarray, table: int, column: int, i: int, angle: float) -> float:
    """Cubic Hermite interpolation in interval `i` of the column of an angle table that begins at `column`."""
    count = int(packed[table])
    start = packed[table + 1 + i]
    width = packed[table + 2 + i] - start
    t = (angle - start) / width
    at = column + i
    left, right = packed[at], packed[at + 1]
    rise_left, rise_right = width * packed[at + count], width * packed[at + count + 1]
    step = right - left
    return left + t * (
        rise_left + t * (3.0 * step - 2.0 * rise_left - rise_right + t * (rise_left + rise_right - 2.0 * step))
    )
