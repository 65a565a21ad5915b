"""Free decay in roll, heave and pitch: from a record to damping with its uncertainty."""

from importlib import import_module
from typing import Any

_HOMES = {
    "amplitude_points": ("AmplitudePoints",),
    "compare": ("DEFAULT_METHOD", "METHODS", "DecayComparison", "compare_methods", "fit_decay"),
    "damping_models": ("DampingModel", "damping_model"),
    "decay_curve": ("DecayCurve", "fit_decay_curve"),
    "decay_input": ("decay_from_table", "read_decay"),
    "decay_record": ("DecayRecord",),
    "derivation_fit": ("fit_derivation",),
    "energy_method": ("fit_energy_method",),
    "equation": ("simulate_decay",),
    "equivalent_damping": ("EquivalentDamping", "equivalent_linear"),
    "exponential_cosine": ("fit_exponential_cosine",),
    "extinction_curve": ("extinction_points", "fit_extinction_curve"),
    "extremes": ("Extremes", "find_extremes"),
    "fit_diagnostics": ("FitDiagnostics", "FittedRun"),
    "integration_fit": ("fit_integration",),
    "logarithmic_decrement": ("damping_ratio", "decrement_points", "fit_logarithmic_decrement"),
    "quasi_linear": ("fit_quasi_linear", "quasi_linear_points"),
    "release": ("FreePart", "find_free_part"),
    "restoring_curve": ("RestoringCurve",),
    "roll_damping": ("RollDamping",),
    "smooth_curve_fit": ("fit_smooth_curve",),
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
