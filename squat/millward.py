"""Millward 1990: the largest squat in open water from model tests of many hulls."""

from __future__ import annotations

from .squat_formula import Ends, Passage, SquatFormula


def _bow(passage: Passage) -> Ends:
    froude = passage.depth_froude
    form = 15.0 * passage.block_coefficient * passage.B / passage.L - 0.55
    return Ends(bow=0.01 * passage.L * form * froude**2 / (1.0 - 0.9 * froude))


FORMULAS = (SquatFormula("millward", _bow, "Millward 1990 [S]", ()),)
