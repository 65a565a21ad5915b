"""Roemisch 1989: squat at bow and stern by the ratio of speed to the critical speed of the fairway."""

from __future__ import annotations

import numpy as np

from ..core.variables import GRAVITY
from .restricted_flow import critical_depth_froude
from .squat_formula import Ends, Limit, Passage, SquatFormula


def roemisch_critical_speed(passage: Passage) -> float:
    """Critical speed in m/s of open water, a canal, or between them of a trench."""
    open_factor = 0.58 * (passage.depth_ratio * passage.L / passage.B) ** 0.125
    if passage.fairway.kind == "open":
        return float(open_factor * np.sqrt(GRAVITY * passage.depth))
    canal_factor = critical_depth_froude(passage.blockage)[0]
    if passage.fairway.bank_height is None:
        return float(canal_factor * np.sqrt(GRAVITY * passage.fairway.mean_depth))
    share = passage.fairway.bank_height / passage.depth
    factor = open_factor * (1.0 - share) + canal_factor * share
    # Banks take the depth that counts from that of the trench towards the mean of its prolonged section.
    depth = passage.depth - share * (passage.depth - passage.fairway.mean_depth)
    return float(factor * np.sqrt(GRAVITY * depth))


def _ends(passage: Passage) -> Ends:
    return squat_at(passage, roemisch_critical_speed(passage))


def squat_at(passage: Passage, critical_speed: float) -> Ends:
    """Squat for a critical speed in m/s that the caller chooses."""
    ratio = passage.speed / critical_speed
    speed_factor = 8.0 * ratio**2 * ((ratio - 0.5) ** 4 + 0.0625)
    stern = speed_factor * 0.155 * np.sqrt(passage.depth_ratio) * passage.T
    return Ends(bow=stern * (10.0 * passage.block_coefficient * passage.B / passage.L) ** 2, stern=stern)


FORMULAS = (
    SquatFormula(
        "roemisch",
        _ends,
        "Roemisch 1989 [K]; the depth that a trench counts with [?]",
        (Limit("h/T", 1.19, 2.25),),
        ("open", "canal", "trench"),
    ),
)
