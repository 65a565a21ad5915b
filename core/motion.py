"""From a motion in SI at midship to the scaled variables of any convention, and forces back again.

This is the exact route: no series. Fits build their design matrix with it, simulators and virtual campaigns
their forces.
"""

from __future__ import annotations

from collections.abc import Mapping

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
    motion: Motion, ship: Ship, conventions: Conventions, approach_speed: float | np.ndarray | None = None
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

    Returns
    -------
    state : dict of str to ndarray
        Scaled variables; ``beta`` is always there.
    speed : ndarray
        The speed in m/s that scales the forces.
    """
    if conventions.force_scaling not in ("LT", "L2"):
        raise ConventionError(
            f"a motion is not scaled by '{conventions.force_scaling}'",
            cure="convert the set to LT or L2 first",
        )
    x = {name: np.asarray(value, dtype=float) for name, value in motion.items() if name in VARIABLES}
    surge, v, r = x["surge"], x.get("v", np.zeros(())), x.get("r", np.zeros(()))
    lever = origin_position(conventions, ship) * ship.L
    x["surge"], x["r"] = surge, r
    x["v"] = v + lever * r
    if "vdot" in x and "rdot" in x:
        x["vdot"] = x["vdot"] + lever * x["rdot"]
    drift = np.arctan2(-x["v"], surge)
    x["beta"] = drift if conventions.drift_sign == "-v" else -drift
    if approach_speed is not None:
        x["u"] = surge - np.asarray(approach_speed, dtype=float)
    if conventions.velocity_scale == "approach":
        if approach_speed is None:
            raise ConventionError("the approach speed is needed", cure="give the carriage speed of the run")
        speed = np.broadcast_to(np.asarray(approach_speed, dtype=float), np.shape(x["v"]))
    else:
        speed = np.hypot(surge, x["v"])
    if conventions.axes == "forward-port-up":
        for name in ("v", "r", "vdot", "rdot"):
            if name in x:
                x[name] = -x[name]
    if conventions.rudder_sign == "port" and "delta" in x:
        x["delta"] = -x["delta"]
    if conventions.angle_unit == "deg":
        for name in ("beta", "phi", "delta"):
            if name in x:
                x[name] = np.degrees(x[name])
    for name in x:
        x[name] = x[name] / (
            variable_unit(name, conventions.force_scaling, ship, 1.0) * speed ** VARIABLES[name].speed
        )
    return x, speed


def force_units(component: str, ship: Ship, conventions: Conventions, speed: np.ndarray | float) -> np.ndarray:
    """Newtons in one unit of the scaled force `component`, at each speed; signs of axes and balance included.

    The force in home axes at the convention's origin is this times the scaled force.
    """
    unit = force_unit(component, conventions.force_scaling, ship, 1.0)
    sign = -1.0 if conventions.force_sign == "by-ship" else 1.0
    if conventions.axes == "forward-port-up" and component in ("Y", "N"):
        sign = -sign
    return sign * unit * np.asarray(speed) ** 2
