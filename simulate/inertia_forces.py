"""Mass matrix and forces of inertia of a hull: the rigid body and the added masses, each placed once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import SimulationError
from ..core.motion import force_units, origin_position
from ..core.scales import variable_unit
from ..core.ship import Ship
from ..core.terms import Term
from ..core.variables import GRAVITY
from .parameters import Parameter

_ACCELERATIONS = {"udot": 0, "vdot": 1, "rdot": 2, "pdot": 3}
_ROWS = {"X": 0, "Y": 1, "N": 2, "K": 3}
_NEEDED = (("X", "udot", "Xudot"), ("Y", "vdot", "Yvdot"), ("N", "rdot", "Nrdot"))

FloatArray = np.ndarray


@dataclass(frozen=True)
class RollBody:
    """Roll inertia about the origin in kg m2, metacentric height in m, depth of the centre of gravity below the roll
    axis in m, height arm of the surge added mass in m; each a number or one a draw."""

    Ixx: float | FloatArray
    GM: float | FloatArray
    zG: float | FloatArray
    lx: float | FloatArray


def is_acceleration(term: Term) -> bool:
    """True when a term holds one acceleration to the first power, and at most the depth beside it."""
    rest = [factor for factor in term.factors if factor.variable != "depth"]
    return len(rest) == 1 and rest[0].variable in _ACCELERATIONS and (rest[0].power, rest[0].modulus) == (1, 0)


def added_mass_matrix(terms: list[Term], values: FloatArray, ship: Ship, conventions: Conventions) -> FloatArray:
    """Minus the acceleration terms, about the origin of the set in home axes, shape (draws, 4, 4), SI.

    Rows X, Y, N, K; columns u, v, r, p. The ship's mass is in it when the set says so.
    """
    matrix = np.zeros((len(values), 4, 4))
    for term, value in zip(terms, values.T, strict=True):
        factor = next(f for f in term.factors if f.variable in _ACCELERATIONS)
        unit = float(force_units(term.component, ship, conventions, 1.0))
        unit /= variable_unit(factor.variable, conventions.force_scaling, ship, 1.0)
        if conventions.axes == "forward-port-up" and factor.variable in ("vdot", "rdot"):
            unit = -unit
        matrix[:, _ROWS[term.component], _ACCELERATIONS[factor.variable]] -= term.sign * unit * value
    return matrix


def require_added_mass(names: set[tuple[str, str]], set_name: str) -> None:
    """Raise unless surge, sway and yaw have an acceleration term each."""
    for component, variable, term in _NEEDED:
        if (component, variable) not in names:
            raise SimulationError(
                f"set '{set_name}' has no {term}, so nothing is known about that added mass",
                cure=f"add it: hull.with_values({term}=...), e.g. from a chart or an empirical formula",
            )


def acceleration_of(term: Term) -> tuple[str, str]:
    """Component and acceleration of an acceleration term."""
    return term.component, next(f.variable for f in term.factors if f.variable in _ACCELERATIONS)


def inertia_parameters(
    parameters: FloatArray,
    added: FloatArray,
    ship: Ship,
    conventions: Conventions,
    roll: RollBody | None,
) -> None:
    """Fill in the inverse mass matrix and the coefficients of the forces of inertia.

    Parameters
    ----------
    parameters : ndarray, shape (draws, n)
        Written to.
    added : ndarray, shape (draws, 4, 4)
        From :func:`added_mass_matrix`.
    ship : Ship
    conventions : Conventions
        Say what stands in the derivatives already: the ship's own inertia, the Coriolis terms of the added mass.
    roll : RollBody or None
        None for a ship that does not roll.
    """
    mass, inertia = ship.displacement_mass, ship.yaw_inertia
    inside = conventions.rigid_body_inertia == "inside"
    if not inside and (mass is None or inertia is None):
        raise SimulationError(
            f"the {'mass' if mass is None else 'yaw inertia'} of '{ship.name}' is not known",
            cure="give the ship's volume or mass, and its Izz or kzz",
        )
    lever = origin_position(conventions, ship) * ship.L
    shift = np.eye(4)
    shift[1, 2] = lever
    zG: float | FloatArray = 0.0 if roll is None else roll.zG

    def put(place: int, value: float | FloatArray) -> None:
        parameters[:, place] += value

    total = shift.T @ added @ shift
    own = np.zeros_like(total)
    if mass is not None and inertia is not None:
        own[:, 0, 0] = own[:, 1, 1] = mass
        own[:, 1, 2] = own[:, 2, 1] = mass * ship.xG
        own[:, 2, 2] = inertia + mass * ship.xG**2
        own[:, 1, 3] = own[:, 3, 1] = -mass * zG
        own[:, 2, 3] = own[:, 3, 2] = -mass * ship.xG * zG
        own[:, 3, 3] = 0.0 if roll is None else roll.Ixx
    if not inside:
        total = total + own
        assert mass is not None
        put(Parameter.X_VR, mass)
        put(Parameter.X_RR, mass * ship.xG)
        put(Parameter.X_PR, -mass * zG)
        put(Parameter.Y_UR, -mass)
        put(Parameter.N_UR, -mass * ship.xG)
        put(Parameter.K_UR, mass * zG)
    if conventions.added_mass_coriolis != "inside":
        if inside:
            # the added mass alone, about the origin of the set
            back = np.eye(4)
            back[1, 2] = -lever
            added = added - back.T @ own @ back
        surge, sway, coupling = added[:, 0, 0], added[:, 1, 1], added[:, 1, 2]
        put(Parameter.X_VR, sway)
        put(Parameter.X_RR, sway * lever)
        put(Parameter.Y_UR, -surge)
        put(Parameter.N_UR, -lever * surge)
        if conventions.added_mass_coriolis == "outside-with-munk":
            put(Parameter.X_RR, coupling)
            put(Parameter.N_UV, surge - sway)
            put(Parameter.N_UR, (surge - sway) * lever - coupling)
        if roll is not None:
            put(Parameter.K_UR, surge * roll.lx)
    if roll is None:
        _put_inverse(parameters, total[:, :3, :3])
        return
    assert mass is not None
    put(Parameter.K_PHI, mass * GRAVITY * roll.GM)
    _put_inverse(parameters, total)


def _put_inverse(parameters: FloatArray, matrix: FloatArray) -> None:
    """Write the inverse of the mass matrix; surge is coupled with nothing."""
    surge, lateral = matrix[:, 0, 0], matrix[:, 1:, 1:]
    sound = (surge > 0.0) & (np.linalg.det(lateral) > 0.0) & (lateral[:, 0, 0] > 0.0) & (lateral[:, 1, 1] > 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        # a draw whose mass is not positive is left for the kernel to count as diverged
        parameters[:, Parameter.MASS_U] = np.where(sound, 1.0 / surge, np.nan)
    safe = np.where(sound[:, None, None], lateral, np.eye(lateral.shape[1]))
    inverse = np.linalg.inv(safe)
    places = (
        (Parameter.MASS_V_V, Parameter.MASS_V_R, Parameter.MASS_V_P),
        (Parameter.MASS_R_V, Parameter.MASS_R_R, Parameter.MASS_R_P),
        (Parameter.MASS_P_V, Parameter.MASS_P_R, Parameter.MASS_P_P),
    )
    for i in range(inverse.shape[1]):
        for j in range(inverse.shape[1]):
            parameters[:, places[i][j]] = inverse[:, i, j]
