"""Steady part of a run: where the transient ends, which window is averaged, and whether it is stationary.

The start-up transient is cut where the marginal standard error of what remains is smallest (MSER on batch
means: White 1997; White, Cobb and Spratt 2000), looked for at both ends because a run also ends with the
carriage braking. A carriage speed channel, when there is one, limits the search to its plateau.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from ..core.errors import FitError
from .autoregression import fit_autoregression

Rule = Literal["fraction", "mser", "key-times"]
Rows = slice

MIN_SAMPLES = 8
# MSER-5 averages five samples to a batch; longer records use longer batches so that the search of both
# ends stays within MAX_BATCHES squared trials.
MIN_BATCH = 5
MAX_BATCHES = 120
# A pass that cuts less than this part of the record ends the search.
SMALL_CUT = 0.1
MAX_PASSES = 4
# Tolerance of the carriage-speed plateau: part of its level, and multiples of the channel's own noise.
PLATEAU_TOLERANCE = 0.01
PLATEAU_NOISE = 4.0
MOVING_SHARE = 0.5
LEVEL_NEIGHBOURHOOD = 0.05
# The speed is judged on means of about n/PLATEAU_BLOCKS samples, which quiets the channel.
PLATEAU_BLOCKS = 300


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


@dataclass(frozen=True, eq=False)
class WindowChoice:
    """A window and why it was chosen.

    Attributes
    ----------
    slice : slice
        Rows of the record.
    rule : str
        ``fraction``, ``mser`` or ``key-times``.
    start_time, stop_time : float
        Times of the first and last sample in the window, s.
    note : str
        One sentence for the report.
    times, channels : ndarray, shape (n,) and (n, m)
        Samples of the window.
    """

    slice: Rows
    rule: str
    start_time: float
    stop_time: float
    note: str
    times: np.ndarray = field(repr=False)
    channels: np.ndarray = field(repr=False)

    @cached_property
    def stationarity(self) -> Stationarity:
        """Trend test of the channels in the window, made when it is asked for."""
        return stationarity(self.times, self.channels)

    @property
    def is_stationary(self) -> bool:
        """True when no channel drifts."""
        return self.stationarity.stationary

    @property
    def drift(self) -> tuple[float, ...]:
        """Remaining change of each channel over the window, in its unit."""
        return self.stationarity.drift


def steady_window(
    t: np.ndarray,
    y: np.ndarray,
    *,
    rule: Rule = "fraction",
    fraction: tuple[float, float] = (0.30, 0.95),
    start: float | None = None,
    stop: float | None = None,
    speed: np.ndarray | None = None,
) -> WindowChoice:
    """Choose the window of a steady run that is averaged.

    Parameters
    ----------
    t : ndarray, shape (n,)
        Time in seconds, increasing.
    y : ndarray, shape (n,) or (n, m)
        Measured channels; each is scaled by its own scatter before they are judged together.
    rule : {"fraction", "mser", "key-times"}
        ``mser`` keeps all from the end of the transient to the stop. ``fraction`` takes `fraction` of
        that. ``key-times`` takes what lies between `start` and `stop`.
    fraction : tuple of float
        Begin and end as parts of the steady stretch.
    start, stop : float, optional
        Times in s: the window itself with ``key-times``, else the limits of the search.
    speed : ndarray, shape (n,), optional
        Carriage speed: acceleration and stop phases are cut before the search. Needed where the record also
        holds the model at rest, which is as steady as the run.

    Returns
    -------
    WindowChoice

    Raises
    ------
    FitError
        If fewer than eight samples are left, a value is not finite, or the arguments contradict.
    """
    time = np.asarray(t, dtype=float)
    channels = np.asarray(y, dtype=float)
    channels = channels[:, None] if channels.ndim == 1 else channels
    if rule not in get_args(Rule):
        raise FitError(f"there is no window rule '{rule}'", cure=f"use one of {', '.join(get_args(Rule))}")
    if channels.shape[0] != time.size:
        raise FitError(
            f"the channels have {channels.shape[0]} rows and the time {time.size}",
            cure="cut time and channels with the same window",
        )
    if rule == "key-times" and start is None and stop is None:
        raise FitError("the rule key-times needs a start or a stop time", cure="give start and stop in s")
    lower, upper = fraction
    if not 0.0 <= lower < upper <= 1.0:
        raise FitError(f"the fraction {lower} to {upper} is no window", cure="use 0 <= begin < end <= 1")

    first = 0 if start is None else int(np.searchsorted(time, start))
    last = time.size if stop is None else int(np.searchsorted(time, stop, side="right"))
    _require_samples(last - first, "between start and stop")
    if rule == "key-times":
        return _choice(time, channels, slice(first, last), rule, "between the given times")

    reasons = []
    if speed is not None:
        begin, end = speed_plateau(np.asarray(speed, dtype=float)[first:last])
        reasons.append(f"speed plateau {time[first + begin]:.4g} to {time[first + end - 1]:.4g} s")
        first, last = first + begin, first + end
        _require_samples(last - first, "on the plateau of the carriage speed")
    begin, end = transient_ends(channels[first:last])
    first, last = first + begin, first + end
    reasons.append(f"steady by MSER {time[first]:.4g} to {time[last - 1]:.4g} s")
    if rule == "fraction":
        length = last - first
        first, last = first + math.ceil(lower * length), first + math.ceil(upper * length)
        reasons.append(f"{100 * lower:.0f}-{100 * upper:.0f} % of it")
    _require_samples(last - first, "in the steady part")
    return _choice(time, channels, slice(first, last), rule, ", ".join(reasons))


def _choice(time: np.ndarray, channels: np.ndarray, window: Rows, rule: str, note: str) -> WindowChoice:
    begin, end = float(time[window.start]), float(time[window.stop - 1])
    return WindowChoice(window, rule, begin, end, note, time[window], channels[window])


def _require_samples(count: int, where: str) -> None:
    if count < MIN_SAMPLES:
        raise FitError(
            f"{max(count, 0)} samples {where} are too few, at least {MIN_SAMPLES} are needed",
            cure="widen the window or check the record",
        )


def transient_ends(channels: np.ndarray) -> tuple[int, int]:
    """Rows between which a record is steady, by the marginal standard error rule at both ends.

    Minimises the sum over channels of SSE/(batches kept)^2, each channel scaled by its scatter, over all pairs
    of begin (first half) and end (second half); at least half of the batches are kept. When much was cut, the
    rest is searched again: a long transient hides a shorter one from the first pass.

    Parameters
    ----------
    channels : ndarray, shape (n, m)

    Returns
    -------
    first, last : int
        Half-open range of rows.

    Raises
    ------
    FitError
        If fewer than eight rows are given or a value is not finite.
    """
    n = channels.shape[0]
    _require_samples(n, "in the record")
    if not np.isfinite(channels).all():
        raise FitError("a channel holds values that are not finite", cure="fill or cut the gaps first")
    first, last = 0, n
    for _ in range(MAX_PASSES):
        begin, end = _marginal_ends(channels[first:last])
        cut = last - first - (end - begin)
        if end - begin < MIN_SAMPLES or cut == 0:
            break
        first, last = first + begin, first + end
        if cut < SMALL_CUT * n:
            break
    return first, last


def _marginal_ends(channels: np.ndarray) -> tuple[int, int]:
    n = channels.shape[0]
    batch = max(min(MIN_BATCH, n // MIN_SAMPLES), math.ceil(n / MAX_BATCHES))
    count = n // batch
    # The remainder stays with the last batch's end, so that no row is lost when nothing is cut.
    means = channels[: count * batch].reshape(count, batch, -1).mean(axis=1)
    middle = np.median(means, axis=0)
    scatter = 1.4826 * np.median(np.abs(means - middle), axis=0)
    scatter = np.where(scatter > 0.0, scatter, means.std(axis=0))
    # Rounding of a constant channel is not scatter.
    moving = scatter > 1e-10 * np.abs(means).max(axis=0)
    if not moving.any():
        return 0, n
    z = (means[:, moving] - middle[moving]) / scatter[moving]
    totals = np.vstack([np.zeros(z.shape[1]), np.cumsum(z, axis=0)])
    squares = np.concatenate([[0.0], np.cumsum((z**2).sum(axis=1))])
    half = count // 2
    begins, ends = np.arange(half + 1), np.arange(half, count + 1)
    kept = ends[None, :] - begins[:, None]
    sums = totals[ends][None, :, :] - totals[begins][:, None, :]
    allowed = kept >= max(count - half, 2)
    size = np.where(allowed, kept, 1)
    sse = squares[ends][None, :] - squares[begins][:, None] - (sums**2).sum(axis=2) / size
    statistic = np.where(allowed, sse / size.astype(float) ** 2, np.inf)
    begin, end = np.unravel_index(int(np.argmin(statistic)), statistic.shape)
    last = int(ends[end])
    return int(begins[begin]) * batch, n if last == count else last * batch


def speed_plateau(speed: np.ndarray) -> tuple[int, int]:
    """Rows of the longest stretch on which the carriage speed keeps its level.

    Parameters
    ----------
    speed : ndarray, shape (n,)
        Carriage speed, either sign.

    Returns
    -------
    first, last : int
        Half-open range of rows.

    Raises
    ------
    FitError
        If a value is not finite or the carriage does not move.
    """
    if not np.isfinite(speed).all():
        raise FitError("the carriage speed holds values that are not finite", cure="fill or cut the gaps")
    n = speed.size
    block = max(n // PLATEAU_BLOCKS, 1)
    size = np.abs(speed[: n - n % block].reshape(-1, block).mean(axis=1))
    # A high quantile rather than the maximum: a spike must not decide what counts as moving.
    top = float(np.quantile(size, 0.98))
    if top <= 0.0:
        raise FitError("the carriage does not move", cure="check the speed channel")
    level = float(np.median(size[size > MOVING_SHARE * top]))
    for _ in range(3):
        # The ramps pull the median; the neighbourhood of the level does not hold them.
        near = size[np.abs(size - level) <= LEVEL_NEIGHBOURHOOD * level]
        level = float(np.median(near)) if near.size else level
    noise = 1.4826 * float(np.median(np.abs(np.diff(size)))) / math.sqrt(2.0)
    tolerance = max(PLATEAU_TOLERANCE * level, PLATEAU_NOISE * noise)
    inside = np.concatenate([[False], np.abs(size - level) <= tolerance, [False]])
    changes = np.flatnonzero(np.diff(inside.astype(np.int8)))
    begins, ends = changes[::2], changes[1::2]
    if begins.size == 0:
        raise FitError("the carriage never keeps its speed", cure="check the speed channel, or give key times")
    longest = int(np.argmax(ends - begins))
    first, last = int(begins[longest]), int(ends[longest])
    return first * block, n if last == size.size else last * block


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
    _require_samples(time.size, "in the window")
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
