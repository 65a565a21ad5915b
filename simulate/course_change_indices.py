"""Indices of the initial turning test, the pull-out and the Williamson turn, for one run or for many draws."""

from __future__ import annotations

import numpy as np

from ..core.ship import Ship
from .event_geometry import (
    across_course,
    along_course,
    elapsed,
    heading_change,
    require_events,
    speed_at,
    turning_side,
)
from .events import Events, FloatArray
from .track_length import track_length


def initial_turning_indices(events: Events, ship: Ship) -> dict[str, FloatArray]:
    """Indices of an initial turning test: track, advance and time to a heading change of 10 degrees.

    Parameters
    ----------
    events : Events
        ``"execute"`` and ``"heading 10"``; those of a turning circle serve as well.
    ship : Ship

    Returns
    -------
    dict of str to ndarray, shape (draws,)

    Notes
    -----
    IMO resolution MSC.137(76), 5.3.2: with 10 degrees of rudder the ship should not have travelled more than 2.5
    ship lengths by the time the heading has changed by 10 degrees.
    """
    require_events(events, ("execute", "heading 10"), "initial turning test")
    return {
        "initial turning track": track_length(events, ("execute", "heading 10")) / ship.L,
        "initial turning advance": along_course(events, "execute", "heading 10") / ship.L,
        "time to heading 10": elapsed(events, "execute", "heading 10"),
    }


def pull_out_indices(events: Events, ship: Ship) -> dict[str, FloatArray]:
    """Indices of a pull-out: the yaw rate that remains with the rudder amidships.

    Parameters
    ----------
    events : Events
        ``"execute"``: the rudder is put amidships in a steady turn; ``"end"``.
    ship : Ship

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        A ship that is stable on a straight course keeps the same residual rate, near 0, after turns to either
        side; an unstable one keeps turning to the side of the turn.
    """
    require_events(events, ("execute", "end"), "pull-out")
    before = events.at("execute", "r")
    residual = np.sign(before) * events.at("end", "r")
    return {
        "yaw rate before": np.degrees(np.abs(before)),
        "residual yaw rate": np.degrees(residual),
        "residual yaw rate L/U": residual * ship.L / speed_at(events, "end"),
    }


def williamson_indices(events: Events, ship: Ship) -> dict[str, FloatArray]:
    """Indices of a Williamson turn: when the ship is back on the reciprocal course, and how far beside her track.

    Parameters
    ----------
    events : Events
        ``"execute"``; ``"reciprocal"``: the heading is first within 1 degree of the reciprocal course; ``"extreme"``:
        it is furthest beyond it; ``"end"``: the ship is steady on that course.
    ship : Ship

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        The side offset is positive to the side of the first turn; the overshoot is NaN for a ship that does not
        swing over.
    """
    require_events(events, ("execute", "reciprocal", "end"), "Williamson turn")
    side = np.nan_to_num(turning_side(events), nan=1.0)
    beyond = -side * heading_change(events, "execute", "extreme") - np.pi
    return {
        "side offset": side * across_course(events, "execute", "end") / ship.L,
        "distance back": along_course(events, "execute", "reciprocal") / ship.L,
        "time to reciprocal course": elapsed(events, "execute", "reciprocal"),
        "course overshoot": np.degrees(np.where(beyond > 0.0, beyond, np.nan)),
        "time to steady course": elapsed(events, "execute", "end"),
    }
