"""Empirical squat formulas: samples of four passages, and ICORELS for the calm runs of the DTC model."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ..datasets.catalogue import find
from ..squat.fairway import Fairway
from ..squat.prediction import FORMULAS, predict
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_rows, ship_of

KEY = "squat-formulas"

_GRAVITY_SHARE = 5e-4
"""The references were computed with g = 9.81; the steepest formula goes with g to -1.4."""

_COLUMNS = {
    "icorels_24": ("icorels-2.4", "maximum"),
    "icorels": ("icorels", "maximum"),
    "huuska": ("huuska", "maximum"),
    "barrass_3": ("barrass-3", "maximum"),
    "barrass_2": ("barrass-2", "maximum"),
    "eryuzlu": ("eryuzlu", "maximum"),
    "eryuzlu_hausser": ("eryuzlu-hausser", "maximum"),
    "yoshimura": ("yoshimura", "maximum"),
    "roemisch_bow": ("roemisch", "bow"),
    "roemisch_stern": ("roemisch", "stern"),
    "tuck_hooft": ("tuck-hooft", "maximum"),
    "millward": ("millward", "maximum"),
    "norrbin": ("norrbin", "maximum"),
    "ankudinov_bow": ("ankudinov", "bow"),
    "ankudinov_stern": ("ankudinov", "stern"),
}

_OPEN_CRITICAL = "computed with the critical speed of open water; the canal's own gives more than twice as much"


def cases() -> Iterator[Case]:
    """All cases."""
    for row in printed_rows("squat-samples"):
        yield from _passage(row)
    model = ship_of("squat-icorels-dtc").at_scale(89.11)
    for row in printed_rows("squat-icorels-dtc"):
        found = predict(model, row["depth"], [row["speed"]], formulas=(FORMULAS["icorels"],)).of("icorels", "bow")
        yield Case(
            KEY,
            f"DTC model, {row['case']}",
            "bow squat of ICORELS in mm (recomputed reference)",
            row["bow"],
            1000.0 * float(found[0]),
            half_digit(int(row["decimals"])) + _GRAVITY_SHARE * row["bow"],
        )


def _passage(row: dict[str, Any]) -> Iterator[Case]:
    ship = find("table", "squat-samples").ship(row["ship"])
    wide = math.isnan(row["width"])
    channel = None if wide else Fairway.canal(row["depth"], row["width"])
    found = predict(ship, row["depth"], [row["speed"] * KNOT], channel=channel)
    water = "open water" if wide else f"canal {row['width']:g} m wide"
    for column, (formula, place) in _COLUMNS.items():
        yield Case(
            KEY,
            f"{ship.name}, depth {row['depth']:g} m, {row['speed']:g} kn, {water}",
            f"{formula} {place} in m (recomputed reference)",
            row[column],
            float(found.of(formula, place)[0]),
            half_digit(3) + _GRAVITY_SHARE * row[column],
            note=_OPEN_CRITICAL if formula == "roemisch" and not wide else "",
        )


PAPER = Paper(KEY, "PIANC 121 (2014), Briggs (2013) and their sources: empirical squat formulas", cases)
