"""Grid and time-step convergence of DTC in calm water and head waves (MASHCON 2019), Tables 2 to 5.

The paper computed its tables from values with more digits than it prints. What the print allows is the interval
that the results cover when each of the three values moves within its rounding.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import product
from typing import Any

from ..verify.grid_triplet import GridTriplet
from ..verify.triplet_uncertainty import gci_celik
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows

KEY = "dtc-gci"

RATIO = math.sqrt(2.0)

_PARTS: tuple[tuple[str, str, int, Callable[[GridTriplet], float]], ...] = (
    ("R", "R", 3, lambda grids: grids.ratio),
    ("P", "order", 3, lambda grids: grids.order),
    ("S_ext", "extrapolated value", 4, lambda grids: grids.extrapolated),
    ("e_a", "e_a, %", 2, lambda grids: 100 * grids.relative_change),
    ("e_ext", "e_ext, %", 2, lambda grids: 100 * grids.relative_extrapolation),
    ("GCI", "GCI, %", 2, lambda grids: 100 * gci_celik(grids).uncertainty / abs(grids.fine)),
)

WIDE = 0.2
"""Share of a printed number beyond which its interval says no more than that the number lies inside."""


def cases() -> Iterator[Case]:
    """All cases of the four tables."""
    for row in printed_rows("dtc-waves-convergence"):
        yield from _row(row)
    yield from _shared_grid()


def _row(row: dict[str, Any]) -> Iterator[Case]:
    where = f"Tables 2 to 5, {row['study']}, {row['quantity']}"
    values = (row["S1"], row["S2"], row["S3"])
    grids = _triplet(values)
    kind = grids.behaviour.partition(" ")[0].replace("monotone", "monotonic")
    yield Case(KEY, where, "convergence", row["convergence"], kind)
    decimals = 5 if (row["study"], row["quantity"]) == ("time calm", "z0/L") else 4
    half = half_digit(decimals)
    corners = [
        _triplet([value + sign * half for value, sign in zip(values, signs, strict=True)])
        for signs in product((-1, 0, 1), repeat=3)
    ]
    for column, name, places, function in _PARTS:
        printed, computed = row[column], function(grids)
        reached = [function(corner) for corner in corners]
        # where a corner does not converge, its result has no bound
        bounded = not any(math.isnan(value) for value in reached)
        known = [value for value in reached if not math.isnan(value)]
        low, high = min(known) - half_digit(places), max(known) + half_digit(places)
        reach = max(high - computed, computed - low)
        if bounded and reach <= WIDE * abs(printed):
            yield Case(KEY, where, name, printed, computed, reach)
            continue
        said = "inside" if low <= printed and (printed <= high or not bounded) else "outside"
        upper = f"{high:.3g}" if bounded else "any number"
        note = f"printed {printed:g}, from the printed values {computed:.3g}; rounding allows {low:.3g} to {upper}"
        yield Case(KEY, where, f"{name}, within the rounding of the values", "inside", said, note=note)


def _triplet(values: Sequence[float]) -> GridTriplet:
    fine, medium, coarse = values
    return GridTriplet(fine, medium, coarse, RATIO, RATIO)


def _shared_grid() -> Iterator[Case]:
    """The smallest time step is used on all grids, and the medium grid for all time steps: one value is in both."""
    rows = {(row["study"], row["quantity"]): row for row in printed_rows("dtc-waves-convergence")}
    for (study, quantity), row in rows.items():
        if study.startswith("grid"):
            other = rows[study.replace("grid", "time"), quantity]
            yield Case(
                KEY,
                "Tables 2 to 5, medium grid against smallest time step",
                f"{quantity}, {study.removeprefix('grid ')}",
                row["S2"],
                other["S1"],
                half_digit(4),
            )


PAPER = Paper(
    KEY,
    "RANS simulation of DTC in shallow calm water and head waves (2019), 5th MASHCON, Ostend, pp. 395-409: "
    "grid and time-step convergence",
    cases,
)
