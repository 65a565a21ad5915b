"""Drift of a turning circle in waves, wind or current, and the safety index of turning in waves."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..core.ship import Ship
from .event_geometry import turning_side
from .events import Events, FloatArray

DRIFT_WINDOWS = ((360, 720), (270, 630))
"""Heading changes in degrees between which drift is measured.

360 to 720 after Ueno et al. (2003); 270 to 630 for tests that end before 720. The first quarter turn is transient.
The two are not comparable.
"""


def drift_indices(events: Events, ship: Ship, start: int = 360, end: int = 720) -> dict[str, FloatArray]:
    """Distance and direction by which a turning ship drifts in one full turn.

    Parameters
    ----------
    events : Events
        Of a turning circle with the events ``heading {start}`` and ``heading {end}``.
    ship : Ship
    start, end : int
        Heading changes in degrees.

    Returns
    -------
    dict
        ``"drift distance 360-720"`` in L; ``"drift direction 360-720"`` in degrees from 0 to 360, from the heading
        at execute towards the side of the turn, so that turns to port and to starboard in mirrored waves agree.
        Each of shape (draws,); NaN where the turn did not get that far.
    """
    side = turning_side(events)
    first, last = f"heading {start}", f"heading {end}"
    dx = events.at(last, "x") - events.at(first, "x")
    dy = events.at(last, "y") - events.at(first, "y")
    direction = np.arctan2(dy, dx) - events.at("execute", "psi")
    return {
        f"drift distance {start}-{end}": np.hypot(dx, dy) / ship.L,
        f"drift direction {start}-{end}": np.mod(np.degrees(side * direction), 360.0),
    }


def relative_drift_direction(wave_direction: ArrayLike, drift_direction: ArrayLike) -> FloatArray:
    """Wave direction less drift direction in degrees, from -180 to 180; 0 for a ship that drifts with the waves.

    Both in degrees and in the same sense. In the KCS tests (MASHCON 2019) 180 is a head wave and a drift
    towards 180 goes back to where the turn began.
    """
    difference = np.asarray(wave_direction, dtype=float) - np.asarray(drift_direction, dtype=float)
    return np.mod(difference + 180.0, 360.0) - 180.0


def turning_distance(advance: ArrayLike, transfer: ArrayLike) -> FloatArray:
    """D90, distance from execute to the position at a heading change of 90 degrees, in the unit of the arguments."""
    return np.hypot(np.asarray(advance, dtype=float), np.asarray(transfer, dtype=float))


def turning_direction(advance: ArrayLike, transfer: ArrayLike) -> FloatArray:
    """A90, direction of the position at a heading change of 90 degrees, in degrees from the original course."""
    return np.degrees(np.arctan2(np.asarray(transfer, dtype=float), np.asarray(advance, dtype=float)))


def safety_index(direction_ratio: ArrayLike, distance_ratio: ArrayLike) -> FloatArray:
    """Safety index STw of turning in waves: ``(A90w / A90) / (D90w / D90) - 1``.

    Parameters
    ----------
    direction_ratio, distance_ratio : array_like
        A90 and D90 in waves over those in calm water.

    Returns
    -------
    ndarray
        0 in calm water, above 0 safer (the ship turns aside sooner and runs less far), below 0 more dangerous.

    References
    ----------
    Initial and steady turning characteristics of KCS in regular waves (KRISO), 5th MASHCON, 2019, equation 3.
    """
    return np.asarray(direction_ratio, dtype=float) / np.asarray(distance_ratio, dtype=float) - 1.0


def safety_index_of_turns(
    advance: ArrayLike, transfer: ArrayLike, calm_advance: float, calm_transfer: float
) -> FloatArray:
    """Safety index of turns in waves from their advance and transfer and those of the calm-water turn."""
    direction = turning_direction(advance, transfer) / turning_direction(calm_advance, calm_transfer)
    distance = turning_distance(advance, transfer) / math.hypot(calm_advance, calm_transfer)
    return safety_index(direction, distance)
