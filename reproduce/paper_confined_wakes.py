"""Wakes and drag of inland vessels in confined water (Pprime, MASHCON 2019): critical speeds and Froude numbers."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.variables import GRAVITY
from ..squat.fairway import blockage
from ..squat.restricted_flow import critical_depth_froude
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows

KEY = "confined-wakes"

_DEPTH = 0.103
_LENGTH = 1.20


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    ratio = blockage(0.18 * 0.075, 1.50 * _DEPTH)
    lower, upper = critical_depth_froude(ratio)
    yield Case(KEY, "data", "blockage", 0.0874, ratio, half_digit(4))
    yield Case(
        KEY,
        "equation 3",
        "lower critical depth Froude number",
        0.64,
        lower,
        half_digit(2),
        expected=0.647,
        note="0.6467: cut off after two decimals, not rounded",
    )
    yield Case(KEY, "equation 3", "upper critical depth Froude number", 1.37, upper, half_digit(2))
    for exponent, printed in ((2, 0.67), (8, 0.89)):
        # y = B/2 (1 - (2x/L)^n): the mean over half the length
        block = exponent / (exponent + 1.0)
        yield Case(KEY, "equation 1", f"block coefficient for n = {exponent}", printed, block, half_digit(2))
    for row in printed_rows("confined-wakes-speeds"):
        for name, scale in (("depth_froude", _DEPTH), ("length_froude", _LENGTH)):
            yield Case(
                KEY,
                f"runs at {row['speed']:.2f} m/s",
                f"{name.replace('_', ' ')} number (recomputed reference)",
                row[name],
                row["speed"] / math.sqrt(GRAVITY * scale),
                half_digit(3),
            )


PAPER = Paper(KEY, "Caplier et al. (2019), wakes and drag forces of inland vessels in confined water", cases)
