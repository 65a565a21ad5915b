"""Trial conversion of a fast rescue cruiser (HSVA, MASHCON 2019): depth Froude numbers and three corrections."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.variables import GRAVITY
from ..squat.fairway import width_of_influence
from ..squat.restricted_flow import critical_depth_froude, kreitner
from ..squat.speed_corrections import lackenby_speed_loss
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_rows

KEY = "rescue-cruiser"

_DEPTH = 19.5
_BLOCKAGE = 7.2 / (86.4 * 19.5)


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    for row in printed_rows("rescue-cruiser-froude"):
        for knots in (19, 22, 24):
            yield Case(
                KEY,
                f"Table 2, depth {row['depth']:g} m",
                f"depth Froude number at {knots} kn",
                row[f"kn{knots}"],
                knots * KNOT / math.sqrt(GRAVITY * row["depth"]),
                half_digit(2),
            )
    yield Case(KEY, "contract", "depth Froude number", 0.79, 24 * KNOT / math.sqrt(GRAVITY * 25.0), half_digit(2))
    width = width_of_influence(5.99, 0.43)
    yield Case(KEY, "equation 8", "width in m (recomputed reference)", 86.4, width, half_digit(1))
    yield from _corrections()


def _corrections() -> Iterator[Case]:
    for row in printed_rows("rescue-cruiser-corrections"):
        knots = row["speed"]
        case = f"depth 19.5 m, {knots:g} kn"
        speed = knots * KNOT
        lackenby = 100 * lackenby_speed_loss(speed, _DEPTH, 0.02 * _DEPTH**2, guarded=False)
        gamma = float(kreitner(_BLOCKAGE, speed / math.sqrt(GRAVITY * _DEPTH)).gamma[0])
        for quantity, printed, computed, tolerance in (
            ("own correction in kn", row["own"], 0.0235 * knots - 0.1541, half_digit(4)),
            # 0.04 % in g is 0.01 in the last digit of the per cent
            ("Lackenby in %", row["lackenby"], lackenby, 0.01),
            ("Kreitner's gamma", row["gamma"], gamma, 2e-4),
        ):
            yield Case(KEY, case, f"{quantity} (recomputed reference)", printed, computed, tolerance)
    critical = critical_depth_froude(_BLOCKAGE)[0]
    yield Case(
        KEY, "depth 19.5 m", "critical depth Froude number (recomputed reference)", 0.920, critical, half_digit(3)
    )


PAPER = Paper(KEY, "HSVA (2019), shallow-water speed-trial conversion for a rescue cruiser", cases)
