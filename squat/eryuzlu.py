"""Eryuzlu et al. 1994 for bulk carriers and tankers with bulbs, and Eryuzlu-Hausser 1978 for loaded tankers."""

from __future__ import annotations

import math

import numpy as np

from ..core.variables import GRAVITY
from .squat_formula import Ends, Limit, Passage, SquatFormula


def _channel_factor(passage: Passage) -> float:
    """Kb: 1 in water wider than 9.61 B, ``3.1 / sqrt(W/B)`` in narrower."""
    if passage.fairway.top_width is None:
        return 1.0
    width = passage.fairway.top_width / passage.B
    return 3.1 / math.sqrt(width) if width < 9.61 else 1.0


def _1994(passage: Passage) -> Ends:
    ratio = passage.depth_ratio
    speed = passage.speed / np.sqrt(GRAVITY * passage.T)
    return Ends(bow=0.298 * passage.depth**2 / passage.T * speed**2.289 * ratio**-2.972 * _channel_factor(passage))


def _1978(passage: Passage) -> Ends:
    return Ends(bow=0.113 * passage.B * passage.depth_ratio**-0.27 * passage.depth_froude**1.8)


FORMULAS = (
    SquatFormula(
        "eryuzlu",
        _1994,
        "Eryuzlu, Cao and D'Agnolo 1994 [K]",
        (Limit("CB", low=0.8), Limit("B/T", 2.4, 2.9), Limit("L/B", 6.7, 6.8), Limit("h/T", 1.1, 2.5)),
        ("open", "canal", "trench"),
    ),
    SquatFormula("eryuzlu-hausser", _1978, "Eryuzlu and Hausser 1978 [K]", (Limit("h/T", 1.08, 2.75),)),
)
