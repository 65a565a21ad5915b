"""KVLCC2 with the MMG standard set: the system-based column of Kim et al. (2021), independent runs, the wake."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..simulate.packing import pack
from ..simulate.propeller import Propeller
from ..simulate.self_propulsion import self_propulsion_rates
from ..simulate.ships import named_ship
from ..simulate.vessel import Vessel
from .case import Case, Paper
from .compared_manoeuvres import overshoot_cases, turn_cases
from .printed_numbers import printed_rows
from .sailed_manoeuvres import overshoots, turn

KEY = "kvlcc2-mmg"

LENGTHS = 0.05
"""Tolerance of advance, transfer and diameter in L: two programs of the same model differ by this much."""

DEGREES = 0.3
"""Tolerance of overshoots: their second one moves by 0.35 deg when steps of 0.2 s find the switching heading."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _kim()
    yield from _independent()
    yield from _wake()


def _kim() -> Iterator[Case]:
    vessel = named_ship("kvlcc2")
    for row in printed_rows("kvlcc2-kim"):
        case = f"Kim et al., Tables 7 and 8, {row['manoeuvre']} {row['delta']:+g}"
        if row["manoeuvre"] == "turning":
            ours = turn(vessel, row["delta"])[row["quantity"]]
            yield Case(KEY, case, f"{row['quantity']}, L", row["system_based"], ours, LENGTHS)
        else:
            number = int(row["quantity"].split()[-1])
            ours = overshoots(vessel, row["delta"])[number - 1]
            yield Case(KEY, case, f"{row['quantity']}, deg", row["system_based"], ours, DEGREES)


def _independent() -> Iterator[Case]:
    for row in printed_rows("kvlcc2-turning-computed"):
        case = f"independent computation, {row['ship']}, turn with {row['delta']:g} deg"
        ours = turn(named_ship(row["ship"]), row["delta"])
        yield from turn_cases(KEY, case, row, ours, "L", lambda printed: LENGTHS)
    for row in printed_rows("kvlcc2-zigzag-computed"):
        case = f"independent computation, {row['ship']}, zig-zag {row['delta']:+g}"
        found = overshoots(named_ship(row["ship"]), row["delta"])
        yield from overshoot_cases(KEY, case, row, found, lambda printed: DEGREES)


def _wake() -> Iterator[Case]:
    """At zero drift the wake is wP0: the propeller rate is that of a wake that never changes."""
    vessel = named_ship("kvlcc2")
    assert isinstance(vessel.propeller, Propeller)
    constant = vessel.but(propeller=replace(vessel.propeller, wake="constant"))
    yield Case(
        KEY,
        "wake at beta = 0",
        "self-propulsion rate with the drift-dependent wake, 1/s, beside that with wP0 alone",
        _approach_rate(constant),
        _approach_rate(vessel),
        1e-12,
        note="public ports that leave out the bracket of the wake have w = 0.09 at zero drift",
    )


def _approach_rate(vessel: Vessel) -> float:
    return float(self_propulsion_rates(pack(vessel), vessel.speed)[0])


PAPER = Paper(
    KEY,
    "Yasukawa and Yoshimura (2015) MMG standard method, KVLCC2, with Kim et al. (2021), system-based column",
    cases,
)
