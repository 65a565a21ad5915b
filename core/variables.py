"""The motion variables that hull-force terms are made of, and how each is made non-dimensional.

A variable is scaled as ``x' = x L**length / U**speed``; with ``bis`` scaling the speed is ``sqrt(g L)``.
``mirrored`` says whether the variable changes sign when port and starboard are exchanged.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Variable:
    """One motion variable.

    Attributes
    ----------
    name : str
        Name in this package.
    token : str
        Its spelling inside a derivative's name (``Yvvphi`` holds ``v``, ``v``, ``phi``).
    length, speed : int
        Exponents of the non-dimensional form ``x' = x L**length / U**speed``.
    mirrored : bool
        True when it changes sign under exchange of port and starboard.
    angle : bool
        True for angles, whose unit (rad or deg) is a convention.
    unit : str
        SI unit.
    meaning : str
        One line for tables.
    """

    name: str
    token: str
    length: int
    speed: int
    mirrored: bool
    angle: bool
    unit: str
    meaning: str


_ALL = (
    Variable("v", "v", 0, 1, True, False, "m/s", "sway velocity"),
    # before beta: in the other order the spelling of both together would read as beta
    Variable("eta", "eta", -1, 0, False, False, "m", "lateral deviation towards a bank to starboard"),
    Variable("beta", "b", 0, 0, True, True, "rad", "drift angle"),
    Variable("r", "r", 1, 1, True, False, "rad/s", "yaw rate"),
    Variable("p", "p", 1, 1, True, False, "rad/s", "roll rate"),
    Variable("phi", "phi", 0, 0, True, True, "rad", "roll angle"),
    Variable("u", "u", 0, 1, False, False, "m/s", "surge velocity less the approach speed"),
    Variable("surge", "surge", 0, 1, False, False, "m/s", "surge velocity"),
    Variable("delta", "d", 0, 0, True, True, "rad", "rudder angle"),
    Variable("c", "c", 0, 1, False, False, "m/s", "flow velocity at the rudder"),
    Variable("thrust", "T", 1, 2, False, False, "m/s2", "propeller thrust over the mass of the ship"),
    Variable("depth", "z", 0, 0, False, False, "-", "depth parameter T/(h-T)"),
    Variable("udot", "udot", 1, 2, False, False, "m/s2", "surge acceleration"),
    Variable("vdot", "vdot", 1, 2, True, False, "m/s2", "sway acceleration"),
    Variable("rdot", "rdot", 2, 2, True, False, "rad/s2", "yaw acceleration"),
    Variable("pdot", "pdot", 2, 2, True, False, "rad/s2", "roll acceleration"),
)

VARIABLES: dict[str, Variable] = {variable.name: variable for variable in _ALL}

ORDER: dict[str, int] = {variable.name: position for position, variable in enumerate(_ALL)}

TOKENS: dict[str, str] = {variable.token: variable.name for variable in _ALL} | {
    "beta": "beta",
    "delta": "delta",
}

GRAVITY = 9.80665
"""Standard gravity in m/s2."""
