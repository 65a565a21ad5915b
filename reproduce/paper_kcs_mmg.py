"""KCS with the MMG set in the drift angle (SIMMAN 2008): self-propulsion rate, turning circles, zig-zags."""

from __future__ import annotations

from collections.abc import Iterator

from ..datasets import load_extras
from ..simulate.packing import pack
from ..simulate.self_propulsion import self_propulsion_rates
from ..simulate.ships import named_ship
from .case import Case, Paper, half_digit
from .compared_manoeuvres import overshoot_cases, turn_cases
from .printed_numbers import printed_rows
from .sailed_manoeuvres import overshoots, turn

KEY = "kcs-mmg"

LENGTHS = 0.05
"""Tolerance of advance, transfer and diameter in L, as for the other ship with an MMG set."""

DEGREES = 0.3
"""Tolerance of overshoots."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    vessel = named_ship("kcs")
    rate = 60.0 * float(self_propulsion_rates(pack(vessel), vessel.speed)[0])
    yield Case(
        KEY,
        "self-propulsion at 24 knots",
        "propeller rate, rpm",
        load_extras("kcs")["propeller"]["n_selfpropulsion_rpm"],
        rate,
        half_digit(1),
    )
    for row in printed_rows("kcs-turning-computed"):
        case = f"independent computation, turn with {row['delta']:g} deg"
        yield from turn_cases(KEY, case, row, turn(vessel, row["delta"]), "L", lambda printed: LENGTHS)
    for row in printed_rows("kcs-zigzag-computed"):
        case = f"independent computation, zig-zag {row['delta']:+g}"
        yield from overshoot_cases(KEY, case, row, overshoots(vessel, row["delta"]), lambda printed: DEGREES)


PAPER = Paper(KEY, "Yoshimura, Ueno and Tsukada (2008) KCS coefficients for the MMG model, SIMMAN workshop", cases)
