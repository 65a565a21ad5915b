"""Yoshimura 1986 (with Ohtsu 2006): Japanese practice, open water and channels through an equivalent speed."""

from __future__ import annotations

from ..core.variables import GRAVITY
from .squat_formula import Ends, Limit, Passage, SquatFormula


def _bow(passage: Passage) -> Ends:
    fullness = passage.block_coefficient * passage.B / passage.L
    closeness = 1.0 / passage.depth_ratio
    speed = passage.speed
    if passage.fairway.kind != "open":
        speed = speed / (1.0 - passage.blockage)
    form = (0.7 + 1.5 * closeness) * fullness + 15.0 * closeness * fullness**3
    return Ends(bow=form * speed**2 / GRAVITY)


FORMULAS = (
    SquatFormula(
        "yoshimura",
        _bow,
        "Yoshimura 1986, Ohtsu 2006 [K]",
        (Limit("CB", 0.55, 0.8), Limit("B/T", 2.5, 5.5), Limit("L/B", 3.7, 6.0), Limit("h/T", low=1.2)),
        ("open", "canal", "trench"),
    ),
)
