"""Rows of a table of manoeuvres beside the same manoeuvres sailed here."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from .case import Case

TURN = ("advance", "transfer", "tactical_diameter", "radius")
"""Columns of a turning circle, those that a table has."""


def turn_cases(
    key: str,
    case: str,
    row: Mapping[str, Any],
    ours: Mapping[str, float],
    unit: str,
    tolerance: Callable[[float], float],
) -> Iterator[Case]:
    """A case for each index of a turning circle that the row prints.

    Parameters
    ----------
    key, case : str
        Of the paper, and what was done.
    row : mapping
        Columns of `TURN`; NaN or absent where nothing is printed.
    ours : mapping of str to float
        Indices by name, words parted by blanks.
    unit : str
    tolerance : callable
        Of the printed value.
    """
    for column in TURN:
        if math.isnan(row.get(column, math.nan)):
            continue
        quantity = column.replace("_", " ")
        yield Case(key, case, f"{quantity}, {unit}", row[column], ours[quantity], tolerance(row[column]))


def overshoot_cases(
    key: str, case: str, row: Mapping[str, Any], ours: Sequence[float], tolerance: Callable[[float], float]
) -> Iterator[Case]:
    """A case for each overshoot of a zig-zag; the row has columns ``overshoot_1``, ``overshoot_2``, ..."""
    for number, angle in enumerate(ours, start=1):
        printed = row[f"overshoot_{number}"]
        yield Case(key, case, f"overshoot {number}, deg", printed, angle, tolerance(printed))


def printed_overshoots(row: Mapping[str, Any]) -> int:
    """Number of overshoots that the row prints."""
    return sum(not math.isnan(value) for name, value in row.items() if name.startswith("overshoot_"))
