"""Exact body-fixed kinematics of captive runs.

A path x(t), y(t) and heading psi(t) of a reference point, each a constant rate plus a sum of sines and cosines
(or, for pure yaw, the heading that follows the path), give u, v, r and their rates without a small-angle
assumption. The sinusoid formulas of the textbooks bias pure yaw: with y_a w/U = 0.35 they return Yr -0.020 for
-0.048 (virtual captive tests of DTMB 5512, Tables 8, 9 and 17).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .run_types import Run


@dataclass(frozen=True)
class Oscillation:
    """Constant plus harmonics of one coordinate: ``c0 + sum a_k cos(k w t) + b_k sin(k w t)``.

    Attributes
    ----------
    constant : float
    cosine, sine : tuple of float
        Coefficients of harmonics 1, 2, ...
    """

    constant: float = 0.0
    cosine: tuple[float, ...] = ()
    sine: tuple[float, ...] = ()

    @classmethod
    def sine_wave(cls, amplitude: float, phase: float) -> Oscillation:
        """``amplitude * sin(w t + phase)``."""
        return cls(0.0, (amplitude * float(np.sin(phase)),), (amplitude * float(np.cos(phase)),))

    @classmethod
    def cosine_wave(cls, amplitude: float, phase: float) -> Oscillation:
        """``amplitude * cos(w t + phase)``."""
        return cls(0.0, (amplitude * float(np.cos(phase)),), (-amplitude * float(np.sin(phase)),))

    def derivative(self, t: np.ndarray, omega: float, order: int, waves: Waves | None = None) -> np.ndarray:
        """Time derivative of the given order at `t`, shape of `t`; `waves` of the same `t` and `omega` save time."""
        waves = waves or Waves(t, omega)
        value = np.full(np.shape(t), self.constant if order == 0 else 0.0)
        for k, (a, b) in enumerate(zip(self.cosine, self.sine, strict=True), start=1):
            # each derivative turns (cos, sin) by 90 deg and multiplies by k w
            c, s = a, b
            for _ in range(order):
                c, s = s * k * omega, -c * k * omega
            if c:
                value += c * waves.cos(k)
            if s:
                value += s * waves.sin(k)
        return value


class Waves:
    """Cosines and sines of the harmonics of w t, each computed once.

    Parameters
    ----------
    t : ndarray
        Time in s.
    omega : float
        Circular frequency in rad/s.
    """

    def __init__(self, t: np.ndarray, omega: float) -> None:
        self._phase = omega * np.asarray(t, dtype=float)
        self._cos: dict[int, np.ndarray] = {}
        self._sin: dict[int, np.ndarray] = {}

    def cos(self, k: int) -> np.ndarray:
        """``cos(k w t)``."""
        if k not in self._cos:
            self._cos[k] = np.cos(k * self._phase)
        return self._cos[k]

    def sin(self, k: int) -> np.ndarray:
        """``sin(k w t)``."""
        if k not in self._sin:
            self._sin[k] = np.sin(k * self._phase)
        return self._sin[k]


@dataclass(frozen=True)
class PlanarMotion:
    """Motion of a run, from which body-fixed velocities follow exactly.

    Attributes
    ----------
    speed : float
        Carriage speed in m/s (mean of x-dot).
    omega : float
        Circular frequency in rad/s; 0 for a steady run.
    surge, sway : Oscillation
        Oscillation of x and y of the reference point in m.
    heading : Oscillation
        Heading in rad; when `along_path` it is what is added to the direction of the path.
    along_path : bool
        True when the heading follows the path (pure yaw).
    yaw_rate : float
        Constant yaw rate in rad/s of a circular run.
    reference : float
        Place of the reference point, m forward of midship.
    constants : tuple of (str, float)
        Further variables that stay constant in the run: ``delta``, ``phi``, ``eta``.
    """

    speed: float
    omega: float = 0.0
    surge: Oscillation = Oscillation()
    sway: Oscillation = Oscillation()
    heading: Oscillation = Oscillation()
    along_path: bool = False
    yaw_rate: float = 0.0
    reference: float = 0.0
    constants: tuple[tuple[str, float], ...] = ()

    def at(self, t: np.ndarray) -> dict[str, np.ndarray]:
        """Motion of midship in SI and home axes.

        Parameters
        ----------
        t : ndarray, shape (n,)
            Time in s.

        Returns
        -------
        dict
            ``surge``, ``v``, ``udot``, ``vdot`` in m/s and m/s2; ``r``, ``rdot`` in rad/s and rad/s2; ``psi``
            in rad; ``x``, ``y`` of the reference point in m; and the constants; each of shape (n,).
        """
        t = np.asarray(t, dtype=float)
        w = self.omega
        if w == 0.0:
            return self._steady(t)
        waves = Waves(t, w)
        xd = self.speed + self.surge.derivative(t, w, 1, waves)
        xdd = self.surge.derivative(t, w, 2, waves)
        yd, ydd = self.sway.derivative(t, w, 1, waves), self.sway.derivative(t, w, 2, waves)
        psi = self.heading.derivative(t, w, 0, waves) if self.heading.cosine else np.float64(self.heading.constant)
        r, rdot = self.heading.derivative(t, w, 1, waves), self.heading.derivative(t, w, 2, waves)
        cos, sin = np.cos(psi), np.sin(psi)
        if self.along_path:
            ydddot, xdddot = self.sway.derivative(t, w, 3, waves), self.surge.derivative(t, w, 3, waves)
            square = xd * xd + yd * yd
            turning = xd * ydd - yd * xdd
            r = r + turning / square
            turning_rate = xd * ydddot - yd * xdddot
            rdot = rdot + (turning_rate - turning * 2.0 * (xd * xdd + yd * ydd) / square) / square
            # heading = direction of the path + psi, by the addition theorems
            path = np.sqrt(square)
            cos, sin = (xd * cos - yd * sin) / path, (yd * cos + xd * sin) / path
            psi = psi + np.arctan2(yd, xd)
        u = xd * cos + yd * sin
        v = -xd * sin + yd * cos
        udot = xdd * cos + ydd * sin + r * v
        vdot = -xdd * sin + ydd * cos - r * u
        motion = {
            "surge": u,
            "v": v - self.reference * r,
            "r": r,
            "udot": udot,
            "vdot": vdot - self.reference * rdot,
            "rdot": rdot,
            "psi": np.broadcast_to(psi, np.shape(t)),
            "x": self.speed * t + self.surge.derivative(t, w, 0, waves),
            "y": self.sway.derivative(t, w, 0, waves),
        }
        return self._with_constants(motion, t)

    def _steady(self, t: np.ndarray) -> dict[str, np.ndarray]:
        drift = self.heading.constant
        one = np.ones(np.shape(t))
        zero = np.zeros(np.shape(t))
        motion = {
            "surge": self.speed * np.cos(drift) * one,
            "v": (-self.speed * np.sin(drift) - self.reference * self.yaw_rate) * one,
            "r": self.yaw_rate * one,
            "udot": zero,
            "vdot": zero,
            "rdot": zero,
            "psi": drift + self.yaw_rate * t,
            "x": self.speed * t,
            "y": zero,
        }
        return self._with_constants(motion, t)

    def _with_constants(self, motion: dict[str, np.ndarray], t: np.ndarray) -> dict[str, np.ndarray]:
        for name, value in self.constants:
            motion[name] = np.full(np.shape(t), value)
        return motion


def prescribed_motion(run: Run, reference: float = 0.0) -> PlanarMotion:
    """Motion that the test matrix prescribes.

    Parameters
    ----------
    run : Run
    reference : float
        Point that follows the prescribed path, m forward of midship.
    """
    constants = (("delta", run.rudder_angle), ("phi", run.heel), ("eta", run.bank_position))
    if not run.harmonic:
        return PlanarMotion(
            speed=run.speed,
            heading=Oscillation(run.drift_angle),
            yaw_rate=run.yaw_rate,
            reference=reference,
            constants=constants,
        )
    along_path = run.kind in ("pure_yaw", "yaw_drift")
    heading = Oscillation(run.drift_angle)
    if not along_path and run.yaw_amplitude:
        wave = Oscillation.cosine_wave(run.yaw_amplitude, run.yaw_phase)
        heading = Oscillation(run.drift_angle, wave.cosine, wave.sine)
    return PlanarMotion(
        speed=run.speed,
        omega=run.frequency,
        surge=Oscillation.sine_wave(run.surge_amplitude, 0.0),
        sway=Oscillation.sine_wave(run.sway_amplitude, run.sway_phase),
        heading=heading,
        along_path=along_path,
        reference=reference,
        constants=constants,
    )


def measured_motion(
    run: Run, t: np.ndarray, x: np.ndarray | None, y: np.ndarray, psi: np.ndarray, order: int, reference: float
) -> PlanarMotion:
    """Motion fitted to measured position and heading: harmonics up to `order` at the run's frequency.

    Parameters
    ----------
    run : Run
        Gives the frequency and the constants.
    t, y, psi : ndarray, shape (n,)
        Time in s, lateral position in m, heading in rad.
    x : ndarray, shape (n,), or None
        Position along the tank in m; None when the carriage speed of the run holds.
    order : int
        Number of harmonics.
    reference : float
        Point whose position is measured, m forward of midship.
    """
    from ..identify.harmonics import harmonic_basis

    basis = harmonic_basis(t, run.frequency, order)

    def fitted(values: np.ndarray) -> Oscillation:
        coefficients = np.linalg.lstsq(basis, values, rcond=None)[0]
        return Oscillation(float(coefficients[0]), tuple(coefficients[1::2]), tuple(coefficients[2::2]))

    speed, surge = run.speed, Oscillation()
    if x is not None:
        columns = np.column_stack([t - t[0], basis])
        coefficients = np.linalg.lstsq(columns, x, rcond=None)[0]
        speed = float(coefficients[0])
        surge = Oscillation(0.0, tuple(coefficients[2::2]), tuple(coefficients[3::2]))
    return PlanarMotion(
        speed=speed,
        omega=run.frequency,
        surge=surge,
        sway=fitted(y),
        heading=fitted(psi),
        reference=reference,
        constants=(("delta", run.rudder_angle), ("phi", run.heel), ("eta", run.bank_position)),
    )


def path_limits(runs: Sequence[Run], length: float) -> dict[str, tuple[float, float]]:
    """Range of v' and r' that the prescribed motions of `runs` cover."""
    v_range, r_range = [0.0], [0.0]
    phase = np.linspace(0.0, 1.0, 64, endpoint=False)
    for run in runs:
        motion = prescribed_motion(run).at(phase * (run.period if run.harmonic else 1.0))
        speed = np.hypot(motion["surge"], motion["v"])
        v_range += [float((motion["v"] / speed).min()), float((motion["v"] / speed).max())]
        yaw = motion["r"] * length / speed
        r_range += [float(yaw.min()), float(yaw.max())]
    return {"v": (min(v_range), max(v_range)), "r": (min(r_range), max(r_range))}
