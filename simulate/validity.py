"""Where a manoeuvre leaves the range of the data behind a derivative set."""

from __future__ import annotations

import numpy as np

from ..core.findings import Finding
from ..core.motion import scaled_state
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
