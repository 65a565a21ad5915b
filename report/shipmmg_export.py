"""A derivative set as parameters of shipmmg's three-degree-of-freedom MMG model.

Names and equations are those of ``shipmmg.mmg_3dof`` (Mmg3DofManeuveringParams, Mmg3DofBasicParams): hull forces
over ``0.5 rho L_pp d U**2`` in v' and r' about midship, resistance R_0, added masses m_x, m_y, J_z outside the
derivatives (Yasukawa and Yoshimura 2015).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from ..core.terms import Factor, Term
from .export_heading import heading, no_place, number

PARAMETERS = {
    "R0": "R_0_dash",
    "Xvv": "X_vv_dash",
    "Xvr": "X_vr_dash",
    "Xrr": "X_rr_dash",
    "Xvvvv": "X_vvvv_dash",
    **{
        f"{force}{variables}": f"{force}_{variables}_dash"
        for force in "YN"
        for variables in ("v", "r", "vvv", "vvr", "vrr", "rrr")
    },
}
"""Terms of the model and their names there."""

ADDED_MASSES = {"Xudot": "m_x", "Yvdot": "m_y", "Nrdot": "J_z"}

_MODEL = "the MMG model of shipmmg"
_VARIABLES = {"v", "beta", "r", "udot", "vdot", "rdot"}

IGNORED = {
    "Yrdot": "shipmmg has no sway-yaw added mass",
    "Nvdot": "shipmmg has no sway-yaw added mass",
}


def shipmmg_text(derivatives: DerivativeSet) -> str:
    """Python source with the parameters of a set.

    Parameters
    ----------
    derivatives : DerivativeSet

    Returns
    -------
    str

    Raises
    ------
    ConventionError
        When a term has no place in the model, or the conversion to its conventions is not exact.
    """
    for term in derivatives.terms:
        if not set(term.variables) <= _VARIABLES:
            raise no_place(term, _MODEL)
    assumed: list[str] = []
    converted = _outside(derivatives, assumed)
    terms = {(term.component, term.factors): term for term in converted.terms}
    placed = {_key(name): parameter for name, parameter in PARAMETERS.items()}
    masses = {_key(name): parameter for name, parameter in ADDED_MASSES.items()}
    ignored = {_key(name): reason for name, reason in IGNORED.items()}
    for key, term in terms.items():
        if key not in placed and key not in masses and key not in ignored:
            raise no_place(term, _MODEL, term.name in derivatives)
    spread = converted.bse.to_dict()
    hull, absent = [], []
    for name, parameter in PARAMETERS.items():
        found = terms.get(_key(name))
        if found is None:
            absent.append(name)
            hull.append(f"    {parameter}=0.0,  # NOT IN THE SET")
            continue
        # the model's R_0_dash is a resistance: X = -R_0
        value = found.sign * Term.parse(name).sign * converted[found.name]
        hull.append(f"    {parameter}={number(value)},{_spread(spread[found.name])}")
    lines = heading(converted, derivatives, "shipmmg (mmg_3dof)")
    if absent:
        lines.append(f"NOT IN THE SET, written as 0: {', '.join(absent)}")
    lines += assumed
    for name, reason in IGNORED.items():
        found = terms.get(_key(name))
        if found is not None:
            lines.append(f"LEFT OUT: {name} = {number(converted[found.name])}: {reason}")
    ship = converted.ship
    if ship.xG:
        lines.append("shipmmg takes U from v - r x_G; here U is that of midship")
    lines.append("Call simulate_mmg_3dof(..., ρ=rho): its default is 1.025 (tonnes), the masses here are in kg.")
    lines.append("Usage: Mmg3DofManeuveringParams(k_0=..., k_1=..., k_2=..., **hull_derivatives)")
    comment = [f"# {line}".rstrip() for line in lines]
    return "\n".join([*comment, "", *_ship_lines(converted), "", "hull_derivatives = dict(", *hull, ")", ""])


def _key(name: str) -> tuple[str, tuple[Factor, ...]]:
    term = Term.parse(name)
    return term.component, term.factors


def _spread(std: float) -> str:
    return f"  # std {number(std, 3)}" if math.isfinite(std) and std > 0 else ""


def _outside(derivatives: DerivativeSet, assumed: list[str]) -> DerivativeSet:
    """The set in the conventions of the model; added masses that it lacks are taken as zero, and said so."""
    target = HOME.but(scale=derivatives.conventions.scale)
    plain = derivatives.to("lt")
    inside = plain.conventions.added_mass_coriolis != "outside"
    for name, holds in (("Xudot", ("Yr", "Yru")), ("Yvdot", ("Xvr",))):
        carried = [term for term in holds if term in plain]
        known = any((term.component, term.factors) == _key(name) for term in plain.terms)
        if known:
            continue
        if inside and carried:
            plain = _with_zero(plain, name)
            mass = ADDED_MASSES[name]
            assumed.append(
                f"ATTENTION: {name} is not in the set, so {mass} = 0 and {', '.join(carried)} keeps its added-mass"
                f" Coriolis term INSIDE. Do not set {mass} without taking that term out of {', '.join(carried)}."
            )
    try:
        return plain.to(target)
    except ConventionError as error:
        raise ConventionError(
            f"'{derivatives.name}' cannot be written in the conventions of shipmmg: {error.cause}", cure=error.cure
        ) from None


def _with_zero(derivatives: DerivativeSet, name: str) -> DerivativeSet:
    """The set with one more term of value zero and no uncertainty."""
    size = len(derivatives)
    covariance = None
    if derivatives.covariance is not None:
        covariance = np.zeros((size + 1, size + 1))
        covariance[:size, :size] = derivatives.covariance
    return replace(
        derivatives,
        terms=(*derivatives.terms, Term.parse(name)),
        values=np.append(derivatives.values, 0.0),
        covariance=covariance,
    )


def _ship_lines(converted: DerivativeSet) -> list[str]:
    """Particulars and added masses, as far as they are known, in SI."""
    ship = converted.ship
    lines = [
        f"rho = {number(ship.rho)}  # kg/m3",
        f"L_pp, B, d = {number(ship.L)}, {number(ship.B)}, {number(ship.T)}  # m",
        f"x_G = {number(ship.xG)}  # m forward of midship",
    ]
    mass, inertia = ship.displacement_mass, ship.yaw_inertia
    lines.append(f"m = {number(mass)}  # kg" if mass is not None else "# m: the mass is not known")
    lines.append(
        f"I_zG = {number(inertia)}  # kg m2" if inertia is not None else "# I_zG: the yaw inertia is not known"
    )
    spread = converted.bse.to_dict()
    for name, mass_name in ADDED_MASSES.items():
        term = next((t for t in converted.terms if (t.component, t.factors) == _key(name)), None)
        if term is None:
            lines.append(f"# {mass_name}: {name} is not in the set")
            continue
        power = 4 if name == "Nrdot" else 2
        value = -converted[term.name]
        lines.append(f"{mass_name} = {number(value)} * 0.5 * rho * L_pp**{power} * d{_spread(spread[term.name])}")
    return lines
