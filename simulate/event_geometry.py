"""Times, distances and headings between the events of a manoeuvre, a number a draw."""

from __future__ import annotations

import numpy as np

from ..core.errors import TowtankError
from .events import Events, FloatArray


def elapsed(events: Events, start: str, end: str) -> FloatArray:
    """Time from one event to another in s, shape (draws,)."""
    return events.at(end, "time") - events.at(start, "time")


def heading_change(events: Events, start: str, end: str) -> FloatArray:
    """Change of heading from one event to another in radians, positive to starboard, shape (draws,)."""
    return events.at(end, "psi") - events.at(start, "psi")


def speed_at(events: Events, name: str) -> FloatArray:
    """Speed of midship through the water in m/s at an event, shape (draws,)."""
    return np.hypot(events.at(name, "u"), events.at(name, "v"))


def along_course(events: Events, start: str, end: str) -> FloatArray:
    """Distance along the heading at `start` from there to `end` in m, shape (draws,)."""
    course = events.at(start, "psi")
    dx, dy = _displacement(events, start, end)
    return dx * np.cos(course) + dy * np.sin(course)


def across_course(events: Events, start: str, end: str) -> FloatArray:
    """Distance to starboard of the heading at `start` from there to `end` in m, shape (draws,)."""
    course = events.at(start, "psi")
    dx, dy = _displacement(events, start, end)
    return dy * np.cos(course) - dx * np.sin(course)


def _displacement(events: Events, start: str, end: str) -> tuple[FloatArray, FloatArray]:
    return (
        events.at(end, "x") - events.at(start, "x"),
        events.at(end, "y") - events.at(start, "y"),
    )


def turning_side(events: Events, start: str = "execute") -> FloatArray:
    """+1 for a turn to starboard, -1 to port, by the shift of the rudder or the first heading event; shape (draws,).

    NaN where neither occurred.
    """
    side = np.full(events.draws, np.nan)
    for name in ("shift", *[name for name in events if name.startswith("heading ")], "end"):
        turned = np.sign(heading_change(events, start, name))
        side = np.where(np.isnan(side) & (turned != 0.0), turned, side)
    return side


def with_last_heading(events: Events) -> Events:
    """Events in which the end of a turn serves as the heading event that it falls on.

    A turn that is sailed to 540 degrees ends there: ``"end"`` is ``"heading 540"``.
    """
    if "execute" not in events or "end" not in events:
        return events
    turned = np.degrees(np.abs(heading_change(events, "execute", "end")))
    quarters = np.round(turned / 90.0) * 90.0
    # A thousandth of a degree: the end is located far better than that.
    meets = np.abs(turned - quarters) < 1e-3
    added = dict(events.mapping)
    for quarter in np.unique(quarters[meets & (quarters > 0.0)]):
        name = f"heading {quarter:.0f}"
        here = (meets & (quarters == quarter))[:, np.newaxis]
        before = added.get(name, np.full_like(events["end"], np.nan))
        added[name] = np.where(here & np.isnan(before), events["end"], before)
    return Events(added)


def require_events(events: Events, names: tuple[str, ...], manoeuvre: str) -> None:
    """Refuse events of another manoeuvre.

    Raises
    ------
    TowtankError
        When one of `names` was not watched.
    """
    for name in names:
        if name not in events:
            raise TowtankError(
                f"these are no events of a {manoeuvre}: '{name}' is missing",
                cure=f"watched were {', '.join(events) or 'no events'}",
            )
