"""Periodic runs cycle by cycle: harmonics of each cycle, cycles to drop, phase average."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .harmonic_projection import checked_time, harmonic_basis, require_positive_frequency
from .harmonics import fit_harmonics

if TYPE_CHECKING:
    import pandas as pd

# A cycle counts as converged when it lies this many standard deviations from the last ones, or within the tolerance.
SIGMAS = 4.0
TOLERANCE = 0.005
MIN_KEPT = 2
# Share of the cycles, from the end, that tells the level and scatter of a converged cycle.
LAST_SHARE = 0.5
# Probability of calling a converged run moving, shared among its coefficients.
TREND_LEVEL = 0.01
# Standard errors that a change of amplitude to come must exceed.
SIGNIFICANT = 2.0
# With fewer last cycles than this, their noise is taken from within the cycles.
FEW_CYCLES = 4
# The ratio of one cycle's change to the change before it; nearer to 1 the approach has no end in sight.
SLOWEST_RATIO = 0.95


@dataclass(frozen=True, eq=False)
class CycleConvergence:
    """Harmonics of each cycle of a periodic record, one channel.

    Attributes
    ----------
    omega : float
        Fundamental frequency, rad/s.
    starts : ndarray, shape (cycles,)
        Start of each whole cycle.
    coefficients : ndarray, shape (cycles, 2 order + 1)
        mean, cos 1, sin 1, ... of each cycle; the phase runs on from cycle to cycle.
    drop : int
        Cycles to drop at the beginning.
    converged : bool
        True when at least two cycles are left and neither the amplitude nor any coefficient still moves beyond scatter
        and tolerance.
    remaining, remaining_se : float
        Estimated change of the first harmonic's amplitude that is still to come, and its standard error.
    tolerance : float
        Difference between cycles that does not matter, in the unit of the channel.
    trend, trend_se : ndarray, shape (2 order + 1,)
        Change of each coefficient over the last half of the cycles by its regression line, and its standard error.
    """

    omega: float
    starts: np.ndarray
    coefficients: np.ndarray
    drop: int
    converged: bool
    remaining: float
    remaining_se: float
    tolerance: float
    trend: np.ndarray
    trend_se: np.ndarray

    @property
    def cycles(self) -> int:
        """Whole cycles in the record."""
        return self.starts.size

    @property
    def amplitude(self) -> np.ndarray:
        """Amplitude of each harmonic in each cycle, shape (cycles, order)."""
        return np.hypot(self.coefficients[:, 1::2], self.coefficients[:, 2::2])

    @property
    def phase(self) -> np.ndarray:
        """Phase of each harmonic in each cycle in rad, shape (cycles, order): A cos(k omega t + phase)."""
        return np.arctan2(-self.coefficients[:, 2::2], self.coefficients[:, 1::2])

    @property
    def start_time(self) -> float:
        """Start of the first cycle that is kept."""
        return float(self.starts[min(self.drop, self.cycles - 1)])

    def to_frame(self) -> pd.DataFrame:
        """One row a cycle: start, whether it is kept, mean, amplitude and phase of each harmonic."""
        import pandas as pd

        columns: dict[str, np.ndarray] = {
            "cycle": np.arange(1, self.cycles + 1),
            "start": self.starts,
            "kept": np.arange(self.cycles) >= self.drop,
            "mean": self.coefficients[:, 0],
        }
        for k in range(self.amplitude.shape[1]):
            columns[f"amplitude {k + 1}"] = self.amplitude[:, k]
            columns[f"phase {k + 1} [rad]"] = self.phase[:, k]
        return pd.DataFrame(columns)


def cycle_convergence(
    t: np.ndarray, x: np.ndarray, omega: float, *, order: int = 3, tolerance: float | None = None
) -> CycleConvergence:
    """Harmonics cycle by cycle, and how many cycles at the beginning belong to the transient.

    The level and scatter of a converged cycle are those of the last half of the cycles; a cycle is dropped when it or
    any earlier kept one differs in a coefficient by more than four standard deviations and more than `tolerance`.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time, increasing.
    x : ndarray, shape (n,)
        One channel.
    omega : float
        Fundamental frequency, rad/s.
    order : int
        Highest harmonic.
    tolerance : float, optional
        Difference that does not matter, in the unit of `x`; 0.5 % of the root mean square of the last cycles about
        their mean when omitted.

    Raises
    ------
    FitError
        If the record holds less than two whole cycles, or a cycle has too few samples for its harmonics.
    """
    time, step, _ = checked_time(t)
    require_positive_frequency(omega)
    values = np.asarray(x, dtype=float)
    period = 2.0 * math.pi / omega
    # Counted back from the end, so that the last cycle is a whole one.
    end = float(time[-1]) + step
    cycles = math.floor((end - float(time[0])) / period + 0.25 * step / period)
    if cycles < 2:
        raise FitError(
            f"the record holds {(end - float(time[0])) / period:.2f} cycles of {period:.4g} s, less than two",
            cure="run longer: nothing can be said about convergence",
        )
    starts = end - period * np.arange(cycles, 0, -1)
    edges = np.searchsorted(time, np.append(starts, end) - 0.5 * step)
    if int(np.diff(edges).min()) < 2 * order + 2:
        raise FitError(
            f"a cycle has {int(np.diff(edges).min())} samples, too few for {order} harmonics",
            cure="write forces more often, or lower the order",
        )
    basis = harmonic_basis(time, omega, order)
    rows = [np.linalg.lstsq(basis[a:b], values[a:b], rcond=None)[0] for a, b in pairwise(edges)]
    coefficients = np.array(rows)
    last = coefficients[-max(math.ceil(LAST_SHARE * cycles), 2) :]
    if tolerance is None:
        kept = values[edges[-1 - last.shape[0]] :]
        tolerance = TOLERANCE * float(kept.std())
    level = np.median(last, axis=0)
    first = int(edges[cycles - last.shape[0]])
    fit = fit_harmonics(time[first:], values[first:], omega=omega, order=order, detrend=True)
    noise = math.sqrt(last.shape[0]) * fit.se
    # What cycles differ by from one to the next, and no less than the noise within them explains.
    scatter = np.sqrt((np.diff(last, axis=0) ** 2).mean(axis=0) / 2.0) if last.shape[0] > 2 else 0.0 * level
    scatter = np.maximum(scatter, noise)
    strange = (np.abs(coefficients - level) > np.maximum(SIGMAS * scatter, tolerance)).any(axis=1)
    drop = int(np.flatnonzero(strange)[-1]) + 1 if strange.any() else 0
    remaining, se = _to_come(np.hypot(last[:, 1], last[:, 2]), float(np.hypot(noise[1], noise[2])))
    moving = abs(remaining) > max(tolerance, SIGNIFICANT * se)
    trend, trend_se, significant = _trend(last, noise if last.shape[0] < FEW_CYCLES else None)
    moving |= bool((significant & (np.abs(trend) > tolerance)).any())
    converged = cycles - drop >= MIN_KEPT and not moving
    return CycleConvergence(
        omega, starts, coefficients, drop, converged, remaining, se, float(tolerance), trend, trend_se
    )


def _trend(last: np.ndarray, noise: np.ndarray | None) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Change of each coefficient over the last cycles by its regression line, standard error, and significance.

    The error is that of the scatter about the line, or follows from the `noise` of one cycle where the cycles are few.
    """
    count, coefficients = last.shape
    line = np.arange(count) - 0.5 * (count - 1)
    power = float(line @ line)
    slope = line @ last / power
    change = (count - 1) * slope
    if noise is not None:
        se = (count - 1) * noise / math.sqrt(power)
        return change, se, np.abs(change) > SIGMAS * se
    from scipy.special import stdtrit

    left = last - last.mean(axis=0) - line[:, None] * slope
    se = (count - 1) * np.sqrt((left**2).sum(axis=0) / (count - 2) / power)
    return change, se, np.abs(change) > float(stdtrit(count - 2, 1.0 - 0.5 * TREND_LEVEL / coefficients)) * se


def _to_come(amplitude: np.ndarray, noise: float) -> tuple[float, float]:
    """Sum of the geometric series that the changes from cycle to cycle follow, and its standard error.

    `noise` is the standard deviation of one amplitude, below which the error of a change cannot be.
    """
    change = np.diff(amplitude)
    if change.size == 1:
        return float(change[0]), max(abs(float(change[0])), noise)
    before = float(change[:-1] @ change[:-1])
    ratio = float(change[1:] @ change[:-1]) / before if before > 0.0 else 0.0
    ratio = min(max(ratio, 0.0), SLOWEST_RATIO)
    left = change[1:] - ratio * change[:-1]
    scatter = max(float(np.sqrt(left @ left / max(left.size - 1, 1))), noise)
    return float(change[-1]) * ratio / (1.0 - ratio), scatter / (1.0 - ratio)


@dataclass(frozen=True, eq=False)
class PhaseAverage:
    """Mean cycle of a periodic channel.

    Attributes
    ----------
    phase : ndarray, shape (points,)
        omega t within the cycle, 0 to 2 pi, rad.
    mean, sd : ndarray, shape (points,)
        Mean over the cycles at each phase, and standard deviation between cycles (nan for one cycle).
    cycles : int
        Cycles averaged.
    """

    phase: np.ndarray
    mean: np.ndarray
    sd: np.ndarray
    cycles: int


def phase_average(t: np.ndarray, x: np.ndarray, omega: float, *, drop: int = 0, points: int = 72) -> PhaseAverage:
    """Average of the cycles at equal phase; cycles are counted back from the end of the record.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time, increasing; need not be uniform.
    x : ndarray, shape (n,)
        One channel.
    omega : float
        Fundamental frequency, rad/s.
    drop : int
        Cycles dropped at the beginning.
    points : int
        Phases, equally spaced.

    Raises
    ------
    FitError
        If no whole cycle is left.
    """
    time, step, _ = checked_time(t)
    require_positive_frequency(omega)
    period = 2.0 * math.pi / omega
    end = float(time[-1]) + step
    cycles = math.floor((end - float(time[0])) / period + 0.25 * step / period) - drop
    if cycles < 1:
        raise FitError("no whole cycle is left to average", cure="drop fewer cycles, or run longer")
    phase = 2.0 * math.pi * np.arange(points) / points
    # First instant of zero phase at or after the first kept cycle's start; the last piece wraps into the cycle before.
    start = end - cycles * period
    offset = (phase / omega - start) % period
    at = start + offset + period * np.arange(cycles)[:, None]
    table = np.interp(at, time, np.asarray(x, dtype=float))
    sd = table.std(axis=0, ddof=1) if cycles > 1 else np.full(points, np.nan)
    return PhaseAverage(phase, table.mean(axis=0), sd, cycles)
