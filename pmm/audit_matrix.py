"""Audit of the ship and the test matrix, before anything is read."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..core.conventions import Conventions
from ..core.findings import Finding, Severity
from ..core.ship import Ship
from .audit_rules import finding
from .run_types import Run

_LONGEST_MODEL, _LONGEST_SHIP, _SHORTEST_SHIP = 70.0, 500.0, 15.0
_HIGH_FROUDE, _ABSURD_FROUDE = 0.60, 0.90
_SLOW_SHIP = 2.0
_LIMITS = {
    "drift_angle": math.pi + 0.1,
    "rudder_angle": 1.4,
    "heel": 1.1,
    "yaw_amplitude": math.pi / 2,
}
"""Largest size in rad that each angle of a test matrix can have."""


def audit_matrix(runs: Sequence[Run], ship: Ship, conventions: Conventions) -> list[Finding]:
    """Findings about the ship's particulars, the speeds and the angles of a test matrix.

    Parameters
    ----------
    runs : sequence of Run
    ship : Ship
    conventions : Conventions
        Of the campaign.
    """
    return [*_scale(runs, ship, conventions), *_density(ship), *_angles(runs)]


def _scale(runs: Sequence[Run], ship: Ship, conventions: Conventions) -> list[Finding]:
    found = []
    if ship.L * ship.scale > _LONGEST_SHIP or (ship.scale > 1.5 and ship.L > _LONGEST_MODEL):
        text = (
            f"L = {ship.L:.5g} m at a scale of 1:{ship.scale:.5g} makes a ship of {ship.L * ship.scale:.5g} m: "
            "the length is full scale, the label is a model's"
        )
        found.append(finding("scale-label", text, place="ship"))
    elif ship.scale == 1.0 and ship.L < _SHORTEST_SHIP and conventions.scale == "model":
        text = f"L = {ship.L:.5g} m is a model's length, but ship.scale = 1 says full scale"
        found.append(finding("scale-label", text, severity="warning", place="ship", cure="set ship.scale"))
    elif conventions.scale == "full" and ship.scale > 1.5:
        text = f"conventions.scale is full, but ship.scale = {ship.scale:.5g} is a model's"
        found.append(finding("scale-label", text, severity="warning", place="ship"))
    wet = [run for run in runs if not run.dry and run.speed > 0]
    if not wet:
        return found
    fastest = max(wet, key=lambda run: run.speed)
    froude = ship.froude_number(fastest.speed)
    place = f"run '{fastest.name}'"
    if froude > _HIGH_FROUDE:
        text = f"{fastest.speed:.4g} m/s is a Froude number of {froude:.2f} at L = {ship.L:.5g} m"
        if ship.scale > 1.5:
            text += f"; at model scale it would be {fastest.speed / math.sqrt(ship.scale):.4g} m/s"
        severity: Severity = "error" if froude > _ABSURD_FROUDE else "warning"
        found.append(finding("scale-label", text, severity=severity, place=place))
    # Tables of non-dimensional points carry a nominal speed of 1 m/s and no file.
    elif ship.L > _LONGEST_MODEL and fastest.speed < _SLOW_SHIP and fastest.file is not None:
        text = (
            f"{fastest.speed:.4g} m/s at L = {ship.L:.5g} m is a Froude number of {froude:.3f}: the speed of a "
            "model with the length of the ship"
        )
        found.append(finding("scale-label", text, severity="warning", place=place))
    return found


def _density(ship: Ship) -> list[Finding]:
    """Mass over volume is the density, unless the model floats at another draught than it displaces."""
    if ship.mass is None or ship.volume is None:
        return []
    density = ship.mass / ship.volume
    fresh, salt = 995.0 < density < 1003.0, 1020.0 < density < 1030.0
    if not ((fresh and ship.rho > 1010.0) or (salt and ship.rho < 1010.0)):
        return []
    kind = "fresh" if fresh else "salt"
    text = f"mass over volume is {density:.5g} kg/m3, {kind} water, but ship.rho = {ship.rho:.5g} kg/m3"
    return [finding("density", text, severity="warning", place="ship")]


def _angles(runs: Sequence[Run]) -> list[Finding]:
    for run in runs:
        if found := audit_angles(run):
            return found
    drift = [abs(run.drift_angle) for run in runs if run.drift_angle]
    if len(drift) >= 2 and max(drift) < math.radians(0.6):
        text = f"no drift angle is above {math.degrees(max(drift)):.2g} deg: radians were taken for degrees"
        cure = "set conventions.angle_unit = 'rad'"
        return [finding("angle-in-degrees", text, place="test matrix", cure=cure)]
    return []


def audit_angles(run: Run) -> list[Finding]:
    """Finding when an angle of a run is larger than any captive test has it."""
    for name, limit in _LIMITS.items():
        angle: float = getattr(run, name)
        if not -limit <= angle <= limit:
            text = (
                f"{name} = {angle:.4g} rad is {math.degrees(angle):.4g} deg: degrees of the test matrix were taken for "
                "radians"
            )
            cure = "set conventions.angle_unit = 'deg'"
            return [finding("angle-in-degrees", text, place=f"run '{run.name}'", cure=cure)]
    return []
