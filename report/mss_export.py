"""A derivative set as MATLAB code for the Marine Systems Simulator (MSS), in the form of its ``mariner.m``.

``mariner.m`` holds prime-I derivatives about midship, speeds over the instantaneous U, a rudder angle that turns
the ship to port when positive, and masses m, Iz about midship, xG over L. Its forces have no centripetal terms,
because the velocity derivatives of the Mariner hold the mass. A set that does not hold it gets these terms written
out, as in ``navalvessel.m``, whose names for moduli (Yvav for v|v|) are used too; so does one without the
added-mass Coriolis terms. No term is changed for that, so the force is the same to the last digit.
"""

from __future__ import annotations

import math
import re

from ..core.conventions import HOME
from ..core.derivative_set import DerivativeSet
from ..core.errors import ConventionError
from ..core.scales import mass_coefficient, yaw_inertia_coefficient
from ..core.terms import Factor, Term
from .export_heading import heading, no_place, number

_VARIABLES = {"u": "u", "v": "v", "r": "r", "delta": "delta", "surge": "(U0/U+u)"}
_TOKENS = {"u": "u", "v": "v", "r": "r", "delta": "d", "surge": "s"}
_ACCELERATIONS = {"udot", "vdot", "rdot"}
_MASS_TERMS = ("Xudot", "Yvdot", "Yrdot", "Nvdot", "Nrdot")
_SPELLED = {"Xvr": "Xrv"}
"""Names that mariner.m spells in its own way."""


def mss_text(derivatives: DerivativeSet) -> str:
    """MATLAB source that takes the place of the parameters and forces in ``mariner.m``.

    Parameters
    ----------
    derivatives : DerivativeSet

    Returns
    -------
    str

    Raises
    ------
    ConventionError
        When a term has no place in that model, or the conversion to its conventions is not exact.
    """
    converted = _prime(derivatives)
    ship = converted.ship
    constant = [term for term in converted.terms if not term.factors and term.component == "X"]
    masses = [term for term in converted.terms if set(term.variables) & _ACCELERATIONS]
    forces = [term for term in converted.terms if term not in masses and term not in constant]
    own = {(term.component, term.factors) for term in derivatives.terms}
    for term in (*masses, *forces):
        _check_place(term, (term.component, term.factors) in own)
    spread = converted.bse.to_dict()
    lines = [f"% {line}".rstrip() for line in heading(converted, derivatives, "MSS (mariner.m)")]
    absent = [name for name in _MASS_TERMS if name not in {_plain_name(term) for term in masses}]
    if absent:
        lines.append(f"% NOT IN THE SET, written as 0: {', '.join(absent)}")
    lines.append("% Put this in place of the parameters and of the forces and moments of mariner.m.")
    lines += ["", *_particulars(converted), ""]
    for name in absent:
        lines.append(f"{name} = 0;    % NOT IN THE SET")
    inside = _mass_inside(converted, masses)
    for term in masses:
        lines.append(_assignment(term, converted[term.name] + inside[term.name], spread[term.name]))
    for term in (*forces, *constant):
        lines.append(_assignment(term, converted[term.name], spread[term.name]))
    lines += ["", *_mass_matrix(), "", "% Forces and moments"]
    centripetal = _centripetal(converted)
    for component in "XYN":
        products = [_product(term) for term in forces if term.component == component]
        lines += _sum(component, [*products, *centripetal[component]] or ["0"])
    for term in constant:
        resistance = "R0" if term.sign < 0 else "-X0"
        lines += [
            f"% {matlab_name(term)} is left out of X: mariner.m takes the thrust as equal to the resistance.",
            "% With the thrust of the approach speed held:",
            f"% X = X + {resistance}*((U0/U)^2 - 1);",
        ]
    lines.append(f"% {ship.name}: rudder angle delta is positive when it turns the ship to port, as in mariner.m.")
    return "\n".join([*lines, ""])


def matlab_name(term: Term) -> str:
    """Name of a term as a MATLAB variable: its own where MATLAB allows it; ``Yv|v|`` is Yvav."""
    plain = _plain_name(term)
    if plain not in _MASS_TERMS and term.name.isidentifier():
        plain = term.name
    return _SPELLED.get(plain, plain)


def _plain_name(term: Term) -> str:
    if set(term.variables) & _ACCELERATIONS:
        return Term.spell(term.component, term.factors).name
    parts = []
    for factor in term.factors:
        token = _TOKENS.get(factor.variable, factor.variable)
        parts.append(token * factor.power + f"a{token}" * factor.modulus)
    return term.component + ("".join(parts) or "0")


def _prime(derivatives: DerivativeSet) -> DerivativeSet:
    """The set in prime I about midship; what holds the mass and what scales the speed stay as they are."""
    own = derivatives.conventions
    munk = own.added_mass_coriolis == "outside-with-munk"
    conventions = HOME.but(
        force_scaling="L2",
        rudder_sign="port",
        velocity_scale=own.velocity_scale,
        rigid_body_inertia=own.rigid_body_inertia,
        added_mass_coriolis="outside" if munk else own.added_mass_coriolis,
        scale=own.scale,
    )
    try:
        return derivatives.to(conventions)
    except ConventionError as error:
        raise ConventionError(
            f"'{derivatives.name}' cannot be written in the conventions of MSS: {error.cause}", cure=error.cure
        ) from None


def _mass_inside(converted: DerivativeSet, masses: list[Term]) -> dict[str, float]:
    """What is added to each acceleration derivative so that it is one of added mass alone."""
    inside = dict.fromkeys((term.name for term in masses), 0.0)
    if converted.conventions.rigid_body_inertia != "inside":
        return inside
    ship = converted.ship
    ratio = ship.T / ship.L  # of the LT to the L2 scaling
    for term in masses:
        name = Term.spell(term.component, term.factors).name
        if name in ("Xudot", "Yvdot"):
            inside[term.name] = ratio * mass_coefficient(ship)
        elif name in ("Yrdot", "Nvdot"):
            inside[term.name] = ratio * mass_coefficient(ship) * ship.xG / ship.L
        else:
            inside[term.name] = ratio * yaw_inertia_coefficient(ship)
    return inside


def _centripetal(converted: DerivativeSet) -> dict[str, list[str]]:
    """Centripetal terms of mass and added mass that the derivatives do not hold."""
    terms: dict[str, list[str]] = {"X": [], "Y": [], "N": []}
    if converted.conventions.added_mass_coriolis == "outside":
        terms["X"].append("- Yvdot*v*r")
        terms["Y"].append("Xudot*(U0/U+u)*r")
    if converted.conventions.rigid_body_inertia == "outside":
        terms["X"] += ["m*v*r", "m*xG*r^2"]
        terms["Y"].append("- m*(U0/U+u)*r")
        terms["N"].append("- m*xG*(U0/U+u)*r")
    return terms


def _check_place(term: Term, is_own: bool) -> None:
    if set(term.variables) & _ACCELERATIONS:
        fits = Term.spell(term.component, term.factors).name in _MASS_TERMS
    else:
        fits = term.component in "XYN" and set(term.variables) <= set(_VARIABLES)
    if not fits:
        raise no_place(term, "the three-degree-of-freedom model of MSS (mariner.m)", is_own)


def _particulars(converted: DerivativeSet) -> list[str]:
    """Length, approach speed, and masses over 0.5 rho L^3 and 0.5 rho L^5."""
    ship = converted.ship
    mass, inertia = ship.displacement_mass, ship.yaw_inertia
    speed = converted.reference_speed
    unit = 0.5 * ship.rho * ship.L**3
    lines = [f"L = {number(ship.L)};    % length between perpendiculars (m)"]
    if speed is None:
        lines.append("% U0: the set has no reference speed; give the approach speed (m/s)")
    else:
        lines.append(f"U0 = {number(speed)};    % approach speed (m/s)")
    if mass is None:
        lines.append("% m, Iz: the mass of the ship is not known; give m = mass/(0.5*rho*L^3)")
    else:
        lines.append(f"m = {number(mass / unit)};    % mass/(0.5*rho*L^3)")
        if inertia is None:
            lines.append("% Iz: the yaw inertia of the ship is not known; give it about midship over 0.5*rho*L^5")
        else:
            about = inertia + mass * ship.xG**2
            lines.append(f"Iz = {number(about / (unit * ship.L**2))};    % about midship, over 0.5*rho*L^5")
    lines.append(f"xG = {number(ship.xG / ship.L)};    % over L, forward of midship")
    if converted.conventions.velocity_scale == "approach":
        lines += [
            "% This set is scaled with the approach speed, so the states are too:",
            "U = U0;",
            "u = x(1)/U;",
            "v = x(2)/U;",
            "r = x(3)*L/U;",
        ]
    return lines


def _assignment(term: Term, value: float, std: float) -> str:
    spread = f"    % std {number(std, 3)}" if math.isfinite(std) and std > 0 else ""
    return f"{matlab_name(term)} = {number(value)};{spread}"


def _mass_matrix() -> list[str]:
    return [
        "% Masses and moments of inertia",
        "m11 = m-Xudot;",
        "m22 = m-Yvdot;",
        "m23 = m*xG-Yrdot;",
        "m32 = m*xG-Nvdot;",
        "m33 = Iz-Nrdot;",
    ]


def _product(term: Term) -> str:
    factors = [_power(factor) for factor in term.factors]
    sign = "- " if term.sign < 0 else ""
    return sign + "*".join([matlab_name(term), *(part for parts in factors for part in parts)])


def _power(factor: Factor) -> list[str]:
    variable = _VARIABLES[factor.variable]
    parts = []
    if factor.power:
        parts.append(variable if factor.power == 1 else f"{variable}^{factor.power}")
    if factor.modulus:
        size = f"abs({variable})"
        parts.append(size if factor.modulus == 1 else f"{size}^{factor.modulus}")
    return parts


def _sum(component: str, products: list[str], width: int = 84) -> list[str]:
    """``X = a + b + ...;`` over as many lines as it needs."""
    text = " + ".join(products).replace("+ - ", "- ")
    pieces = re.split(r" (?=[+-] )", text)
    lines = [f"{component} = {pieces[0]}"]
    for piece in pieces[1:]:
        if len(lines[-1]) + len(piece) > width:
            lines[-1] += " ..."
            lines.append(f"    {piece}")
        else:
            lines[-1] += f" {piece}"
    lines[-1] += ";"
    return lines
