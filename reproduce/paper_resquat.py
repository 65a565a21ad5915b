"""Scale effects on squat (ReSquat, MASHCON 2019): uncertainty of three grids, scaling error, revolutions, clearance."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from ..core.variables import GRAVITY
from ..squat.scaling_error import ScalingErrors, scaling_errors
from ..squat.squat_curve import SquatCurve
from ..verify.grid_triplet import GridTriplet
from ..verify.triplet_uncertainty import data_range, gci_roache
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows
from .rounding import spread_of

KEY = "resquat"

_FACTOR = 3.0
_OSCILLATION_FACTOR = 1.25
_BEHAVIOUR = {
    "monotone convergent": "CONV",
    "oscillatory convergent": "OCONV",
    "monotone divergent": "DIV",
    "oscillatory divergent": "DIV",
}
_COPIED = "the uncertainties of scale 6 repeat those of full scale"

_LENGTH, _DRAUGHT, _DEPTH_RATIO, _FROUDE, _SCALE = 347.0, 16.0, 1.25, 0.12, 40.0
"""PPM52 and the condition of its grids."""


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
    yield from _scaling()
    for row in printed_rows("resquat-validation"):
        where = f"Table 2, validation of {row['quantity']}"
        measured = math.sqrt(row["validation"] ** 2 - row["grid"] ** 2)
        reference = {"trim": 14.85, "sinkage": 7.48}[row["quantity"]]
        name = "uncertainty of the measurement that it implies, % (recomputed reference)"
        yield Case(KEY, where, name, reference, measured, half_digit(2))
        yield Case(KEY, where, "validated", "yes", "yes" if row["error"] < row["validation"] else "no")
    yield Case(
        KEY, "text", "0.19 m of the clearance at h/T 1.15, %", 8.0, 100 * 0.19 / (0.15 * 16.0), half_digit(0)
    )


def _fine_grid(scale: float) -> SquatCurve:
    """The one computed point of PPM52 on the fine grid, at a scale, in home signs."""
    import pandas as pd

    rows = {row["quantity"]: row["fine"] for row in printed_rows("resquat-grids") if row["scale"] == scale}
    trim = math.sin(math.radians(rows["trim"]))
    middle, half = -rows["sinkage"], 0.5 * _LENGTH / scale
    point = {
        "speed": _FROUDE * math.sqrt(GRAVITY * _LENGTH / scale),
        "sinkage_cog": middle,
        "sinkage_bow": middle + half * trim,
        "sinkage_stern": middle - half * trim,
        "trim": trim,
    }
    draught = _DRAUGHT / scale
    return SquatCurve(pd.DataFrame([point]), _DEPTH_RATIO * draught, draught, "PPM52", scale)


def fine_grid_errors() -> ScalingErrors:
    """Scaling errors between the model 1:40 and the ship at the condition of the grids."""
    return scaling_errors(_fine_grid(_SCALE), _fine_grid(1.0))


def _scaling() -> Iterator[Case]:
    ship = _fine_grid(1.0).points.iloc[0]
    where = "Table 3, fine grid at full scale"
    for end, printed in (("bow", -1.326), ("stern", -0.998)):
        name = f"sinkage of the {end} in m, negative down (recomputed reference)"
        yield Case(KEY, where, name, printed, -float(ship[f"sinkage_{end}"]), half_digit(3))
    found = fine_grid_errors()
    rows = found.frame.set_index("quantity").to_dict("index")
    where = "equation 1, Tables 2 and 3"
    error = float(rows["sinkage_cog"]["error_as_printed"])
    # the model's sinkage is printed with two digits
    name = "scaling error of the sinkage in m (recomputed reference)"
    yield Case(KEY, where, name, -0.042, error, half_digit(3))
    yield Case(KEY, "text", "scaling error of the sinkage below 15 cm", "yes", _yes(abs(error) < 0.15))
    trim = math.degrees(float(rows["trim"]["error"]))
    yield Case(KEY, "text", "scaling error of the trim below 0.02 deg", "yes", _yes(abs(trim) < 0.02))
    percent = abs(float(rows["sinkage_cog"]["percent"]))
    yield Case(KEY, "text", "scaling error below 10 % of the sinkage", "yes", _yes(percent < 10.0))


def _yes(fact: bool) -> str:
    return "yes" if fact else "no"


def grid_uncertainty(fine: float, medium_change: float, fine_change: float) -> float:
    """Uncertainty in % of the fine grid's result, by the paper's rule for each kind of convergence.

    Parameters
    ----------
    fine : float
        Result on the fine grid.
    medium_change, fine_change : float
        Coarse to medium and medium to fine.
    """
    triplet = _triplet(fine, medium_change, fine_change)
    if triplet.behaviour == "monotone convergent":
        # the order and the refinement cancel: r^p is the ratio of the changes
        absolute = gci_roache(triplet, _FACTOR).uncertainty
    else:
        values = (triplet.fine, triplet.medium, triplet.coarse)
        absolute = data_range(values, triplet.behaviour).uncertainty
        if triplet.behaviour == "oscillatory convergent":
            absolute *= _OSCILLATION_FACTOR
    return 100.0 * absolute / abs(fine)


def _triplet(fine: float, medium_change: float, fine_change: float) -> GridTriplet:
    return GridTriplet(fine, fine - fine_change, fine - fine_change - medium_change)


def _grids(row: dict[str, Any]) -> Iterator[Case]:
    case = f"Tables 2 to 4, scale {row['scale']:g}"
    name = row["quantity"]
    numbers = (row["fine"], row["medium_change"], row["fine_change"])
    triplet = _triplet(*numbers)
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
        note="half the extent times 1.25" if triplet.behaviour == "oscillatory convergent" else "",
    )  # fmt: skip


def _decimals(value: float) -> int:
    """Decimals of a number that is printed with three significant digits."""
    return 2 - int(f"{value:E}".split("E")[1])


PAPER = Paper(KEY, "ReSquat (2019), scale effects on squat of three container ships", cases)
