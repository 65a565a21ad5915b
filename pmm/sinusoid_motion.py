"""The textbook's view of an oscillating run: sinusoidal velocities, and forces turned to their phase.

With v' = V cos a the powers of v' have closed harmonics, from which the single-run and multiple-run relations
follow: c1 = Yv V + 3/4 Yvvv V^3, c3 = 1/4 Yvvv V^3, s1 = -Yvdot w' V (Strom-Tejsen and Chislett 1966). The view
neglects that heading and speed vary along the path; :mod:`.planar_motion` has the exact motion.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import dataclass
from functools import cache

import numpy as np

from ..core.errors import FitError
from ..core.terms import Term
from .planar_motion import Oscillation
from .reduced_run import ReducedRun

OSCILLATING = {"pure_sway": "v", "pure_yaw": "r", "yaw_drift": "r", "pure_surge": "u"}
"""Run types that the textbook relations cover, with the velocity that oscillates."""

ACCELERATION = {"v": "vdot", "r": "rdot", "u": "udot"}

MEAN, COS1, SIN1, COS2, SIN2, COS3 = range(6)
"""Places of the mean and the harmonics in a vector of coefficients."""

_CONDITIONS = {"delta": "rudder_angle", "phi": "heel", "eta": "bank_position"}


@dataclass(frozen=True)
class SinusoidMotion:
    """Sinusoidal motion of midship, non-dimensional.

    Attributes
    ----------
    velocity : {"v", "r", "u"}
        The velocity that oscillates: sway velocity, yaw rate, or surge velocity less the carriage speed.
    amplitude : float
        Its amplitude over U (times L for the yaw rate), positive.
    phase : float
        The velocity is ``amplitude * cos(w t + phase)``, rad.
    frequency : float
        ``w L / U``.
    drift : float
        Constant part of v', minus the sine of the drift angle.
    """

    velocity: str
    amplitude: float
    phase: float
    frequency: float
    drift: float

    def column(self, term: Term, order: int) -> np.ndarray:
        """Mean and harmonics 1..order of a term with unit coefficient, about the phase of the velocity.

        Parameters
        ----------
        term : Term
            Terms in variables that neither oscillate nor stay constant here contribute nothing.
        order : int

        Returns
        -------
        ndarray, shape (2 order + 1,)
            Mean, cos 1, sin 1, cos 2, ...
        """
        column = np.zeros(2 * order + 1)
        if term.variables == (ACCELERATION[self.velocity],) and term.degree == 1:
            column[SIN1] = -term.sign * self.frequency * self.amplitude
            return column
        size, power, modulus = float(term.sign), 0, 0
        for factor in term.factors:
            if factor.variable == self.velocity:
                power, modulus = factor.power, factor.modulus
                size *= self.amplitude**factor.degree
            elif factor.variable == "v":
                size *= self.drift**factor.power * abs(self.drift) ** factor.modulus
            else:
                return column
        column[MEAN] = size * cosine_harmonic(power, modulus, 0)
        for k in range(1, order + 1):
            column[2 * k - 1] = size * cosine_harmonic(power, modulus, k)
        return column

    def turned(self, coefficients: np.ndarray, sd: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Mean and harmonics of a force about the phase of the velocity, with their standard errors.

        Parameters
        ----------
        coefficients, sd : ndarray, shape (2 order + 1,)
            Mean, cos 1, sin 1, ... about w t, and their standard errors.

        Returns
        -------
        coefficients, sd : ndarray, shape (2 order + 1,)
            Cosines are in phase with the velocity, and minus the sines with the acceleration.
        """
        angle = self.phase * np.arange(1, (len(coefficients) + 1) // 2)
        cos, sin = np.cos(angle), np.sin(angle)
        turned, spread = np.array(coefficients, dtype=float), np.array(sd, dtype=float)
        a, b = coefficients[1::2], coefficients[2::2]
        turned[1::2], turned[2::2] = a * cos - b * sin, a * sin + b * cos
        u_a, u_b = sd[1::2], sd[2::2]
        spread[1::2], spread[2::2] = np.hypot(u_a * cos, u_b * sin), np.hypot(u_a * sin, u_b * cos)
        return turned, spread


@cache
def cosine_harmonic(power: int, modulus: int, k: int) -> float:
    """Coefficient of cos k a in ``cos(a)**power * abs(cos a)**modulus`` (the mean for k = 0).

    Closed form of the integral, e.g. 3/4 and 1/4 for cos^3, 8/(3 pi) and 8/(15 pi) for cos|cos|.
    """
    from scipy.special import gamma, rgamma

    if (power + k) % 2:
        return 0.0
    n = power + modulus
    value = gamma(n + 1.0) / 2.0**n * rgamma(1.0 + 0.5 * (n + k)) * rgamma(1.0 + 0.5 * (n - k))
    return float(value if k == 0 else 2.0 * value)


def sinusoid_motion(run: ReducedRun) -> SinusoidMotion:
    """Textbook motion of an oscillating run, from the first harmonics of its path and heading.

    Amplitudes are those of the linearised motion at midship, v = dy/dt - U (psi - psi0), r = dpsi/dt, over the
    carriage speed: y_a w/U for pure sway and y_a w^2 L/U^2 for pure yaw, with any phase and sign of the path.

    Raises
    ------
    FitError
        For a type of run without textbook relations, or a motion that does not oscillate.
    """
    kind = run.run.kind
    if kind not in OSCILLATING:
        raise FitError(
            f"a {kind} run has no sinusoid relations",
            cure=f"they exist for {', '.join(OSCILLATING)}; the fit of all runs takes every type",
            place=f"run '{run.name}'",
        )
    motion = run.motion
    w, speed, length = motion.omega, motion.speed, run.ship.L
    lateral = 1j * w * _phasor(motion.sway)
    heading = _phasor(motion.heading) + (lateral / speed if motion.along_path else 0.0)
    yaw = 1j * w * heading
    phasors = {
        "v": (lateral - speed * heading - motion.reference * yaw) / speed,
        "r": yaw * length / speed,
        "u": 1j * w * _phasor(motion.surge) / speed,
    }
    velocity = OSCILLATING[kind]
    phasor = phasors[velocity]
    if abs(phasor) < 1e-9:
        raise FitError(
            f"the motion of this {kind} run does not oscillate",
            cure="check amplitude and frequency",
            place=f"run '{run.name}'",
        )
    return SinusoidMotion(
        velocity=velocity,
        amplitude=abs(phasor),
        phase=float(np.angle(phasor)),
        frequency=w * length / speed,
        drift=-math.sin(motion.heading.constant) if run.run.drift_angle else 0.0,
    )


def _phasor(oscillation: Oscillation) -> complex:
    """First harmonic as the c of ``Re(c exp(i w t))``."""
    if not oscillation.cosine:
        return 0j
    return complex(oscillation.cosine[0], -oscillation.sine[0])


def conditions_are_zero(run: ReducedRun, allowed: Collection[str] = ()) -> bool:
    """True for a run without rudder angle, heel and bank, but for the variables in `allowed`."""
    return not any(getattr(run.run, name) for variable, name in _CONDITIONS.items() if variable not in allowed)
