"""Norrbin 1986: bow squat in open water at moderate speed, in knots and metres at full scale."""

from __future__ import annotations

from .squat_formula import Ends, Limit, Passage, SquatFormula


def _bow(passage: Passage) -> Ends:
    form = passage.block_coefficient / 15.0 * passage.B / passage.L / passage.depth_ratio
    return Ends(bow=form * passage.knots**2)


FORMULAS = (SquatFormula("norrbin", _bow, "Norrbin 1986 [K]", (Limit("Fh", high=0.4),)),)
