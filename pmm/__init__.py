"""Captive tests: campaign files, run types, exact kinematics, reduction, hull fits, virtual campaigns."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .campaign import Campaign
    from .campaign_result import CampaignResult
    from .planar_motion import PlanarMotion, prescribed_motion
    from .run_types import RUN_TYPES, Run

_HOME = {
    "Campaign": ".campaign",
    "CampaignResult": ".campaign_result",
    "PlanarMotion": ".planar_motion",
    "prescribed_motion": ".planar_motion",
    "RUN_TYPES": ".run_types",
    "Run": ".run_types",
}

__all__ = ["RUN_TYPES", "Campaign", "CampaignResult", "PlanarMotion", "Run", "prescribed_motion"]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_HOME[name], __name__), name)
