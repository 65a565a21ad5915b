"""Names of manoeuvres: ``turning +35``, ``zigzag -20/20``, ``initial turning 10``, ``crash stop``, ..."""

from __future__ import annotations

import re
from typing import NamedTuple

from ..core.errors import TowtankError

KINDS = (
    "turning",
    "zigzag",
    "initial turning",
    "pull-out",
    "spiral",
    "reverse spiral",
    "crash stop",
    "williamson",
)
"""Manoeuvres that have indices."""

# The longer names first: an initial turning test is no turning circle.
WORDS = (
    ("initial turning", r"initial[ _-]*turn\w*"),
    ("reverse spiral", r"reverse[ _-]*spiral"),
    ("spiral", r"(dieudonn\w+[ _-]*)?spiral"),
    ("pull-out", r"pull[ _-]*out"),
    ("crash stop", r"crash[ _-]*(stop|astern)|stopping"),
    ("williamson", r"williamson([ _-]*turn)?"),
    ("zigzag", r"zig[ _-]*zag"),
    ("turning", r"turning([ _-]*circle)?|turn"),
)
"""Kind of manoeuvre and a pattern of its names in small letters."""
_NUMBERS = re.compile(r"([+-]?\d+(?:\.\d+)?)(?:\s*/\s*(\d+(?:\.\d+)?))?")


class NamedManoeuvre(NamedTuple):
    """What a name says.

    Attributes
    ----------
    kind : str
        One of `KINDS`.
    rudder : float or None
        Rudder angle in degrees with the sign of the first side, positive to starboard.
    heading : float or None
        Switching heading of a zig-zag in degrees, positive.
    """

    kind: str
    rudder: float | None = None
    heading: float | None = None


def read_manoeuvre_name(name: str) -> NamedManoeuvre:
    """Kind of manoeuvre and angles from a name such as ``"zigzag -20/20"``.

    Raises
    ------
    TowtankError
        When the name has no known kind.
    """
    text = name.strip().lower()
    for kind, words in WORDS:
        match = re.match(words, text)
        if match:
            numbers = _NUMBERS.search(text[match.end() :])
            rudder = float(numbers[1]) if numbers else None
            heading = float(numbers[2]) if numbers and numbers[2] else None
            return NamedManoeuvre(kind, rudder, heading)
    raise TowtankError(
        f"'{name}' names no known manoeuvre",
        cure=f"begin the name with one of {', '.join(KINDS)}, e.g. 'turning +35' or 'zigzag 10/10'",
    )
