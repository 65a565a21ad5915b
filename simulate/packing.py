"""A vessel as flat arrays for the compiled kernel: one row of numbers a draw, one structure for all."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from ..core.conventions import Conventions
from ..core.conversion import conversion_map
from ..core.derivative_set import DerivativeSet
from ..core.errors import SimulationError
from ..core.motion import force_units, origin_position
from ..core.scales import variable_unit
from ..core.ship import Ship
from ..core.terms import Term
from ..core.variables import VARIABLES
from .inertia_forces import (
    RollBody,
    acceleration_of,
    added_mass_matrix,
    inertia_parameters,
    is_acceleration,
    require_added_mass,
)
from .monomials import monomials
from .parameters import COEFFICIENTS, SHAPES, Inflow, Parameter, Shape, Thrust, Wake
from .propeller import WAKES, Propeller, ThrustSurface
from .vessel import Vessel

FloatArray = np.ndarray
Lookup = Callable[..., float | FloatArray]


@dataclass(frozen=True, eq=False)
class Packed:
    """A vessel as arrays (layout: :mod:`towtank.simulate.parameters`).

    Attributes
    ----------
    vessel : Vessel
    shape, products, nodes : ndarray of int64
        Structure, the same for all draws.
    tables : ndarray
        Open-water diagram and cross-flow drag.
    parameters : ndarray, shape (draws, n)
    """

    vessel: Vessel
    shape: np.ndarray
    products: np.ndarray
    nodes: np.ndarray
    tables: np.ndarray
    parameters: FloatArray

    @property
    def draws(self) -> int:
        """Number of draws."""
        return len(self.parameters)


def pack(
    vessel: Vessel, hull: FloatArray | None = None, changes: Mapping[str, FloatArray] | None = None
) -> Packed:
    """Arrays of a vessel, or of many draws of it.

    Parameters
    ----------
    vessel : Vessel
    hull : ndarray, shape (draws, terms), optional
        Values of the derivatives, in the order and the conventions of ``vessel.hull``.
    changes : mapping of str to ndarray, shape (draws,), optional
        Other numbers by name, e.g. ``{"rudder.eps": ..., "propeller.wP0": ...}``; names as
        :meth:`Vessel.parameter_names` gives them.

    Raises
    ------
    SimulationError
        When the vessel lacks something that the equations of motion need, or a name is unknown.
    """
    changes = dict(changes or {})
    known = vessel.parameter_names()
    for name in changes:
        if name not in known:
            raise SimulationError(f"the vessel has no number '{name}'", cure=f"it has {', '.join(known)}")
    values = np.atleast_2d(np.asarray(vessel.hull.values if hull is None else hull, dtype=float))
    draws = max([len(values), *(len(np.atleast_1d(v)) for v in changes.values())])
    if values.shape[1] != len(vessel.hull) or len(values) not in (1, draws):
        raise SimulationError(
            f"derivatives of shape {values.shape} for {len(vessel.hull)} terms and {draws} draws",
            cure="give an array of shape (draws, terms)",
        )
    values = np.broadcast_to(values, (draws, values.shape[1]))

    def get(part: str, item: str, value: float | None = None) -> float | FloatArray:
        name = f"{part}.{item}"
        if name in changes:
            return np.asarray(changes[name], dtype=float)
        return getattr(getattr(vessel, part), item) if value is None else value

    terms, values, conventions = _scaled(vessel.hull, values)
    ship = vessel.ship
    still = [i for i, term in enumerate(terms) if not is_acceleration(term)]
    moving = [i for i, term in enumerate(terms) if is_acceleration(term)]
    require_added_mass({acceleration_of(terms[i]) for i in moving}, vessel.hull.name)
    form = monomials([_without_depth(terms[i]) for i in still])
    rows = [still[i] for i in form.rows]

    parameters = np.zeros((draws, COEFFICIENTS + len(rows)))
    shape = np.zeros(SHAPES, dtype=np.int64)
    shape[Shape.APPROACH_SCALED] = conventions.velocity_scale == "approach"
    shape[Shape.BETA_IS_TANGENT] = vessel.beta_is_tangent
    shape[Shape.NEEDS_BETA] = "beta" in form.variables
    shape[Shape.PRODUCTS] = len(form.products)
    shape[Shape.X_END : Shape.K_END + 1] = form.ends
    parameters[:, Parameter.LENGTH] = ship.L
    parameters[:, Parameter.SPEED] = vessel.speed
    parameters[:, Parameter.ORIGIN] = origin_position(conventions, ship) * ship.L
    parameters[:, Parameter.X_CONSTANT] = vessel.towing_force
    for place, row in enumerate(rows):
        unit = _term_unit(terms[row], ship, conventions)
        parameters[:, COEFFICIENTS + place] = unit * values[:, row]

    roll = _roll_body(vessel, terms, get)
    shape[Shape.ROLL] = roll is not None
    depth = np.array([_depth_factor(terms[i], ship) for i in moving])
    added = added_mass_matrix([terms[i] for i in moving], depth * values[:, moving], ship, conventions)
    inertia_parameters(parameters, added, ship, conventions, roll)

    tables: list[FloatArray] = []
    _pack_propeller(vessel, get, shape, parameters, tables, form.variables)
    _pack_rudder(vessel, get, shape, parameters)
    for place, item in (
        (Parameter.GEAR_RATE, "rate"),
        (Parameter.GEAR_LIMIT, "limit"),
        (Parameter.GEAR_LAG, "lag"),
        (Parameter.GEAR_BAND, "band"),
    ):
        parameters[:, place] = get("gear", item)
    parameters[:, Parameter.RATE_LAG] = vessel.engine.lag
    shape[Shape.NEEDS_DRIFT] = shape[Shape.WAKE] in (Wake.C1C2, Wake.EXPONENTIAL) or (
        shape[Shape.RUDDER] == Inflow.MMG
    )
    if vessel.cross_flow is not None:
        shape[Shape.CROSS_FLOW] = sum(map(len, tables))
        shape[Shape.STATIONS] = len(vessel.cross_flow.stations)
        tables.append(vessel.cross_flow.packed(ship.L, ship.T, ship.rho))
    return Packed(
        vessel,
        shape,
        form.products,
        form.nodes,
        np.concatenate(tables) if tables else np.zeros(1),
        parameters,
    )


def _scaled(hull: DerivativeSet, values: FloatArray) -> tuple[tuple[Term, ...], FloatArray, Conventions]:
    """Terms, values and conventions with forces scaled by L T or L**2; another scaling is converted exactly."""
    if hull.conventions.force_scaling in ("LT", "L2"):
        return hull.terms, values, hull.conventions
    target = hull.conventions.but(force_scaling="LT")
    step = conversion_map(hull.terms, hull.conventions, target, hull.ship, hull.reference_speed)
    return step.target, values @ step.matrix.T + step.offset, target


def _without_depth(term: Term) -> Term:
    if "depth" not in term.variables:
        return term
    return Term(term.name, term.component, tuple(f for f in term.factors if f.variable != "depth"), term.sign)


def _depth_factor(term: Term, ship: Ship) -> float:
    """The term's power of the depth parameter T/(h-T), which a manoeuvre does not change."""
    if "depth" not in term.variables:
        return 1.0
    degree = sum(f.degree for f in term.factors if f.variable == "depth")
    return 0.0 if math.isinf(ship.depth) else (ship.T / (ship.depth - ship.T)) ** degree


def _term_unit(term: Term, ship: Ship, conventions: Conventions) -> float:
    """Force in N over the squared speed for a unit value, with the variables in SI over the speed."""
    unit = float(force_units(term.component, ship, conventions, 1.0)) * term.sign * _depth_factor(term, ship)
    for factor in term.factors:
        if factor.variable == "depth":
            continue
        scale = 1.0 / variable_unit(factor.variable, conventions.force_scaling, ship, 1.0)
        if conventions.angle_unit == "deg" and VARIABLES[factor.variable].angle:
            scale *= 180.0 / math.pi
        negative = (
            (conventions.axes == "forward-port-up" and factor.variable in ("v", "beta", "r"))
            ^ (conventions.rudder_sign == "port" and factor.variable == "delta")
            ^ (conventions.drift_sign == "+v" and factor.variable == "beta")
        )
        if negative and factor.power % 2:
            unit = -unit
        unit *= scale**factor.degree
    return unit


def _roll_body(vessel: Vessel, terms: tuple[Term, ...], get: Lookup) -> RollBody | None:
    """Roll inertia and righting arm of a ship whose hull terms know roll; None for one that stays upright."""
    rolls = any(term.component == "K" for term in terms)
    uses = sorted({name for term in terms for name in term.variables} & {"phi", "p", "pdot"})
    if not rolls:
        if uses:
            raise SimulationError(
                f"set '{vessel.hull.name}' has terms in {', '.join(uses)} but no roll moment K",
                cure="give K terms (Kpdot, Kp, ...), or leave the terms in roll out of the set",
            )
        return None
    ship = vessel.ship
    zG = get("inertia", "zG")
    Ixx, GM = get("inertia", "Ixx"), get("inertia", "GM")
    if Ixx is None and ship.kxx is not None and ship.displacement_mass is not None:
        Ixx = ship.displacement_mass * (ship.kxx**2 + np.square(zG))
    GM = ship.GM if GM is None else GM
    for item, value in (("Ixx", Ixx), ("GM", GM), ("mass", ship.displacement_mass)):
        if value is None:
            raise SimulationError(
                f"set '{vessel.hull.name}' has a roll moment, but the ship's {item} is not known",
                cure="give inertia.Ixx or the ship's kxx, GM and mass, or leave the terms in roll out",
            )
    return RollBody(Ixx, GM, zG, get("inertia", "lx") * ship.L)


def _pack_propeller(
    vessel: Vessel,
    get: Lookup,
    shape: np.ndarray,
    parameters: FloatArray,
    tables: list[FloatArray],
    variables: frozenset[str],
) -> None:
    """Wake, thrust and torque."""
    ship, propeller = vessel.ship, vessel.propeller
    if not isinstance(propeller, ThrustSurface) and {"c", "thrust"} & variables:
        raise SimulationError(
            f"set '{vessel.hull.name}' has terms in the rudder flow or the thrust",
            cure="give the vessel a ThrustSurface propeller",
        )
    parameters[:, Parameter.DIAMETER] = 1.0
    if propeller is None:
        return
    parameters[:, Parameter.ONE_MINUS_T] = 1.0 - get("propeller", "tP")
    if isinstance(propeller, ThrustSurface):
        if ship.displacement_mass is None:
            raise SimulationError(f"the mass of '{ship.name}' is not known", cure="give its volume or mass")
        shape[Shape.THRUST] = Thrust.SURFACE
        shape[Shape.ASTERN] = 1
        parameters[:, Parameter.PROPELLER_MASS] = ship.displacement_mass
        for place, item in (
            (Parameter.TUU, "Tuu"),
            (Parameter.TUN, "Tun"),
            (Parameter.TNN, "Tnn"),
            (Parameter.CUN, "cun"),
            (Parameter.CNN, "cnn"),
        ):
            parameters[:, place] = get("propeller", item)
        return
    D = get("propeller", "D")
    shape[Shape.WAKE] = WAKES.index(propeller.wake)
    shape[Shape.ASTERN] = propeller.thrust_astern > 0.0
    for place, item, unit in (
        (Parameter.DIAMETER, "D", 1.0),
        (Parameter.WP0, "wP0", 1.0),
        (Parameter.XP, "xP", ship.L),
        (Parameter.C1, "C1", 1.0),
        (Parameter.C2_POSITIVE, "C2_positive", 1.0),
        (Parameter.C2_NEGATIVE, "C2_negative", 1.0),
        (Parameter.TAU, "tau", 1.0),
        (Parameter.CPV, "cPv", 1.0),
        (Parameter.CPR, "cPr", 1.0),
    ):
        parameters[:, place] = np.multiply(get("propeller", item), unit)
    parameters[:, Parameter.THRUST_UNIT] = ship.rho * np.square(D) * propeller.number
    parameters[:, Parameter.KT_ASTERN] = (
        propeller.thrust_astern if propeller.astern_KT is None else get("propeller", "astern_KT")
    )
    if propeller.tabulated:
        shape[Shape.THRUST] = Thrust.TABLE
        shape[Shape.TABLE] = sum(map(len, tables))
        shape[Shape.TABLE_ROWS] = len(propeller.KT)
        tables.append(_open_water_rows(propeller))
    else:
        shape[Shape.THRUST] = Thrust.POLYNOMIAL if len(propeller.KT) > 3 else Thrust.PARABOLA
        for power, (name, value) in enumerate(propeller.coefficients.items()):
            parameters[:, Parameter.KT0 + power] = get("propeller", name, value)
    for power, coefficient in enumerate(propeller.KQ):
        parameters[:, Parameter.KQ0 + power] = coefficient
    parameters[:, Parameter.TORQUE_UNIT] = ship.rho * np.power(D, 3)
    if vessel.engine.kind == "constant torque":
        if not propeller.KQ or len(propeller.KQ) > 3:
            raise SimulationError(
                "an engine of constant torque needs the torque of its propeller",
                cure="give the propeller's KQ: one to three coefficients of J",
            )
        shape[Shape.TORQUE] = 1
        parameters[:, Parameter.SHAFT] = 2.0 * math.pi * (vessel.engine.inertia or 0.0)


def _open_water_rows(propeller: Propeller) -> FloatArray:
    from scipy.interpolate import PchipInterpolator

    table = np.asarray(propeller.KT)
    slope = PchipInterpolator(table[:, 0], table[:, 1]).derivative()(table[:, 0])
    return np.column_stack([table, slope]).ravel()


def _pack_rudder(vessel: Vessel, get: Lookup, shape: np.ndarray, parameters: FloatArray) -> None:
    """Rudder inflow and force."""
    rudder, ship = vessel.rudder, vessel.ship
    if rudder is None:
        return
    if not isinstance(vessel.propeller, Propeller):
        raise SimulationError(
            f"the rudder of '{vessel.name}' stands behind no propeller with a wake",
            cure="give the vessel a Propeller, or the rudder as terms of the hull (Yd, Nd, ...)",
        )
    shape[Shape.RUDDER] = Inflow.MMG if rudder.inflow == "MMG" else Inflow.SON_NOMOTO
    shape[Shape.SWITCH_AT_PROPELLER] = rudder.switch == "betaP"
    for place, item, unit in (
        (Parameter.EPS, "eps", 1.0),
        (Parameter.KAPPA, "kappa", 1.0),
        (Parameter.ETA, "eta", 1.0),
        (Parameter.GAMMA_POSITIVE, "gammaR_positive", 1.0),
        (Parameter.GAMMA_NEGATIVE, "gammaR_negative", 1.0),
        (Parameter.RUDDER_LEVER, "lR", ship.L),
        (Parameter.CR_R, "cRr", 1.0),
        (Parameter.CR_RRR, "cRrrr", 1.0),
        (Parameter.CR_RRV, "cRrrv", 1.0),
    ):
        parameters[:, place] = np.multiply(get("rudder", item), unit)
    aH = get("rudder", "aH")
    force = np.multiply(get("rudder", "area"), get("rudder", "f_alpha"))
    parameters[:, Parameter.RUDDER_FORCE] = 0.5 * ship.rho * rudder.number * force
    parameters[:, Parameter.JET] = 8.0 / (
        ship.rho * math.pi * np.square(get("propeller", "D")) * vessel.propeller.number
    )
    parameters[:, Parameter.ONE_MINUS_TR] = 1.0 - get("rudder", "tR")
    parameters[:, Parameter.ONE_PLUS_AH] = 1.0 + aH
    parameters[:, Parameter.YAW_LEVER] = (get("rudder", "xR") + aH * get("rudder", "xH")) * ship.L
    parameters[:, Parameter.ROLL_LEVER] = get("rudder", "zR") * (1.0 + aH) * ship.L
