"""S-175 with roll (Son and Nomoto 1981): the derated engine of EShipman, twelve turns, the public code's turns."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from ..simulate.manoeuvres import turning
from ..simulate.sailing import sail
from ..simulate.ships import named_ship
from ..simulate.turning_indices import turning_indices
from ..simulate.vessel import Engine, SteeringGear, Vessel
from .approach_speed import steady_speed
from .case import Case, Paper, half_digit
from .compared_manoeuvres import turn_cases
from .printed_numbers import printed_by, printed_rows
from .sailed_manoeuvres import SAMPLES_EVERY, largest_heel, turn_after_approach

KEY = "s175-4dof"

SHARE = 0.01
"""Tolerance that is asked for beside the rounding of the print."""

CODE_SHARE = 0.001
"""Tolerance of the turns of the public code, whose shaft has a lag that changes with the rate."""

_ROLL_AT_THE_LIMIT = (
    "track, radius and final heel of the same run agree; how the heel was sampled in that run is not known"
)

_DECIMALS = {
    "advance": 2, "transfer": 2, "tactical_diameter": 2, "roll_peak": 1, "roll_steady": 1, "speed_end": 2,
}  # fmt: skip
_TURNED = 720.0


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _engine()
    yield from _turns()
    yield from _power()
    yield from _public_code()


def vessel_at(rate: float, GM: float) -> Vessel:
    """The ship at a propeller rate in rpm and a metacentric height in m, at its own steady speed."""
    vessel = named_ship("s175-4dof")
    vessel = vessel.but(rate=rate / 60.0, inertia=replace(vessel.inertia, GM=GM))
    return vessel.but(speed=steady_speed(vessel))


@cache
def _turn(rate: float, GM: float, delta: float) -> dict[str, float]:
    vessel = vessel_at(rate, GM)
    trajectory = sail(vessel, turning(delta, _TURNED), interval=SAMPLES_EVERY)
    assert trajectory.events is not None
    found = {name: float(v[0]) for name, v in turning_indices(trajectory.events, vessel.ship).items()}
    return {
        "speed": vessel.speed,
        "advance": found["advance"],
        "transfer": found["transfer"],
        "tactical_diameter": found["tactical diameter"],
        "roll_peak": largest_heel(trajectory),
        "roll_steady": math.degrees(float(trajectory.events.at("end", "phi")[0])),
        "speed_end": found["steady speed"],
    }


def _engine() -> Iterator[Case]:
    """Equation 25: the rate grows with the cube root of power."""
    full = printed_by("eshipman-engine-computed", "power")[100]["rate"]
    for row in printed_rows("eshipman-engine-computed"):
        rate = full * (row["power"] / 100.0) ** (1.0 / 3.0)
        yield Case(KEY, "equation 25", f"rate at {row['power']:g} % power, rpm", row["rate"], rate, half_digit(1))


def _turns() -> Iterator[Case]:
    for row in printed_rows("s175-4dof-turning-computed"):
        ours = _turn(row["rate"], row["GM"], row["delta"])
        case = f"independent computation, {row['rate']:g} rpm, GM {row['GM']:g} m, {row['delta']:g} deg"
        for column, decimals in _DECIMALS.items():
            printed = row[column]
            tolerance = SHARE * abs(printed) + half_digit(decimals)
            yield Case(KEY, case, column.replace("_", " "), printed, ours[column], tolerance)


def _power() -> Iterator[Case]:
    """Tactical diameters at 60 and 100 % power; the metacentric height is not printed, both are tried."""
    printed = {power: row["tactical_diameter"] for power, row in printed_by("eshipman-turning", "power").items()}
    rates = {power: row["rate"] for power, row in printed_by("eshipman-engine-computed", "power").items()}
    for GM in (0.3, 0.5):
        ours = {power: _turn(rates[power], GM, 35.0)["tactical_diameter"] for power in (100, 60)}
        for power in (100, 60):
            yield Case(
                KEY,
                f"tactical diameter with 35 deg, GM {GM:g} m",
                f"at {power} % power, L",
                printed[power],
                ours[power],
                0.1 * printed[power],
                note="neither the metacentric height nor the resistance at that power is printed: 10 %",
            )
        yield Case(
            KEY,
            f"tactical diameter with 35 deg, GM {GM:g} m",
            "at 60 % over that at 100 % power",
            printed[60] / printed[100],
            ours[60] / ours[100],
            0.02,
        )


def _public_code() -> Iterator[Case]:
    """Turns of the public code: its gear, 7 m/s and 70 rpm at the start, 80 rpm ordered."""
    for row in printed_rows("s175-container-code-computed"):
        gear = SteeringGear(rate=math.radians(5.0), limit=math.radians(row["limit"]), lag=1.0)
        # its shaft follows with a time constant of 5.65 / n seconds, here the one at 80 rpm
        vessel = named_ship("s175-4dof").but(
            speed=7.0, rate=70.0 / 60.0, gear=gear, engine=Engine(lag=5.65 / (80.0 / 60.0))
        )
        ours = turn_after_approach(vessel, min(row["delta"], row["limit"]), rate=80.0 / 60.0)
        case = f"public code, {row['delta']:g} deg ordered, limit {row['limit']:g} deg"
        yield from turn_cases(KEY, case, row, ours, "m", lambda printed: CODE_SHARE * printed)
        for column in ("roll_peak", "roll_end"):
            if math.isnan(row[column]):
                continue
            quantity = column.replace("_", " ")
            ours_here = abs(ours[quantity])
            note = _ROLL_AT_THE_LIMIT if quantity == "roll peak" and row["limit"] < row["delta"] else ""
            yield Case(KEY, case, f"{quantity}, deg", row[column], ours_here, half_digit(1), note=note)


PAPER = Paper(
    KEY,
    "Son and Nomoto (1981) S-175 with roll, in EShipman (MASHCON 2019) and the MSS toolbox (container.m)",
    cases,
)
