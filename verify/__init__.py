"""Scores of computed against measured values: relative errors, quality and bias, phasors, z-scores, repeats.

This room works on plain arrays and names; it knows no ship.
"""

from .complex_error import complex_error, phase_difference, phasor
from .curve_scores import pooled_scores, score_codes, score_curves
from .repeatability import Repeats, coverage, pooled_repeats
from .scores import (
    RelativeErrors,
    Score,
    at_measured_points,
    bias_is_possible,
    normalised_rms,
    quality_and_bias,
    relative_errors,
    rms,
    score_table,
    z_score,
)

__all__ = [
    "RelativeErrors",
    "Repeats",
    "Score",
    "at_measured_points",
    "bias_is_possible",
    "complex_error",
    "coverage",
    "normalised_rms",
    "phase_difference",
    "phasor",
    "pooled_repeats",
    "pooled_scores",
    "quality_and_bias",
    "relative_errors",
    "rms",
    "score_codes",
    "score_curves",
    "score_table",
    "z_score",
]
