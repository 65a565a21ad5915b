"""Grid study of the virtual captive tests of DTMB 5512 (Tables 2 to 5)."""

from __future__ import annotations

from collections.abc import Iterator

from ..verify.grid_triplet import GridTriplet
from ..verify.refinement import spacings_from_cells
from ..verify.triplet_uncertainty import gci_celik
from .case import Case, half_digit
from .printed_numbers import printed_by, printed_rows
from .rounding import spread_of

REFINEMENT = 1.4
"""Refinement ratio that the paper names."""


_MISPRINT = (
    "the three surge forces of Table 3 give R 0.357, p 3.06 and GCI 0.00103; the column follows from changes "
    "of 0.00188 and 0.00394 instead of 0.00148 and 0.00414"
)


def grid_cases(key: str) -> Iterator[Case]:
    """Tables 2 to 5 of the paper `key`."""
    triplets = _triplets()
    yield from _convergence(key, triplets)
    yield from _misprint(key)
    yield from _refinement(key)
    yield from _true_ratios(key)
    yield from _differences(key, triplets)


def _triplets() -> dict[str, GridTriplet]:
    drift = sorted(printed_rows("dtmb5512-drift-grids"), key=lambda row: row["cells"], reverse=True)
    triplets = {f"drift_{force}": _triplet(*(row[force] for row in drift)) for force in ("X", "Y", "N")}
    grids = printed_by("dtmb5512-pmm-grids", "grid")
    for motion in ("sway", "yaw"):
        for force in ("X", "Y", "N"):
            name = f"{motion}_{force}"
            triplets[name] = _triplet(*(grids[grid][name] for grid in ("fine", "medium", "coarse")))
    return triplets


def _triplet(fine: float, medium: float, coarse: float) -> GridTriplet:
    return GridTriplet(fine, medium, coarse, REFINEMENT, REFINEMENT)


def _convergence(key: str, triplets: dict[str, GridTriplet]) -> Iterator[Case]:
    """Table 4; the paper computed it from the numbers that it prints, so no rounding of these enters."""
    printed = printed_by("dtmb5512-grid-convergence", "quantity")
    for quantity, grids in triplets.items():
        for column, computed in _row(grids).items():
            yield Case(
                key,
                "Tables 2 and 3 to Table 4",
                f"{column} of {quantity.replace('_', ' ')}",
                printed[quantity][column],
                computed,
                half_digit(5),
                note=_MISPRINT if quantity == "sway_X" else "",
            )


def _row(grids: GridTriplet) -> dict[str, float]:
    """What Table 4 prints of a triplet; its index is the absolute one."""
    return {"R": grids.ratio, "p": grids.order, "GCI_fine": gci_celik(grids).uncertainty}


def _misprint(key: str) -> Iterator[Case]:
    """The column of sway X from the changes that it was computed from."""
    printed = printed_by("dtmb5512-grid-convergence", "quantity")["sway_X"]
    fine = printed_by("dtmb5512-pmm-grids", "grid")["fine"]["sway_X"]
    grids = _triplet(fine, fine + 0.00188, fine + 0.00188 + 0.00394)
    for column, computed in _row(grids).items():
        yield Case(
            key,
            "Table 4, sway X with the changes 0.00188 and 0.00394",
            f"{column} of sway X",
            printed[column],
            computed,
            half_digit(5),
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


def _true_ratios(key: str) -> Iterator[Case]:
    """What the ratios of the cell counts make of Table 4: an independent solution for the order."""
    rows = sorted(printed_rows("dtmb5512-drift-grids"), key=lambda row: row["cells"], reverse=True)
    spacings = spacings_from_cells([row["cells"] for row in rows]).tolist()
    for expected in printed_rows("dtmb5512-true-ratios-computed"):
        force = expected["force"]
        grids = GridTriplet.from_spacings([row[force] for row in rows], spacings)
        index = 100.0 * gci_celik(grids).uncertainty / abs(grids.fine)
        assumed = _triplets()[f"drift_{force}"]
        instead = 100.0 * gci_celik(assumed).uncertainty / abs(assumed.fine)
        for quantity, computed, decimals, note in (
            ("p", grids.order, 2, f"{assumed.order:.2f} with 1.4"),
            ("GCI, % of the fine grid", index, 2, f"{instead:.2f} with 1.4"),
            ("extrapolated", grids.extrapolated, 5, f"{assumed.extrapolated:.5f} with 1.4"),
        ):
            yield Case(
                key,
                "Table 2 with the ratios 1.334 and 1.230 of the cell counts (independent computation)",
                f"{quantity} of drift {force}",
                expected[quantity.partition(",")[0]],
                computed,
                half_digit(decimals),
                note=note,
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
            of_fine = 100 * abs(grids.eps21 / grids.fine)
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
