"""Grid study of the virtual captive tests of DTMB 5512 (Tables 2 to 5)."""

from __future__ import annotations

from collections.abc import Iterator

from .case import Case, half_digit
from .grid_triplet import GridTriplet
from .printed_numbers import printed_by, printed_rows
from .rounding import spread_of

REFINEMENT = 1.4
"""Refinement ratio that the paper names."""


def grid_cases(key: str) -> Iterator[Case]:
    """Tables 2 to 5 of the paper `key`."""
    triplets = _triplets()
    yield from _convergence(key, triplets)
    yield from _refinement(key)
    yield from _differences(key, triplets)


def _triplets() -> dict[str, GridTriplet]:
    drift = sorted(printed_rows("dtmb5512-drift-grids"), key=lambda row: row["cells"], reverse=True)
    triplets = {f"drift_{force}": GridTriplet(*(row[force] for row in drift)) for force in ("X", "Y", "N")}
    grids = printed_by("dtmb5512-pmm-grids", "grid")
    for motion in ("sway", "yaw"):
        for force in ("X", "Y", "N"):
            name = f"{motion}_{force}"
            triplets[name] = GridTriplet(*(grids[grid][name] for grid in ("fine", "medium", "coarse")))
    return triplets


def _convergence(key: str, triplets: dict[str, GridTriplet]) -> Iterator[Case]:
    """Table 4; the paper computed it from the numbers that it prints, so no rounding of these enters."""
    printed = printed_by("dtmb5512-grid-convergence", "quantity")
    for quantity, grids in triplets.items():
        for column, computed in (
            ("R", grids.ratio),
            ("p", grids.order(REFINEMENT)),
            ("GCI_fine", grids.convergence_index(REFINEMENT)),
        ):
            value = printed[quantity][column]
            differs = quantity == "sway_X"
            yield Case(
                key,
                "Tables 2 and 3 to Table 4",
                f"{column} of {quantity.replace('_', ' ')}",
                value,
                computed,
                half_digit(5),
                note="the three surge forces of Table 3 do not give this column" if differs else "",
            )


def _refinement(key: str) -> Iterator[Case]:
    cells = [row["cells"] for row in printed_rows("dtmb5512-drift-grids")]
    for pair, coarse, fine in (("coarse to medium", cells[0], cells[1]), ("medium to fine", cells[1], cells[2])):
        yield Case(
            key,
            "Table 2, refinement ratio",
            pair,
            REFINEMENT,
            (fine / coarse) ** (1.0 / 3.0),
            half_digit(1),
            note="cube root of the ratio of cell counts; Table 4 assumes 1.4 throughout",
        )


def _differences(key: str, triplets: dict[str, GridTriplet]) -> Iterator[Case]:
    printed = printed_by("dtmb5512-grid-differences", "condition")
    for condition in ("drift", "pure sway", "pure yaw"):
        for force in ("X", "Y", "N"):
            grids = triplets[f"{condition.removeprefix('pure ')}_{force}"]
            value = printed[condition][force]

            def percent(fine: float, medium: float) -> float:
                return 100 * abs((fine - medium) / medium)

            computed = percent(grids.fine, grids.medium)
            tolerance = spread_of(percent, (grids.fine, 5), (grids.medium, 5)) + half_digit(1)
            of_fine = 100 * abs(grids.fine_change / grids.fine)
            note = f"relative to the fine grid {of_fine:.2f} %"
            if condition == "drift":
                note = f"does not follow from Table 2 on either base; {note}"
            yield Case(
                key,
                "Tables 2 and 3 to Table 5",
                f"fine against medium grid, {condition} {force}, %",
                value,
                computed,
                tolerance,
                note=note if abs(computed - value) > tolerance else "",
            )
