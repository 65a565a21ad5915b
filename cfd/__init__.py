"""CFD campaigns: from solver logs to settled loads, sweeps of cases, and derivatives with numerical uncertainty.

====================  =================================================================================
``case_loads``        a solver's forces in home axes at midship
``case_sweep``        a folder of cases as one campaign table
``settled_loads``     means and harmonics with errors and a verdict; points of a captive campaign
``grid_study``        a sweep on several grids: derivatives with numerical uncertainty, beside an experiment
``virtual_sweep``     a virtual sweep with a known truth, written as solver files
``shipped_sweep``     the one that ``towtank demo cfd`` runs
====================  =================================================================================

Names are loaded when they are first used, so that a program pays only for what it needs. The functions
:func:`.case_loads.case_loads` and :func:`.grid_study.grid_study` share their names with their modules and are imported
from there.
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

_HOMES = {
    "CaseLoads": "case_loads",
    "CaseSweep": "case_sweep",
    "GridStudy": "grid_study",
    "LoadChoices": "case_loads",
    "SettledCase": "settled_loads",
    "SweepCase": "case_sweep",
    "find_cases": "case_sweep",
    "points_table": "settled_loads",
    "run_virtual_sweep": "shipped_sweep",
    "settle_case": "settled_loads",
    "settle_sweep": "settled_loads",
    "settled_table": "settled_loads",
    "write_virtual_sweep": "virtual_sweep",
}

__all__ = sorted(_HOMES)


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(f".{_HOMES[name]}", __name__), name)
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOMES})
