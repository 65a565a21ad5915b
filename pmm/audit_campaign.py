"""The audit across runs: signs, inertia, reference point and scaling, measured against empirical formulas."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from ..core.conventions import Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..core.findings import Finding
from ..core.scales import mass_coefficient, yaw_inertia_coefficient
from ..core.ship import Ship
from .audit_matrix import audit_matrix
from .audit_rules import finding
from .audit_signs import audit_exchanged_forces, audit_rudder_sign, audit_signs
from .empirical_derivatives import (
    clarke,
    shallow_added_mass_factors,
    shallow_sway_factor,
    yoshimura_masumoto,
    zhou_added_mass,
)
from .linear_slopes import LinearSlopes, RunSummary, linear_slopes

__all__ = ["RunSummary", "audit_campaign"]

_SCATTER = 0.30
"""Relative standard deviation of an empirical added mass."""

_SURE = 2.0
"""Logarithm of the likelihood ratio from which the audit speaks: odds of 7 to 1."""

_NOTHING = 0.05
"""Share of an empirical added mass below which a slope says nothing: the run shows no acceleration force."""

_LEVER_USUAL, _LEVER_POSSIBLE = (0.10, 0.80), (-0.10, 1.00)


def audit_campaign(
    reduced: Sequence[RunSummary],
    ship: Ship,
    conventions: Conventions,
    fitted: DerivativeSet | None,
    *,
    inertia_inside: bool,
) -> list[Finding]:
    """Findings across the runs of a campaign.

    Parameters
    ----------
    reduced : sequence of RunSummary
        Runs of one water depth, after reduction.
    ship : Ship
        In that depth.
    conventions : Conventions
        Of the campaign.
    fitted : DerivativeSet or None
        The fit, whose linear derivatives are judged where no run shows them alone.
    inertia_inside : bool
        True when inertia was subtracted from the forces.

    Returns
    -------
    list of Finding
        Empty for a sound campaign.
    """
    wet = [one for one in reduced if not one.run.dry]
    found = audit_matrix([one.run for one in reduced], ship, conventions)
    slopes = linear_slopes(wet, ship)
    exchanged = audit_exchanged_forces(wet, ship)
    if exchanged:
        return found + exchanged
    signs = audit_signs(slopes)
    found += signs
    if not any(item.rule == "force-sign" and item.severity == "error" for item in signs):
        found += audit_rudder_sign(wet, ship)
    yardstick = _yardstick(ship, wet)
    if yardstick is None:
        return found
    scaling = _scaling(slopes, fitted, yardstick, ship)
    found += scaling
    if not signs and not scaling:
        found += _inertia(slopes, yardstick, ship, inertia_inside)
        found += _moment_reference(slopes, yardstick, ship)
    return found


@dataclass(frozen=True)
class _Yardstick:
    """Empirical sizes over 0.5 rho L T U^2 at this depth: means of Clarke with Yoshimura-Masumoto or Zhou."""

    Yv: float
    Nv: float
    Nr: float
    sway_added_mass: float
    yaw_added_inertia: float
    lever: float
    shallow: bool


def _yardstick(ship: Ship, runs: Sequence[RunSummary]) -> _Yardstick | None:
    depths = {one.run.depth for one in runs if one.run.depth is not None}
    if len(depths) == 1:
        ship = replace(ship, depth=depths.pop())
    try:
        by_clarke, by_yoshimura, by_zhou = clarke(ship).to("lt"), yoshimura_masumoto(ship), zhou_added_mass(ship)
    except TowtankError:
        return None  # without volume and mass there is no block coefficient to enter the formulas with
    factor, added = shallow_sway_factor(ship), shallow_added_mass_factors(ship)
    Yv, Nv = ((by_clarke[name] + by_yoshimura[name]) / 2 for name in ("Yv", "Nv"))
    return _Yardstick(
        Yv=Yv * factor,
        Nv=Nv * factor,
        Nr=by_yoshimura["Nr"],
        sway_added_mass=(by_zhou.sway - by_clarke["Yvdot"]) / 2 * added.sway,
        yaw_added_inertia=(by_zhou.yaw - by_clarke["Nrdot"]) / 2 * added.yaw,
        lever=Nv / Yv,
        shallow=ship.depth_ratio < 3.0,
    )


def _linear(fitted: DerivativeSet | None, names: Sequence[str]) -> float | None:
    """Size of a fitted linear derivative in the LT form; None when the set has none of `names`."""
    if fitted is None:
        return None
    try:
        scaled = fitted.to("lt,radians")
    except TowtankError:
        return None
    return next((abs(scaled[name]) for name in names if name in scaled), None)


def _scaling(
    slopes: LinearSlopes, fitted: DerivativeSet | None, yardstick: _Yardstick, ship: Ship
) -> list[Finding]:
    """Forces that are L/T too large or small, or off by a power of ten."""
    pairs = (
        ("Yv'", slopes.Yv or slopes.sway_damping or _linear(fitted, ("Yv", "Yb")), yardstick.Yv),
        ("Nv'", (slopes.Nv if slopes.Yv else None) or _linear(fitted, ("Nv", "Nb")), yardstick.Nv),
        ("Nr'", slopes.yaw_damping or _linear(fitted, ("Nr",)), yardstick.Nr),
        ("Yvdot'", slopes.sway_added_mass, yardstick.sway_added_mass),
    )
    known = [(name, abs(value), abs(usual)) for name, value, usual in pairs if value]
    if not known:
        return []
    # Force and moment may be read in units of their own.
    for component in "YN":
        own = [value / usual for name, value, usual in known if name[0] == component]
        if own and min(max(size, 1.0 / size) for size in own) > 2.5 * ship.L / ship.T and _one_side(own):
            seen = ", ".join(f"{n} = {v:.3g} for about {u:.3g}" for n, v, u in known if n[0] == component)
            text = f"{component} is {own[0]:.2g} times the empirical one ({seen})"
            return [finding("force-unit", text, place=f"channel {component}")]
    ratios = sorted(value / usual for _, value, usual in known)
    ratio = ratios[len(ratios) // 2]
    slender = ship.L / ship.T
    # All must be off the same way: one derivative may be small by nature, or not be shown by the runs.
    if (ratios[-1] > slender**-0.6 and ratios[0] < slender**0.6) or max(ratio, 1.0 / ratio) < slender**0.75:
        return []
    seen = ", ".join(f"{name} = {value:.3g} for about {usual:.3g}" for name, value, usual in known)
    made, read = ("L^2", "L T") if ratio < 1.0 else ("L T", "L^2")
    text = (
        f"forces are {ratio:.3g} times the empirical ones and L/T is {slender:.3g}: they were divided by {made} "
        f"and read as divided by {read} ({seen})"
    )
    return [finding("l2-against-lt", text)]


def _one_side(ratios: Sequence[float]) -> bool:
    """True when all are larger than 1, or all smaller."""
    return min(ratios) > 1.0 or max(ratios) < 1.0


def _inertia(slopes: LinearSlopes, yardstick: _Yardstick, ship: Ship, inside: bool) -> list[Finding]:
    """The acceleration slope is -my when inertia is out, -(m + my) when in, -(my - m) when taken out twice."""
    evidence = {-1: 0.0, 0: 0.0, 1: 0.0}
    seen = []
    scatter = _SCATTER * (2.0 if yardstick.shallow else 1.0)
    yaw = slopes.yaw_added_inertia if abs(slopes.yaw_damping or 0.0) > 0.1 * abs(yardstick.Nr) else None
    mass, inertia = _own(mass_coefficient, ship), _own(yaw_inertia_coefficient, ship)
    for name, slope, added, own in (
        ("sway", slopes.sway_added_mass, yardstick.sway_added_mass, mass),
        ("yaw", yaw, yardstick.yaw_added_inertia, inertia),
    ):
        if slope is None or own is None or abs(slope) < _NOTHING * added:
            continue
        for count in evidence:
            evidence[count] += -0.5 * ((-slope - added - count * own) / (scatter * added)) ** 2
        seen.append(f"{name}: {-slope:.3g} measured, {added:.3g} added and {own:.3g} own")
    best = max(evidence, key=lambda count: evidence[count])
    if not seen or best == 0 or evidence[best] - evidence[0] < _SURE:
        return []
    odds = math.exp(min(evidence[best] - evidence[0], 20.0))
    known = f"over 0.5 rho L^2 T and L^4 T ({'; '.join(seen)}); odds {odds:.2g} to 1"
    if best == 1:
        state = "although inertia was subtracted" if inside else "and inertia.inside is false"
        return [finding("inertia-inside", f"the forces hold the model's own inertia, {state}: {known}")]
    state = "was subtracted" if inside else "is missing"
    return [
        finding("inertia-outside", f"the forces lack the inertia of the model's own mass, which {state}: {known}")
    ]


def _own(coefficient: Callable[[Ship], float], ship: Ship) -> float | None:
    try:
        return float(coefficient(ship))
    except TowtankError:
        return None


def _moment_reference(slopes: LinearSlopes, yardstick: _Yardstick, ship: Ship) -> list[Finding]:
    """The drift force attacks between midship and the bow, usually 0.3 to 0.6 L forward of midship."""
    lever = slopes.lever
    if lever is None or _LEVER_USUAL[0] <= lever <= _LEVER_USUAL[1]:
        return []
    point = yardstick.lever - lever
    places = {0.5: "the fore perpendicular", -0.5: "the aft perpendicular"}
    nearest = min(places, key=lambda x: abs(x - point))
    guess = f", near {places[nearest]}" if abs(nearest - point) < 0.2 else ""
    text = (
        f"the drift force attacks {lever:+.2f} L forward of the reference of N, {yardstick.lever:.2f} L is usual "
        f"for midship: the moment would fit a reference at x = {point * ship.L:.3g} m{guess}"
    )
    grave = not _LEVER_POSSIBLE[0] <= lever <= _LEVER_POSSIBLE[1]
    return [finding("moment-reference", text, severity="error" if grave else "warning", place="N")]
