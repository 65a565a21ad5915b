"""Least squares of Eca and Hoekstra (2014) on five series of five grids that take every branch of the method.

No paper prints these; they are compared with an independent evaluation of Appendices A and B.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..verify.eca_hoekstra import eca_hoekstra
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows

KEY = "eca-hoekstra"

SPACINGS = (1.0, 1.5, 2.0, 2.5, 3.0)

_DECIMALS = {"p": 5, "phi0": 6, "sigma": 6, "delta": 6, "safety": 2, "U1": 6}


def cases() -> Iterator[Case]:
    """All five series."""
    for row in printed_rows("least-squares-samples"):
        where = f"{row['sample']}, independent computation"
        found = eca_hoekstra([row[f"phi{grid}"] for grid in range(1, 6)], SPACINGS)
        computed = {
            "p": found.observed_order,
            "phi0": found.fit.phi0,
            "sigma": found.fit.sigma,
            "delta": found.data_range,
            "safety": found.safety,
            "U1": float(found.uncertainty[0]),
        }
        yield Case(KEY, where, "form of the fit that counts", row["form"], found.fit.form)
        for quantity, value in computed.items():
            if not math.isnan(row[quantity]):
                yield Case(KEY, where, quantity, row[quantity], value, half_digit(_DECIMALS[quantity]))
        if row["sample"] == "not monotone":
            yield Case(KEY, where, "sigma exceeds the range per grid", "yes", "yes" if found.scattered else "no")
            order = "none" if math.isnan(found.observed_order) else "one"
            yield Case(KEY, where, "order", "none", order)


PAPER = Paper(
    KEY,
    "Eca and Hoekstra (2014), Journal of Computational Physics 262, 104-130: least squares (independent computation)",
    cases,
)
