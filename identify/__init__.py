"""Estimators on plain arrays: steady means, harmonics, regressions and their uncertainty. They know no ship.

============================  =========================================================================
``autocorrelation``           means and noise densities of autocorrelated records
``autoregression``            the autoregressive noise model behind them
``steady_window``             averaging window of a towed run
``transient``                 where the start-up transient ends
``stationarity``              trend test, drift that is still to come
``settling``                  has a run settled: verdict, cut, mean with its error
``batch_means``               means of separate stretches, running mean
``cycle_convergence``         periodic runs cycle by cycle, phase average
``divergence``                has a computation blown up
``even_time``                 records with a varying time step
``harmonic_projection``       harmonic basis, factorised once for many channels
``frequency``                 frequency of a motion by variable projection
``harmonics``                 mean and harmonics over whole or broken cycles, phases against the motion
``regression``                least squares with model, HAC, clustered or HC3 covariance
``linear_fit``                its result: statistics, influence of rows and runs, prediction
``normal_equations``          the same over many runs without keeping their rows
``robust``                    Huber
``ridge``                     ridge and truncated singular values, chosen by left-out rows or runs
``lssvm``                     least-squares support vector machine as a scikit-learn regressor
``lssvm_linear``              its linear kernel in the primal: coefficients with covariance
``lssvm_curve``               its smooth curve of uniform samples, fast (``toeplitz_*``)
``constrained``               signs, bounds, equalities, prior
``bootstrap``                 resampling of whole runs
``shared_bias``               errors that all runs share
``model_selection``           AICc, left-out runs, fitting range
``design_optimality``         expected errors of a programme, best next run
``sklearn_face``              all of these regressions as a scikit-learn estimator
============================  =========================================================================

Names are loaded when they are first used, so that a program pays only for what it needs. A function that shares its
name with its module (``steady_window``, ``stationarity``, ``batch_means``, ``cycle_convergence``) is imported from
there.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "autocorrelation": (
        "MeanEstimate",
        "effective_size",
        "integrated_time",
        "long_run_variance",
        "long_run_variances",
        "mean_with_error",
    ),
    "autoregression": ("AutoregressiveNoise", "fit_autoregression"),
    "bootstrap": ("BootstrapResult", "block_bootstrap"),
    "coefficient_table": ("CoefficientTable",),
    "constrained": ("ConstrainedFit", "fit_constrained"),
    "design_optimality": (
        "CandidateRanking",
        "augment_greedily",
        "expected_covariance",
        "expected_standard_errors",
        "rank_candidates",
        "repeats_for_target",
        "run_information",
    ),
    "harmonics": (
        "FrequencyEstimate",
        "HarmonicFit",
        "HarmonicProjector",
        "PhaseSplit",
        "find_frequency",
        "fit_harmonics",
        "harmonic_basis",
        "in_out_of_phase",
        "whole_cycle_window",
    ),
    "model_selection": ("LeftOutScore", "compare_models", "left_out_runs", "range_sensitivity"),
    "linear_fit": ("LinearFit",),
    "lssvm": ("LSSVMRegressor",),
    "lssvm_curve": ("LSSVMCurve", "fit_lssvm_curve"),
    "lssvm_linear": ("LSSVMFit", "fit_lssvm"),
    "normal_equations": ("NormalEquations", "StackedFit", "fit_stacked"),
    "regression": ("fit_linear",),
    "ridge": ("RidgeFit", "fit_ridge", "fit_truncated_svd"),
    "robust": ("RobustFit", "fit_huber"),
    "shared_bias": (
        "BiasSample",
        "bias_contributions",
        "estimator_matrix",
        "monte_carlo_bias",
        "propagate_bias",
    ),
    "sklearn_face": ("TermRegressor",),
    "batch_means": ("BatchMeans", "running_mean"),
    "cycle_convergence": ("CycleConvergence", "PhaseAverage", "phase_average"),
    "divergence": ("divergence_row",),
    "even_time": ("EvenRecord", "even_record"),
    "settling": ("ChannelSettling", "Settling", "natural_frequency", "settle"),
    "stationarity": ("RemainingDrift", "Stationarity", "is_stationary", "remaining_drift"),
    "steady_window": ("WindowChoice",),
    "transient": ("TransientCut", "transient_cut", "transient_ends"),
}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME_OF)


def __getattr__(name: str) -> Any:
    if name not in _HOME_OF:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_HOME_OF[name]}", __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
