"""Sway and yaw of a ship that is disturbed from its straight course, from any derivative set.

The equations are, in prime form with the time over L/U and at midship in home axes::

    M (dv'/dt', dr'/dt') = D (v', r') + b delta        M = -[[Yvdot, Yrdot], [Nvdot, Nrdot]]
                                                       D =  [[Yv, Yr], [Nv, Nr]],  b = (Yd, Nd)

where the derivatives hold the ship's inertia and all added-mass terms (``Yr - m' - mx'``, ``Nr - m' xG'``, ...):
in this form they mean the same for an MMG and for an Abkowitz set. Roll is held.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.conventions import HOME, Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from ..core.ship import Ship
from ..core.terms import Factor, Term
from ..core.variables import VARIABLES

NAMES = ("Yv", "Yr", "Nv", "Nr", "Yvdot", "Yrdot", "Nvdot", "Nrdot", "Yd", "Nd")

_LATERAL = ("v", "beta", "r", "vdot", "rdot", "delta")
_VELOCITIES = ("Yv", "Yr", "Nv", "Nr")
_COUPLED_INERTIA = ("Yrdot", "Nvdot")
_ON_COURSE = {"surge": 1.0, "u": 0.0, "udot": 0.0, "eta": 0.0}
"""Scaled variables of a ship on its course at its own speed; the depth parameter is that of the ship."""


@dataclass(frozen=True, eq=False)
class LinearMotion:
    """Linear sway and yaw equations of a ship at constant speed.

    Attributes
    ----------
    ship : Ship
    derivatives : DerivativeSet
        Those of :data:`NAMES` that are known, over ``0.5 rho L T U^2``, with all inertia inside.
    without_inertia : str
        Why the mass matrix is not known; empty when it is.
    """

    ship: Ship
    derivatives: DerivativeSet
    without_inertia: str = ""

    def value(self, name: str) -> float:
        """One of :data:`NAMES`; 0 when the set does not have it."""
        return self.derivatives[name] if name in self.derivatives else 0.0

    @property
    def damping(self) -> np.ndarray:
        """D, shape (2, 2)."""
        return np.array([[self.value("Yv"), self.value("Yr")], [self.value("Nv"), self.value("Nr")]])

    @property
    def mass(self) -> np.ndarray:
        """M, shape (2, 2).

        Raises
        ------
        ConventionError
            When the set has no added masses or the ship no yaw inertia.
        """
        if self.without_inertia:
            raise ConventionError(
                f"{self.derivatives.name}: {self.without_inertia}",
                cure="give Yvdot and Nrdot (Yvdot = -my', Nrdot = -Jz') and the ship's Izz or kzz",
            )
        return -np.array([[self.value("Yvdot"), self.value("Yrdot")], [self.value("Nvdot"), self.value("Nrdot")]])

    @property
    def rudder(self) -> np.ndarray:
        """b, shape (2,): rudder positive when it turns the ship to starboard.

        Raises
        ------
        ConventionError
            When the set has no rudder derivatives.
        """
        if "Nd" not in self.derivatives:
            raise ConventionError(
                f"{self.derivatives.name} has no rudder derivatives", cure="add Yd and Nd to the set"
            )
        return np.array([self.value("Yd"), self.value("Nd")])

    @property
    def free(self) -> np.ndarray:
        """Rates of (v', r') from themselves, the inverse of M times D, shape (2, 2)."""
        return np.linalg.solve(self.mass, self.damping)

    @property
    def by_rudder(self) -> np.ndarray:
        """Rates of (v', r') from the rudder angle, shape (2,)."""
        return np.linalg.solve(self.mass, self.rudder)

    def covariance(self, names: tuple[str, ...]) -> np.ndarray | None:
        """Covariance of the named derivatives, 0 for those that the set does not have; None when unknown."""
        known = self.derivatives.covariance
        if known is None:
            return None
        have = self.derivatives.names
        found = np.zeros((len(names), len(names)))
        for i, first in enumerate(names):
            for j, second in enumerate(names):
                if first in have and second in have:
                    found[i, j] = known[have.index(first), have.index(second)]
        return found


def linear_motion(derivatives: DerivativeSet) -> LinearMotion:
    """Linear part of a derivative set about the straight course, in one form for all conventions.

    Parameters
    ----------
    derivatives : DerivativeSet
        In any conventions; terms in the surge velocity and the water depth are taken at the ship's own speed and
        depth, terms in heel, bank distance and propeller thrust at 0. A covariance is carried along.

    Raises
    ------
    ConventionError
        When Yv, Yr, Nv or Nr is missing, or what the change of conventions needs (the mass of the ship; Xudot
        where the added-mass Coriolis terms are outside).
    """
    linear = _linear_set(derivatives)
    names = set(linear.names)
    missing = ""
    if not {"Yvdot", "Nrdot"} <= names:
        missing = "the set has no added masses"
    elif linear.ship.yaw_inertia is None and linear.conventions.rigid_body_inertia == "outside":
        missing = f"the yaw inertia of '{linear.ship.name}' is not known"
    if missing:
        # Yvdot stays: the Coriolis terms of some conventions need it.
        linear = linear.subset([name for name in linear.names if name not in (*_COUPLED_INERTIA, "Nrdot")])
    else:
        # A set that does not name the coupled inertia still has m' xG' there.
        linear = linear.with_values(**{name: 0.0 for name in _COUPLED_INERTIA if name not in names})
    found = linear.to(_target(linear.conventions))
    kept = [name for name in NAMES if name in found.names]
    absent = [name for name in _VELOCITIES if name not in kept]
    if absent:
        raise ConventionError(
            f"'{derivatives.name}' has no {absent[0]}", cure="straight-line stability needs Yv, Yr, Nv and Nr"
        )
    return LinearMotion(derivatives.ship, found.subset(kept), missing)


def _target(conventions: Conventions) -> Conventions:
    return HOME.but(
        velocity_scale="approach",
        rigid_body_inertia="inside",
        added_mass_coriolis="inside",
        scale=conventions.scale,
        wave_heading=conventions.wave_heading,
    )


def _linear_set(derivatives: DerivativeSet) -> DerivativeSet:
    """Terms of one lateral variable, the others at their value on the course, over ``0.5 rho L T U^2``."""
    chosen = [term for term in derivatives.terms if _target_name(term)]
    scaled = derivatives.subset([term.name for term in chosen]).to("lt")
    names: dict[str, list[float]] = {}
    for column, term in enumerate(scaled.terms):
        row = names.setdefault(_target_name(term), [0.0] * len(scaled))
        row[column] += term.sign * _on_course(term, derivatives)
    fold = np.array(list(names.values())).reshape(len(names), len(scaled))
    covariance = None if scaled.covariance is None else fold @ scaled.covariance @ fold.T
    return DerivativeSet(
        name=derivatives.name,
        ship=derivatives.ship,
        terms=tuple(Term.parse(name) for name in names),
        values=fold @ scaled.values,
        conventions=scaled.conventions,
        covariance=covariance,
        reference_speed=scaled.reference_speed,
        provenance=scaled.provenance.and_then("linear part about the straight course"),
    )


def _target_name(term: Term) -> str:
    """Linear derivative that a term belongs to, ``Yv`` for ``Yuv``; empty for a term that is none."""
    if term.component == "X":
        plain = [factor for factor in term.factors if factor.variable != "depth"]
        return "Xudot" if plain == [Factor("udot", 1)] else ""
    lateral = [factor for factor in term.factors if VARIABLES[factor.variable].mirrored]
    if term.component == "K" or len(lateral) != 1 or lateral[0].variable not in _LATERAL:
        return ""
    if (lateral[0].power, lateral[0].modulus) != (1, 0):
        return ""
    others = {factor.variable for factor in term.factors} - {lateral[0].variable}
    if not others <= {*_ON_COURSE, "depth"}:
        return ""
    return Term.spell(term.component, lateral).name


def _on_course(term: Term, derivatives: DerivativeSet) -> float:
    """Product of the factors beside the lateral one."""
    ship = derivatives.ship
    value = 1.0
    for factor in term.factors:
        if factor.variable == "depth":
            value *= (ship.T / (ship.depth - ship.T)) ** factor.degree
        elif factor.variable in _ON_COURSE and factor.variable != "udot":
            value *= _ON_COURSE[factor.variable] ** factor.degree
    return value
