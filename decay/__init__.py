"""Free decay in roll, heave and pitch: from a record to damping with its uncertainty.

Names are loaded when they are first used. The functions :func:`.virtual_decay.virtual_decay` and
:func:`.random_decrement.random_decrement` share their names with their modules and are imported from there.
"""

from importlib import import_module
from typing import Any

_HOMES = {
    "amplitude_points": ("AmplitudePoints",),
    "at_sea": ("AtSeaFit", "fit_roll_at_sea"),
    "at_sea_analysis": ("analyse_at_sea", "run_at_sea_campaign"),
    "at_sea_results": ("AtSeaAnalysis", "AtSeaRecord"),
    "beside_memory": ("MemoryComparison", "beside_memory"),
    "compare": ("DEFAULT_METHOD", "METHODS", "DecayComparison", "compare_methods", "fit_decay"),
    "damping_models": ("DampingModel", "damping_model"),
    "decay_analysis": ("analyse_decays", "run_decay_campaign"),
    "decay_campaign": ("DecayCampaign", "load_decay_campaign"),
    "decay_curve": ("DecayCurve", "fit_decay_curve"),
    "decay_input": ("decay_from_table", "read_decay"),
    "decay_record": ("DecayRecord",),
    "decay_results": ("DecayAnalysis", "DecayGroup"),
    "derivation_fit": ("fit_derivation",),
    "discrete_search": ("search_on_grid",),
    "energy_method": ("fit_energy_method",),
    "equation": ("simulate_decay",),
    "equivalent_damping": ("EquivalentDamping", "equivalent_linear"),
    "excited_roll": ("Excitation", "simulate_excited_roll"),
    "exponential_cosine": ("fit_exponential_cosine",),
    "extinction_curve": ("extinction_points", "fit_extinction_curve"),
    "extremes": ("Extremes", "find_extremes"),
    "fit_diagnostics": ("FitDiagnostics", "FittedRun"),
    "fluid_memory": ("memory_state", "simulate_memory_decay"),
    "heave_pitch": ("DecayRatio", "decay_ratio"),
    "ikeda": ("IkedaDamping", "IkedaHull", "ikeda_damping"),
    "ikeda_comparison": ("IkedaComparison", "beside_ikeda"),
    "integration_fit": ("fit_integration",),
    "logarithmic_decrement": ("damping_ratio", "decrement_points", "fit_logarithmic_decrement"),
    "memory_damping": ("MemoryDamping",),
    "memory_fit": ("fit_memory_decay",),
    "model_verdict": ("ModelVerdict", "judge_models", "term_verdicts"),
    "nls_svm": ("fit_nls_svm",),
    "oscillations": ("split_oscillations",),
    "quasi_linear": ("fit_quasi_linear", "quasi_linear_points"),
    "radiation_table": ("RadiationTable", "read_radiation"),
    "random_decrement": ("damping_by_level",),
    "release": ("FreePart", "find_free_part"),
    "restoring_curve": ("RestoringCurve",),
    "retardation": ("impulse_response",),
    "roll_damping": ("RollDamping",),
    "smooth_curve_fit": ("fit_smooth_curve",),
    "transfer_function": ("TransferFunction", "fit_transfer_function", "memory_of_damping"),
    "virtual_decay": ("VirtualDecay", "VirtualRecord", "demo_plan"),
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
