"""Where a manoeuvre leaves the range of the data behind a derivative set."""

from __future__ import annotations

import numpy as np

from ..core.findings import Finding
from ..core.motion import scaled_state
from .programme import Programme
from .propeller import ASTERN_SHARE, Propeller
from .vessel import Vessel

_COLUMNS = {"surge": 4, "v": 5, "r": 6, "phi": 7, "p": 8, "delta": 9}


def left_ranges(vessel: Vessel, frame: np.ndarray) -> list[Finding]:
    """A warning for each variable that leaves the validity range of the hull's derivatives.

    Parameters
    ----------
    vessel : Vessel
    frame : ndarray, shape (n, 11)
        Samples of the kernel: time and state.
    """
    hull = vessel.hull
    if not hull.validity:
        return []
    conventions = hull.conventions
    if conventions.force_scaling not in ("LT", "L2"):
        conventions = conventions.but(force_scaling="LT")
    motion = {name: frame[:, column] for name, column in _COLUMNS.items()}
    state, _ = scaled_state(motion, vessel.ship, conventions, vessel.speed)
    ranges = {
        name: (float(np.min(values)), float(np.max(values)))
        for name, values in state.items()
        if name in hull.validity
    }
    return [
        Finding(
            "extrapolation",
            "warning",
            f"set '{hull.name}': {message}",
            cure="measure in that range, or read the result as an extrapolation",
        )
        for message in hull.extrapolates(**ranges)
    ]


def assumed_astern(vessel: Vessel, programme: Programme) -> list[Finding]:
    """A warning when the propeller is ordered astern and its thrust there is assumed."""
    propeller = vessel.propeller
    if not (programme.goes_astern() and isinstance(propeller, Propeller) and propeller.astern_KT is None):
        return []
    return [
        Finding(
            "assumption",
            "warning",
            f"'{vessel.name}': the thrust astern is assumed to be {ASTERN_SHARE:g} of the bollard thrust ahead at the"
            f" same rate, KT = -{propeller.thrust_astern:.4g}",
            cure="give the propeller's astern_KT from its four-quadrant diagram",
        )
    ]
