"""A ship that can be sailed: hull derivatives, inertia, propeller, rudder, steering gear and engine."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import TowtankError
from ..core.findings import Finding
from ..core.ship import Ship
from .cross_flow import CrossFlow
from .propeller import Propeller, ThrustSurface
from .rudder import Rudder


@dataclass(frozen=True)
class Inertia:
    """Rigid body in roll, and what a derivative set does not hold about the coupling of roll.

    Mass, yaw inertia and centre of gravity are those of the ship.

    Attributes
    ----------
    Ixx : float, optional
        Roll moment of inertia about the axis through the origin in kg m2; the ship's ``mass kxx**2`` when not given.
        Without it the ship does not roll.
    GM : float, optional
        Metacentric height in m; the ship's when not given. The righting moment is ``mass g GM phi``.
    zG : float
        Centre of gravity below the roll axis in m; 0 when moments K are about the centre of gravity.
    lx : float
        Height arm of the surge added mass over L: ``K`` receives ``mx lx L u r`` (Son and Nomoto 1981).
    """

    Ixx: float | None = None
    GM: float | None = None
    zG: float = 0.0
    lx: float = 0.0


@dataclass(frozen=True)
class SteeringGear:
    """Steering gear.

    Attributes
    ----------
    rate : float
        Largest rate of the rudder in rad/s.
    limit : float
        Largest rudder angle in rad.
    lag : float
        Time constant in s of the first-order approach to the order, ``min(rate, error / lag)``; 0 runs at the full
        rate until the order is reached.
    band : float
        Error in rad above which an autopilot's order is followed at the full rate; used when `lag` is 0.
    """

    rate: float
    limit: float = math.radians(40.0)
    lag: float = 0.0
    band: float = math.radians(1.0)

    def __post_init__(self) -> None:
        for item in ("rate", "limit", "band"):
            if not getattr(self, item) > 0.0:
                raise TowtankError(f"steering gear: {item} = {getattr(self, item)} is not positive")
        if self.lag < 0.0:
            raise TowtankError(f"steering gear: lag = {self.lag} is negative")


@dataclass(frozen=True)
class Engine:
    """What the propeller's rate does in a manoeuvre.

    Attributes
    ----------
    kind : {"constant rate", "constant torque"}
        Constant rate follows the ordered rate; constant torque keeps the torque of the approach (needs the
        propeller's ``KQ``) until another rate is ordered.
    lag : float
        Time constant in s of the rate after a new order; 0 changes it at once.
    inertia : float, optional
        Polar inertia of shaft, propeller and entrained water in kg m2, for constant torque.
    power : float
        Power of the approach over that of the self-propulsion point; the rate there is multiplied by
        ``power**(1/3)``.
    """

    kind: str = "constant rate"
    lag: float = 0.0
    inertia: float | None = None
    power: float = 1.0

    def __post_init__(self) -> None:
        if self.kind not in ("constant rate", "constant torque"):
            raise TowtankError(
                f"engine '{self.kind}' is not known", cure="use 'constant rate' or 'constant torque'"
            )
        if self.kind == "constant torque" and not (self.inertia or 0.0) > 0.0:
            raise TowtankError(
                "an engine of constant torque needs the inertia of its shaft", cure="give inertia in kg m2"
            )
        if not self.power > 0.0:
            raise TowtankError(f"engine: power = {self.power} is not positive")


@dataclass(frozen=True)
class Vessel:
    """A ship with its models of hull, propeller, rudder, steering gear and engine.

    Attributes
    ----------
    name : str
    hull : DerivativeSet
        Hull forces, added masses as its acceleration terms; its ship gives the particulars.
    speed : float
        Approach speed U0 in m/s.
    gear : SteeringGear
    propeller : Propeller, ThrustSurface or None
        None when the hull terms hold thrust and resistance together (deviations from the approach).
    rudder : Rudder or None
        None when the hull terms hold the rudder (``Yd``, ``Nd``, ...).
    inertia : Inertia
    engine : Engine
    rate : float, optional
        Propeller rate of the approach in 1/s; that of the self-propulsion point at `speed` when not given.
    cross_flow : CrossFlow, optional
        Cross-flow drag beside the terms of the hull.
    towing_force : float
        Constant force ahead in N, such as the skin-friction correction of a model test.
    beta_is_tangent : bool
        Terms in the drift angle are meant for ``-v/u`` (van Berlekom and Goddard 1972).
    sources : mapping of str to str
        Where parts beside the hull come from.
    findings : tuple of Finding
        Doubts about its parts; each trajectory tells them.
    """

    name: str
    hull: DerivativeSet
    speed: float
    gear: SteeringGear
    propeller: Propeller | ThrustSurface | None = None
    rudder: Rudder | None = None
    inertia: Inertia = field(default_factory=Inertia)
    engine: Engine = field(default_factory=Engine)
    rate: float | None = None
    cross_flow: CrossFlow | None = None
    towing_force: float = 0.0
    beta_is_tangent: bool = False
    sources: Mapping[str, str] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()

    def __post_init__(self) -> None:
        if not self.speed > 0.0:
            raise TowtankError(f"vessel '{self.name}': approach speed {self.speed} m/s is not positive")

    @property
    def ship(self) -> Ship:
        """Particulars."""
        return self.hull.ship

    def but(self, **changes: Any) -> Vessel:
        """Copy with some attributes changed."""
        return replace(self, **changes)

    def with_hull(self, hull: DerivativeSet) -> Vessel:
        """The same vessel with other hull derivatives, e.g. fitted ones."""
        return replace(self, hull=hull)

    def at_scale(self, scale: float, *, rho: float | None = None) -> Vessel:
        """The geometrically similar vessel at another scale, all by Froude's law, the wake included.

        Parameters
        ----------
        scale : float
            New scale factor; 1 for full scale.
        rho : float, optional
            Water density there in kg/m3.
        """
        hull = self.hull.at_scale(scale, rho=rho)
        k = hull.ship.L / self.ship.L
        force = k**3 * hull.ship.rho / self.ship.rho

        def times(value: float | None, factor: float) -> float | None:
            return None if value is None else value * factor

        return replace(
            self,
            hull=hull,
            speed=self.speed * k**0.5,
            rate=times(self.rate, k**-0.5),
            gear=replace(self.gear, rate=self.gear.rate * k**-0.5, lag=self.gear.lag * k**0.5),
            engine=replace(
                self.engine, lag=self.engine.lag * k**0.5, inertia=times(self.engine.inertia, force * k**2)
            ),
            inertia=replace(
                self.inertia,
                Ixx=times(self.inertia.Ixx, force * k**2),
                GM=times(self.inertia.GM, k),
                zG=self.inertia.zG * k,
            ),
            propeller=None if self.propeller is None else self.propeller.enlarged(k),
            rudder=None if self.rudder is None else self.rudder.enlarged(k),
            towing_force=self.towing_force * force,
        )

    def parameter_names(self) -> tuple[str, ...]:
        """Names of the numbers beside the hull derivatives that an ensemble may vary, e.g. ``rudder.eps``."""
        names = []
        for part in ("propeller", "rudder", "inertia", "gear"):
            holder = getattr(self, part)
            if holder is None:
                continue
            for item in fields(holder):
                value = getattr(holder, item.name)
                if isinstance(value, float | int | np.floating) and not isinstance(value, bool):
                    names.append(f"{part}.{item.name}")
        if isinstance(self.propeller, Propeller):
            names += [f"propeller.{name}" for name in self.propeller.coefficients]
        return tuple(names)
