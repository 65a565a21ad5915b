"""Vertical motions of nine container ships at sea (MASHCON 2019): particulars, stability, encounters, accuracy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ..squat.sensor_budget import sensor_budget
from .case import Case, Paper, half_digit
from .printed_numbers import printed_by, printed_rows
from .rounding import spread_of

KEY = "container-ships-at-sea"

_TENDER = 3.2
"""Metacentric height in m below which the text calls a ship tender."""

_OTHER_WATERLINE = "length, draught and density that this coefficient refers to are not said; within 0.02"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    recomputed = printed_by("container-ships-recomputed", "ship")
    rows = printed_rows("container-ships-at-sea")
    for row in rows:
        yield from _particulars(row, recomputed[row["ship"]])
    tender = sorted((_stability(row), row["ship"]) for row in rows if _stability(row) < _TENDER)
    yield Case(
        KEY,
        "Table 1",
        "ships with a corrected metacentric height below 3.2 m",
        "ULCS1, ULCS3, ULCS8",
        ", ".join(sorted(ship for _, ship in tender)),
    )
    for row in printed_rows("container-ships-encounters"):
        own, other = row["own"], row["other"]
        relative = own - other if row["same_way"] else own + other
        yield Case(
            KEY,
            f"Table 3, case {row['case']:g}",
            "relative speed in kn",
            row["relative"],
            relative,
            spread_of(lambda a, b: a + b, (own, 1), (other, 1)) + half_digit(1),
        )
    yield from _accuracy()


def block_coefficient(displacement: float, rho: float, length: float, breadth: float, draught: float) -> float:
    """Displacement in kg over that of the box."""
    return displacement / rho / (length * breadth * draught)


def _particulars(row: dict[str, Any], reference: dict[str, Any]) -> Iterator[Case]:
    name = f"Table 1, {row['ship']}"
    draught = 0.5 * (row["forward"] + row["aft"])
    yield Case(
        KEY,
        name,
        "mean draught in m (recomputed reference)",
        reference["draught"],
        draught,
        half_digit(int(reference["decimals"])),
    )
    block = block_coefficient(1000.0 * row["displacement"], row["rho"], row["LPP"], row["B"], draught)
    yield Case(KEY, name, "block coefficient (recomputed reference)", reference["CB"], block, half_digit(3))
    spread = spread_of(
        lambda length, breadth, mean: block_coefficient(
            1000.0 * row["displacement"], row["rho"], length, breadth, mean
        ),
        (row["LPP"], 0),
        (row["B"], 1),
        (draught, 2),
    )
    tolerance = spread + half_digit(2)
    note = "" if abs(block - row["CB"]) <= tolerance else _OTHER_WATERLINE
    yield Case(KEY, name, "block coefficient as printed", row["CB"], block, tolerance, note=note)


def _stability(row: dict[str, Any]) -> float:
    """Metacentric height less the effect of free surfaces, m."""
    return float(row["GM"] - row["free_surface"])


def _accuracy() -> Iterator[Case]:
    for row in printed_rows("container-ships-accuracy"):
        budget = sensor_budget(row["lever"])
        name = f"{row['place']}, lever {row['lever']:g} m"
        yield Case(KEY, name, "linear sum of the sensors in m", row["accuracy"], budget.linear, half_digit(2))
        smaller = "yes" if budget.rss < 0.6 * row["accuracy"] else "no"
        yield Case(KEY, name, "root sum of squares well below the printed accuracy", "yes", smaller)


PAPER = Paper(KEY, "Verwilligen et al. (2019), vertical motions of nine container ships at full scale", cases)
