"""Tanker of 190 000 dwt in deep and shallow water (van Berlekom and Goddard 1972)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache
from itertools import pairwise
from typing import Any

from ..simulate.ships import named_ship
from .case import Case, Paper
from .compared_manoeuvres import overshoot_cases, turn_cases
from .printed_numbers import printed_rows
from .sailed_manoeuvres import overshoots, turn_after_approach

KEY = "esso"

SHARE = 0.01
"""Tolerance that is asked for."""

STEP = 0.02
"""Overshoots in deg: what the steps of the other program add, which find the switching heading late."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _turning()
    yield from _zigzags()
    yield from _monotone()


@cache
def _turn(depth_ratio: float, delta: float) -> dict[str, float]:
    # the set's rudder angle is positive to port
    return turn_after_approach(named_ship("esso190k", depth_ratio=depth_ratio), -delta)


@cache
def _overshoots(depth_ratio: float, delta: float) -> list[float]:
    return overshoots(named_ship("esso190k", depth_ratio=depth_ratio), delta)


def _depth(row: dict[str, Any]) -> str:
    return "deep (200 m)" if row["depth_ratio"] > 10.0 else f"h/T = {row['depth_ratio']:g}"


def _turning() -> Iterator[Case]:
    for row in printed_rows("esso-turning-computed"):
        case = f"independent computation, {_depth(row)}, turn with {row['delta']:g} deg"
        ours = _turn(row["depth_ratio"], row["delta"])
        yield from turn_cases(KEY, case, row, ours, "m", lambda printed: SHARE * printed)


def _zigzags() -> Iterator[Case]:
    for row in printed_rows("esso-zigzag-computed"):
        case = f"independent computation, {_depth(row)}, zig-zag {row['delta']:g}/{row['delta']:g}"
        ours = _overshoots(row["depth_ratio"], row["delta"])
        yield from overshoot_cases(KEY, case, row, ours, lambda printed: SHARE * printed + STEP)


def _monotone() -> Iterator[Case]:
    """Less water, wider turns and smaller overshoots, at every step of the series."""
    rows = [row for row in printed_rows("esso-turning-computed") if row["delta"] == 35.0]
    depths = sorted((row["depth_ratio"] for row in rows), reverse=True)
    diameters = [_turn(depth, 35.0)["tactical diameter"] for depth in depths]
    series = {"tactical diameter grows": diameters}
    for delta in (10.0, 20.0):
        for number in (0, 1):
            angles = [-_overshoots(depth, delta)[number] for depth in depths]
            series[f"overshoot {number + 1} of {delta:g}/{delta:g} falls"] = angles
    for what, values in series.items():
        steps = [b - a for a, b in pairwise(values)]
        yield Case(
            KEY,
            "deep to h/T = 1.2",
            what,
            "at every step",
            "at every step" if all(step > 0.0 and math.isfinite(step) for step in steps) else "not at every step",
        )


PAPER = Paper(
    KEY, "van Berlekom and Goddard (1972) Maneuvering of large tankers, as in the MSS toolbox (tanker.m)", cases
)
