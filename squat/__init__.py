"""Squat: from sinkage and trim records to squat curves, scores of predictions, and empirical formulas.

=====================================  ==================================================================
``sinkage_layout``, ``sinkage_record``  channels, and a run as sinkage and trim over time
``steady_squat``, ``speed_steps``       means over a window; ``squat_in_waves`` with harmonics
``wave_response``                       motions over the wave that a gauge saw
``squat_curve``, ``repeated_runs``      sinkage over speed with bands; repeats pooled
``squat_campaign``, ``squat_analysis``  a campaign file, and all that it yields
``rtk_antennas``, ``full_scale``        a voyage: tide, density, static reference, steady and unsteady squat
``prediction``, ``forecast``            every formula with its limits; the clearance that is left
``named_corrections``                   walls and bottom taken out by name
``curve_table``, ``code_scores``        computations against a measured curve
=====================================  ==================================================================

Names are loaded when they are first used. The functions :func:`.forecast.forecast`, :func:`.speed_steps.speed_steps`
and :func:`.static_reference.static_reference` share their names with their modules and are imported from there.
"""

from importlib import import_module
from typing import Any

_HOMES = {
    "code_scores": ("CodeScores", "score_tables"),
    "curve_table": ("CurveTable", "read_curve_table"),
    "fairway": ("Fairway", "blockage", "section_ratio", "width_of_influence"),
    "forecast": ("SquatForecast",),
    "formula_comparison": ("FormulaComparison", "beside_formulas"),
    "full_scale": ("FullScaleSquat", "reduce_full_scale"),
    "head_waves": ("HeadWave", "met_wave", "phase_at", "wave_number", "wave_of_encounter"),
    "named_corrections": ("CORRECTIONS", "ShipInWater", "correct_curve", "correct_record"),
    "noise_filter": ("FILTERS", "filter_record"),
    "prediction": ("FORMULAS", "SquatPrediction", "predict"),
    "repeated_runs": ("RepeatedRuns", "pool_repeats"),
    "restricted_flow": ("critical_depth_froude", "kreitner", "level_drop", "raven_overspeed"),
    "rtk_antennas": ("Antenna", "AntennaLayout", "read_antennas"),
    "scaling_error": ("ScalingErrors", "scale_allowance", "scaling_errors"),
    "shipped_squat": ("write_squat_campaign",),
    "sinkage_layout": ("SinkageLayout",),
    "sinkage_record": ("SinkageRecord", "read_sinkage"),
    "speed_steps": ("reduce_speed_steps",),
    "squat_analysis": ("SquatAnalysis", "run_squat_campaign"),
    "squat_campaign": ("SquatCampaign", "load_squat_campaign"),
    "squat_curve": ("CurveFit", "SquatCurve"),
    "squat_formula": ("SquatFormula",),
    "squat_in_waves": ("SquatInWaves", "reduce_in_waves"),
    "static_reference": ("StaticReference",),
    "steady_squat": ("SteadySquat", "reduce_steady"),
    "tabled_curve": ("TabledCurve", "read_squat_curve"),
    "tide": ("TideTable", "read_water_level"),
    "wave_response": ("WaveResponses", "wave_responses"),
    "under_keel": ("DynamicClearance", "dynamic_clearance", "gross_clearance"),
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
