"""ICORELS 1980 in its three coefficient forms, and Huuska/Guliev 1976 for canals and trenches.

All have the form ``Cs volume/L^2 Fh^2 / sqrt(1 - Fh^2)``.
"""

from __future__ import annotations

import numpy as np

from .squat_formula import Ends, Limit, Passage, SquatFormula, slender_body_factor

_TRENCH_POLYNOMIALS = (
    (0.3, (0.46, 15.85, 124.06, -380.04)),
    (0.5, (0.21, 28.2, -53.17, 87.97)),
    (0.7, (1.1, -5.55, 167.76, -417.72)),
    (1.0, (0.82, 6.11, 16.9, -70.86)),
)
"""Up to which bank height over depth, and the polynomial of the divisor of the blockage."""

_HULLS = (Limit("CB", 0.6, 0.8), Limit("B/T", 2.19, 3.5), Limit("L/B", 5.5, 8.5), Limit("h/T", 1.1, 2.0))


def block_dependent_coefficient(block_coefficient: float) -> float:
    """Cs of ICORELS by fullness: 1.7 below 0.7, 2.0 from there to 0.8, 2.4 at and above."""
    if block_coefficient < 0.7:
        return 1.7
    return 2.0 if block_coefficient < 0.8 else 2.4


def _by_fullness(passage: Passage) -> Ends:
    return Ends(bow=block_dependent_coefficient(passage.block_coefficient) * slender_body_factor(passage))


def _finnish(passage: Passage) -> Ends:
    return Ends(bow=2.4 * slender_body_factor(passage))


def _original(passage: Passage) -> Ends:
    trim = passage.volume / passage.L**3 * passage.depth_froude**2 / np.sqrt(1.0 - passage.depth_froude**2)
    return Ends(bow=1.46 * slender_body_factor(passage) + 0.5 * passage.L * np.sin(trim))


def huuska_channel_factor(passage: Passage) -> float:
    """Ks: 1 in open water, growing with the blockage in canals and trenches."""
    fairway = passage.fairway
    if fairway.kind == "open":
        return 1.0
    blockage = passage.blockage
    divisor = 1.0
    if fairway.bank_height is not None:
        share = fairway.bank_height / fairway.depth
        coefficients = next(values for most, values in _TRENCH_POLYNOMIALS if share <= most)
        divisor = float(np.polynomial.polynomial.polyval(blockage, coefficients))
    corrected = blockage / divisor
    return 7.45 * corrected + 0.76 if corrected > 0.03 else 1.0


def _huuska(passage: Passage) -> Ends:
    return Ends(bow=2.4 * huuska_channel_factor(passage) * slender_body_factor(passage))


FORMULAS = (
    SquatFormula(
        "icorels",
        _by_fullness,
        "ICORELS 1980 with Cs 1.7, 2.0 or 2.4 by CB [K]",
        (Limit("Fh", high=0.7),),
    ),
    SquatFormula(
        "icorels-2.4", _finnish, "ICORELS 1980 with Cs 2.4, Finnish practice [K]", (Limit("Fh", high=0.7),)
    ),
    SquatFormula(
        "tuck-hooft",
        _original,
        "Tuck 1966, Hooft 1974: 1.46 for sinkage, 1.0 for trim; the ICORELS form of 1980 [K]",
        (Limit("Fh", high=0.7),),
    ),
    SquatFormula(
        "huuska",
        _huuska,
        "Huuska 1976 after Guliev 1971; trench polynomials [S] of the Finnish squat calculator, the rest [K]",
        (*_HULLS, Limit("Fh", high=0.7)),
        ("open", "canal", "trench"),
    ),
)
