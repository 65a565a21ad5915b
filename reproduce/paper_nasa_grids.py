"""Grid convergence of the pressure recovery of an inlet: the example of NASA's tutorial."""

from __future__ import annotations

from collections.abc import Iterator

from ..verify.grid_triplet import GridTriplet
from ..verify.triplet_uncertainty import GCI_SAFETY, gci_roache
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows

KEY = "nasa-grids"


def cases() -> Iterator[Case]:
    """All cases of the tutorial."""
    (row,) = printed_rows("nasa-grids")
    grids = GridTriplet(row["S1"], row["S2"], row["S3"], row["ratio"], row["ratio"])
    fine = 100 * gci_roache(grids).uncertainty / grids.fine
    medium = 100 * GCI_SAFETY * abs(grids.medium_error) / grids.medium
    for quantity, printed, computed, decimals in (
        ("order p", row["p"], grids.order, 6),
        ("extrapolated value", row["extrapolated"], grids.extrapolated, 5),
        ("GCI of grids 1 and 2, %", row["GCI12"], fine, 6),
        ("GCI of grids 2 and 3, %", row["GCI23"], medium, 6),
        ("asymptotic ratio GCI23 / (r^p GCI12)", row["asymptotic_ratio"], grids.asymptotic_ratio, 4),
    ):
        yield Case(KEY, "example", quantity, printed, computed, half_digit(decimals))


PAPER = Paper(KEY, "Slater, NASA Glenn Research Center, examining spatial (grid) convergence", cases)
