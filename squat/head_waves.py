"""Regular waves in water of finite depth, met by a ship under way: wave number, encounter frequency, place of phase.

Linear theory: ``omega^2 = g k tanh(k h)``; a ship at speed V meets waves at the angle mu (180 degrees: from ahead)
with ``omega_e = omega - k V cos(mu)``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.errors import TowtankError
from ..core.variables import GRAVITY

HEAD = math.pi
"""Wave angle mu of head waves in rad; 0 is from astern."""


@dataclass(frozen=True)
class HeadWave:
    """A regular wave as a ship meets it.

    Attributes
    ----------
    omega, wave_number : float
        Frequency at a fixed place in rad/s, wave number in rad/m.
    omega_encounter : float
        Frequency of encounter in rad/s; negative when the ship overtakes the waves.
    depth, speed : float
        Water depth in m, speed of the ship in m/s.
    """

    omega: float
    wave_number: float
    omega_encounter: float
    depth: float
    speed: float

    @property
    def length(self) -> float:
        """Wave length in m."""
        return 2.0 * math.pi / self.wave_number

    @property
    def period_of_encounter(self) -> float:
        """Period of encounter in s; infinite when the ship keeps pace with the waves."""
        return 2.0 * math.pi / abs(self.omega_encounter) if self.omega_encounter else math.inf


def wave_number(omega: float, depth: float) -> float:
    """Wave number k in rad/m of ``omega^2 = g k tanh(k h)``.

    Parameters
    ----------
    omega : float
        Wave frequency in rad/s, positive.
    depth : float
        Water depth in m, positive; infinity for deep water.

    Raises
    ------
    TowtankError
        When frequency or depth is not positive.
    """
    if not depth > 0.0:
        raise TowtankError(f"a water depth of {depth:g} m is impossible", cure="give the depth in m, positive")
    if not (omega > 0.0 and math.isfinite(omega)):
        raise TowtankError(f"a wave frequency of {omega:g} rad/s is impossible", cure="give omega = 2 pi / T")
    deep = omega**2 / GRAVITY
    if math.isinf(depth):
        return deep
    # Newton on x tanh x = y from a start above the root, where the function is convex: it cannot overshoot.
    y = deep * depth
    x = max(y, math.sqrt(y))
    for _ in range(50):
        tangent = math.tanh(x)
        step = (x * tangent - y) / (tangent + x * (1.0 - tangent**2))
        x -= step
        if abs(step) <= 1e-15 * x:
            break
    return x / depth


def met_wave(period: float, depth: float, speed: float = 0.0, angle: float = HEAD) -> HeadWave:
    """The wave of a given period as a ship meets it.

    Parameters
    ----------
    period : float
        Period at a fixed place in s.
    depth : float
        Water depth in m.
    speed : float
        Speed of the ship in m/s.
    angle : float
        Angle between the courses of ship and wave in rad: pi for head waves.

    Raises
    ------
    TowtankError
        When period or depth is not positive.
    """
    if not period > 0.0:
        raise TowtankError(f"a wave period of {period:g} s is impossible", cure="give the period in s, positive")
    omega = 2.0 * math.pi / period
    k = wave_number(omega, depth)
    return HeadWave(omega, k, omega - k * speed * math.cos(angle), depth, speed)


def wave_of_encounter(omega_encounter: float, depth: float, speed: float = 0.0) -> HeadWave:
    """The head wave that a ship meets with a given frequency.

    Parameters
    ----------
    omega_encounter : float
        Frequency of encounter in rad/s, positive.
    depth : float
        Water depth in m.
    speed : float
        Speed of the ship in m/s, not negative: from ahead each frequency of encounter has one wave.

    Raises
    ------
    TowtankError
        When frequency or depth is not positive, or the speed is negative.
    """
    if not (speed >= 0.0 and math.isfinite(speed)):
        raise TowtankError(f"a speed of {speed:g} m/s meets no head waves", cure="give the speed ahead in m/s")
    low, high = 0.0, omega_encounter
    wave_number(omega_encounter, depth)
    # omega + k(omega) V rises with omega: halving the interval cannot miss its one root.
    for _ in range(200):
        omega = 0.5 * (low + high)
        if omega in (low, high):
            break
        if omega + wave_number(omega, depth) * speed > omega_encounter:
            high = omega
        else:
            low = omega
    omega = high
    return HeadWave(omega, wave_number(omega, depth), omega_encounter, depth, speed)


def phase_at(phase: float, x_from: float, x_to: float, k: float, angle: float = HEAD) -> float:
    """Phase lead of a wave elevation, moved from one place along the ship to another.

    Parameters
    ----------
    phase : float
        Phase eps at `x_from` in rad: ``zeta_a cos(omega_e t + eps)``.
    x_from, x_to : float
        Places in m, positive forward, on the axis of the ship.
    k : float
        Wave number in rad/m.
    angle : float
        Wave angle in rad; in head waves a place further aft sees the same wave later.

    Returns
    -------
    float
        In rad, between -pi and pi.
    """
    moved = phase - k * math.cos(angle) * (x_to - x_from)
    return float(np.angle(np.exp(1j * moved)))
