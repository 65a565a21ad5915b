"""When has a run settled: verdict, cut, mean with its error, remaining drift.

One call for the force histories of a computation or of a long steady run. The transient is cut by
:func:`.transient.transient_cut` (for periodic runs by whole cycles, :func:`.cycle_convergence.cycle_convergence`);
the mean has its standard error from the autocorrelation, with batch means beside it; what is left of the transient
is estimated by :func:`.stationarity.remaining_drift`.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .autocorrelation import mean_with_error
from .batch_means import batch_means
from .cycle_convergence import CycleConvergence, cycle_convergence
from .divergence import divergence_row
from .even_time import even_record
from .frequency import find_frequency
from .harmonics import fit_harmonics
from .stationarity import remaining_drift, stationarity
from .transient import transient_cut

Verdict = Literal["settled", "still drifting", "periodic", "diverged", "too short"]
VERDICTS: tuple[Verdict, ...] = ("settled", "still drifting", "periodic", "diverged", "too short")

MIN_SAMPLES = 40
# Fewer independent samples than this do not tell an error of the mean, unless that error is harmless.
MIN_EFFECTIVE = 8.0
# Drift below this part of the channel's root mean square does not matter.
TOLERANCE = 0.01
# Significance that a remaining drift needs, in standard errors and as chi-square of its fit.
SIGNIFICANT = 3.0
EXPLAINS = 16.0
TREND_LEVEL = 0.002
# A record is periodic when the harmonics of its first half predict this share of the variance of its second half.
COHERENCE = 0.5
MIN_CYCLES = 4
LINE_SHARE = 0.25
ORDER = 3


@dataclass(frozen=True, eq=False)
class ChannelSettling:
    """Verdict and mean of one channel.

    Attributes
    ----------
    verdict : str
        ``settled``, ``still drifting``, ``periodic``, ``diverged`` or ``too short``.
    mean, se : float
        Mean behind the cut and its standard error from the autocorrelation, in the unit of the channel; nan when
        the channel diverged.
    dof, n_eff : float
        Degrees of freedom of `se`; independent samples (whole cycles kept for a periodic channel).
    batch_se : float
        Standard error by batch means.
    drift, drift_se : float
        Remaining drift of the mean and its standard error; for a periodic channel, that of the first harmonic's
        amplitude.
    time_constant : float
        Of the approach, in the unit of time; inf when the record shows no bend, nan where none was fitted.
    cycles : CycleConvergence or None
        Cycle by cycle, for a periodic channel.
    amplitude, amplitude_se : float
        First harmonic of a periodic channel behind the cut; nan for the others.
    note : str
        Why, in one sentence.
    """

    verdict: Verdict
    mean: float
    se: float
    dof: float
    n_eff: float
    batch_se: float
    drift: float
    drift_se: float
    time_constant: float
    note: str
    cycles: CycleConvergence | None = None
    amplitude: float = math.nan
    amplitude_se: float = math.nan

    @property
    def standard_uncertainty(self) -> float:
        """Error of the mean with the drift that is still to come: root sum of squares of `se` and `drift`.

        The drift counts when it exceeds twice its own error; for a periodic channel `se` stands alone.
        """
        known = self.cycles is None and abs(self.drift) > 2.0 * self.drift_se
        return math.hypot(self.se, self.drift) if known else self.se

    def half_width(self, level: float = 0.95) -> float:
        """Half width of the t-interval of the mean at `level`."""
        from scipy.special import stdtrit

        return float(stdtrit(self.dof, 0.5 + 0.5 * level)) * self.se


@dataclass(frozen=True, eq=False)
class Settling:
    """Verdicts of all channels of a run.

    Attributes
    ----------
    channels : tuple of ChannelSettling
        In the order of the columns.
    first : int
        First row that is kept, of the even grid; the same for all channels.
    cut_time, end_time : float
        Times of the first row kept and of the last row.
    omega : float
        Frequency of a periodic run, rad per unit of time; nan for the others.
    interpolated : bool
        True when a varying time step was made even.
    note : str
        How the transient was cut.
    """

    channels: tuple[ChannelSettling, ...]
    first: int
    cut_time: float
    end_time: float
    omega: float
    interpolated: bool
    note: str

    @property
    def verdict(self) -> Verdict:
        """The worst verdict of the channels: diverged, still drifting, too short, periodic, settled."""
        found = {channel.verdict for channel in self.channels}
        for verdict in ("diverged", "still drifting", "too short", "periodic"):
            if verdict in found:
                return verdict  # type: ignore[return-value]
        return "settled"


def settle(
    t: np.ndarray,
    x: np.ndarray,
    *,
    omega: float | None = None,
    tolerance: Sequence[float] | None = None,
    start: float | None = None,
) -> Settling:
    """Cut the transient, judge, and give each channel's mean with its error.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time or iteration number, increasing; a varying step is made even.
    x : ndarray, shape (n,) or (n, m)
        Channels.
    omega : float, optional
        Frequency of a forced motion, rad per unit of `t`. A natural period is looked for when omitted.
    tolerance : sequence of m floats, optional
        Drift that does not matter, in the unit of each channel; 1 % of the root mean square when omitted.
    start : float, optional
        Cut here instead of where the rules say.

    Returns
    -------
    Settling

    Raises
    ------
    FitError
        If time does not increase, the channels do not fit it, or `start` leaves nothing.
    """
    time, channels = np.asarray(t, dtype=float), np.asarray(x, dtype=float)
    channels = channels[:, None] if channels.ndim == 1 else channels
    if channels.shape[0] != time.size:
        raise FitError(
            f"the channels have {channels.shape[0]} rows and the time {time.size}",
            cure="cut time and channels with the same window",
        )
    rows = [divergence_row(column) for column in channels.T]
    diverged = [row for row in rows if row is not None]
    if diverged:
        return _diverged(time, rows, min(diverged))
    if time.size < MIN_SAMPLES:
        note = f"{time.size} samples are too few for a verdict, at least {MIN_SAMPLES} are needed"
        end = float(time[-1]) if time.size else math.nan
        each = tuple(_no_mean("too short", note) for _ in channels.T)
        return Settling(each, 0, float(time[0]) if time.size else math.nan, end, math.nan, False, note)
    time, channels, interpolated = even_record(time, channels)
    harmless = _tolerances(channels, tolerance)
    found = [omega if omega is not None else natural_frequency(time, column) for column in channels.T]
    strongest = omega
    cycles = [
        _cycles(time, column, value, float(limit), omega is not None) if value is not None else None
        for column, value, limit in zip(channels.T, found, harmless)
    ]
    if omega is None:
        strongest = next((own.omega for own in cycles if own is not None), None)
    first, note = _cut(time, channels, cycles, harmless, start)
    window = slice(first, time.size)
    judged = tuple(
        _periodic(time[window], column[window], own)
        if own is not None
        else _steady(time[window], column[window], limit)
        for column, own, limit in zip(channels.T, cycles, harmless)
    )
    at = math.nan if strongest is None else float(strongest)
    return Settling(judged, first, float(time[first]), float(time[-1]), at, interpolated, note)


def _diverged(time: np.ndarray, rows: list[int | None], first: int) -> Settling:
    channels = tuple(
        _no_mean("diverged", f"diverged from {time[row]:.6g} on")
        if row is not None
        else _no_mean("diverged", f"another channel diverged at {time[first]:.6g}")
        for row in rows
    )
    note = f"diverged from {time[first]:.6g} on: no mean is given"
    return Settling(channels, time.size, math.nan, float(time[-1]), math.nan, False, note)


def _no_mean(verdict: Verdict, note: str) -> ChannelSettling:
    nan = math.nan
    return ChannelSettling(verdict, nan, nan, nan, nan, nan, nan, nan, nan, note)


def _tolerances(channels: np.ndarray, given: Sequence[float] | None) -> np.ndarray:
    if given is None:
        # The later half: the transient of an impulsive start is many times the level.
        later = channels[channels.shape[0] // 2 :]
        return TOLERANCE * np.sqrt((later**2).mean(axis=0))
    return np.broadcast_to(np.asarray(given, dtype=float), (channels.shape[1],))


def _cycles(time: np.ndarray, values: np.ndarray, omega: float, tolerance: float, given: bool) -> CycleConvergence:
    """Cycles of a periodic channel; a frequency that was found is found again behind the transient."""
    cycles = cycle_convergence(time, values, omega, order=ORDER, tolerance=tolerance)
    kept = time >= cycles.start_time
    if given or cycles.cycles - cycles.drop < MIN_CYCLES:
        return cycles
    try:
        better = find_frequency(time[kept], values[kept], order=ORDER).omega
    except FitError:
        return cycles
    if abs(better - omega) * float(time[-1] - time[0]) > math.pi:
        # Another line than the one that repeats itself.
        return cycles
    return cycle_convergence(time, values, better, order=ORDER, tolerance=tolerance)


def _cut(
    time: np.ndarray,
    channels: np.ndarray,
    cycles: list[CycleConvergence | None],
    tolerance: np.ndarray,
    start: float | None,
) -> tuple[int, str]:
    """First row kept, and how it was found."""
    if start is not None:
        first = int(np.searchsorted(time, start))
        if time.size - first < MIN_SAMPLES:
            raise FitError(
                f"{time.size - first} samples lie behind the cut at {start:.6g}",
                cure=f"cut earlier: at least {MIN_SAMPLES} are needed, the record ends at {time[-1]:.6g}",
            )
        return first, "cut as given"
    steady = [number for number, own in enumerate(cycles) if own is None]
    first, notes = 0, []
    if steady:
        found = transient_cut(channels[:, steady], tolerance[steady])
        first = found.first
        if found.at_limit:
            # What is left is too short to judge by: the second half tells whether it still drifts, and where to.
            first = time.size // 2
            notes.append("the transient reaches to the end of the record, the second half is judged")
        else:
            notes.append(found.note)
    periodic = [own for own in cycles if own is not None]
    if periodic:
        begin = max(own.start_time for own in periodic)
        drop = max(own.drop for own in periodic)
        # The sample nearest to the start of the cycle: a later one would cost a whole cycle.
        first = max(first, int(np.searchsorted(time, begin - 0.5 * float(time[1] - time[0]))))
        notes.append(f"{drop} of {periodic[0].cycles} cycles dropped")
    return min(first, time.size - MIN_SAMPLES // 2), "; ".join(notes)


def natural_frequency(t: np.ndarray, x: np.ndarray) -> float | None:
    """Frequency of a record that repeats itself, rad per unit of `t`; None when it does not.

    A line must carry a quarter of the variance of the second half of the record (where the transient is over), return
    at least four times there, and be coherent: the harmonics fitted to the first half of that stretch must predict
    half of the variance of the rest.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time, even.
    x : ndarray, shape (n,)
        One channel.
    """
    half = t.size // 2
    time, values = t[half:], x[half:] - x[half:].mean()
    n = values.size
    if np.ptp(values) <= 1e-9 * max(float(np.abs(x[half:]).max()), 1e-300):
        return None
    line = np.linspace(-0.5, 0.5, n)
    values = values - line * float(line @ values) / float(line @ line)
    power = np.abs(np.fft.rfft(values * np.hanning(n))) ** 2
    # A Hanning window spreads a line over its two neighbours.
    near = np.convolve(power, np.ones(3), mode="same")
    peak = int(np.argmax(near[1:])) + 1
    if peak < MIN_CYCLES or near[peak] < LINE_SHARE * float(power[1:].sum()):
        return None
    try:
        omega = find_frequency(time, values, order=1).omega
        middle = n // 2
        order = ORDER if omega * (time[1] - time[0]) * (ORDER + 1) < math.pi else 1
        fit = fit_harmonics(time[:middle], values[:middle], omega=omega, order=order)
    except FitError:
        return None
    left = values[middle:] - fit.predict(time[middle:])
    return omega if left.var() < (1.0 - COHERENCE) * values[middle:].var() else None


def _periodic(time: np.ndarray, values: np.ndarray, cycles: CycleConvergence) -> ChannelSettling:
    period = 2.0 * math.pi / cycles.omega
    step = float(time[1] - time[0])
    whole = math.floor((time.size * step) / period + 0.25 * step / period)
    if whole < 1:
        return _no_mean("too short", "less than one cycle is left behind the transient")
    kept = slice(time.size - min(round(whole * period / step), time.size), time.size)
    fit = fit_harmonics(time[kept], values[kept], omega=cycles.omega, order=ORDER)
    if cycles.converged:
        verdict: Verdict = "periodic"
        note = f"{cycles.drop} of {cycles.cycles} cycles dropped, {whole} kept"
    elif cycles.cycles - cycles.drop < 2:
        verdict, note = "still drifting", f"no two of {cycles.cycles} cycles agree at the end"
    elif abs(float(cycles.trend[0])) > max(SIGNIFICANT * float(cycles.trend_se[0]), cycles.tolerance):
        change, error = float(cycles.trend[0]), float(cycles.trend_se[0])
        verdict = "still drifting"
        note = f"the mean of a cycle changed by {change:+.4g} ± {error:.2g} over the last half of the cycles"
    else:
        verdict, note = "still drifting", "the first harmonic still changes from cycle to cycle"
    a, b = fit.se_cos[0], fit.se_sin[0]
    return ChannelSettling(
        verdict=verdict,
        mean=float(fit.mean),
        se=float(fit.se_mean),
        dof=float(fit.dof[0]),
        n_eff=float(whole),
        batch_se=batch_means(values[kept], max(whole, 2)).se,
        drift=cycles.remaining,
        drift_se=cycles.remaining_se,
        time_constant=math.nan,
        note=note,
        cycles=cycles,
        amplitude=float(fit.amplitude[0]),
        amplitude_se=float(math.hypot(a * fit.cos[0], b * fit.sin[0]) / max(float(fit.amplitude[0]), 1e-300)),
    )


def _steady(time: np.ndarray, values: np.ndarray, tolerance: float) -> ChannelSettling:
    mean = mean_with_error(values)
    drift = remaining_drift(time, values)
    trend = stationarity(time, values, level=TREND_LEVEL, tolerance=tolerance)
    approaches = drift.significance > SIGNIFICANT and drift.gain > EXPLAINS and abs(drift.value) > tolerance
    half = float(mean.se) * SIGNIFICANT
    verdict: Verdict
    if approaches or not trend.stationary:
        verdict = "still drifting"
        note = _drift_note(drift.value, drift.se, drift.time_constant)
    elif float(mean.n_eff) < MIN_EFFECTIVE and half > tolerance:
        verdict = "too short"
        note = f"only {float(mean.n_eff):.1f} independent samples behind the transient"
    else:
        verdict = "settled"
        note = "does not vary" if bool(mean.constant) else f"{float(mean.n_eff):.0f} independent samples"
    return ChannelSettling(
        verdict=verdict,
        mean=float(mean.mean),
        se=float(mean.se),
        dof=float(mean.dof),
        n_eff=float(mean.n_eff),
        batch_se=batch_means(values).se,
        drift=drift.value,
        drift_se=drift.se,
        time_constant=drift.time_constant,
        note=note,
    )


def _drift_note(value: float, se: float, time_constant: float) -> str:
    if math.isinf(time_constant):
        return f"drifts without a bend: {value:+.4g} ± {se:.2g} over one more window as long as this one"
    return f"the mean would still change by {value:+.4g} ± {se:.2g} (time constant {time_constant:.4g})"
