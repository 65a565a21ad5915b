"""Is a record steady: the trend test of its channels, and the drift that is still to come.

The trend test asks whether a straight line explains more than autocorrelated noise would. The remaining drift
asks where the channel is going: a level approached exponentially, its time constant profiled out, or, where the
record does not show the bend, one more window of the same trend.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .autoregression import fit_autoregression
from .transient import require_samples

# Time constants of the approach that are tried, as parts of the window.
SHORTEST, LONGEST, TRIALS = 0.04, 1.5, 24
REFINEMENTS = 2
# Rise of the misfit over the noise density that limits the time constant: one standard deviation.
ONE_SIGMA = 1.0


@dataclass(frozen=True)
class Stationarity:
    """Verdict on the trend of each channel in a window.

    Attributes
    ----------
    stationary : bool
        False when a channel drifts both significantly and by more than the tolerance.
    drift, drift_se : tuple of float
        Change of each channel over the window by its regression line, and its standard error, which
        accounts for autocorrelation; unit of the channel.
    p_value : tuple of float
        Two-sided p-value of no drift, by the slope's t-test.
    """

    stationary: bool
    drift: tuple[float, ...]
    drift_se: tuple[float, ...]
    p_value: tuple[float, ...]


def stationarity(
    t: np.ndarray, y: np.ndarray, *, level: float = 0.01, tolerance: float | Sequence[float] | None = None
) -> Stationarity:
    """Test each channel for a trend.

    The slope's standard error uses the noise density at frequency zero, so that slow noise is not taken for
    drift. The level is shared among the channels (Bonferroni).

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in s.
    y : ndarray, shape (n,) or (n, m)
        Channels.
    level : float
        Probability of calling a stationary record drifting.
    tolerance : float or sequence of m floats, optional
        Drift over the window that does not matter, in the unit of the channel; 1 % of the channel's
        root mean square when omitted.

    Raises
    ------
    FitError
        If fewer than eight samples are given.
    """
    from scipy.special import stdtr

    time = np.asarray(t, dtype=float)
    channels = np.asarray(y, dtype=float)
    channels = channels[:, None] if channels.ndim == 1 else channels
    require_samples(time.size, "in the window")
    centred = time - time.mean()
    spread = float(centred @ centred)
    rows = np.ascontiguousarray(channels.T)
    about = rows - rows.mean(axis=1, keepdims=True)
    slope = np.where(np.ptp(rows, axis=1) > 0.0, about @ centred / spread, 0.0)
    noise = fit_autoregression((about - slope[:, None] * centred).T, fitted=[(0.0, 2)])
    length = float(time[-1] - time[0])
    drift = slope * length
    drift_se = np.where(slope != 0.0, np.sqrt(noise.density([0.0])[0] / spread) * length, 0.0)
    ratio = np.divide(np.abs(drift), drift_se, out=np.where(slope != 0.0, np.inf, 0.0), where=drift_se > 0.0)
    p_value = 2.0 * stdtr(noise.dof([0.0])[0], -ratio)
    rms = np.sqrt(np.einsum("ij,ij->i", rows, rows) / time.size)
    harmless = 0.01 * rms if tolerance is None else np.broadcast_to(tolerance, rms.shape)
    drifting = (p_value < level / rms.size) & (np.abs(drift) > harmless)
    return Stationarity(
        not bool(drifting.any()),
        tuple(map(float, drift)),
        tuple(map(float, drift_se)),
        tuple(map(float, p_value)),
    )


def is_stationary(t: np.ndarray, y: np.ndarray, *, level: float = 0.01) -> bool:
    """True when no channel of `y` drifts: :func:`stationarity` reduced to its verdict."""
    return stationarity(t, y, level=level).stationary


@dataclass(frozen=True)
class RemainingDrift:
    """What the mean of a window would still change by if the run went on.

    Attributes
    ----------
    value, se : float
        Level that is approached less the mean of the window, and its standard error, in the unit of the channel.
    time_constant : float
        Time constant of the approach in the unit of `t`; inf when the record shows no bend, and `value` is
        then the change over one more window of the same length.
    gain : float
        How much the approach explains, over the noise density: chi-square with two degrees of freedom.
    """

    value: float
    se: float
    time_constant: float
    gain: float

    @property
    def significance(self) -> float:
        """Remaining drift over its standard error, without sign."""
        if self.value == 0.0:
            return 0.0
        return abs(self.value) / self.se if self.se > 0.0 else float("inf")


def remaining_drift(t: np.ndarray, x: np.ndarray) -> RemainingDrift:
    """Drift that is still to come: fit of ``a + c exp(-t/tau)`` by variable projection.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time or iteration number, increasing, uniform.
    x : ndarray, shape (n,)
        One channel behind its transient.

    Returns
    -------
    RemainingDrift

    Raises
    ------
    FitError
        If fewer than eight samples are given or a value is not finite.
    """
    time = np.asarray(t, dtype=float)
    values = np.asarray(x, dtype=float)
    require_samples(time.size, "in the window")
    length = float(time[-1] - time[0])
    clock = (time - time[0]) / length
    about = values - values.mean()
    total = float(about @ about)
    if np.ptp(values) <= 1e-12 * np.abs(values).max():
        return RemainingDrift(0.0, 0.0, float("inf"), 0.0)
    constants = np.geomspace(SHORTEST, LONGEST, TRIALS)
    for _ in range(REFINEMENTS):
        _, _, _, misfit = _approaches(clock, about, constants)
        best = int(np.argmin(misfit))
        fine = np.geomspace(constants[max(best - 1, 0)], constants[min(best + 1, constants.size - 1)], TRIALS)
        constants = np.union1d(constants, fine)
    shapes, centres, size, misfit = _approaches(clock, about, constants)
    power = np.einsum("ij,ij->i", shapes, shapes)
    best = int(np.argmin(misfit))
    if best == constants.size - 1:
        line = clock - clock.mean()
        spread = float(line @ line)
        slope = float(line @ about) / spread
        density = _density(about - slope * line, total)
        gain = slope**2 * spread / density
        return RemainingDrift(slope, float(np.sqrt(density / spread)), float("inf"), gain)
    density = _density(about - size[best] * shapes[best], total)
    gain = (total - float(misfit[best])) / density
    # Level less mean is -c times the mean of the exponential, for each time constant that the data allow.
    remaining = -size * centres
    own = np.sqrt(density / power) * centres
    allowed = misfit <= misfit[best] + ONE_SIGMA * density
    spread_by_constant = 0.5 * float(np.ptp(remaining[allowed]))
    se = float(np.hypot(own[best], spread_by_constant))
    return RemainingDrift(float(remaining[best]), se, float(constants[best] * length), gain)


def _density(left: np.ndarray, total: float) -> float:
    """Noise density at frequency zero of what a fit leaves; never below rounding."""
    return max(float(fit_autoregression(left, fitted=[(0.0, 3)]).density([0.0])[0, 0]), 1e-24 * total)


def _approaches(
    clock: np.ndarray, about: np.ndarray, constants: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Exponentials without their mean (k, n), those means, their fitted sizes, and the misfits, each (k,)."""
    shapes = np.exp(-clock / constants[:, None])
    centres = shapes.mean(axis=1)
    shapes -= centres[:, None]
    power = np.einsum("ij,ij->i", shapes, shapes)
    size = shapes @ about / power
    misfit = float(about @ about) - size**2 * power
    return shapes, centres, size, np.maximum(misfit, 0.0)
