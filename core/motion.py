"""From a motion in SI at midship to the scaled variables of any convention, and forces back again.

This is the exact route: no series. Fits build their design matrix with it, simulators and virtual campaigns
their forces.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping

import numpy as np

from .conventions import Conventions
from .errors import ConventionError
from .scales import force_unit, variable_unit
from .ship import Ship
from .variables import VARIABLES

Motion = Mapping[str, np.ndarray | float]


def origin_position(conventions: Conventions, ship: Ship) -> float:
    """x/L of the reference point forward of midship."""
    if conventions.origin == "midship":
        return 0.0
    if conventions.origin == "cog":
        return ship.xG / ship.L
    return float(conventions.origin)


def scaled_state(
    motion: Motion,
    ship: Ship,
    conventions: Conventions,
    approach_speed: float | np.ndarray | None = None,
    *,
    only: Collection[str] | None = None,
) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """Variables of the terms, in the units and signs of `conventions`.

    Parameters
    ----------
    motion : mapping
        Motion of midship in home axes and SI: ``surge`` (velocity ahead, m/s), ``v``, ``r``, and where known
        ``udot``, ``vdot``, ``rdot``, ``p``, ``pdot``, ``phi`` (rad), ``delta`` (rad, positive to starboard),
        ``eta`` (m), and further variables of :data:`~towtank.core.variables.VARIABLES`; arrays of shape (n,)
        or numbers.
    ship : Ship
    conventions : Conventions
    approach_speed : float or ndarray, optional
        U0 in m/s: needed for terms in ``u`` and for ``velocity_scale = "approach"``.
    only : collection of str, optional
        Variables that are wanted; all that the motion gives when None.

    Returns
    -------
    state : dict of str to ndarray
        Scaled variables.
    speed : ndarray
        The speed in m/s that scales the forces.
    """
    if conventions.force_scaling not in ("LT", "L2"):
        raise ConventionError(
            f"a motion is not scaled by '{conventions.force_scaling}'",
            cure="convert the set to LT or L2 first",
        )
    x = {name: np.asarray(value, dtype=float) for name, value in motion.items() if name in VARIABLES}
    surge = x["surge"]
    x.setdefault("r", np.zeros(()))
    x["v"] = _at_origin(x.get("v", np.zeros(())), x["r"], conventions, ship)
    if "vdot" in x and "rdot" in x:
        x["vdot"] = _at_origin(x["vdot"], x["rdot"], conventions, ship)
    if only is None or "beta" in only:
        drift = np.arctan2(-x["v"], surge)
        x["beta"] = drift if conventions.drift_sign == "-v" else -drift
    if approach_speed is not None:
        x["u"] = surge - np.asarray(approach_speed, dtype=float)
    if conventions.velocity_scale == "approach":
        if approach_speed is None:
            raise ConventionError("the approach speed is needed", cure="give the carriage speed of the run")
        speed = np.broadcast_to(np.asarray(approach_speed, dtype=float), np.shape(x["v"]))
    else:
        speed = np.sqrt(surge * surge + x["v"] * x["v"])
    if only is not None:
        x = {name: value for name, value in x.items() if name in only}
    square = speed * speed
    for name, value in x.items():
        kind = VARIABLES[name]
        unit = 1.0 / variable_unit(name, conventions.force_scaling, ship, 1.0)
        if conventions.axes == "forward-port-up" and name in ("v", "beta", "r", "vdot", "rdot"):
            unit = -unit
        if conventions.rudder_sign == "port" and name == "delta":
            unit = -unit
        if conventions.angle_unit == "deg" and kind.angle:
            unit *= 180.0 / math.pi
        scaled = value * unit
        if kind.speed:
            scaled = scaled / (speed if kind.speed == 1 else square)
        x[name] = scaled
    return x, speed


def _at_origin(lateral: np.ndarray, turning: np.ndarray, conventions: Conventions, ship: Ship) -> np.ndarray:
    """Lateral velocity or acceleration of the convention's origin from that of midship."""
    lever = origin_position(conventions, ship) * ship.L
    return lateral + lever * turning if lever else lateral


def force_units(component: str, ship: Ship, conventions: Conventions, speed: np.ndarray | float) -> np.ndarray:
    """Newtons in one unit of the scaled force `component`, at each speed; signs of axes and balance included.

    The force in home axes at the convention's origin is this times the scaled force.
    """
    unit = force_unit(component, conventions.force_scaling, ship, 1.0)
    sign = -1.0 if conventions.force_sign == "by-ship" else 1.0
    if conventions.axes == "forward-port-up" and component in ("Y", "N"):
        sign = -sign
    return sign * unit * np.asarray(speed) ** 2
