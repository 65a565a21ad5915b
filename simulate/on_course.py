"""A complete ship about its straight course: hull, rudder amidships, propeller at its rate, roll where it rolls.

The hull alone is in ``linear_motion``; here the compiled equations of motion themselves are differentiated, so that
the stabilising force of the rudder in the slipstream and the coupling of roll are in the roots.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import ConventionError
from .parameters import CONTROLS, NODES, STATES, Node, Parameter, Shape, State
from .vessel import Vessel

_STEP = 1e-5
"""Disturbance in units of U, U/L and rad: small beside every scale of the models, large beside rounding."""


@dataclass(frozen=True, eq=False)
class ShipOnCourse:
    """Linear equations of a ship that is disturbed from its straight course, time over L/U.

    Attributes
    ----------
    name : str
    states : tuple of str
        ``v``, ``r`` in prime form, and for a ship that rolls ``p`` in prime form and ``phi`` in rad.
    free : ndarray, shape (n, n)
        Rates of the states from themselves, rudder amidships.
    by_rudder : ndarray, shape (n,)
        Rates from the rudder angle.
    """

    name: str
    states: tuple[str, ...]
    free: np.ndarray
    by_rudder: np.ndarray

    @property
    def roots(self) -> np.ndarray:
        """Roots in U/L, the largest real part first, shape (n,)."""
        roots = np.linalg.eigvals(self.free).astype(complex)
        return roots[np.argsort(-roots.real, kind="stable")]

    @property
    def stable(self) -> bool:
        """True when every root has a negative real part."""
        return bool(self.roots[0].real < 0.0)


def ship_on_course(vessel: Vessel) -> ShipOnCourse:
    """Linearise a vessel about its straight course at its approach speed.

    Central differences of the right-hand side that is sailed; flow straightening that differs between port and
    starboard enters with its mean.

    Parameters
    ----------
    vessel : Vessel

    Raises
    ------
    SimulationError
        When the vessel lacks what the equations of motion need.
    ConventionError
        When it has no self-propulsion point.
    """
    from .equations import derivative
    from .packing import pack
    from .self_propulsion import self_propulsion_rates

    packed = pack(vessel)
    rate = vessel.rate if vessel.rate is not None else float(self_propulsion_rates(packed, vessel.speed)[0])
    if not np.isfinite(rate):
        raise ConventionError(
            f"'{vessel.name}' has no self-propulsion point at {vessel.speed:.4g} m/s",
            cure="give its propeller rate",
        )
    places = [State.V, State.R]
    names = ["v", "r"]
    if packed.shape[Shape.ROLL] == 1:
        places += [State.P, State.PHI]
        names += ["p", "phi"]
    time = float(packed.parameters[0, Parameter.LENGTH]) / vessel.speed
    units = {State.V: vessel.speed, State.R: 1.0 / time, State.P: 1.0 / time, State.PHI: 1.0, State.DELTA: 1.0}

    state, rates = np.zeros(STATES), np.zeros(STATES)
    state[State.U], state[State.N] = vessel.speed, rate
    control, room = np.zeros(CONTROLS), np.zeros(NODES + len(packed.products))
    room[Node.ONE] = 1.0

    def slope(place: int) -> np.ndarray:
        found = np.zeros(len(places))
        for sign in (1.0, -1.0):
            disturbed = state.copy()
            disturbed[place] += sign * _STEP * units[place]
            derivative(
                disturbed,
                control,
                packed.shape,
                packed.products,
                packed.nodes,
                packed.parameters[0],
                packed.tables,
                np.zeros(4),
                room,
                rates,
            )
            found += sign * np.array([rates[one] * time / units[one] for one in places])
        return found / (2.0 * _STEP)

    free = np.column_stack([slope(place) for place in places])
    return ShipOnCourse(vessel.name, tuple(names), free, slope(State.DELTA))
