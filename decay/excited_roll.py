"""Roll under one harmonic excitation with a bias, integrated by a compiled kernel.

``phi'' + b1 phi' + b2 |phi'|phi' + b3 phi'^3 + c1 phi + c3 phi^3 + c5 phi^5 = f sin(we t + phase) + f0``, divided by
the inertia with its added part; f and f0 in rad/s2. Time of the excitation counts from the first sample.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numba import njit

from .equation import DIVERGED, STEPS_A_PERIOD
from .term_values import rising_times, term_values


@dataclass(frozen=True)
class Excitation:
    """Harmonic moment over inertia, with a bias from wind or loading.

    Attributes
    ----------
    amplitude : float
        f in rad/s2.
    frequency : float
        Encounter frequency in rad/s.
    phase : float
        rad, at the first sample.
    bias : float
        f0 in rad/s2.
    """

    amplitude: float = 0.0
    frequency: float = 1.0
    phase: float = 0.0
    bias: float = 0.0

    def moment(self, time: np.ndarray) -> np.ndarray:
        """Moment over inertia in rad/s2 at times counted from the first sample."""
        return self.amplitude * np.sin(self.frequency * time + self.phase) + self.bias


@njit(cache=True, error_model="numpy", nogil=True)
def _acceleration(x: float, v: float, t: float, c: np.ndarray, e: np.ndarray) -> float:
    """Roll acceleration; e holds the sine and cosine parts, frequency and bias of the excitation."""
    x2 = x * x
    inner = (c[0] + c[1] * abs(v) + c[2] * v * v) * v + (c[3] + c[4] * x2 + c[5] * x2 * x2) * x
    return e[0] * math.sin(e[2] * t) + e[1] * math.cos(e[2] * t) + e[3] - inner


@njit(cache=True, error_model="numpy", nogil=True)
def integrate_excited(
    time: np.ndarray, start: np.ndarray, c: np.ndarray, e: np.ndarray, longest: float
) -> np.ndarray:
    """Angle and rate at the times, shape (n, 2); rows after a divergence are nan.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising, in s; the first is the origin of the excitation's phase.
    start : ndarray, shape (2,)
        Angle and rate at the first time.
    c : ndarray, shape (6,)
        b1, b2, b3, c1, c3, c5.
    e : ndarray, shape (4,)
        Sine and cosine parts (rad/s2), frequency (rad/s), bias (rad/s2).
    longest : float
        Longest step in s.
    """
    path = np.full((time.size, 2), np.nan)
    x, v = start[0], start[1]
    path[0] = start
    for i in range(1, time.size):
        interval = time[i] - time[i - 1]
        steps = max(math.ceil(interval / longest), 1)
        h = interval / steps
        for j in range(steps):
            t = time[i - 1] - time[0] + j * h
            a1 = _acceleration(x, v, t, c, e)
            v2 = v + 0.5 * h * a1
            a2 = _acceleration(x + 0.5 * h * v, v2, t + 0.5 * h, c, e)
            v3 = v + 0.5 * h * a2
            a3 = _acceleration(x + 0.5 * h * v2, v3, t + 0.5 * h, c, e)
            v4 = v + h * a3
            a4 = _acceleration(x + h * v3, v4, t + h, c, e)
            x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4)
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
        if not abs(x) < DIVERGED:
            break
        path[i, 0], path[i, 1] = x, v
    return path


def longest_step(stiffness: float, frequency: float) -> float:
    """Step in s that resolves the natural period of c1 = `stiffness` and the excitation."""
    fastest = max(math.sqrt(max(stiffness, 0.0)), abs(frequency), 1e-6)
    return 2.0 * math.pi / fastest / STEPS_A_PERIOD


def simulate_excited_roll(
    time: np.ndarray,
    start: tuple[float, float],
    coefficients: Mapping[str, float],
    excitation: Excitation | None = None,
) -> np.ndarray:
    """Roll of a ship from a given state.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Rising times in s.
    start : tuple of float
        Angle in rad and rate in rad/s at the first time.
    coefficients : mapping of str to float
        Some of b1, b2, b3, c1, c3, c5; the others are zero.
    excitation : Excitation, optional
        Free decay without.

    Returns
    -------
    ndarray, shape (n, 2)
        Angle and rate; rows after a capsize are nan.

    Raises
    ------
    FitError
        For times that do not rise or an unknown term.
    """
    instants, values = rising_times(time), term_values(coefficients)
    wave = excitation or Excitation()
    parts = np.array(
        [
            wave.amplitude * math.cos(wave.phase),
            wave.amplitude * math.sin(wave.phase),
            wave.frequency,
            wave.bias,
        ]
    )
    with np.errstate(over="ignore", invalid="ignore"):
        return integrate_excited(
            instants, np.array(start, dtype=float), values, parts, longest_step(values[3], wave.frequency)
        )


def harmonic_motion(
    time: np.ndarray, angle: np.ndarray, frequency: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle, rate and acceleration of one oscillation by its mean and three harmonics, shape (n,) each.

    Differentiated so, the noise of the record does not grow.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        s and rad.
    frequency : float
        Of the oscillation in rad/s.
    """
    order = np.arange(1, 4) * frequency
    cosines, sines = np.cos(np.outer(time, order)), np.sin(np.outer(time, order))
    basis = np.column_stack([np.ones_like(time), cosines, sines])
    parts = np.linalg.lstsq(basis, angle, rcond=None)[0]
    c, s = parts[1:4], parts[4:]
    rate = cosines @ (order * s) - sines @ (order * c)
    acceleration = -(cosines @ (order**2 * c) + sines @ (order**2 * s))
    return basis @ parts, rate, acceleration


def needed_excitation(
    time: np.ndarray,
    motion: tuple[np.ndarray, np.ndarray, np.ndarray],
    coefficients: np.ndarray,
    frequency: float,
) -> tuple[float, float, float]:
    """Sine part, cosine part and bias (rad/s2) of the excitation that a motion needs, by least squares.

    Parameters
    ----------
    time : ndarray, shape (n,)
        s, from the first sample of the oscillation.
    motion : tuple of ndarray, shape (n,)
        Angle, rate and acceleration.
    coefficients : ndarray, shape (6,)
        b1, b2, b3, c1, c3, c5.
    frequency : float
        Of the excitation in rad/s.
    """
    y, v, a = motion
    b1, b2, b3, c1, c3, c5 = coefficients
    moment = a + (b1 + b2 * np.abs(v) + b3 * v**2) * v + (c1 + c3 * y**2 + c5 * y**4) * y
    wave = np.column_stack([np.sin(frequency * time), np.cos(frequency * time), np.ones_like(time)])
    sine, cosine, bias = np.linalg.lstsq(wave, moment, rcond=None)[0]
    return float(sine), float(cosine), float(bias)
