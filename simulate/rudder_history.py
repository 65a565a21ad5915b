"""When the helm was moved, from a recorded rudder angle."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..core.errors import ReadError
from .events import FloatArray

LEAST_STEP = np.radians(0.5)
"""Rudder movements smaller than this are no order."""


class RudderPhase(NamedTuple):
    """A stretch with the rudder on one side.

    Attributes
    ----------
    side : float
        +1 for a rudder that turns to starboard, -1 to port.
    ordered : float
        Time in s at which the rudder began to move there.
    reached : float
        Time in s at which it passed the middle between the old angle and the new.
    """

    side: float
    ordered: float
    reached: float


def step_start(time: FloatArray, values: FloatArray, what: str = "rudder") -> float:
    """Time at which a channel leaves its first level for the first time.

    The straight line through 20 and 80 per cent of the step is followed back to the first level: that is when a
    rate-limited rudder was ordered, and noise on the first level does not count as an order.

    Parameters
    ----------
    time, values : ndarray, shape (n,)
        In s, and in rad (rudder) or 1/s (propeller).
    what : str
        For the error message.

    Raises
    ------
    ReadError
        When the channel does not move.
    """
    swing = float(values.max() - values.min())
    if (what == "rudder" and swing < LEAST_STEP) or swing <= 1e-9 * float(np.abs(values).max()):
        raise ReadError(
            f"the {what} does not move in this record, so the order cannot be found",
            cure="cut the record to begin before the order, or give execute=<time in s>",
        )
    first = float(values[0])
    away = np.abs(values - first) > 0.5 * float(np.abs(values - first).max())
    half = int(np.argmax(away))
    after = _next_level(values, half, first)
    # The first level is the median of what lies before the ramp, which is only known from the first level.
    start = _ramp_start(time, values, half, first, after)
    before = float(np.median(values[time <= start]))
    return _ramp_start(time, values, half, before, after)


def _next_level(values: FloatArray, half: int, before: float) -> float:
    """Level that a step beginning before `half` ends at."""
    sign = np.sign(values[half] - before)
    beyond = sign * (values[half:] - before)
    back = np.flatnonzero(beyond < 0.5 * np.maximum.accumulate(beyond))
    stretch = beyond[: back[0]] if len(back) else beyond
    return before + float(sign * np.quantile(stretch, 0.9))


def _ramp_start(time: FloatArray, values: FloatArray, half: int, before: float, after: float) -> float:
    """Where the line through 20 and 80 per cent of a step meets the level before it."""
    share = (values - before) / (after - before)
    low_row = int(np.flatnonzero(share[: half + 1] <= 0.2)[-1]) if (share[: half + 1] <= 0.2).any() else 0
    above = np.flatnonzero(share[low_row:] >= 0.8)
    high_row = low_row + int(above[0]) if len(above) else half
    rows = slice(low_row, max(high_row, low_row + 1) + 1)
    low, high = np.interp((0.2, 0.8), np.maximum.accumulate(share[rows]), time[rows])
    return float(max(low - (high - low) / 3.0, time[0]))


def rudder_phases(time: FloatArray, delta: FloatArray) -> list[RudderPhase]:
    """Stretches of a zig-zag between reversals of the rudder.

    The rudder has been reversed when it has passed half of its angle on the other side: hunting about a
    steady angle is no reversal.

    Parameters
    ----------
    time, delta : ndarray, shape (n,)
        In s and rad.

    Raises
    ------
    ReadError
        When the rudder does not move.
    """
    low, high = float(np.quantile(delta, 0.01)), float(np.quantile(delta, 0.99))
    start = step_start(time, delta)
    middle, reach = 0.5 * (low + high), 0.25 * (high - low)
    side = np.where(delta > middle + reach, 1.0, np.where(delta < middle - reach, -1.0, 0.0))
    side[time < start] = 0.0
    rows = np.flatnonzero(side)
    changes = rows[np.flatnonzero(np.diff(side[rows], prepend=0.0))]
    phases = []
    for number, row in enumerate(changes):
        if number == 0:
            phases.append(RudderPhase(float(side[row]), start, float(time[row])))
            continue
        before, after = middle - 2.0 * reach * side[row], middle + 2.0 * reach * side[row]
        begin = int(changes[number - 1])
        ordered = _ramp_start(time[begin:], delta[begin:], int(row) - begin, before, after)
        phases.append(RudderPhase(float(side[row]), ordered, float(time[row])))
    return phases
