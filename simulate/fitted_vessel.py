"""A fitted derivative set as a ship that can be sailed: what it lacks is taken from a named ship, or is named."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from ..core.derivative_set import DerivativeSet
from ..core.errors import SimulationError
from .propeller import Propeller, ThrustSurface
from .rudder import Rudder
from .ships import named_ship
from .validity import depends, doubtful_scale
from .vessel import Inertia, SteeringGear, Vessel

_ADDED_MASSES = ("Xudot", "Yvdot", "Nrdot")


def vessel_from_set(
    derivatives: DerivativeSet,
    *,
    like: str | Vessel | None = None,
    speed: float | None = None,
    propeller: Propeller | ThrustSurface | None = None,
    rudder: Rudder | None = None,
    gear: SteeringGear | None = None,
    inertia: Inertia | None = None,
    **more: Any,
) -> Vessel:
    """A vessel whose hull is a derivative set.

    Parameters
    ----------
    derivatives : DerivativeSet
        Fitted or read from a file.
    like : str or Vessel, optional
        A named ship (see :func:`towtank.simulate.ships.named_ships`) or a vessel: propeller, rudder, steering gear,
        added masses and inertia that neither the set nor an argument gives are its own, enlarged to the length
        of the set's ship by Froude's law. Nothing is taken from a ship that is not named here.
    speed : float, optional
        Approach speed in m/s; the reference speed of the set, else that of `like` by Froude's law.
    propeller, rudder, gear, inertia : optional
        Parts of the vessel.
    **more
        Other attributes of :class:`Vessel`, such as ``engine`` or ``rate``.

    Raises
    ------
    SimulationError
        With everything that is missing.
    """
    donor = named_ship(like) if isinstance(like, str) else like
    sources = {"hull": derivatives.provenance.source or derivatives.name}
    hull = derivatives
    if donor is not None:
        k = hull.ship.L / donor.ship.L
        if propeller is None and donor.propeller is not None and not _holds_thrust(hull):
            propeller, sources["propeller"] = donor.propeller.enlarged(k), donor.name
        if rudder is None and donor.rudder is not None and not _holds_rudder(hull):
            rudder, sources["rudder"] = donor.rudder.enlarged(k), donor.name
        if gear is None:
            gear = replace(donor.gear, rate=donor.gear.rate * k**-0.5, lag=donor.gear.lag * k**0.5)
            sources["steering gear"] = donor.name
        if speed is None and hull.reference_speed is None:
            speed, sources["speed"] = donor.speed * k**0.5, donor.name
        hull = _with_added_masses(hull, donor, sources)
        hull = _with_inertia(hull, donor, sources)
    bare = [name for name, value in zip(hull.names, hull.values, strict=True) if not math.isfinite(value)]
    if bare:
        raise SimulationError(
            f"set '{hull.name}' cannot be sailed: {', '.join(bare)} {'is' if len(bare) == 1 else 'are'} not finite",
            cure="fit these terms again, or leave them out",
        )
    speed = hull.reference_speed if speed is None else speed
    missing = _missing(hull, propeller, rudder, gear, speed, inertia or Inertia())
    if more.get("cross_flow") is None:
        missing += _missing_damping(hull)
    if missing or gear is None or speed is None:
        raise SimulationError(
            f"set '{hull.name}' cannot be sailed: it lacks {'; '.join(missing)}",
            cure="give these, or name a ship to take them from (like='kvlcc2')",
        )
    return Vessel(
        name=hull.name,
        hull=hull,
        speed=speed,
        gear=gear,
        propeller=propeller,
        rudder=rudder,
        inertia=inertia or Inertia(),
        sources=sources,
        findings=tuple(doubtful_scale(hull)),
        **more,
    )


def _holds_rudder(hull: DerivativeSet) -> bool:
    """True when the terms hold the rudder: N depends on the rudder angle."""
    return any(term.component == "N" and "delta" in term.variables for term in hull.terms)


def _holds_thrust(hull: DerivativeSet) -> bool:
    """True when X is a deviation from the approach, where resistance and thrust cancel."""
    variables = {name for term in hull.terms if term.component == "X" for name in term.variables}
    return "u" in variables and "surge" not in variables and "R0" not in hull


def _holds_resistance(hull: DerivativeSet) -> bool:
    steady = [
        term for term in hull.terms if term.component == "X" and not {"v", "beta", "r"} & set(term.variables)
    ]
    return any(not name.endswith("dot") for term in steady for name in (term.variables or ("constant",)))


def _missing(
    hull: DerivativeSet,
    propeller: Propeller | ThrustSurface | None,
    rudder: Rudder | None,
    gear: SteeringGear | None,
    speed: float | None,
    inertia: Inertia,
) -> list[str]:
    """Each part that the equations of motion need and nobody gives."""
    ship = hull.ship
    inside = hull.conventions.rigid_body_inertia == "inside"
    rolls = any(term.component == "K" for term in hull.terms)
    no_roll_inertia = inertia.Ixx is None and (ship.kxx is None or ship.displacement_mass is None)
    wanted = {
        "a propeller (D, KT, wP0, tP)": propeller is None and not _holds_thrust(hull),
        "the resistance (R0)": not _holds_resistance(hull),
        "a rudder (area, f_alpha, ...) or rudder derivatives (Yd, Nd)": rudder is None and not _holds_rudder(hull),
        "a steering gear (rate)": gear is None,
        "an approach speed": speed is None,
        "the mass of the ship (volume or mass)": ship.displacement_mass is None and not inside,
        "the yaw inertia of the ship (Izz or kzz)": ship.yaw_inertia is None and not inside,
        "the sway added mass (Yvdot)": "Yvdot" not in hull,
        "the yaw added inertia (Nrdot)": "Nrdot" not in hull,
        "the roll inertia of the ship (kxx)": rolls and no_roll_inertia and not inside,
        "the metacentric height (GM)": rolls and inertia.GM is None and ship.GM is None,
    }
    return [part for part, lacking in wanted.items() if lacking]


def _missing_damping(hull: DerivativeSet) -> list[str]:
    """Damping without which a disturbance grows for want of measurements: static drift alone shows no yaw damping."""
    wanted = {
        "the damping of sway (Yv: runs with drift)": depends(hull, "Y", "v", "beta"),
        "the damping of yaw (Nr: runs with a yaw rate)": depends(hull, "N", "r"),
    }
    return [part for part, there in wanted.items() if not there]


def _with_added_masses(hull: DerivativeSet, donor: Vessel, sources: dict[str, str]) -> DerivativeSet:
    lacking = [name for name in _ADDED_MASSES if name not in hull and name in donor.hull]
    if not lacking:
        return hull
    theirs = donor.hull.conventions
    plain = theirs.but(force_scaling="LT", rigid_body_inertia="outside", angle_unit="rad")
    # the donor's own mass comes off at its own size; what is left holds for a similar hull of any size
    similar = replace(donor.hull.subset(lacking).to(plain), ship=hull.ship, reference_speed=hull.reference_speed)
    taken = similar.to(hull.conventions.but(scale=plain.scale))
    sources["added masses"] = f"{', '.join(lacking)} of {donor.name}"
    return hull.with_values(**{name: taken[name] for name in lacking})


def _with_inertia(hull: DerivativeSet, donor: Vessel, sources: dict[str, str]) -> DerivativeSet:
    ship, theirs = hull.ship, donor.ship
    k = ship.L / theirs.L
    changes: dict[str, Any] = {}
    if ship.displacement_mass is None and theirs.displacement_mass is not None:
        changes["mass"] = theirs.displacement_mass * k**3 * ship.rho / theirs.rho
    if ship.yaw_inertia is None and ship.Izz is None and ship.kzz is None and theirs.yaw_inertia is not None:
        own = theirs.displacement_mass
        if own is not None:
            changes["kzz"] = (theirs.yaw_inertia / own) ** 0.5 * k
    if not changes:
        return hull
    sources["inertia"] = donor.name
    return replace(hull, ship=replace(ship, **changes))
