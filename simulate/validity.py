"""Where a manoeuvre leaves the range of the data behind a derivative set."""

from __future__ import annotations

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..core.findings import Finding
from ..core.motion import scaled_state
from .linear_motion import linear_motion
from .programme import Programme
from .propeller import ASTERN_SHARE, Propeller
from .vessel import Vessel

SLENDER = (0.25, 8.0)
"""N'v of a plausible set over that of a slender body."""

ADDED = (0.2, 4.0)
"""Added mass in sway of a plausible set over the mass of the ship."""

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


def depends(hull: DerivativeSet, component: str, *variables: str) -> bool:
    """True when a term of one force of a set holds one of some variables.

    Parameters
    ----------
    hull : DerivativeSet
    component : {"X", "Y", "N", "K"}
    *variables : str
        As in a term's ``variables``, e.g. ``"v", "beta"``.
    """
    return any(term.component == component and set(variables) & set(term.variables) for term in hull.terms)


def missing_coupling(vessel: Vessel) -> list[Finding]:
    """A warning for each force that the hull's terms leave out: sway force by yaw rate, yaw moment by drift."""
    if vessel.cross_flow is not None:
        return []
    hull = vessel.hull
    wanted = {
        "sway force does not depend on the yaw rate (Yr, ...)": depends(hull, "Y", "r"),
        "yaw moment does not depend on the drift (Nv, ...)": depends(hull, "N", "v", "beta"),
    }
    return [
        Finding(
            "missing-terms",
            "warning",
            f"set '{hull.name}': the {what}: it is taken as zero",
            cure="measure and fit these terms",
        )
        for what, there in wanted.items()
        if not there
    ]


def doubtful_scale(hull: DerivativeSet) -> list[Finding]:
    """Warnings where a set looks as if it were labelled with another scaling than it was made with.

    Notes
    -----
    The linear yaw moment of drift of a slender body is ``N'v = -2 T/L`` over ``0.5 rho L^2 T U^2`` (Jones 1946);
    those of 40 published sets are 0.6 to 1.9 times this in deep water and up to 4.6 times in shallow water. Numbers
    made with L^2 in the place of L T are wrong by L/T, 15 to 25. Their added mass in sway is 0.75 to 2.5 times the mass
    of the ship: nothing or less is left of it where the label says that the mass is inside and it is not.
    """
    try:
        motion = linear_motion(hull)
    except TowtankError:
        return []
    ship = hull.ship
    found = []
    slender = -2.0 * ship.T / ship.L
    ratio = motion.value("Nv") / slender
    if not SLENDER[0] < ratio < SLENDER[1]:
        found.append(
            f"N'v = {motion.value('Nv'):.3g} is {ratio:.3g} times that of a slender body, {slender:.3g} (L/T is"
            f" {ship.L / ship.T:.3g})"
        )
    mass = ship.displacement_mass
    if mass is not None and not motion.without_inertia:
        scaled = mass / (0.5 * ship.rho * ship.L**2 * ship.T)
        added = -motion.value("Yvdot") / scaled - 1.0
        if not ADDED[0] < added < ADDED[1]:
            found.append(f"the added mass in sway is {added:.2g} of the ship's mass")
    return [
        Finding(
            "doubtful-scale",
            "warning",
            f"set '{hull.name}': {what}: its conventions may be mislabelled",
            cure="check force_scaling (LT or L2) and rigid_body_inertia (inside or outside) of the set",
        )
        for what in found
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
