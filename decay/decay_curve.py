"""Damped cosine with a slowly varying decrement and frequency, fitted to a decay: a smooth curve with derivatives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre

from ..core.errors import FitError
from .decay_record import DecayRecord


@dataclass(frozen=True, eq=False)
class DecayCurve:
    """x = offset + Re z + Re((p + q |z|) z^3/|z|) with z = exp(L + i P), L and P polynomials of time.

    The third harmonic runs with the square and the cube of the amplitude, as quadratic damping and cubic terms make it.

    Attributes
    ----------
    first, last : float
        Times in s between which the polynomials are defined.
    degree : int
        Of both polynomials; 1 is the exponentially damped cosine.
    harmonics : bool
        Whether the third harmonic is there.
    parameters : ndarray, shape (2 degree + 3,) or (2 degree + 7,)
        Legendre coefficients of L and of P, offset, then real and imaginary parts of p and q.
    """

    first: float
    last: float
    degree: int
    harmonics: bool
    parameters: np.ndarray

    def evaluate(self, time: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Coordinate without offset, velocity, acceleration, and gradient of the coordinate with offset.

        Returns
        -------
        value, rate, acceleration : ndarray, shape (n,)
        gradient : ndarray, shape (n, number of parameters)
        """
        count = self.degree + 1
        middle, half = 0.5 * (self.first + self.last), 0.5 * (self.last - self.first)
        s = (time - middle) / half
        log, phase = self.parameters[:count], self.parameters[count : 2 * count]
        table = legendre.legvander(s, self.degree)
        l1, p1 = (legendre.legval(s, legendre.legder(one)) / half for one in (log, phase))
        l2, p2 = (legendre.legval(s, legendre.legder(one, 2)) / half**2 for one in (log, phase))
        envelope, angle = table @ log, table @ phase
        parts = [(1.0 + 0.0j, 1, 1)]
        if self.harmonics:
            a, b, c, d = self.parameters[2 * count + 1 :]
            parts += [(complex(a, b), 2, 3), (complex(c, d), 3, 3)]
        value, rate, acceleration = (np.zeros(time.size) for _ in range(3))
        by_log, by_phase, by_factor = np.zeros(time.size), np.zeros(time.size), []
        for factor, power, order in parts:
            wave = np.exp(power * envelope + 1j * order * angle)
            z = factor * wave
            first = power * l1 + 1j * order * p1
            value += z.real
            rate += (first * z).real
            acceleration += ((first**2 + power * l2 + 1j * order * p2) * z).real
            by_log += power * z.real
            by_phase += (1j * order * z).real
            if order == 3:
                by_factor += [wave.real, -wave.imag]
        gradient = np.column_stack(
            [by_log[:, None] * table, by_phase[:, None] * table, np.ones(time.size), *by_factor]
        )
        return value, rate, acceleration, gradient

    @property
    def offset(self) -> float:
        """Rest position in rad or m."""
        return float(self.parameters[2 * self.degree + 2])


def fit_decay_curve(record: DecayRecord, degree: int = 1, *, harmonics: bool = False) -> DecayCurve:
    """Least-squares curve through a record, started from its turning points.

    Parameters
    ----------
    record : DecayRecord
    degree : int
        Degree of log-amplitude and phase in time; lowered when there are few turning points.
    harmonics : bool
        Include the third harmonic.

    Raises
    ------
    FitError
        If the search does not converge.
    """
    from scipy.optimize import least_squares

    found = record.extremes
    order = max(1, min(degree, found.value.size - 2))
    height = np.maximum(found.amplitudes(), 1e-9 * float(np.ptp(found.value)))
    first, last = float(record.time[0]), float(record.time[-1])
    s = (found.time - 0.5 * (first + last)) * 2.0 / (last - first)
    # Beyond the first degree the turning points would not hold the ends; the search finds those.
    log = np.zeros(order + 1)
    phase = np.zeros(order + 1)
    start_degree = min(order, 2)
    log[: start_degree + 1] = legendre.legfit(s, np.log(height), start_degree)
    turned = np.pi * np.arange(s.size) + (0.0 if found.value[0] > found.rest_line()(found.time[0]) else np.pi)
    phase[: start_degree + 1] = legendre.legfit(s, turned, start_degree)
    start = np.concatenate([log, phase, [float(found.rest_line()(found.time[0]))], np.zeros(4 * harmonics)])

    def curve(parameters: np.ndarray) -> DecayCurve:
        return DecayCurve(first, last, order, harmonics, parameters)

    def residual(parameters: np.ndarray) -> np.ndarray:
        value = curve(parameters).evaluate(record.time)[0]
        return value + curve(parameters).offset - record.value

    def gradient(parameters: np.ndarray) -> np.ndarray:
        return curve(parameters).evaluate(record.time)[3]

    with np.errstate(over="ignore", invalid="ignore"):
        try:
            outcome = least_squares(residual, start, gradient, method="lm", x_scale="jac", max_nfev=400)
        except ValueError:
            outcome = None
    if outcome is None or not outcome.success:
        raise FitError(
            "no damped cosine fits the record",
            cure="check that it is a free decay, or lower the degree",
            file=record.source or None,
            place=record.name,
        )
    return curve(outcome.x)
