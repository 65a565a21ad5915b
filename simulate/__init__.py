"""The reference manoeuvring simulator: models, manoeuvres, indices, criteria, ensembles.

============================  =========================================================================
``ships``, ``fitted_vessel``  named ships; a fitted set as a ship
``vessel``                    hull, propeller, rudder, steering gear, engine
``manoeuvres``                turning circle, zig-zag, ... as programmes; ``named_programmes`` by name
``sailing``                   one trajectory, or the events of many draws
``manoeuvring_results``       several manoeuvres of one ship
``trajectory``, ``events``    a manoeuvre, simulated or measured
``manoeuvre_indices``         indices with their definitions; ``criteria`` of IMO MSC.137(76)
``ensembles``                 uncertainty of the indices, elasticities
``environment``               current, wind, waves
``current``                   a current found in a trial and removed
``trial_validation``          a measured manoeuvre against the simulated one
``stability``, ``bank``       straight-line stability, bank effect with autopilot
============================  =========================================================================

Names are loaded when they are first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "criteria": ("imo_criteria",),
    "current": ("CurrentEstimate", "estimate_current", "remove_current"),
    "ensembles": ("Ensemble", "ensemble"),
    "environment": ("Current", "Environment"),
    "environment_file": ("read_environment",),
    "events": ("Events",),
    "fitted_vessel": ("vessel_from_set",),
    "found_events": ("find_events",),
    "manoeuvre_indices": ("event_indices", "indices"),
    "manoeuvres": (
        "course_keeping",
        "crash_stop",
        "initial_turning",
        "pull_out",
        "reverse_spiral",
        "schedule",
        "spiral",
        "turning",
        "williamson",
        "zigzag",
    ),
    "manoeuvring_results": ("ManoeuvringResults", "sail_manoeuvres"),
    "named_programmes": ("IMO_SET", "named_programme"),
    "programme": ("Programme",),
    "propeller": ("Propeller", "ThrustSurface"),
    "rudder": ("Rudder",),
    "sailing": ("sail", "sail_events"),
    "schedule_file": ("read_schedule",),
    "ships": ("named_ship", "named_ships"),
    "trajectory": ("Trajectory",),
    "trial_validation": ("TrialValidation", "validate_trial"),
    "vessel": ("Engine", "Inertia", "SteeringGear", "Vessel"),
    "wave_drift": ("AnkudinovDrift", "DriftTable", "Waves"),
    "wind": ("Wind", "WindCoefficients", "blendermann_coefficients"),
}
_HOME = {name: f".{module}" for module, names in _HOMES.items() for name in names}

__all__ = sorted(_HOME)


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(_HOME[name], __name__), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return __all__
