"""Drag of KVLCC2 in shallow water (MASHCON 2019): refinement, convergence ratio, uncertainty, validation."""

from __future__ import annotations

from collections.abc import Iterator

from ..verify.grid_triplet import GridTriplet
from ..verify.numerical_uncertainty import numerical_uncertainty
from ..verify.refinement import refinement_ratios, spacings_from_cells
from ..verify.validation import validate_value
from .case import Case, Paper, half_digit
from .printed_numbers import printed_by, printed_rows

KEY = "kvlcc2-cemt"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    cells = [row["cells"] for row in printed_rows("cemt-grids")]
    drags = drag_triplet()
    changes = printed_by("cemt-grid-changes", "pair")
    (computed,) = printed_rows("cemt-chain-computed")
    (printed,) = printed_rows("cemt-convergence")
    fine, coarse = refinement_ratios(spacings_from_cells(cells)).tolist()
    yield Case(
        KEY, "Table 2 to Table 3", "ratio, coarse to medium", changes["3 to 2"]["ratio"], coarse, half_digit(2)
    )
    yield Case(KEY, "Table 2 to Table 3", "ratio, medium to fine", changes["2 to 1"]["ratio"], fine, half_digit(2))
    of_medium = 100 * -drags.eps32 / drags.medium
    of_fine = 100 * -drags.eps21 / drags.fine
    yield Case(KEY, "Table 3", "change, coarse to medium, % of the medium grid", 5.2, of_medium, half_digit(1))
    yield Case(KEY, "Table 3", "change, medium to fine, % of the fine grid", -4.8, of_fine, half_digit(1))
    ratio = changes["2 to 1"]["percent"] / changes["3 to 2"]["percent"]
    note = "the paper divides percentages of different grids"
    yield Case(KEY, "text", "convergence ratio of the percentages", printed["R"], ratio, half_digit(2), note=note)
    yield Case(
        KEY,
        "Table 3 (independent computation)",
        "convergence ratio of the drags",
        computed["R"],
        drags.ratio,
        half_digit(3),
    )
    yield Case(KEY, "text", "convergence", "oscillatory convergent", drags.behaviour)
    found = numerical_uncertainty(
        (drags.fine, drags.medium, drags.coarse), spacings_from_cells(cells)[::-1], quantity="drag", unit="N"
    ).preferred
    yield Case(
        KEY,
        "equation 8 (independent computation)",
        "half the range of the drags in N",
        computed["U"],
        found.uncertainty,
        half_digit(2),
    )
    yield Case(KEY, "equation 8 (independent computation)", "method", "data range", found.method)
    yield from _validation(found.uncertainty, printed["U_D"])


def drag_triplet() -> GridTriplet:
    """The drags of case K50, from that of the medium grid and the printed changes."""
    medium = printed_by("cemt-drag", "case")["K50"]["drag"]
    changes = printed_by("cemt-grid-changes", "pair")
    h = spacings_from_cells([row["cells"] for row in printed_rows("cemt-grids")]).tolist()
    values = (medium - changes["3 to 2"]["change"], medium, medium + changes["2 to 1"]["change"])
    return GridTriplet.from_spacings(values, h)


def _validation(numerical: float, measurement: float) -> Iterator[Case]:
    (computed,) = printed_rows("cemt-chain-computed")
    drags = printed_by("cemt-drag", "case")
    for case in ("K50", "K20"):
        where = f"Table 4 (independent computation), {case}"
        drag = drags[case]["drag"]
        measured = drag / (1.0 + drags[case]["error"] / 100.0)
        yield Case(KEY, where, "measured drag in N", computed[f"D_{case}"], measured, half_digit(3))
        verdict = validate_value(drag, measured, U_D=measurement, U_SN=numerical).verdict
        note = "with the measurement's 0.06 N as it is given, at 68 %; at 95 % all the more"
        yield Case(KEY, where, "verdict", "validated", verdict, note=note)


PAPER = Paper(
    KEY,
    "CFD model to identify inland vessels (CEMT I) in shallow water, validated on KVLCC2 (2019), 5th MASHCON, Ostend",
    cases,
)
