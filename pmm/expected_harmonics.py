"""First harmonics of the motion that the test matrix prescribes, at little cost for the audit of every run.

The exact path of :class:`~towtank.pmm.planar_motion.PlanarMotion` on 32 points of a cycle; rates follow from the
positions by multiplication with i omega.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .run_types import Run

_POINTS = 32
_ANGLE = 2.0 * math.pi * np.arange(_POINTS) / _POINTS
_COS, _SIN = np.cos(_ANGLE), np.sin(_ANGLE)
# mean, and a - i b of a cos + b sin
_PROJECTION = np.column_stack([np.full(_POINTS, 1.0 / _POINTS), 2 / _POINTS * _COS, -2 / _POINTS * _SIN])
_SMALL = 0.01


@dataclass(frozen=True)
class ExpectedMotion:
    """Means and first harmonics of a prescribed oscillation.

    Attributes
    ----------
    first : mapping of str to complex
        ``a - i b`` of ``a cos wt + b sin wt`` for x (without its trend), y, psi, u, v, r and their rates, in SI;
        of midship but for x and y, which are those of the point on the path.
    surge : float
        Mean surge velocity in m/s.
    sway : float
        Mean sway velocity of the point on the path in m/s.
    reference : float
        That point, m forward of midship.
    smallest : mapping of str to float
        Amplitude below which a channel counts as at rest.
    telling : tuple of str
        Channels that show the frequency of the motion, best first.
    """

    first: Mapping[str, complex]
    surge: float
    sway: float
    reference: float
    smallest: Mapping[str, float]
    telling: tuple[str, ...]

    def moves(self, name: str) -> bool:
        """True when the motion oscillates this channel."""
        return abs(self.first[name]) > self.smallest[name]

    def sway_at(self, position: float) -> complex:
        """First harmonic of the sway velocity at a point, m forward of midship."""
        return self.first["v"] + position * self.first["r"]


def expected_motion(run: Run, reference: float = 0.0) -> ExpectedMotion:
    """Means and first harmonics of what the test matrix prescribes.

    Parameters
    ----------
    run : Run
        An oscillating run.
    reference : float
        Point that follows the prescribed path, m forward of midship.
    """
    w, speed = run.frequency, run.speed
    # y_a sin(wt + e) is -i y_a exp(ie) in this form, psi_a cos(wt + e) is psi_a exp(ie)
    y = -1j * run.sway_amplitude * cmath.exp(1j * run.sway_phase)
    x = -1j * run.surge_amplitude
    cosine, sine = math.cos(run.drift_angle), math.sin(run.drift_angle)
    if run.kind in ("pure_yaw", "yaw_drift"):
        # The heading follows the path but for the drift angle, so the velocity keeps its direction in the ship.
        along, across = speed + _wave(1j * w * x), _wave(1j * w * y)
        (_, *psi), (pace, *change) = (
            np.array([np.arctan2(across, along), np.hypot(along, across)]) @ _PROJECTION
        ).tolist()
        surge, sway = pace * cosine, -pace * sine
        psi1, u1, v1 = complex(*psi), complex(*change) * cosine, -complex(*change) * sine
    elif run.yaw_amplitude:
        along, across = speed + _wave(1j * w * x), _wave(1j * w * y)
        heading = run.drift_angle + _wave(run.yaw_amplitude * cmath.exp(1j * run.yaw_phase))
        cos, sin = np.cos(heading), np.sin(heading)
        series = np.array([heading, along * cos + across * sin, across * cos - along * sin])
        (_, *psi), (surge, *u), (sway, *v) = (series @ _PROJECTION).tolist()
        psi1, u1, v1 = complex(*psi), complex(*u), complex(*v)
    else:
        surge, sway = speed * cosine, -speed * sine
        psi1, u1, v1 = 0j, 1j * w * (x * cosine + y * sine), 1j * w * (y * cosine - x * sine)
    r1 = 1j * w * psi1
    v1 -= reference * r1
    slow = _SMALL * max(speed, w * abs(y), w * abs(x))
    turn = 2e-3
    return ExpectedMotion(
        first={
            "x": x,
            "y": y,
            "psi": psi1,
            "u": u1,
            "v": v1,
            "r": r1,
            "udot": 1j * w * u1,
            "vdot": 1j * w * v1,
            "rdot": 1j * w * r1,
        },
        surge=surge,
        sway=sway,
        reference=reference,
        smallest={
            "x": 0.0,
            "y": 0.0,
            "psi": turn,
            "u": slow,
            "v": slow,
            "r": turn * w,
            "udot": slow * w,
            "vdot": slow * w,
            "rdot": turn * w * w,
        },
        telling=_TELLING.get(run.kind, ("y", "psi", "r", "v", "Y")),
    )


_TELLING = {
    "pure_sway": ("y", "v", "vdot", "Y"),
    "dry_sway": ("y", "v", "vdot", "Y"),
    "dry_yaw": ("psi", "r", "rdot", "N"),
    "pure_surge": ("x", "u", "udot", "X"),
    "dry_surge": ("x", "u", "udot", "X"),
}


def _wave(first: complex) -> np.ndarray:
    return first.real * _COS - first.imag * _SIN
