"""Two triplets by correction factor, factor of safety and grid convergence index.

No paper prints these; they are compared with an independent evaluation of the formulas.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..verify.grid_triplet import GridTriplet
from ..verify.triplet_uncertainty import correction_factor, factor_of_safety, gci_celik
from .case import Case, Paper
from .printed_numbers import printed_rows

KEY = "grid-triplets"

_HALF_DIGIT = {"error": 5e-9, "CF": 5e-9, "CF_corrected": 5e-9, "FS": 5e-9, "GCI": 5e-9, "extrapolated": 5e-9}
"""Half of the last digit given; six decimals where none is named."""


def cases() -> Iterator[Case]:
    """Both triplets."""
    for row in printed_rows("grid-triplet-samples"):
        grids = GridTriplet(row["S1"], row["S2"], row["S3"], row["ratio"], row["ratio"])
        computed = {
            "R": grids.ratio,
            "p": grids.order,
            "error": grids.error,
            "C": grids.correction_factor(),
            "CF": correction_factor(grids).uncertainty,
            "CF_corrected": correction_factor(grids, corrected=True).uncertainty,
            "FS": factor_of_safety(grids).uncertainty,
            "GCI": gci_celik(grids).uncertainty,
            "extrapolated": grids.extrapolated,
        }
        for quantity, value in computed.items():
            if not math.isnan(row[quantity]):
                tolerance = _HALF_DIGIT.get(quantity, 5e-7)
                yield Case(
                    KEY,
                    f"triplet {row['triplet']}, independent computation",
                    quantity,
                    row[quantity],
                    value,
                    tolerance,
                )


PAPER = Paper(
    KEY,
    "Wilson, Shao and Stern (2004), Xing and Stern (2010): two triplets by every method (independent computation)",
    cases,
)
