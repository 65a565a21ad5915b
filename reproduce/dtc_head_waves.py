"""Head waves of the DTC model tests: frequency of encounter, and the unit of added resistance."""

from __future__ import annotations

import math

from ..core.ship import Ship
from ..core.variables import GRAVITY

SPEEDS = {"CW2": 0.327, "CW3": 0.872, "CW4": 0.0, "CW5": 0.327}
"""Speed of the model in m/s in each test."""

CLEARANCES = {"CW2": 1.0, "CW3": 1.0, "CW4": 0.2, "CW5": 0.2}
"""Under-keel clearance over draught."""

WAVE_LENGTH = 0.55
"""In ship lengths; printed in two digits."""


def depth_of(ship: Ship, clearance: float) -> float:
    """Water depth in m."""
    return ship.T * (1.0 + clearance)


def encounter_frequency(length: float, depth: float, speed: float) -> float:
    """Frequency in rad/s with which a ship meets head waves of a given length in m, by linear theory."""
    k = 2.0 * math.pi / length
    return math.sqrt(GRAVITY * k * math.tanh(k * depth)) + k * speed


def added_resistance_unit(ship: Ship, amplitude: float) -> float:
    """rho g A^2 B^2 / L in N: what an added resistance is divided by; A in m."""
    return float(ship.rho * GRAVITY * amplitude**2 * ship.B**2 / ship.L)
