"""Mean and harmonics of forces under a forced motion, with errors that know the noise is autocorrelated.

Model: y = a0 + sum_k (a_k cos k a + b_k sin k a), a = omega t + phase, fitted by least squares, so that whole
cycles are welcome and not required. The standard error of a coefficient follows from the noise density at
its own frequency, not from the scatter of the samples.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..core.errors import FitError
from .autoregression import fit_autoregression
from .frequency import FrequencyEstimate, find_frequency
from .harmonic_projection import HarmonicProjector, checked_time, harmonic_basis, require_positive_frequency

if TYPE_CHECKING:
    import pandas as pd

__all__ = [
    "FrequencyEstimate",
    "HarmonicFit",
    "HarmonicProjector",
    "PhaseSplit",
    "find_frequency",
    "fit_harmonics",
    "harmonic_basis",
    "in_out_of_phase",
    "whole_cycle_window",
]


@dataclass(frozen=True, eq=False)
class HarmonicFit:
    """Harmonics of one channel (shapes as given) or of m channels (a last axis m is added).

    Attributes
    ----------
    omega : float
        Fundamental frequency, rad/s.
    omega_se : float
        Its standard error; 0 when it was given.
    order : int
        Highest harmonic.
    reference_phase : float
        Phase of the motion at t = 0, rad; the angle is omega t + reference_phase.
    coefficients : ndarray, shape (2 order + 1,)
        mean, cos 1, sin 1, cos 2, sin 2, ...
    cov : ndarray, shape (2 order + 1, 2 order + 1), or (m, ...) before these for m channels
        Covariance of `coefficients` from the noise density at each harmonic, and from `omega_se`.
    dof : ndarray, shape (2 order + 1,)
        Degrees of freedom of the standard errors.
    residual_std : float or ndarray, shape (m,)
        Standard deviation of what the harmonics leave.
    r2 : float or ndarray, shape (m,)
        Share of the variance about the mean that the harmonics explain.
    n_cycles : float
        Cycles in the window.
    n : int
        Samples.
    slope, slope_se : float or ndarray, shape (m,)
        Drift per second when it was fitted, else 0.
    time_origin : float
        Time about which the drift is measured.
    """

    omega: float
    omega_se: float
    order: int
    reference_phase: float
    coefficients: np.ndarray
    cov: np.ndarray
    dof: np.ndarray
    residual_std: float | np.ndarray
    r2: float | np.ndarray
    n_cycles: float
    n: int
    slope: float | np.ndarray
    slope_se: float | np.ndarray
    time_origin: float

    @property
    def mean(self) -> np.ndarray:
        """Mean a0."""
        return self.coefficients[0]

    @property
    def cos(self) -> np.ndarray:
        """Cosine coefficients a_k, shape (order,) or (order, m)."""
        return self.coefficients[1::2]

    @property
    def sin(self) -> np.ndarray:
        """Sine coefficients b_k, shape (order,) or (order, m)."""
        return self.coefficients[2::2]

    @property
    def amplitude(self) -> np.ndarray:
        """Amplitudes A_k of A_k cos(k a + phase_k)."""
        return np.hypot(self.cos, self.sin)

    @property
    def phase(self) -> np.ndarray:
        """Phases of A_k cos(k a + phase_k) in rad, positive when the channel leads the reference."""
        return np.arctan2(-self.sin, self.cos)

    @cached_property
    def se(self) -> np.ndarray:
        """Standard errors of `coefficients`, same shape."""
        variance = np.maximum(np.diagonal(self.cov, axis1=-2, axis2=-1), 0.0)
        return np.sqrt(variance).T

    @property
    def se_mean(self) -> np.ndarray:
        """Standard error of the mean."""
        return self.se[0]

    @property
    def se_cos(self) -> np.ndarray:
        """Standard errors of the cosine coefficients."""
        return self.se[1::2]

    @property
    def se_sin(self) -> np.ndarray:
        """Standard errors of the sine coefficients."""
        return self.se[2::2]

    def conf_int(self, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits of the t-intervals of `coefficients`."""
        from scipy.special import stdtrit

        half = stdtrit(self.dof, 0.5 + 0.5 * level) * self.se
        return self.coefficients - half, self.coefficients + half

    def predict(self, t: np.ndarray) -> np.ndarray:
        """Fitted series at times `t` (n,), shape (n,) or (n, m)."""
        time = np.asarray(t, dtype=float)
        fitted = harmonic_basis(time, self.omega, self.order, phase=self.reference_phase) @ self.coefficients
        return fitted + np.multiply.outer(time - self.time_origin, self.slope)

    def to_frame(self) -> pd.DataFrame:
        """One row for each channel and harmonic (0 is the mean): values and standard errors."""
        import pandas as pd

        many = self.coefficients.ndim == 2
        rows = []
        for channel in range(self.coefficients.shape[1] if many else 1):
            pick = (slice(None), channel) if many else slice(None)
            values, errors = self.coefficients[pick], self.se[pick]
            rows.append((channel, 0, 0.0, values[0], errors[0], 0.0, 0.0, abs(values[0]), 0.0))
            for k in range(1, self.order + 1):
                a, b = values[2 * k - 1], values[2 * k]
                se_a, se_b = errors[2 * k - 1], errors[2 * k]
                size, lead = math.hypot(a, b), math.atan2(-b, a)
                rows.append((channel, k, k * self.omega, a, se_a, b, se_b, size, lead))
        columns = ["channel", "harmonic", "omega [rad/s]", "cos", "cos_se", "sin", "sin_se", "amplitude"]
        return pd.DataFrame(rows, columns=[*columns, "phase [rad]"])


def fit_harmonics(
    t: np.ndarray,
    y: np.ndarray,
    *,
    omega: float | None = None,
    order: int = 3,
    phase: float = 0.0,
    detrend: bool = False,
    projector: HarmonicProjector | None = None,
) -> HarmonicFit:
    """Fit mean and harmonics 1..order by least squares.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds, increasing.
    y : ndarray, shape (n,) or (n, m)
        One channel, or m channels in columns.
    omega : float, optional
        Fundamental frequency in rad/s; found from `y` by variable projection when omitted.
    order : int
        Highest harmonic.
    phase : float
        Phase of the motion at t = 0, rad: with a motion V cos(omega t + phase) the cosine is in phase with it.
    detrend : bool
        Fit a straight line together with the harmonics.
    projector : HarmonicProjector, optional
        That of the same `t`, `omega`, `order`, `phase` and trend, when it is there already.

    Returns
    -------
    HarmonicFit

    Raises
    ------
    FitError
        If the window cannot carry the harmonics, or a value is not finite.
    """
    time = np.asarray(t, dtype=float)
    channels = np.asarray(y, dtype=float)
    frequency = FrequencyEstimate(float(omega), 0.0) if omega else find_frequency(time, channels, order)
    if projector is None:
        projector = HarmonicProjector(time, frequency.omega, order, phase=phase, trend=detrend)
    single = channels.ndim == 1
    columns = channels[:, None] if single else channels
    solution = projector.project(columns)
    # Channels as contiguous rows from here on: the sums below run along time.
    rows = np.array(columns.T, order="C")
    residual = rows - projector.reconstruct_rows(solution)

    cycles_a_sample = frequency.omega * projector.time_step / (2.0 * math.pi)
    harmonic = np.concatenate([[0], np.repeat(np.arange(1, order + 1), 2)])
    fitted = [(0.0, 1 + int(detrend)), *((k * cycles_a_sample, 2) for k in range(1, order + 1))]
    noise = fit_autoregression(residual.T, highest_frequency=order * cycles_a_sample, fitted=fitted)
    lines = np.arange(order + 1) * cycles_a_sample
    density = noise.density(lines)
    root = np.sqrt(density[harmonic]).T
    p = harmonic.size
    cov = projector.inverse_gram[:p, :p] * root[:, :, None] * root[:, None, :]
    if frequency.se > 0.0:
        # A wrong frequency tilts every coefficient by its own amount: c(omega) moves along -B+ dy/domega.
        tilt = projector.project(_frequency_gradient(time, projector, solution))[:p].T
        cov = cov + frequency.se**2 * tilt[:, :, None] * tilt[:, None, :]

    sse = np.einsum("ij,ij->i", residual, residual)
    rows -= rows.mean(axis=1, keepdims=True)
    sst = np.einsum("ij,ij->i", rows, rows)
    r2 = np.where(sst > 0.0, 1.0 - sse / np.where(sst > 0.0, sst, 1.0), np.nan)
    spread = np.sqrt(sse / max(projector.size - solution.shape[0], 1))
    slope = solution[-1] if detrend else np.zeros(columns.shape[1])
    slope_se = np.sqrt(projector.inverse_gram[-1, -1] * density[0]) if detrend else np.zeros_like(slope)
    dof = noise.dof(lines)[harmonic]
    return HarmonicFit(
        omega=frequency.omega,
        omega_se=frequency.se,
        order=order,
        reference_phase=float(phase),
        coefficients=solution[:p, 0] if single else solution[:p],
        cov=cov[0] if single else cov,
        dof=dof[:, 0] if single else dof,
        residual_std=float(spread[0]) if single else spread,
        r2=float(r2[0]) if single else r2,
        n_cycles=projector.cycles,
        n=projector.size,
        slope=float(slope[0]) if single else slope,
        slope_se=float(slope_se[0]) if single else slope_se,
        time_origin=projector.middle,
    )


def _frequency_gradient(time: np.ndarray, projector: HarmonicProjector, solution: np.ndarray) -> np.ndarray:
    # dy/domega = t * sum_k k (b_k cos k a - a_k sin k a), shape (n, m).
    turned = np.zeros_like(solution)
    k = np.arange(1, projector.order + 1)[:, None]
    last = 2 * projector.order + 1
    turned[1:last:2], turned[2:last:2] = k * solution[2:last:2], -k * solution[1:last:2]
    return time[:, None] * projector.reconstruct(turned)


def whole_cycle_window(
    t: np.ndarray,
    omega: float,
    *,
    skip_cycles: float = 0,
    start: float | None = None,
    stop: float | None = None,
) -> slice:
    """Largest window of whole cycles.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds, increasing.
    omega : float
        Fundamental frequency, rad/s.
    skip_cycles : float
        Cycles dropped at the beginning, counted from `start`.
    start, stop : float, optional
        Times between which the window must lie; the record's ends when omitted.

    Returns
    -------
    slice
        Rows of `t`; the next sample after the last would begin a new cycle.

    Raises
    ------
    FitError
        If less than one cycle is left.
    """
    time, step, _ = checked_time(t)
    require_positive_frequency(omega)
    period = 2.0 * math.pi / omega
    begin = (float(time[0]) if start is None else start) + skip_cycles * period
    end = float(time[-1]) if stop is None else min(stop, float(time[-1]))
    first = int(np.searchsorted(time, begin - 1e-6 * step))
    last = int(np.searchsorted(time, end + 1e-6 * step, side="right"))
    # The last sample stands for the step that follows it.
    length = float(time[last - 1] - time[first]) + step if last > first else 0.0
    cycles = math.floor(length / period + 0.25 * step / period)
    if cycles < 1:
        raise FitError(
            f"the window holds {length / period:.2f} cycles of {period:.4g} s, less than one",
            cure="skip fewer cycles or widen the window",
        )
    closing = float(time[first]) + cycles * period
    return slice(first, min(int(np.searchsorted(time, closing - 0.5 * step)), last))


class PhaseSplit(NamedTuple):
    """First harmonic of a force in phase with a velocity and with its acceleration.

    Attributes
    ----------
    velocity, acceleration : float or ndarray, shape (m,)
        Amplitudes in the unit of the force; acceleration leads the velocity by a quarter cycle.
    velocity_se, acceleration_se : float or ndarray, shape (m,)
        Their standard errors from the noise of the force.
    velocity_amplitude, acceleration_amplitude : float
        Amplitudes of the motion: V and omega V.
    """

    velocity: np.ndarray
    acceleration: np.ndarray
    velocity_se: np.ndarray
    acceleration_se: np.ndarray
    velocity_amplitude: float
    acceleration_amplitude: float


def in_out_of_phase(fit: HarmonicFit, motion_fit: HarmonicFit) -> PhaseSplit:
    """Split the first harmonic of a force into parts in phase with velocity and with acceleration.

    For v = V cos(omega t) and Y = Yv v + Yvvv v^3 + Yvd dv/dt the parts are Yv V + 3/4 Yvvv V^3 and
    Yvd omega V.

    Parameters
    ----------
    fit : HarmonicFit
        The force, one or m channels.
    motion_fit : HarmonicFit
        The velocity, one channel, of the same frequency and reference phase.

    Raises
    ------
    FitError
        If the velocity fit has several channels or no first harmonic, or the two fits do not share
        frequency and reference phase.
    """
    if motion_fit.coefficients.ndim != 1:
        raise FitError("the motion must be one channel", cure="fit the velocity alone")
    same_phase = abs(fit.reference_phase - motion_fit.reference_phase) < 1e-9
    if not same_phase or abs(fit.omega - motion_fit.omega) > 1e-9 * fit.omega:
        raise FitError(
            "force and motion were fitted with different frequency or phase",
            cure="pass the motion's omega and phase to the force's fit",
        )
    a, b = float(motion_fit.cos[0]), float(motion_fit.sin[0])
    speed = math.hypot(a, b)
    if speed == 0.0:
        raise FitError("the velocity has no first harmonic", cure="check the motion channel")
    along = np.array([a, b]) / speed
    across = np.array([b, -a]) / speed
    first = fit.coefficients[1:3]
    cov = fit.cov[..., 1:3, 1:3]
    return PhaseSplit(
        along @ first,
        across @ first,
        np.sqrt(np.einsum("i,...ij,j->...", along, cov, along)),
        np.sqrt(np.einsum("i,...ij,j->...", across, cov, across)),
        speed,
        speed * motion_fit.omega,
    )
