"""Units of force and of motion in each force scaling."""

from __future__ import annotations

import math

from .errors import ConventionError
from .ship import Ship
from .variables import GRAVITY, VARIABLES


def force_unit(component: str, scaling: str, ship: Ship, speed: float) -> float:
    """Newtons (or newton-metres for N and K) in one unit of a scaled force.

    Parameters
    ----------
    component : {"X", "Y", "N", "K"}
    scaling : {"LT", "L2", "bis", "dimensional"}
    ship : Ship
    speed : float
        Reference speed in m/s.

    Notes
    -----
    Prime I and bis: SNAME 1950, Norrbin 1971; ``LT``: Yasukawa and Yoshimura 2015. The roll moment is scaled
    like the yaw moment, by L, as in the pure car carrier paper of MASHCON 2019.
    """
    lever = ship.L if component in ("N", "K") else 1.0
    if scaling == "dimensional":
        return 1.0
    if scaling == "LT":
        return 0.5 * ship.rho * ship.L * ship.T * speed**2 * lever
    if scaling == "L2":
        return 0.5 * ship.rho * ship.L**2 * speed**2 * lever
    mass = ship.displacement_mass
    if mass is None:
        raise ConventionError(
            f"bis scaling of '{ship.name}' needs its mass", cure="give the ship's volume or mass"
        )
    return mass * GRAVITY * lever


def variable_unit(variable: str, scaling: str, ship: Ship, speed: float) -> float:
    """SI units in one unit of a scaled motion variable: ``U**speed / L**length``."""
    if scaling == "dimensional":
        return 1.0
    kind = VARIABLES[variable]
    reference = math.sqrt(GRAVITY * ship.L) if scaling == "bis" else speed
    return float(reference**kind.speed / ship.L**kind.length)


def mass_coefficient(ship: Ship) -> float:
    """Mass over ``0.5 rho L**2 T``, m'.

    Raises
    ------
    ConventionError
        When the ship's mass is not known.
    """
    mass = ship.displacement_mass
    if mass is None:
        raise ConventionError(f"the mass of '{ship.name}' is not known", cure="give the ship's volume or mass")
    return mass / (0.5 * ship.rho * ship.L**2 * ship.T)


def yaw_inertia_coefficient(ship: Ship) -> float:
    """Yaw inertia about midship over ``0.5 rho L**4 T``, (Izz + m xG**2)'.

    Raises
    ------
    ConventionError
        When mass or inertia is not known.
    """
    inertia, mass = ship.yaw_inertia, ship.displacement_mass
    if inertia is None or mass is None:
        raise ConventionError(f"the yaw inertia of '{ship.name}' is not known", cure="give the ship's Izz or kzz")
    return (inertia + mass * ship.xG**2) / (0.5 * ship.rho * ship.L**4 * ship.T)
