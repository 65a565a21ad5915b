"""Comparison of a recorded motion with the prescribed one, and what a wrong factor means."""

from __future__ import annotations

import math

from ..core.findings import Finding, Severity
from ..core.ship import Ship
from .audit_rules import finding
from .run_types import Run

NEAR = 0.05
"""Relative difference from the test matrix that is no finding."""

_FAR = 0.30
_SPEED_NEAR, _SPEED_FAR = 0.03, 0.20
_LENGTHS = ("x", "y", "v", "vdot", "u", "udot")
_ANGLES = ("psi", "r", "rdot")
_DEGREES = 180.0 / math.pi
_KNOT = 1852.0 / 3600.0


def _is(ratio: float, factor: float, within: float = 0.08) -> bool:
    return abs(math.log(ratio / factor)) < within if ratio > 0 else False


def explain_angle(ratio: float) -> str:
    """What it means that an angle is `ratio` times the expected one; empty when nothing."""
    if _is(ratio, _DEGREES):
        return "degrees were taken for radians"
    if _is(ratio, 1.0 / _DEGREES):
        return "radians were taken for degrees"
    return ""


def explain_length(ratio: float) -> str:
    """What it means that a length or velocity is `ratio` times the expected one; empty when nothing."""
    for factor, unit in ((1000.0, "millimetres"), (100.0, "centimetres"), (10.0, "decimetres")):
        if _is(ratio, factor):
            return f"{unit} were taken for metres"
        if _is(ratio, 1.0 / factor):
            return f"metres were taken for {unit}, or the matrix is in {unit}"
    return ""


def explain_speed(ratio: float, scale: float) -> str:
    """What it means that a speed is `ratio` times the expected one; empty when nothing."""
    root = math.sqrt(scale)
    known = [
        (1.0 / _KNOT, "knots were taken for m/s"),
        (_KNOT, "m/s were taken for knots, or the matrix is in knots"),
        (3.6, "km/h were taken for m/s"),
        (1.0 / 3.6, "m/s were taken for km/h, or the matrix is in km/h"),
        (1000.0, "mm/s were taken for m/s"),
        (0.001, "m/s were taken for mm/s, or the matrix is in mm/s"),
        (100.0, "cm/s were taken for m/s"),
        (0.01, "m/s were taken for cm/s, or the matrix is in cm/s"),
    ]
    if root > 1.2:
        known += [
            (root, f"this is the full-scale speed (root of the scale 1:{scale:g})"),
            (1.0 / root, f"the matrix has the full-scale speed (root of the scale 1:{scale:g})"),
        ]
    return next((text for factor, text in known if _is(ratio, factor, 0.04)), "")


def compare_size(name: str, ratio: float, measured: str, expected: str) -> list[Finding]:
    """Finding for a motion that is `ratio` times what the matrix says."""
    if abs(ratio - 1.0) <= NEAR:
        return []
    text = f"{name} has {measured} where the test matrix gives {expected}: {ratio:.4g} times as much"
    if name in _ANGLES and (why := explain_angle(ratio)):
        return [finding("angle-in-degrees", f"{text}; {why}", place=f"channel {name}")]
    if name in _LENGTHS and (why := explain_length(ratio)):
        return [finding("length-in-millimetres", f"{text}; {why}", place=f"channel {name}")]
    severity: Severity = "error" if abs(ratio - 1.0) > _FAR else "warning"
    return [finding("amplitude-mismatch", text, severity=severity, place=f"channel {name}")]


def compare_speed(name: str, measured: float, expected: float, ship: Ship) -> list[Finding]:
    """Finding for a speed in m/s that is not the prescribed one, with the likely reason."""
    ratio = measured / expected
    if abs(ratio - 1.0) <= _SPEED_NEAR:
        return []
    why = explain_speed(ratio, ship.scale)
    severity: Severity = "error" if why or abs(ratio - 1.0) > _SPEED_FAR else "warning"
    text = f"{name} is {measured:.4g} m/s, {expected:.4g} m/s is expected: {ratio:.4g} times as much"
    return [
        finding("speed-mismatch", f"{text}; {why}" if why else text, severity=severity, place=f"channel {name}")
    ]


def compare_angle(name: str, measured: float, expected: float, sign_rule: str) -> list[Finding]:
    """Finding for a constant angle in rad that is in degrees or has the wrong sign."""
    ratio = measured / expected
    text = f"{name} is {measured:.4g} rad ({math.degrees(measured):.4g} deg), {expected:.4g} rad is expected"
    if why := explain_angle(abs(ratio)):
        return [finding("angle-in-degrees", f"{text}; {why}", place=f"channel {name}")]
    if is_opposite(measured, expected):
        return [finding(sign_rule, text, place=f"channel {name}")]
    return []


def compare_sign(name: str, measured: float, expected: float, unit: str, run: Run) -> list[Finding]:
    """Finding for a sway velocity or yaw rate that is the negative of what it should be."""
    if not is_opposite(measured, expected):
        return []
    text = f"{name} is {measured:.4g} {unit}, {expected:.4g} {unit} is expected"
    if run.drift_angle:
        text += f" at a drift angle of {math.degrees(run.drift_angle):.4g} deg"
    return [finding("drift-sign", text, place=f"channel {name}")]


def is_opposite(measured: float, expected: float) -> bool:
    """True when `measured` is within a quarter of minus `expected`."""
    return abs(measured + expected) < 0.25 * abs(expected)
