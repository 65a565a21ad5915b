"""What each manoeuvring index is: its unit and its definition, and the table that says both beside the value."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np

from ..core.errors import TowtankError
from ..core.ship import Ship
from .events import FloatArray

if TYPE_CHECKING:
    import pandas as pd

Lengths = Literal["L", "m"]


class IndexDefinition(NamedTuple):
    """Unit of an index (``"L"``: ship lengths) and what it means."""

    unit: str
    definition: str


_STEADY = "at the end of the turn, through the water"

DEFINITIONS: dict[str, IndexDefinition] = {
    # turning circle
    "advance": IndexDefinition(
        "L", "distance of midship along the original course from execute to a heading change of 90 deg"
    ),
    "transfer": IndexDefinition(
        "L", "distance of midship across the original course from execute to a heading change of 90 deg"
    ),
    "tactical diameter": IndexDefinition(
        "L", "distance of midship across the original course from execute to a heading change of 180 deg"
    ),
    "maximum advance": IndexDefinition("L", "largest distance of midship along the original course from execute"),
    "maximum transfer": IndexDefinition(
        "L", "largest distance of midship across the original course from execute"
    ),
    "steady diameter": IndexDefinition("L", f"2 U / r, {_STEADY}"),
    "steady speed": IndexDefinition("m/s", f"speed U of midship {_STEADY}"),
    "steady speed ratio": IndexDefinition("-", f"U / U0, speed {_STEADY} over the approach speed"),
    "speed loss": IndexDefinition("%", f"1 - U / U0, speed {_STEADY} against the approach speed"),
    "steady drift angle": IndexDefinition(
        "deg", f"atan2(-v, u) of midship {_STEADY}; positive with the bow inside the turn"
    ),
    "steady yaw rate": IndexDefinition("deg/s", "r at the end of the turn; positive in the direction of the turn"),
    "steady yaw rate L/U": IndexDefinition("-", "r L / U with the speed at the end of the turn"),
    "steady yaw rate L/U0": IndexDefinition("-", "r L / U0 with the approach speed"),
    "steady heel": IndexDefinition("deg", "roll angle at the end of the turn; positive to starboard"),
    "maximum heel": IndexDefinition(
        "deg", "largest roll angle after execute, out of the turn; positive to starboard"
    ),
    "unsteadiness": IndexDefinition(
        "%", "change of the mean yaw rate between the last two quarter turns; 0 in a steady turn"
    ),
    # pull-out
    "residual yaw rate": IndexDefinition(
        "deg/s", "r at the end of the pull-out, rudder amidships; positive in the direction of the turn before it"
    ),
    "residual yaw rate L/U": IndexDefinition("-", "residual yaw rate times L / U"),
    "yaw rate before": IndexDefinition("deg/s", "r when the rudder is put amidships; positive in the turn"),
    # zig-zag
    "initial turning time": IndexDefinition("s", "from the first execute to the second"),
    "reach": IndexDefinition(
        "s", "from the first execute to the first return of the heading to the original course"
    ),
    "reach U0/L": IndexDefinition("-", "reach times the approach speed over the ship length"),
    "period": IndexDefinition("s", "of a complete cycle: from the second execute to the fourth"),
    # initial turning test
    "initial turning track": IndexDefinition(
        "L", "length of the track of midship from execute to a heading change of 10 deg"
    ),
    "initial turning advance": IndexDefinition(
        "L", "distance along the original course from execute to a heading change of 10 deg"
    ),
    "time to heading 10": IndexDefinition("s", "from execute to a heading change of 10 deg"),
    # stopping
    "track reach": IndexDefinition("L", "length of the track of midship from the astern order to a stop"),
    "head reach": IndexDefinition("L", "distance along the original course from the astern order to a stop"),
    "side reach": IndexDefinition(
        "L", "distance across the original course from the astern order to a stop; positive to starboard"
    ),
    "stopping time": IndexDefinition("s", "from the astern order to a stop (u = 0)"),
    "heading change at stop": IndexDefinition("deg", "heading at the stop against the original; to starboard"),
    # spiral
    "loop width": IndexDefinition("deg", "range of rudder angles that have two steady yaw rates"),
    "loop height": IndexDefinition("deg/s", "difference of the two steady yaw rates at the neutral rudder angle"),
    "neutral rudder": IndexDefinition("deg", "middle of the loop, or the rudder angle of a zero yaw rate"),
    "yaw rate slope": IndexDefinition("1/s", "dr / d delta where the yaw rate is zero, of a stable ship"),
    # Williamson turn
    "side offset": IndexDefinition(
        "L",
        "distance across the original track when steady on the reciprocal course; to the side of the first turn",
    ),
    "distance back": IndexDefinition(
        "L", "distance along the original course from execute when the reciprocal course is reached"
    ),
    "time to reciprocal course": IndexDefinition(
        "s", "from execute to a heading within 1 deg of the reciprocal one"
    ),
    "course overshoot": IndexDefinition("deg", "largest heading beyond the reciprocal course"),
    "time to steady course": IndexDefinition(
        "s", "from execute to the steady reciprocal course, with nearly the speed of the approach"
    ),
}
"""Indices with fixed names."""

_NUMBERED: tuple[tuple[re.Pattern[str], IndexDefinition], ...] = (
    (
        re.compile(r"overshoot (\d+)"),
        IndexDefinition("deg", "heading extreme {0} less the heading at the execute before it"),
    ),
    (
        re.compile(r"time to check yaw (\d+)"),
        IndexDefinition("s", "from the execute that reverses the rudder to heading extreme {0}"),
    ),
    (re.compile(r"time of execute (\d+)"), IndexDefinition("s", "from the first execute to execute {0}")),
    (
        re.compile(r"time of overshoot (\d+)"),
        IndexDefinition("s", "from the first execute to heading extreme {0}"),
    ),
    (re.compile(r"time to (\d+)"), IndexDefinition("s", "from execute to a heading change of {0} deg")),
    (
        re.compile(r"speed ratio at (\d+)"),
        IndexDefinition("-", "speed over approach speed at a heading change of {0} deg"),
    ),
    (
        re.compile(r"drift distance (\d+)-(\d+)"),
        IndexDefinition("L", "distance of midship between heading changes of {0} and {1} deg"),
    ),
    (
        re.compile(r"drift direction (\d+)-(\d+)"),
        IndexDefinition(
            "deg",
            "direction of midship from a heading change of {0} deg to one of {1} deg, 0 to 360 from the original "
            "course towards the side of the turn",
        ),
    ),
)


def definition_of(index: str) -> IndexDefinition:
    """Unit and definition of an index by its name.

    Raises
    ------
    TowtankError
        For an unknown name.
    """
    if index in DEFINITIONS:
        return DEFINITIONS[index]
    for pattern, found in _NUMBERED:
        match = pattern.fullmatch(index)
        if match:
            return found._replace(definition=found.definition.format(*match.groups()))
    raise TowtankError(f"there is no index '{index}'", cure=f"indices are {', '.join(DEFINITIONS)}, ...")


def index_frame(
    values: Mapping[str, FloatArray | float], manoeuvre: str, ship: Ship | None = None, lengths: Lengths = "L"
) -> pd.DataFrame:
    """Table of indices of one run: columns manoeuvre, index, value, unit, definition.

    Parameters
    ----------
    values : mapping of str to float or ndarray of shape (1,)
        In the units of `definition_of`. What is NaN did not occur and is left out.
    manoeuvre : str
    ship : Ship, optional
        Needed for lengths in metres.
    lengths : {"L", "m"}
        Unit of lengths: ship lengths or metres.

    Raises
    ------
    TowtankError
        For several draws, an unknown index, or metres without a ship.
    """
    import pandas as pd

    if lengths == "m" and ship is None:
        raise TowtankError("lengths in metres need a ship", cure="give the ship, or take lengths='L'")
    rows = []
    for name, value in values.items():
        numbers = np.atleast_1d(np.asarray(value, dtype=float))
        if len(numbers) != 1:
            raise TowtankError(
                f"'{name}' has {len(numbers)} values; this table is of one run",
                cure="choose a draw with events.draw(number)",
            )
        unit, definition = definition_of(name)
        number = float(numbers[0])
        if np.isnan(number):
            continue
        if unit == "L" and lengths == "m" and ship is not None:
            unit, number = "m", number * ship.L
        rows.append((manoeuvre, name, number, unit, definition))
    return pd.DataFrame(rows, columns=["manoeuvre", "index", "value", "unit", "definition"])
