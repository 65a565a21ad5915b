"""Impulse response of radiation: from a damping table B(omega) to K(t) and back, and the added mass that goes with it.

Cummins' equation ``(I + A_inf) x'' + int K(t - s) x'(s) ds + C x = 0`` and Ogilvie's relations::

    K(t)     = 2/pi  int B(omega) cos(omega t) d omega
    B(omega) =       int K(t) cos(omega t) dt
    A(omega) = A_inf - 1/omega int K(t) sin(omega t) dt

The integrals are exact for the cubic spline through the table, whatever the product of frequency and time (Filon), so
that a table is never aliased by the cosine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding

if TYPE_CHECKING:
    import pandas as pd

Tail = Literal["inverse-square", "none"]

LARGE_TAIL = 0.05
"""Share of K(0) from beyond the table above which the table is said to be short."""

LATE_KERNEL = 0.02
"""Share of the largest K that may be left at the end of the time axis."""


@dataclass(frozen=True, eq=False)
class ImpulseResponse:
    """Retardation function of one motion.

    Attributes
    ----------
    time : ndarray, shape (n,)
        Seconds from zero, uniform.
    kernel : ndarray, shape (n,)
        K(t), unit of B over second (N m/rad for roll, N/m for heave).
    tail_share : float
        Share of K(0) that comes from frequencies above the table.
    findings : tuple of Finding
        What is doubtful about it.
    """

    time: np.ndarray
    kernel: np.ndarray
    tail_share: float
    findings: tuple[Finding, ...]

    def damping(self, frequency: np.ndarray) -> np.ndarray:
        """B at the frequencies (rad/s), shape (m,)."""
        return cosine_integral(self.time, self.kernel, np.asarray(frequency, dtype=float))

    def added_mass_difference(self, frequency: np.ndarray) -> np.ndarray:
        """A(omega) - A_inf at positive frequencies (rad/s), shape (m,)."""
        omega = np.asarray(frequency, dtype=float)
        return -sine_integral(self.time, self.kernel, omega) / omega

    def to_frame(self) -> pd.DataFrame:
        """Columns ``time`` and ``kernel``."""
        import pandas as pd

        return pd.DataFrame({"time": self.time, "kernel": self.kernel})


def impulse_response(
    frequency: np.ndarray,
    damping: np.ndarray,
    time: np.ndarray,
    *,
    tail: Tail = "inverse-square",
) -> ImpulseResponse:
    """K(t) of a table of radiation damping.

    Parameters
    ----------
    frequency : ndarray, shape (m,)
        Rising, in rad/s. The damping at zero frequency is zero and is added when the table starts later.
    damping : ndarray, shape (m,)
        B of one motion, SI.
    time : ndarray, shape (n,)
        Uniform from 0, in seconds.
    tail : {"inverse-square", "none"}
        Continuation above the table: falling with the square of the frequency from the last row, as the
        transfer functions of :mod:`.fluid_memory` do, or nothing.

    Raises
    ------
    FitError
        For tables that do not pair or rise, values that are not finite, or times that are not uniform from zero.
    """
    omega, b = checked_table(frequency, damping, "damping")
    t = np.asarray(time, dtype=float)
    if t.ndim != 1 or t.size < 2 or abs(t[0]) > 0.0 or not np.allclose(np.diff(t), t[1], rtol=1e-6, atol=0.0):
        raise FitError(
            "the times of an impulse response are not uniform from zero", cure="use linspace(0, end, n)"
        )
    if omega[0] > 0.0:
        omega, b = np.concatenate([[0.0], omega]), np.concatenate([[0.0], b])
    kernel = 2.0 / math.pi * cosine_integral(omega, b, t)
    share = 0.0
    if tail == "inverse-square":
        beyond = 2.0 / math.pi * b[-1] * _inverse_square_tail(float(omega[-1]), t)
        kernel = kernel + beyond
        share = float(abs(beyond[0]) / max(abs(kernel[0]), 1e-300))
    elif tail != "none":
        raise FitError(f"there is no tail '{tail}'", cure="use inverse-square or none")
    return ImpulseResponse(t, kernel, share, tuple(_doubts(b, kernel, share)))


def _doubts(damping: np.ndarray, kernel: np.ndarray, share: float) -> Iterator[Finding]:
    if share > LARGE_TAIL:
        yield Finding(
            "radiation-table-short",
            "warning",
            f"{share:.0%} of K(0) comes from frequencies above the table, of which nothing is known",
            cure="compute the damping up to higher frequencies",
        )
    if damping.min() < -1e-3 * damping.max():
        yield Finding(
            "radiation-not-passive",
            "warning",
            f"the damping is negative down to {damping.min():.3g}: waves would give energy to the ship",
            cure="remove wild points, or the irregular frequencies of the panel method",
        )
    late = float(np.abs(kernel[-max(kernel.size // 20, 1) :]).max() / max(np.abs(kernel).max(), 1e-300))
    if late > LATE_KERNEL:
        yield Finding(
            "impulse-response-cut",
            "warning",
            f"{late:.0%} of the largest K is left at the end of the time axis",
            cure="take a longer time axis, or a finer table of frequencies",
        )


@dataclass(frozen=True, eq=False)
class AddedMassCheck:
    """Added mass of a table against that which its own damping implies.

    Attributes
    ----------
    infinite : float
        A_inf by Ogilvie's relation, mean over the table.
    spread : float
        Standard deviation of A_inf over the table; zero when added mass and damping belong together.
    implied : ndarray, shape (m,)
        A(omega) from the damping and `infinite`.
    r2 : float
        Share of the variance of the table's added mass that `implied` explains.
    findings : tuple of Finding
    """

    infinite: float
    spread: float
    implied: np.ndarray
    r2: float
    findings: tuple[Finding, ...]


def check_added_mass(
    frequency: np.ndarray, added_mass: np.ndarray, response: ImpulseResponse, *, least_r2: float = 0.99
) -> AddedMassCheck:
    """Whether a table of added mass agrees with the impulse response of its damping.

    Parameters
    ----------
    frequency, added_mass : ndarray, shape (m,)
        Positive rad/s, SI.
    response : ImpulseResponse
    least_r2 : float
        Below this the disagreement is a finding.

    Raises
    ------
    FitError
        As :func:`impulse_response`, and for a frequency of zero.
    """
    omega, mass = checked_table(frequency, added_mass, "added mass")
    if omega[0] <= 0.0:
        raise FitError("the added mass at zero frequency says nothing about the memory", cure="leave that row out")
    difference = response.added_mass_difference(omega)
    infinite = mass - difference
    centre = float(infinite.mean())
    implied = centre + difference
    r2 = coefficient_of_determination(mass, implied)
    findings: tuple[Finding, ...] = ()
    if not r2 >= least_r2:
        findings = (
            Finding(
                "added-mass-disagrees",
                "warning",
                f"the damping implies the added mass with R2 = {r2:.4f}, below {least_r2:g}",
                cure="check units, reference point and the highest frequency of both tables",
            ),
        )
    return AddedMassCheck(centre, float(infinite.std()), implied, r2, findings)


def coefficient_of_determination(table: np.ndarray, model: np.ndarray) -> float:
    """``1 - sum (table - model)^2 / sum (table - mean)^2``; 1 when both are constant and equal."""
    left = float(np.sum((table - model) ** 2))
    total = float(np.sum((table - table.mean()) ** 2))
    # A constant table leaves only rounding.
    if total <= (1e-14 * float(np.abs(table).max(initial=0.0))) ** 2 * table.size:
        return 1.0 if left <= 1e-24 * float(np.sum(table**2)) else -math.inf
    return 1.0 - left / total


def checked_table(frequency: np.ndarray, values: np.ndarray, what: str) -> tuple[np.ndarray, np.ndarray]:
    """Both columns as floats, or the reason why they are no table of frequency.

    Raises
    ------
    FitError
        For tables that do not pair or rise, fewer than three rows, or values that are not finite.
    """
    omega, column = np.asarray(frequency, dtype=float), np.asarray(values, dtype=float)
    if omega.ndim != 1 or omega.shape != column.shape or omega.size < 3:
        raise FitError(f"frequencies and {what} do not pair in three rows or more", cure="give one value a row")
    if not (np.isfinite(omega).all() and np.isfinite(column).all()):
        raise FitError(f"the table of {what} holds values that are not finite", cure="leave those rows out")
    if omega[0] < 0.0 or not (np.diff(omega) > 0.0).all():
        raise FitError(
            f"the frequencies of the {what} do not rise from zero or above", cure="sort the table, rad/s"
        )
    return omega, column


def cosine_integral(x: np.ndarray, y: np.ndarray, at: np.ndarray) -> np.ndarray:
    """``int y(x) cos(x s) dx`` of the cubic spline through the nodes.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
        Nodes, rising, and values.
    at : ndarray, shape (m,)
        s.
    """
    return _spline_fourier(x, y, at).real


def sine_integral(x: np.ndarray, y: np.ndarray, at: np.ndarray) -> np.ndarray:
    """``int y(x) sin(x s) dx`` of the cubic spline through the nodes; arguments of :func:`cosine_integral`."""
    return _spline_fourier(x, y, at).imag


def _spline_fourier(x: np.ndarray, y: np.ndarray, at: np.ndarray) -> np.ndarray:
    """``int y(x) exp(i x s) dx`` of the cubic spline through the nodes, shape (m,).

    On [-1, 1] the Legendre polynomial P_l has the transform 2 i^l j_l(z), with the spherical Bessel function j_l.
    """
    from scipy.interpolate import CubicSpline
    from scipy.special import spherical_jn

    spline = CubicSpline(x, y)
    middle, half = 0.5 * (x[1:] + x[:-1]), 0.5 * np.diff(x)
    powers = [spline(middle, order) * half**order / math.factorial(order) for order in range(4)]
    legendre = (
        powers[0] + powers[2] / 3.0,
        powers[1] + 0.6 * powers[3],
        powers[2] * 2.0 / 3.0,
        powers[3] * 0.4,
    )
    out = np.empty(at.size, dtype=complex)
    # Blocks keep the matrix of phases small.
    rows = max(1, 500_000 // middle.size)
    for start in range(0, at.size, rows):
        s = at[start : start + rows, None]
        z = s * half
        inner = sum(1j**order * spherical_jn(order, z) * weight for order, weight in enumerate(legendre))
        out[start : start + rows] = (np.exp(1j * s * middle) * inner) @ (2.0 * half)
    return out


def _inverse_square_tail(last: float, time: np.ndarray) -> np.ndarray:
    """``int_W^inf (W/omega)^2 cos(omega t) d omega`` for W = `last`."""
    from scipy.special import sici

    sine, _ = sici(last * time)
    return last * (np.cos(last * time) + last * time * (sine - 0.5 * math.pi))
