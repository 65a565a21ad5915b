"""S-175 turning in deep water: the circles of the paper, and two misprints that make them impossible."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from ..core.errors import SimulationError
from ..simulate.ships import named_ship
from ..simulate.vessel import Vessel
from .case import Case, half_digit
from .printed_numbers import printed_rows
from .sailed_manoeuvres import turn

_SHIPS = {"model tests": "s175-3dof", "regressions": "s175-3dof-regression"}
_SHARES = {
    "model tests": {"advance": 0.05, "transfer": 0.20, "tactical diameter": 0.05},
    "regressions": {"advance": 0.06, "transfer": 0.06, "tactical diameter": 0.06},
}
_WHY = (
    "mass moment of inertia, propeller, rudder area and its place of straightening are not printed; taken from "
    "Son and Nomoto (1981)"
)


def turning_cases(key: str) -> Iterator[Case]:
    """Cases of Tables 3, 4, 6 and 7."""
    for row in printed_rows("s175-turning"):
        source, quantity = row["derivatives"], row["quantity"]
        found = turn(named_ship(_SHIPS[source]), 35.0 if row["turn"] == "starboard" else -35.0)
        printed = abs(row["simulated"])
        yield Case(
            key,
            f"turning circle, {source}, {row['turn']}",
            f"{quantity} of the turn, L",
            printed,
            found[quantity],
            _SHARES[source][quantity] * printed,
            note=_WHY,
        )
    yield from _shallow(key)
    yield from _misprints(key)


def _shallow(key: str) -> Iterator[Case]:
    """Increase of the circles at h/d = 1.2 over those measured in deep water."""
    deep = {
        (row["turn"], row["quantity"]): abs(row["measured"])
        for row in printed_rows("s175-turning")
        if row["derivatives"] == "regressions"
    }
    for row in printed_rows("s175-shallow-turning"):
        found = turn(named_ship("s175-3dof-shallow"), 35.0 if row["turn"] == "starboard" else -35.0)
        yield Case(
            key,
            f"turning circle at h/d = 1.2, {row['turn']}",
            f"{row['quantity']} over that measured in deep water, %",
            row["increase"],
            100.0 * (found[row["quantity"]] / deep[row["turn"], row["quantity"]] - 1.0),
            half_digit(0),
            note="Table 5 gives a far wider circle; what the paper did to wake, thrust and rudder inflow in "
            "shallow water is not printed",
        )


def _misprints(key: str) -> Iterator[Case]:
    """The numbers as printed do not turn as the paper's ship does."""
    regression = named_ship("s175-3dof-regression")
    printed_sign = _with(regression, "Yv|v|", 0.90020)
    for what, source, wrong, right in (
        (
            "N'rrr = -0.4220 as printed",
            "model tests",
            _with(named_ship("s175-3dof"), "Nrrr", -0.4220),
            named_ship("s175-3dof"),
        ),
        ("Y'v|v| = +0.90020 as printed", "regressions", printed_sign, regression),
    ):
        (row,) = [
            row
            for row in printed_rows("s175-turning")
            if (row["derivatives"], row["turn"], row["quantity"]) == (source, "starboard", "tactical diameter")
        ]
        printed = row["simulated"]
        tolerance = _SHARES[source]["tactical diameter"] * printed
        off = _diameter(wrong)
        yield Case(
            key,
            f"turning circle, {source}, starboard",
            f"tactical diameter with {what}",
            "out of reach",
            "out of reach" if not abs(off - printed) <= tolerance else "within reach",
            note=f"{_said(off)} against {printed:.2f} L; with the corrected value {_said(_diameter(right))}",
        )


def _with(vessel: Vessel, name: str, value: float) -> Vessel:
    hull = vessel.hull
    values = hull.values.copy()
    values[hull.names.index(name)] = value
    return vessel.with_hull(replace(hull, values=values))


def _said(diameter: float) -> str:
    return "the ship loses all speed" if math.isnan(diameter) else f"{diameter:.2f} L"


def _diameter(vessel: Vessel) -> float:
    """Tactical diameter in L; NaN when the turn is not completed."""
    try:
        return turn(vessel, 35.0, 200.0)["tactical diameter"]
    except SimulationError:
        return math.nan
