"""Normal force of the rudder, as a compiled function (arrays: ``parameters``)."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .parameters import Inflow, Parameter, Shape


@compiled
def rudder_normal_force(
    shape: np.ndarray,
    p: np.ndarray,
    v: float,
    r: float,
    speed: float,
    drift: float,
    flow: float,
    thrust: float,
    sine: float,
    cosine: float,
) -> float:
    """Normal force FN in N, positive when it turns the ship to starboard; of a rudder angle's sine and cosine.

    ``alphaR = delta - atan2(vR, uR)`` needs no arc: ``UR sin(alphaR) = uR sin(delta) - vR cos(delta)``.
    """
    forward = max(flow, 0.0)
    jet = p[Parameter.JET] * thrust
    if shape[Shape.RUDDER] == Inflow.MMG:
        accelerated = math.sqrt(max(forward * forward + jet, 0.0)) - forward
        behind = forward + p[Parameter.KAPPA] * accelerated
        eta = p[Parameter.ETA]
        ahead = p[Parameter.EPS] * math.sqrt(eta * behind * behind + (1.0 - eta) * forward * forward)
        if speed == 0.0:
            across = 0.0
        else:
            at_rudder = drift - p[Parameter.RUDDER_LEVER] * r / speed
            side = at_rudder
            if shape[Shape.SWITCH_AT_PROPELLER] == 1:
                side = drift - p[Parameter.XP] * r / speed
            gamma = p[Parameter.GAMMA_POSITIVE] if side > 0.0 else p[Parameter.GAMMA_NEGATIVE]
            across = speed * gamma * at_rudder
    else:
        ahead = p[Parameter.EPS] * math.sqrt(max(forward * forward + p[Parameter.KAPPA] * jet, 0.0))
        across = 0.0
        if speed > 0.0:
            sway, yaw = v / speed, r * p[Parameter.LENGTH] / speed
            gamma = p[Parameter.GAMMA_POSITIVE] if sway <= 0.0 else p[Parameter.GAMMA_NEGATIVE]
            form = gamma * sway + p[Parameter.CR_R] * yaw
            form += p[Parameter.CR_RRR] * yaw * yaw * yaw + p[Parameter.CR_RRV] * yaw * yaw * sway
            across = -speed * form
    inflow = math.sqrt(ahead * ahead + across * across)
    return p[Parameter.RUDDER_FORCE] * inflow * (ahead * sine - across * cosine)
