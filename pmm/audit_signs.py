"""Audit of signs and exchanged forces across the runs of a campaign."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from ..core.findings import Finding
from ..core.ship import Ship
from .audit_rules import finding
from .linear_slopes import LinearSlopes, RunSummary, drift_runs, scaled_force

_CLEAR = 0.02
"""Smallest slope, over 0.5 rho L T U^2, whose sign says something."""

_PUSHES = 0.002


def audit_signs(slopes: LinearSlopes) -> list[Finding]:
    """Findings about the signs of forces and drift.

    A hull resists: X is negative, Y opposes sway (Yv < 0) and sway acceleration (Yvdot < 0), N opposes yaw. Which
    of these fail together tells whose sign is wrong.
    """
    thrust = slopes.X0 is not None and slopes.X0 > _PUSHES
    drift_Y, drift_N = _wrong(slopes.Yv), _wrong(slopes.Nv)
    sway = _wrong(slopes.sway_damping) is True and _wrong(slopes.sway_added_mass) is True
    yaw = _wrong(slopes.yaw_damping, 0.005) is True and _wrong(slopes.yaw_added_inertia, 0.001) is True
    seen = _said(slopes)
    if thrust and (drift_Y or sway):
        return [finding("force-sign", f"the hull pushes itself on and into its drift ({seen})", place="X, Y, N")]
    if sway:
        names = "Y and N" if yaw or drift_N else "Y"
        cure = "turn the sign of the channels in the channel map, or set conventions.axes or force_sign"
        text = f"{names} drives the sway on instead of resisting it ({seen})"
        return [finding("force-sign", text, place=names, cure=cure)]
    if drift_Y:
        if drift_N is False or yaw:
            names = "Y and N" if yaw and drift_N else "Y"
            return [finding("force-sign", f"{names} has the wrong sign ({seen})", place=names)]
        return [finding("drift-sign", f"the hull is pushed into its drift ({seen})", place="static drift")]
    if yaw:
        return [finding("force-sign", f"N drives the yaw on instead of resisting it ({seen})", place="N")]
    if thrust:
        text = f"X pushes the towed hull on ({seen})"
        cure = "turn the sign of X, give propeller_rate where the propeller runs, or subtract the zero level"
        return [finding("force-sign", text, severity="warning", place="X", cure=cure)]
    return []


def _wrong(slope: float | None, clear: float = _CLEAR) -> bool | None:
    """True when a slope that must be negative is positive; None when it says nothing."""
    if slope is None or abs(slope) < clear:
        return None
    return slope > 0.0


def _said(slopes: LinearSlopes) -> str:
    names = (
        ("X at no drift", slopes.X0),
        ("Yv'", slopes.Yv),
        ("Nv'", slopes.Nv),
        ("Yv' of sway", slopes.sway_damping),
        ("Yvdot'", slopes.sway_added_mass),
        ("Nr'", slopes.yaw_damping),
        ("Nrdot'", slopes.yaw_added_inertia),
    )
    return (
        ", ".join(f"{name} = {value:+.3g}" for name, value in names if value is not None)
        + "; a ship has all of these negative"
    )


def audit_exchanged_forces(summaries: Sequence[RunSummary], ship: Ship) -> list[Finding]:
    """Finding when, in static drift, X is odd in the drift angle and Y even: they are exchanged."""
    runs = [one for one in drift_runs(summaries) if {"X", "Y"} <= set(one.mean_force)]
    v = np.array([-math.sin(one.run.drift_angle) for one in runs])
    if len(np.unique(np.round(v, 4))) < 4:
        return []
    odd, even = np.column_stack([v, v**3]), np.column_stack([np.ones_like(v), v**2])

    def misfit(name: str, columns: np.ndarray) -> float:
        force = np.array([scaled_force(name, one, ship) for one in runs])
        rest = force - columns @ np.linalg.lstsq(columns, force, rcond=None)[0]
        return float(rest @ rest) / max(float(force @ force), 1e-300)

    if 4.0 * misfit("X", odd) > misfit("X", even) or 4.0 * misfit("Y", even) > misfit("Y", odd):
        return []
    text = "in static drift X changes sign with the drift angle and Y does not: X and Y are exchanged"
    return [finding("swapped-channels", text, place="X, Y")]


def audit_rudder_sign(summaries: Sequence[RunSummary], ship: Ship) -> list[Finding]:
    """Finding when a rudder to starboard (positive here) does not push the stern to port: Y < 0, N > 0."""
    groups: dict[tuple[float, ...], list[RunSummary]] = {}
    for one in summaries:
        if not one.run.harmonic and not one.run.yaw_rate:
            key = (one.run.drift_angle, one.run.heel, one.run.speed, one.run.depth or 0.0, one.run.bank_position)
            groups.setdefault(key, []).append(one)
    slopes: dict[str, list[float]] = {"Y": [], "N": []}
    for runs in groups.values():
        angle = np.array([one.run.rudder_angle for one in runs])
        if len(runs) < 2 or np.ptp(angle) < math.radians(3.0):
            continue
        for name, values in slopes.items():
            force = np.array([scaled_force(name, one, ship) for one in runs])
            d, f = angle - angle.mean(), force - force.mean()
            strength = math.sqrt(float(d @ d) * float(f @ f))
            if np.isfinite(strength) and strength > 0 and abs(float(d @ f)) > 0.8 * strength:
                values.append(float(d @ f) / float(d @ d))
    side, turn = (float(np.median(slopes[name])) if slopes[name] else 0.0 for name in ("Y", "N"))
    # A rudder gives about -0.05 and +0.025; a bare hull gives nothing.
    if max(abs(side), 2.0 * abs(turn)) < 0.005 or not (side >= 0.0 and turn <= 0.0):
        return []
    seen = f"Y_delta' = {side:+.3g}, N_delta' = {turn:+.3g}"
    text = f"a rudder to starboard must give Y < 0 and N > 0; {seen} were found"
    return [finding("rudder-sign", text, place="rudder runs")]
