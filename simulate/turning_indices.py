"""Indices of a turning circle, for one run or for many draws."""

from __future__ import annotations

import math
import re

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
    with_last_heading,
)
from .events import Events, FloatArray
from .turning_drift import DRIFT_WINDOWS, drift_indices

STEADY_FROM = math.radians(270.0)
"""A turn of less than this has no steady phase."""

_HEADING = re.compile(r"heading (\d+)")


def turning_indices(
    events: Events, ship: Ship, approach_speed: float | FloatArray | None = None
) -> dict[str, FloatArray]:
    """Indices of a turning circle.

    Parameters
    ----------
    events : Events
        Of a turning circle, see :class:`~towtank.simulate.events.Events`.
    ship : Ship
        Its length scales the distances.
    approach_speed : float or ndarray of shape (draws,), optional
        Speed before the turn in m/s; default the speed at execute.

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        In the units of :func:`~towtank.simulate.index_definitions.definition_of`; NaN where the turn did not get
        that far. Distances are measured from the position at execute, along and across the heading there, and
        are positive in the direction of the turn.

    Raises
    ------
    TowtankError
        When these are events of another manoeuvre.

    Notes
    -----
    IMO resolution MSC.137(76), 4.2: advance at 90 degrees, tactical diameter at 180 degrees. Maximum advance and
    maximum transfer are other numbers, and are often quoted for them.
    """
    events = with_last_heading(events)
    require_events(events, ("execute", "heading 90", "end"), "turning circle")
    side = turning_side(events)
    before = speed_at(events, "execute") if approach_speed is None else np.asarray(approach_speed, dtype=float)
    length = ship.L

    def along(name: str) -> FloatArray:
        return along_course(events, "execute", name) / length

    def across(name: str) -> FloatArray:
        return side * across_course(events, "execute", name) / length

    found = {
        "advance": along("heading 90"),
        "maximum advance": along("maximum advance"),
        "transfer": across("heading 90"),
        "maximum transfer": across("maximum transfer"),
        "tactical diameter": across("heading 180"),
        **_steady_indices(events, ship, side, before),
    }
    for heading in (90, 180, 270, 360):
        found[f"time to {heading}"] = elapsed(events, "execute", f"heading {heading}")
    for heading in (90, 180, 360):
        found[f"speed ratio at {heading}"] = speed_at(events, f"heading {heading}") / before
    for start, end in DRIFT_WINDOWS:
        if f"heading {end}" in events:
            found |= drift_indices(events, ship, start, end)
    return found


def _steady_indices(events: Events, ship: Ship, side: FloatArray, before: FloatArray) -> dict[str, FloatArray]:
    """What is left when the turn is steady."""
    turned = np.abs(heading_change(events, "execute", "end"))
    # Half a microradian: an integration that stops at 270 degrees has turned by 270 degrees.
    steady = turned >= STEADY_FROM - 5e-7

    def settled(values: FloatArray) -> FloatArray:
        return np.where(steady, values, np.nan)

    speed = settled(speed_at(events, "end"))
    rate = settled(side * events.at("end", "r"))
    return {
        "steady diameter": 2.0 * speed / rate / ship.L,
        "steady speed": speed,
        "steady speed ratio": speed / before,
        "speed loss": 100.0 * (1.0 - speed / before),
        "steady drift angle": np.degrees(
            settled(side * np.arctan2(-events.at("end", "v"), events.at("end", "u")))
        ),
        "steady yaw rate": np.degrees(rate),
        "steady yaw rate L/U": rate * ship.L / speed,
        "steady yaw rate L/U0": rate * ship.L / before,
        "unsteadiness": settled(_unsteadiness(events)),
        "steady heel": np.degrees(settled(_heel(events, "end"))),
        "maximum heel": np.degrees(_heel(events, "maximum heel")),
    }


def _heel(events: Events, name: str) -> FloatArray:
    """Roll angle in rad, shape (draws,); NaN for a model without roll, which leaves it at zero."""
    phi = events.at(name, "phi")
    return np.where(phi == 0.0, np.nan, phi)


def _unsteadiness(events: Events) -> FloatArray:
    """Change of the mean yaw rate between the last two quarter turns in per cent, shape (draws,)."""
    headings = sorted(int(match[1]) for name in events if (match := _HEADING.fullmatch(name)))
    quarters = [heading for heading in headings if heading % 90 == 0]
    change = np.full(events.draws, np.nan)
    for first, middle, last in zip(quarters, quarters[1:], quarters[2:]):
        if last - middle != 90 or middle - first != 90:
            continue
        earlier = elapsed(events, f"heading {first}", f"heading {middle}")
        later = elapsed(events, f"heading {middle}", f"heading {last}")
        change = np.where(np.isnan(later), change, 100.0 * (earlier / later - 1.0))
    return change
