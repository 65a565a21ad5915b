"""Indices of any manoeuvre, simulated or measured, as a table with units and definitions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from ..core.errors import TowtankError
from ..core.ship import Ship
from .course_change_indices import initial_turning_indices, pull_out_indices, williamson_indices
from .events import Events, FloatArray
from .found_events import with_events
from .index_definitions import Lengths, index_frame
from .manoeuvre_names import read_manoeuvre_name
from .spiral_indices import spiral_event_indices
from .stopping_indices import stopping_indices
from .trajectory import Trajectory
from .turning_indices import turning_indices
from .zigzag_indices import zigzag_indices

if TYPE_CHECKING:
    import pandas as pd


def event_indices(
    manoeuvre: str, events: Events, ship: Ship, approach_speed: float | FloatArray | None = None
) -> dict[str, FloatArray]:
    """Indices of a manoeuvre from its events, for one run or for many draws.

    Parameters
    ----------
    manoeuvre : str
        Name, e.g. ``"turning +35"``, ``"zigzag 10/10"``, ``"crash stop"``.
    events : Events
    ship : Ship
    approach_speed : float or ndarray of shape (draws,), optional
        In m/s; default the speed at the first order.

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        In the units of :func:`~towtank.simulate.index_definitions.definition_of`.

    Raises
    ------
    TowtankError
        For an unknown manoeuvre, or events of another one.
    """
    kind = read_manoeuvre_name(manoeuvre).kind
    if kind in _WITH_APPROACH:
        return _WITH_APPROACH[kind](events, ship, approach_speed)
    return _WITHOUT_APPROACH[kind](events, ship)


def indices(
    trajectory: Trajectory,
    *,
    approach_speed: float | None = None,
    lengths: Lengths = "L",
    execute: float | None = None,
) -> pd.DataFrame:
    """Indices of one manoeuvre.

    Parameters
    ----------
    trajectory : Trajectory
        Simulated, with its events, or measured: then they are found in the samples.
    approach_speed : float, optional
        In m/s; default the speed at the first order.
    lengths : {"L", "m"}
        Unit of lengths: ship lengths or metres.
    execute : float, optional
        Time of the first order of a measured manoeuvre in s; default where the rudder begins to move.

    Returns
    -------
    DataFrame
        Columns manoeuvre, index, value, unit, definition; what did not occur is left out.
    """
    known = with_events(trajectory, execute=execute)
    if known.events is None:
        raise TowtankError("the trajectory has no events", place=trajectory.manoeuvre)
    values = event_indices(trajectory.manoeuvre, known.events, trajectory.ship, approach_speed)
    return index_frame(values, trajectory.manoeuvre, trajectory.ship, lengths)


_WITH_APPROACH: dict[str, Callable[[Events, Ship, float | FloatArray | None], dict[str, FloatArray]]] = {
    "turning": turning_indices,
    "zigzag": zigzag_indices,
}

_WITHOUT_APPROACH: dict[str, Callable[[Events, Ship], dict[str, FloatArray]]] = {
    "initial turning": initial_turning_indices,
    "pull-out": pull_out_indices,
    "crash stop": stopping_indices,
    "williamson": williamson_indices,
    "spiral": spiral_event_indices,
    "reverse spiral": partial(spiral_event_indices, reverse=True),
}
