"""DTC turning circle: Table 14, and what the printed rudder area does to it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from ..simulate.ships import named_ship
from ..simulate.vessel import SteeringGear, Vessel
from .case import Case
from .printed_numbers import printed_by, printed_rows
from .sailed_manoeuvres import turn

_INDICES = {
    "advance": "advance",
    "transfer": "transfer",
    "tactical_diameter": "tactical diameter",
    "steady_diameter": "steady diameter",
    "yaw_rate": "steady yaw rate L/U0",
    "speed_ratio": "steady speed ratio",
}
_TREND = 0.10
"""Tolerance of Table 14: added masses, steering gear and wake in drift are not printed."""

_INDEPENDENT = 0.002
_STEADY = 1080.0
"""Degrees after which the turn is steady."""


def turning_cases(key: str) -> Iterator[Case]:
    """Cases of Table 14 and of independent runs."""
    yield from _table_14(key)
    yield from _independent(key)


def _table_14(key: str) -> Iterator[Case]:
    printed = printed_by("dtc-turning", "source")["simulation"]
    found = turn(named_ship("dtc"), 35.0, _STEADY)
    small = turn(named_ship("dtc", corrected=False), 35.0, _STEADY)
    case = "Table 14, 35 deg to starboard"
    for column, index in _INDICES.items():
        note = "rudder area 0.0183 L T, which the printed aspect ratio and eta give, for the printed 0.0095"
        yield Case(key, case, index, printed[column], found[index], _TREND * printed[column], note=note)
    for column in ("advance", "transfer", "tactical_diameter", "steady_diameter"):
        off = small[_INDICES[column]]
        reached = abs(off - printed[column]) <= _TREND * printed[column]
        yield Case(
            key,
            case,
            f"{_INDICES[column]} with the printed rudder area 0.0095 L T",
            "out of reach",
            "within reach" if reached else "out of reach",
            note=f"{off:.2f} L against {printed[column]:.2f} L: the printed area is not the rudder's",
        )


def _independent(key: str) -> Iterator[Case]:
    for row in printed_rows("dtc-turning-computed"):
        found = turn(_variant(row), 35.0, _STEADY)
        what = f"area {row['rudder_area']:g} L T, my' = {row['my']:g}, ship's mass in Yr and Xvr {_mass(row)}"
        for column, index in _INDICES.items():
            yield Case(
                key, f"independent computation, {what}", index, row[column], found[index], _INDEPENDENT * row[column]
                + 0.0005,
            )  # fmt: skip


def _mass(row: dict[str, Any]) -> str:
    return str(row["mass_in_derivatives"])


def _variant(row: dict[str, Any]) -> Vessel:
    vessel = named_ship("dtc")
    ship = replace(vessel.ship, xG=0.0)
    hull = replace(vessel.hull, ship=ship).with_values(Yvdot=-row["my"], Nrdot=-0.011)
    if _mass(row) == "removed":
        hull = hull.with_values(Yr=0.0262, Xvr=-0.0257)
    assert vessel.rudder is not None
    rudder = replace(vessel.rudder, area=row["rudder_area"] * ship.L * ship.T)
    instant = SteeringGear(rate=math.radians(35.0) / 1e-6)
    return vessel.but(hull=hull, rudder=rudder, gear=instant)
