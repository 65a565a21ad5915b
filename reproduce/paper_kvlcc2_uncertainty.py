"""KVLCC2: how uncertain turning circle and zig-zag are when 31 parameters scatter by 5 per cent.

No paper prints this; it is compared with an independent calculation of the same model, with fixed time steps and
20 000 draws. The parameters are the 17 hull derivatives, the 3 added masses, wake fraction and thrust deduction, and
of the rudder tR, aH, xH, the two gammaR, lR, eps, kappa and f_alpha. All draws have the propeller rate of the
unperturbed vessel.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache

from ..simulate.ensembles import Ensemble, ensemble
from ..simulate.packing import pack
from ..simulate.parameter_scatter import HULL, MMG_COEFFICIENTS
from ..simulate.self_propulsion import self_propulsion_rates
from ..simulate.ships import named_ship
from .case import Case, Paper
from .printed_numbers import printed_rows

KEY = "kvlcc2-uncertainty"

DRAWS, THEIR_DRAWS = 3000, 20_000

PERCENT = 5.0

STEP_ERROR = {"L": 0.004, "deg": 0.02}
"""Share by which steps of fixed size shift an index: the rudder is reversed up to one step late."""

ELASTICITY_ERROR = 0.07
"""Share by which elasticities depend on the size of the change, of which nothing is known."""

_SD_OF_QUANTILE = {"p05": 2.0, "p95": 2.6}
"""Standard error of a quantile times the root of the number of draws, in standard deviations of the index: 2.11 on
either side of a normal distribution; here the upper tail is longer."""


def cases() -> Iterator[Case]:
    """All cases."""
    found = uncertain_kvlcc2()
    statistics = found.indices.set_index(["manoeuvre", "index"])
    noise = math.sqrt(1.0 / DRAWS + 1.0 / THEIR_DRAWS)
    case = f"independent computation, {PERCENT:g} % of {len(found.scatter.names)} parameters"
    for row in printed_rows("kvlcc2-uncertainty-computed"):
        place = (row["manoeuvre"], row["index"])
        unit = str(statistics.loc[place, "unit"])
        # three standard errors of both calculations
        sampling = {
            "mean": 3.0 * row["sd"] * noise,
            "sd": 3.0 * row["sd"] * noise,
            **{name: 3.0 * factor * row["sd"] * noise for name, factor in _SD_OF_QUANTILE.items()},
        }
        for name, error in sampling.items():
            if math.isnan(row[name]):
                continue
            yield Case(
                KEY,
                case,
                f"{name} of the {row['index']}, {row['manoeuvre']}, {unit}",
                row[name],
                float(statistics.loc[place, name]),
                error + STEP_ERROR[unit] * row[name],
            )
    elasticities = found.elasticities.set_index(["manoeuvre", "index", "parameter"])["elasticity"]
    for row in printed_rows("kvlcc2-elasticities-computed"):
        yield Case(
            KEY,
            case,
            f"elasticity of the {row['index']}, {row['manoeuvre']}, by {row['parameter']}",
            row["elasticity"],
            float(elasticities[row["manoeuvre"], row["index"], row["parameter"]]),
            ELASTICITY_ERROR * abs(row["elasticity"]),
        )


@cache
def uncertain_kvlcc2() -> Ensemble:
    """The ensemble behind the cases."""
    vessel = named_ship("kvlcc2")
    rate = float(self_propulsion_rates(pack(vessel), vessel.speed)[0])
    return ensemble(
        vessel.but(rate=rate),
        ["turning 35", "zigzag 10/10"],
        n=DRAWS,
        percent=PERCENT,
        names=(HULL, *MMG_COEFFICIENTS),
    )


PAPER = Paper(
    KEY,
    "KVLCC2 with the set of Yasukawa and Yoshimura (2015), 31 uncertain parameters (independent computation)",
    cases,
)
