"""Scores of computed against measured values: relative errors, quality and bias, phasors, z-scores, repeats;
numerical uncertainty of grids and time steps; validation; propagation of input uncertainty.

This room works on plain arrays and names; it knows no ship.
"""

from .chaos_basis import ChaosBasis
from .chaos_quadrature import quadrature
from .complex_error import complex_error, phase_difference, phasor
from .curve_scores import pooled_scores, score_codes, score_curves
from .curve_uncertainty import CurveUncertainty, curve_uncertainty, harmonic_uncertainty, unwrapped_phases
from .derivative_uncertainty import DerivativeUncertainty, derivative_uncertainty
from .derivative_validation import validate_derivatives
from .eca_hoekstra import ManyGridUncertainty, eca_hoekstra
from .grid_triplet import Behaviour, GridTriplet
from .input_distribution import UncertainInput, parse_input
from .input_uncertainty import input_uncertainty, shared_inputs
from .iterative_uncertainty import IterativeUncertainty, iterative_limits, iterative_uncertainty
from .matched_derivatives import MatchedDerivatives, match_derivatives
from .monte_carlo import MonteCarlo, propagate, sample_statistics
from .numerical_uncertainty import (
    METHODS,
    UNCERTAINTY_COLUMNS,
    NumericalUncertainty,
    combined_uncertainty,
    numerical_uncertainty,
    uncertainty_table,
)
from .polynomial_chaos import ChaosExpansion, fit_chaos, project_chaos
from .propagation import Propagation, propagate_samples
from .refinement import refinement_findings, refinement_ratios, spacings_from_cells, spacings_from_ratio
from .repeatability import Repeats, coverage, pooled_repeats
from .sampling import latin_hypercube, random_samples
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
from .sobol import chaos_sobol, sampled_sobol
from .triplet_uncertainty import UncertaintyEstimate
from .validation import (
    VALIDATION_COLUMNS,
    Validation,
    validate_table,
    validate_value,
    validation_frame,
)

__all__ = [
    "METHODS",
    "UNCERTAINTY_COLUMNS",
    "VALIDATION_COLUMNS",
    "Behaviour",
    "ChaosBasis",
    "ChaosExpansion",
    "CurveUncertainty",
    "DerivativeUncertainty",
    "GridTriplet",
    "IterativeUncertainty",
    "ManyGridUncertainty",
    "MatchedDerivatives",
    "MonteCarlo",
    "NumericalUncertainty",
    "Propagation",
    "RelativeErrors",
    "Repeats",
    "Score",
    "UncertainInput",
    "UncertaintyEstimate",
    "Validation",
    "at_measured_points",
    "bias_is_possible",
    "chaos_sobol",
    "combined_uncertainty",
    "complex_error",
    "coverage",
    "curve_uncertainty",
    "derivative_uncertainty",
    "eca_hoekstra",
    "fit_chaos",
    "harmonic_uncertainty",
    "input_uncertainty",
    "iterative_limits",
    "iterative_uncertainty",
    "latin_hypercube",
    "match_derivatives",
    "normalised_rms",
    "numerical_uncertainty",
    "parse_input",
    "phase_difference",
    "phasor",
    "pooled_repeats",
    "pooled_scores",
    "project_chaos",
    "propagate",
    "propagate_samples",
    "quadrature",
    "quality_and_bias",
    "random_samples",
    "refinement_findings",
    "refinement_ratios",
    "relative_errors",
    "rms",
    "sample_statistics",
    "sampled_sobol",
    "score_codes",
    "score_curves",
    "score_table",
    "shared_inputs",
    "spacings_from_cells",
    "spacings_from_ratio",
    "uncertainty_table",
    "unwrapped_phases",
    "validate_derivatives",
    "validate_table",
    "validate_value",
    "validation_frame",
    "z_score",
]
