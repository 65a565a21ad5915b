"""Scores of computed against measured values: relative errors, quality and bias, z-scores.

This room works on plain arrays and names; it knows no ship.
"""

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
    "Score",
    "at_measured_points",
    "bias_is_possible",
    "normalised_rms",
    "quality_and_bias",
    "relative_errors",
    "rms",
    "score_table",
    "z_score",
]
