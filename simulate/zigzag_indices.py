"""Indices of a zig-zag, for one run or for many draws."""

from __future__ import annotations

import numpy as np

from ..core.ship import Ship
from .event_geometry import elapsed, heading_change, require_events, speed_at
from .events import Events, FloatArray


def zigzag_indices(
    events: Events, ship: Ship, approach_speed: float | FloatArray | None = None
) -> dict[str, FloatArray]:
    """Indices of a zig-zag.

    Parameters
    ----------
    events : Events
        ``"execute 1"``, ``"extreme 1"``, ``"execute 2"``, ...; ``"return 1"`` (first return of the heading to the
        original course) where it was watched.
    ship : Ship
    approach_speed : float or ndarray of shape (draws,), optional
        In m/s; default the speed at the first execute.

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        In the units of :func:`~towtank.simulate.index_definitions.definition_of`; NaN where the run did not get
        that far. Overshoots are positive for either side.

    Raises
    ------
    TowtankError
        When these are events of another manoeuvre.

    Notes
    -----
    IMO resolution MSC.137(76), 4.2: the overshoot is the heading deviation that follows the execute which
    reverses the rudder.
    """
    require_events(events, ("execute 1", "execute 2"), "zig-zag")
    before = speed_at(events, "execute 1") if approach_speed is None else np.asarray(approach_speed, dtype=float)
    found = {"initial turning time": elapsed(events, "execute 1", "execute 2")}
    for number in range(1, _count(events, "extreme") + 1):
        extreme, reversal = f"extreme {number}", f"execute {number + 1}"
        beyond = heading_change(events, reversal, extreme)
        side = np.sign(heading_change(events, "execute 1", extreme))
        found[f"overshoot {number}"] = np.degrees(side * beyond)
        found[f"time to check yaw {number}"] = elapsed(events, reversal, extreme)
        found[f"time of overshoot {number}"] = elapsed(events, "execute 1", extreme)
    for number in range(2, _count(events, "execute") + 1):
        found[f"time of execute {number}"] = elapsed(events, "execute 1", f"execute {number}")
    found["period"] = elapsed(events, "execute 2", "execute 4")
    found["reach"] = elapsed(events, "execute 1", "return 1")
    found["reach U0/L"] = found["reach"] * before / ship.L
    return found


def _count(events: Events, kind: str) -> int:
    """Highest number of the events of a kind."""
    numbers = [name.removeprefix(f"{kind} ") for name in events if name.startswith(f"{kind} ")]
    return max((int(number) for number in numbers if number.isdigit()), default=0)
