"""Scale effects on squat (ReSquat, MASHCON 2019): uncertainty of three grids, revolutions, clearance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .case import Case, Paper, half_digit
from .grid_triplet import GridTriplet
from .printed_numbers import printed_rows
from .rounding import spread_of

KEY = "resquat"

_FACTOR = 3.0
_OSCILLATION_FACTOR = 1.25
_BEHAVIOUR = {"monotonic": "CONV", "oscillatory": "OCONV", "divergent": "DIV"}
_COPIED = "the uncertainties of scale 6 repeat those of full scale"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    for row in printed_rows("resquat-grids"):
        yield from _grids(row)
    for row in printed_rows("resquat-revolutions"):
        yield Case(
            KEY,
            f"Table 5, Froude number {row['froude']:g}",
            "discrepancy of the revolutions",
            row["discrepancy"],
            (row["measured"] - row["computed"]) / row["measured"],
            half_digit(2),
        )
    yield Case(
        KEY, "text", "0.19 m of the clearance at h/T 1.15, %", 8.0, 100 * 0.19 / (0.15 * 16.0), half_digit(0)
    )


def grid_uncertainty(fine: float, medium_change: float, fine_change: float) -> float:
    """Uncertainty in % of the fine grid's result, by the paper's rule for each kind of convergence.

    Parameters
    ----------
    fine : float
        Result on the fine grid.
    medium_change, fine_change : float
        Coarse to medium and medium to fine.
    """
    triplet = GridTriplet(fine, fine - fine_change, fine - fine_change - medium_change)
    extent = max(triplet) - min(triplet)
    if triplet.behaviour == "monotonic":
        # the order and the refinement cancel: r^p is the ratio of the changes
        absolute = triplet.convergence_index(2.0, _FACTOR)
    elif triplet.behaviour == "oscillatory":
        absolute = _OSCILLATION_FACTOR * 0.5 * extent
    else:
        absolute = _FACTOR * extent
    return 100.0 * absolute / abs(fine)


def _grids(row: dict[str, Any]) -> Iterator[Case]:
    case = f"Tables 2 to 4, scale {row['scale']:g}"
    name = row["quantity"]
    numbers = (row["fine"], row["medium_change"], row["fine_change"])
    triplet = GridTriplet(numbers[0], numbers[0] - numbers[2], numbers[0] - numbers[2] - numbers[1])
    copied = row["scale"] == 6
    yield Case(
        KEY,
        case,
        f"convergence of {name}",
        row["behaviour"],
        _BEHAVIOUR[triplet.behaviour],
        expected="OCONV" if copied and name == "sinkage" else None,
        note="the changes of sinkage have opposite signs" if copied and name == "sinkage" else "",
    )
    uncertainty = grid_uncertainty(*numbers)
    if copied:
        yield Case(KEY, case, f"uncertainty of {name} in %", row["uncertainty"], uncertainty, 0.005, note=_COPIED)
        return
    decimals = [(value, _decimals(value)) for value in numbers[1:]]
    spread = spread_of(grid_uncertainty, (numbers[0], 3), *decimals)
    yield Case(
        KEY, case, f"uncertainty of {name} in %", row["uncertainty"], uncertainty, min(spread, 0.1),
        note="half the extent times 1.25" if triplet.behaviour == "oscillatory" else "",
    )  # fmt: skip


def _decimals(value: float) -> int:
    """Decimals of a number that is printed with three significant digits."""
    return 2 - int(f"{value:E}".split("E")[1])


PAPER = Paper(KEY, "ReSquat (2019), scale effects on squat of three container ships", cases)
