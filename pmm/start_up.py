"""Transients of a virtual laboratory: acceleration and braking of the carriage, growth of an oscillation."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from .laboratory import Laboratory
from .planar_motion import Oscillation, Waves


@dataclass(frozen=True)
class GrowingOscillation(Oscillation):
    """An oscillation that grows from rest to its full amplitude in the first `rise` seconds.

    The amplitude follows the polynomial of degree 7 that has three continuous derivatives, so that yaw
    accelerations along the path stay continuous.
    """

    rise: float = 1.0

    def derivative(self, t: np.ndarray, omega: float, order: int, waves: Waves | None = None) -> np.ndarray:
        """Time derivative of the given order at `t`, by the product rule."""
        s = np.clip(np.asarray(t, dtype=float) / self.rise, 0.0, 1.0)
        growth = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20])
        moving = replace(self, constant=0.0)
        value = np.full(np.shape(t), self.constant if order == 0 else 0.0)
        for k in range(order + 1):
            envelope = growth.deriv(k)(s) / self.rise**k if k else growth(s)
            value += math.comb(order, k) * envelope * Oscillation.derivative(moving, t, omega, order - k, waves)
        return value


def carriage_profile(time: np.ndarray, laboratory: Laboratory) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Speed of the carriage in a steady run, as a share of its full speed.

    Forces follow the square of the speed while the carriage accelerates and brakes: the angles stay, and the
    change of the coefficients with speed is neglected there.

    Parameters
    ----------
    time : ndarray, shape (n,)
    laboratory : Laboratory

    Returns
    -------
    share, rate, travelled : ndarray, shape (n,)
        Share of the full speed, its time derivative in 1/s, and its integral in s.
    """
    if not laboratory.ramp:
        return np.ones(len(time)), np.zeros(len(time)), time.copy()
    ramp = laboratory.ramp
    rising = np.clip((time - laboratory.rest) / ramp, 0.0, 1.0)
    braking = time - laboratory.rest - ramp - laboratory.duration
    falling = np.clip(braking / ramp, 0.0, 1.0)
    step = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6])
    share = step(rising) - step(falling)
    rate = (step.deriv()(rising) - step.deriv()(falling)) / ramp
    # What lies beyond each ramp is travelled at full speed by the one and taken back by the other.
    travelled = ramp * (step.integ()(rising) - step.integ()(falling))
    travelled += np.maximum(time - laboratory.rest - ramp, 0.0) - np.maximum(braking - ramp, 0.0)
    return share, rate, travelled
