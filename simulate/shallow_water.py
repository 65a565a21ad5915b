"""Depth corrections of derivatives, added masses and propulsion: Ankudinov, Kijima and Nakiri, Li and Wu.

Each correction gives multipliers of deep-water values, in ``F = h/T - 1`` or ``T/h``, the block coefficient and the
ratios of length, breadth and draught. They were regressed on merchant ships; derivatives of one ship may even change
sign with depth, so that a multiplier is a starting value and not a measurement. Every result says what is doubtful.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError, TowtankError
from ..core.ship import Ship
from ..core.terms import Term

Form = Literal["corrected", "printed"]
AddedMass = Literal["ankudinov", "li-wu"]

SHALLOWEST = 1.2
"""Depth over draught below which none of the sources shows a measurement."""


@dataclass(frozen=True)
class DepthMultipliers:
    """Multipliers of deep-water values at one depth.

    Attributes
    ----------
    source : str
    depth_ratio : float
        Water depth over draught.
    values : mapping of str to float
        Name of the derivative or parameter -> shallow value over deep value.
    doubts : tuple of str
        Sentences on what lies outside the sources or cannot be right.
    """

    source: str
    depth_ratio: float
    values: Mapping[str, float]
    doubts: tuple[str, ...] = field(default=())

    def __getitem__(self, name: str) -> float:
        return self.values[name]


@dataclass(frozen=True)
class _Hull:
    cb: float
    bt: float
    """B/T."""
    bl: float
    """B/L."""
    tl: float
    """T/L."""
    th: float
    """T/h."""
    f: float
    """h/T - 1."""


def _hull(ship: Ship, depth_ratio: float) -> _Hull:
    block = ship.block_coefficient
    if block is None:
        raise ConventionError(
            f"depth corrections of '{ship.name}' need its block coefficient", cure="give the ship's volume"
        )
    if not depth_ratio > 1:
        raise TowtankError(
            f"a water depth of {depth_ratio:g} T leaves no water under the keel", cure="give h/T > 1"
        )
    return _Hull(block, ship.B / ship.T, ship.B / ship.L, ship.T / ship.L, 1.0 / depth_ratio, depth_ratio - 1.0)


def _result(source: str, depth_ratio: float, values: Mapping[str, float], *more: str) -> DepthMultipliers:
    doubts = list(more)
    if depth_ratio < SHALLOWEST:
        doubts.append(f"h/T = {depth_ratio:.3g} is shallower than the {SHALLOWEST:g} of the sources")
    wrong = [f"{name} {value:.3g}" for name, value in values.items() if value <= 0]
    if wrong:
        doubts.append(f"multipliers that change the sign: {', '.join(wrong)}")
    return DepthMultipliers(source, depth_ratio, dict(values), tuple(doubts))


# Ankudinov ------------------------------------------------------------------------------------------------------


def ankudinov_factors(ship: Ship, depth_ratio: float, *, form: Form = "corrected") -> DepthMultipliers:
    """The six depth functions of Ankudinov, as in Taimuri et al. 2020 (Ocean Engineering 218, Table 7).

    Parameters
    ----------
    ship : Ship
    depth_ratio : float
        Water depth over draught.
    form : {"corrected", "printed"}
        ``fyv`` is printed as ``1.5 fnr - 0.5``; the shallow derivatives of two papers were computed with
        ``1.5 fnv - 0.5``.

    Returns
    -------
    DepthMultipliers
        gv (added mass), fyv, fnv, fyr, fnr and gnr.

    Raises
    ------
    ConventionError
        When the ship's volume is not known.
    TowtankError
        When there is no water under the keel.
    """
    hull = _hull(ship, depth_ratio)
    f = hull.f
    if math.isinf(f):
        return _result("Ankudinov", depth_ratio, dict.fromkeys(("gv", "fyv", "fnv", "fyr", "fnr", "gnr"), 1.0))
    k0 = 1.0 + 0.0775 / f**2 - 0.011 / f**3 + 0.000068 / f**5
    k1 = -0.0643 / f + 0.0724 / f**2 - 0.0113 / f**3 + 0.0000767 / f**5
    # The wide-beam form is printed with B/T; only T/B joins the other one at B/T = 4.
    k2 = 0.0342 / f if hull.bt <= 4.0 else 0.137 / (f * hull.bt)
    b = hull.cb * hull.bt * (1.0 + hull.bl) ** 2

    def series(first: float, second: float) -> float:
        return k0 + first * k1 * b + second * k2 * b**2

    fnv, fnr = series(1.0, 1.0), series(1 / 2, 1 / 3)
    values = {
        "gv": series(2 / 3, 8 / 15),
        "fyv": 1.5 * (fnv if form == "corrected" else fnr) - 0.5,
        "fnv": fnv,
        "fyr": series(2 / 5, 24 / 105),
        "fnr": fnr,
        "gnr": series(8 / 15, 40 / 105),
    }
    return _result("Ankudinov (Taimuri et al. 2020)", depth_ratio, values)


_ANKUDINOV_TERMS = {
    "gv": ("Yvdot", "Yrdot", "Nvdot"),
    "fyv": ("Xvv", "Xvvvv", "Yvvv", "Nvvv", "Yvvr", "Yvrr"),
    "fnv": ("Nv",),
    "fyr": ("Xvr",),
    "fnr": ("Xrr", "Yr|r|"),
    "gnr": ("Nrdot", "Yrrr", "Nrrr"),
}


def ankudinov_multipliers(ship: Ship, depth_ratio: float, *, form: Form = "corrected") -> DepthMultipliers:
    """Multiplier of each derivative in the combination of Taimuri et al. 2020 (Table 7).

    Ankudinov's functions for added mass, surge, cubic terms and Nv; Kijima and Nakiri for Yv, Yr, Nr, the
    quadratic terms, Nvvr and Nvrr. Parameters and errors as :func:`ankudinov_factors`.
    """
    factors = ankudinov_factors(ship, depth_ratio, form=form)
    values = {name: factors[factor] for factor, names in _ANKUDINOV_TERMS.items() for name in names}
    theirs = kijima_nakiri_multipliers(ship, depth_ratio)
    for name in ("Yv", "Yr", "Nr", "Yv|v|", "Nv|v|", "Nr|r|", "Nvvr", "Nvrr"):
        values[name] = theirs[name]
    return _result("Ankudinov with Kijima and Nakiri (Taimuri et al. 2020)", depth_ratio, values)


# Kijima and Nakiri ----------------------------------------------------------------------------------------------


def kijima_nakiri_multipliers(ship: Ship, depth_ratio: float) -> DepthMultipliers:
    """Multipliers of Kijima and Nakiri (1990 to 2003) for the second-order modulus model.

    Yv, Yv|v|, Nv and Nr go with ``1/(1 - T/h)^n - T/h``, the others with a cubic in T/h. That of Nr falls below 1
    around h/T = 3. Parameters and errors as :func:`ankudinov_factors`.
    """
    hull = _hull(ship, depth_ratio)
    th = hull.th
    x, y, z, s = hull.cb * hull.bt, (1.0 - hull.cb) / hull.bt, hull.cb / hull.bt, 1.0 - hull.cb

    def power(n: float) -> float:
        return (1.0 - th) ** -n - th

    def cubic(first: float, second: float, third: float) -> float:
        return 1.0 + first * th + second * th**2 + third * th**3

    values = {
        "Yv": power(0.40 * x),
        "Yv|v|": power(-0.26 * x + 1.74),
        "Nv": power(0.425 * x),
        "Nr": power(-14.28 * hull.tl + 1.5),
        "Yr": cubic(-5.5 * x**2 + 26 * x - 31.5, 37 * x**2 - 185 * x + 230, -38 * x**2 + 197 * x - 250),
        "Yr|r|": cubic(-15600 * s**5, 116000 * s**5, -128000 * s**5),
        "Yvvr": cubic(
            21500 * y**2 - 4800 * y + 220, -40800 * y**2 + 7500 * y - 274, -90800 * y**2 + 25500 * y - 1400
        ),
        "Nv|v|": cubic(-240 * s + 57, 1770 * s - 413, -1980 * s + 467),
        "Nr|r|": cubic(-1960 * y**2 + 448 * y - 25, 12220 * y**2 - 2720 * y + 146, -12160 * y**2 + 2650 * y - 137),
        "Nvvr": cubic(91 * z - 25, -515 * z + 144, 508 * z - 143),
        "Nvrr": cubic(40 * x - 88, -295 * x + 645, 312 * x - 678),
    }
    return _result("Kijima and Nakiri", depth_ratio, values)


# Li and Wu ------------------------------------------------------------------------------------------------------


def li_wu_multipliers(ship: Ship, depth_ratio: float) -> DepthMultipliers:
    """Multipliers of the added masses of Li and Wu 1990: Xudot, Yvdot, Nrdot.

    Parameters and errors as :func:`ankudinov_factors`.
    """
    hull = _hull(ship, depth_ratio)
    f, bt = hull.f, hull.bt
    if math.isinf(f):
        return _result("Li and Wu 1990", depth_ratio, {"Xudot": 1.0, "Yvdot": 1.0, "Nrdot": 1.0})
    surge = 3.77 + 1.14 * bt - 0.233 / hull.tl - 3.43 * hull.cb
    sway = 0.413 + 0.032 * bt + 0.0129 * bt**2
    yaw = 0.413 + 0.0192 * bt + 0.00554 * bt**2
    values = {
        "Xudot": 1.0 + surge / f**1.3,
        "Yvdot": 1.0 + sway / f**0.82,
        "Nrdot": 1.0 + yaw / f**0.82,
    }
    shrinking = [name for name, value in values.items() if value < 1.0]
    more = [f"added mass that shrinks in shallow water: {', '.join(shrinking)}"] if shrinking else []
    return _result("Li and Wu 1990", depth_ratio, values, *more)


# Propulsion and rudder ------------------------------------------------------------------------------------------


def amin_hasegawa_multipliers(ship: Ship, depth_ratio: float) -> DepthMultipliers:
    """Multipliers of the wake fraction, of 1 - t and of the flow straightening (Amin and Hasegawa 2010).

    Returns
    -------
    DepthMultipliers
        ``w``, ``1-t`` and ``gammaR``. The two branches of gammaR do not meet; copies exchange them, but only this
        order gives 1 in deep water.

    Other parameters and errors as :func:`ankudinov_factors`.
    """
    hull = _hull(ship, depth_ratio)
    th = hull.th
    lt, lb, bl = hull.cb / hull.tl, hull.cb / hull.bl, hull.cb * hull.bl
    deep = th <= 0.581 - 0.332 / hull.bt
    if deep:
        straightening = 1.0 + (-541 / 4 + 2432.95 * bl - 10137.7 * bl**2) * th**4.81
    else:
        straightening = 1.0 + (-5129 / 500 + 178.207 * bl - 2745 / 4 * bl**2) * (
            -1927 / 500 + 2733 / 200 * th - 2617 / 250 * th**2
        )
    values = {
        "w": 1.0 + (-4.932 + 0.6425 * lt - 0.0165 * lt**2) * th**1.655,
        "1-t": 1.0 + (29.495 - 14.089 * lb + 1.6486 * lb**2) * (1 / 250 - 7 / 200 * th - 13 / 125 * th**2),
        "gammaR": straightening,
    }
    return _result("Amin and Hasegawa 2010", depth_ratio, values)


# Derivative sets ------------------------------------------------------------------------------------------------


def ankudinov_in_shallow_water(
    derivatives: DerivativeSet, depth: float, *, added_mass: AddedMass = "ankudinov", form: Form = "corrected"
) -> DerivativeSet:
    """Deep-water set carried to a water depth with :func:`ankudinov_multipliers`.

    Parameters
    ----------
    derivatives : DerivativeSet
        Found in deep water.
    depth : float
        In m.
    added_mass : {"ankudinov", "li-wu"}
        Whose added masses; Ankudinov's have none for Xudot.
    form : {"corrected", "printed"}
        See :func:`ankudinov_factors`.

    Returns
    -------
    DerivativeSet
        With the ship in that depth. ``diagnostics["depth multipliers"]`` holds each multiplier,
        ``provenance.choices["depth doubts"]`` what is doubtful, terms without a multiplier among it.

    Raises
    ------
    ConventionError
        When the set was found in shallow water already, or the ship's volume is not known.
    TowtankError
        When there is no water under the keel.
    """
    found = ankudinov_multipliers(derivatives.ship, depth / derivatives.ship.T, form=form)
    return _corrected(derivatives, depth, found, added_mass)


def kijima_nakiri_in_shallow_water(
    derivatives: DerivativeSet, depth: float, *, added_mass: AddedMass = "li-wu"
) -> DerivativeSet:
    """Deep-water set carried to a water depth with :func:`kijima_nakiri_multipliers`.

    Parameters, result and errors as :func:`ankudinov_in_shallow_water`.
    """
    return _corrected(
        derivatives, depth, kijima_nakiri_multipliers(derivatives.ship, depth / derivatives.ship.T), added_mass
    )


_ADDED_MASS_TERMS = ("Xudot", "Yvdot", "Yrdot", "Nvdot", "Nrdot", "Kpdot")


def _corrected(
    derivatives: DerivativeSet, depth: float, multipliers: DepthMultipliers, added_mass: AddedMass
) -> DerivativeSet:
    ship = derivatives.ship
    if not math.isinf(ship.depth):
        raise ConventionError(
            f"'{derivatives.name}' was found in a depth of {ship.depth:g} m", cure="start from a deep-water set"
        )
    values = {name: value for name, value in multipliers.values.items() if name not in _ADDED_MASS_TERMS}
    doubts = list(multipliers.doubts)
    if added_mass == "li-wu":
        masses = li_wu_multipliers(ship, multipliers.depth_ratio)
        doubts += masses.doubts
    else:
        masses = ankudinov_factors(ship, multipliers.depth_ratio)
        masses = replace(
            masses, values={name: masses["gnr" if name == "Nrdot" else "gv"] for name in _ADDED_MASS_TERMS[1:5]}
        )
    values.update(masses.values)
    # The ship's own inertia does not depend on the depth.
    outside = derivatives.to(derivatives.conventions, rigid_body_inertia="outside")
    by_factors = {_key(Term.parse(name)): value for name, value in values.items()}
    factors = np.array([by_factors.get(_key(term), 1.0) for term in outside.terms])
    unchanged = [term.name for term in outside.terms if _key(term) not in by_factors]
    if unchanged:
        doubts.append(f"unchanged, for want of a multiplier: {', '.join(unchanged)}")
    covariance = outside.covariance
    note = f"carried to h/T = {multipliers.depth_ratio:.3g}: {multipliers.source}; added masses: {masses.source}"
    provenance = outside.provenance.and_then(note)
    changed = replace(
        outside,
        name=f"{derivatives.name}, h/T = {multipliers.depth_ratio:.3g}",
        ship=replace(ship, depth=depth),
        values=outside.values * factors,
        covariance=None if covariance is None else covariance * np.outer(factors, factors),
        diagnostics={
            **outside.diagnostics,
            "depth multipliers": dict(zip(outside.names, map(float, factors), strict=True)),
        },
        provenance=replace(provenance, choices={**provenance.choices, "depth doubts": tuple(doubts)}),
    )
    return changed.to(derivatives.conventions)


def _key(term: Term) -> tuple[str, tuple[tuple[str, int, int], ...]]:
    """What a term means, the drift angle counting as sway velocity."""
    factors = [
        ("v" if factor.variable == "beta" else factor.variable, factor.power, factor.modulus)
        for factor in term.factors
    ]
    return term.component, tuple(sorted(factors))
