"""Course-keeping autopilot: gains of a PD or three-term controller, and the roots of ship and autopilot together.

The rudder order is ``delta = -(Kp psi + Kd r + Ki integral of psi)`` with psi the heading off the course; rudder
and heading positive to starboard, so that all gains of a useful autopilot are positive.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ConventionError, TowtankError
from .linear_motion import LinearMotion

if TYPE_CHECKING:
    from .on_course import ShipOnCourse


@dataclass(frozen=True)
class Autopilot:
    """Gains of a three-term controller in prime form, time over L/U.

    Attributes
    ----------
    proportional : float
        Rudder angle over heading error, rad/rad.
    derivative : float
        Rudder angle over ``r L / U``, rad.
    integral : float
        Rudder angle over the integral of the heading error over ``t U / L``, 1/rad.
    """

    proportional: float
    derivative: float = 0.0
    integral: float = 0.0

    def dimensional(self, length: float, speed: float) -> tuple[float, float, float]:
        """Gains over heading error, yaw rate in rad/s and integral in rad s, for L in m and U in m/s.

        Raises
        ------
        TowtankError
            When length or speed is not positive.
        """
        if not (length > 0 and speed > 0):
            raise TowtankError(f"gains for a ship of {length} m at {speed} m/s", cure="both must be positive")
        time = length / speed
        return self.proportional, self.derivative * time, self.integral / time

    @classmethod
    def for_nomoto(
        cls, K: float, T: float, natural_frequency: float, damping: float = 1.0, integral_share: float = 0.0
    ) -> Autopilot:
        """Gains that give a first-order Nomoto ship, ``T r. + r = K delta``, a wanted second-order response.

        Parameters
        ----------
        K, T : float
            Prime gain and time constant, K' = K L/U and T' = T U/L.
        natural_frequency : float
            Of the closed loop, in U/L.
        damping : float
            Damping ratio of the closed loop.
        integral_share : float
            Integral gain over proportional gain and natural frequency; 0.1 is common, 0 leaves it out.

        Raises
        ------
        TowtankError
            When K is 0 or the natural frequency is not positive.

        Notes
        -----
        Pole placement: ``Kp = T w^2 / K`` and ``Kd = (2 zeta w T - 1) / K``.
        """
        if K == 0.0 or not natural_frequency > 0:
            raise TowtankError(
                f"gains for K' = {K:g} and a natural frequency of {natural_frequency:g}",
                cure="the rudder must turn the ship, and the frequency must be positive",
            )
        proportional = T * natural_frequency**2 / K
        derivative = (2.0 * damping * natural_frequency * T - 1.0) / K
        return cls(proportional, derivative, integral_share * proportional * natural_frequency)


@dataclass(frozen=True)
class LinearNomoto:
    """Second-order Nomoto equation of a linear ship in prime form, ``T1 T2 r.. + (T1+T2) r. + r = K (d + T3 d.)``.

    Attributes
    ----------
    K, T1, T2, T3 : float or complex
        T1 and T2 are the negative inverses of the roots, the least damped first; T1 is negative for a ship that
        is unstable on a straight course.
    """

    K: float
    T1: complex
    T2: complex
    T3: float

    @property
    def T(self) -> float:
        """Time constant of the first-order equation, T1 + T2 - T3."""
        return float((self.T1 + self.T2).real - self.T3)


def linear_nomoto(ship: LinearMotion | ShipOnCourse) -> LinearNomoto:
    """Nomoto constants of a linear ship with its rudder.

    Raises
    ------
    ConventionError
        When rudder derivatives or inertia are not known, or for a ship that rolls: its equation is of fourth order.
    """
    free, by_rudder = ship.free, ship.by_rudder
    if len(free) != 2:
        raise ConventionError(
            "a ship that rolls has no second-order Nomoto equation", cure="take the linear motion of its hull"
        )
    steady = free[1, 0] * by_rudder[0] - free[0, 0] * by_rudder[1]
    roots = _ordered_roots(free)
    return LinearNomoto(
        K=float(steady / np.linalg.det(free)),
        T1=complex(-1.0 / roots[0]),
        T2=complex(-1.0 / roots[1]),
        T3=float(by_rudder[1] / steady),
    )


def closed_loop_matrix(
    ship: LinearMotion | ShipOnCourse, autopilot: Autopilot, steering_lag: float = 0.0
) -> np.ndarray:
    """Matrix of ship and autopilot: rates of (its states, psi, integral of psi, delta) from themselves.

    Parameters
    ----------
    ship : LinearMotion or ShipOnCourse
        The states of a linear motion are v' and r'.
    autopilot : Autopilot
    steering_lag : float
        Time constant of a first-order steering gear over L/U; with 0 the rudder follows at once.

    Returns
    -------
    ndarray, shape (n, n)
        One more than the ship has states, one more with an integral gain, and one more with a steering lag.

    Raises
    ------
    ConventionError
        When rudder derivatives or inertia are not known.
    """
    free, by_rudder = ship.free, ship.by_rudder
    states = len(free)
    size = states + 1 + (autopilot.integral != 0.0) + (steering_lag > 0.0)
    matrix = np.zeros((size, size))
    matrix[:states, :states] = free
    matrix[states, 1] = 1.0
    order = np.zeros(size)
    order[1], order[states] = -autopilot.derivative, -autopilot.proportional
    if autopilot.integral != 0.0:
        matrix[states + 1, states] = 1.0
        order[states + 1] = -autopilot.integral
    if steering_lag > 0.0:
        matrix[:states, -1] = by_rudder
        matrix[-1] = order / steering_lag
        matrix[-1, -1] = -1.0 / steering_lag
    else:
        matrix[:states] += np.outer(by_rudder, order)
    return matrix


def closed_loop_roots(
    ship: LinearMotion | ShipOnCourse, autopilot: Autopilot, steering_lag: float = 0.0
) -> np.ndarray:
    """Roots of ship and autopilot in U/L, the largest real part first; parameters as :func:`closed_loop_matrix`."""
    return _ordered_roots(closed_loop_matrix(ship, autopilot, steering_lag))


def _ordered_roots(matrix: np.ndarray) -> np.ndarray:
    roots = np.linalg.eigvals(matrix).astype(complex)
    return roots[np.argsort(-roots.real, kind="stable")]
