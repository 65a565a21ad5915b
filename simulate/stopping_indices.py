"""Indices of a crash stop, for one run or for many draws."""

from __future__ import annotations

import numpy as np

from ..core.ship import Ship
from .event_geometry import across_course, along_course, elapsed, heading_change, require_events
from .events import Events, FloatArray
from .track_length import track_length


def stopping_indices(events: Events, ship: Ship, track: float | FloatArray | None = None) -> dict[str, FloatArray]:
    """Indices of a crash stop.

    Parameters
    ----------
    events : Events
        ``"execute"``: astern is ordered; ``"stopped"``: u = 0. Events on the way (``"speed 90"`` to ``"speed 10"``,
        per cent of the speed at execute) make the length of the track exact.
    ship : Ship
    track : float or ndarray of shape (draws,), optional
        Length of the track in m where it was integrated; default that of the cubics through the events.

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        NaN where the ship did not come to a stop.

    Notes
    -----
    IMO resolution MSC.137(76), 5.3.4: the track reach in a full astern test should not exceed 15 ship lengths.
    """
    require_events(events, ("execute", "stopped"), "crash stop")
    if track is None:
        track = track_length(events, ("execute", *(f"speed {share}" for share in range(99, 0, -1)), "stopped"))
    stopped = np.where(events.occurred("stopped"), 1.0, np.nan)
    return {
        "track reach": stopped * np.asarray(track, dtype=float) / ship.L,
        "head reach": along_course(events, "execute", "stopped") / ship.L,
        "side reach": across_course(events, "execute", "stopped") / ship.L,
        "stopping time": elapsed(events, "execute", "stopped"),
        "heading change at stop": np.degrees(heading_change(events, "execute", "stopped")),
    }
