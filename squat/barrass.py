"""Barrass: the second formula (1979) and the third (2002), with the width of influence in open water.

Fitted in knots and metres at full scale.
"""

from __future__ import annotations

import numpy as np

from .squat_formula import Ends, Limit, Passage, SquatFormula


def _second(passage: Passage) -> Ends:
    blockage = passage.box_blockage
    return Ends(
        largest=passage.block_coefficient
        / 30.0
        * (blockage / (1.0 - blockage)) ** (2.0 / 3.0)
        * passage.knots**2.08
    )


def _third(passage: Passage) -> Ends:
    block = passage.block_coefficient
    # Below a blockage of 0.10 the ship is in open water for this formula, above 0.265 in a narrow canal.
    factor = float(np.clip(5.74 * passage.box_blockage**0.76, 1.0, 2.0))
    largest = factor * block * passage.knots**2 / 100.0
    other = largest * (1.0 - 40.0 * (0.7 - block) ** 2)
    if block > 0.7:
        return Ends(bow=largest, stern=other)
    return Ends(bow=other, stern=largest) if block < 0.7 else Ends(bow=largest, stern=largest)


FORMULAS = (
    SquatFormula(
        "barrass-2",
        _second,
        "Barrass 1979 [S]",
        (Limit("CB", 0.5, 0.9), Limit("h/T", 1.1, 1.5)),
        ("open", "canal", "trench"),
    ),
    SquatFormula(
        "barrass-3",
        _third,
        "Barrass 2002; variant of the Finnish calculator seen, this form [K]",
        (Limit("CB", 0.5, 0.9), Limit("h/T", 1.1, 1.5)),
        ("open", "canal", "trench"),
    ),
)
