"""Mariner class (Chislett and Stroem-Tejsen 1965): the seven numbers of the handbook, turning circles, zig-zags."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..simulate.ships import named_ship
from ..simulate.textbook_turning import textbook_turning
from .case import Case, Paper, half_digit
from .compared_manoeuvres import overshoot_cases, printed_overshoots, turn_cases
from .euler_run import euler_run
from .printed_numbers import printed_rows
from .sailed_manoeuvres import ORDER_AFTER, overshoots, turn_after_approach

KEY = "mariner"

STEP = 0.08
"""Tolerance of overshoots in deg: the other program's steps of 0.1 s find the switching heading late, at 0.8 deg/s."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _handbook()
    yield from _turning()
    yield from _zigzags()


def _handbook() -> Iterator[Case]:
    """Euler steps of 0.1 s over 700 s, 15 deg to port, by the textbook's own counting."""
    port = math.radians(-15.0)
    run = euler_run(named_ship("mariner"), lambda time: port if time > ORDER_AFTER - 0.05 else 0.0, 700.0, 0.1)
    ours = textbook_turning(run, 100.0)
    for row in printed_rows("mariner-handbook"):
        yield Case(
            KEY,
            "handbook, 15 deg to port, Euler steps of 0.1 s",
            f"{row['quantity']}, m",
            row["printed"],
            ours[row["quantity"]],
            half_digit(0),
            note="headings rounded to degrees, advance counted from the place at 99.9 s, distances from the x axis",
        )


def _turning() -> Iterator[Case]:
    vessel = named_ship("mariner")
    for row in printed_rows("mariner-turning-computed"):
        case = f"independent computation, turn with {row['delta']:g} deg"
        ours = turn_after_approach(vessel, row["delta"])
        yield from turn_cases(KEY, case, row, ours, "m", lambda printed: half_digit(1))


def _zigzags() -> Iterator[Case]:
    vessel = named_ship("mariner")
    for row in printed_rows("mariner-zigzag-computed"):
        case = f"independent computation, zig-zag {row['delta']:+g}/{row['heading']:g}"
        ours = overshoots(vessel, row["delta"], row["heading"], printed_overshoots(row))
        yield from overshoot_cases(KEY, case, row, ours, lambda printed: STEP)


PAPER = Paper(
    KEY,
    "Chislett and Stroem-Tejsen (1965), Mariner class, as in the MSS toolbox and the handbook of Fossen",
    cases,
)
