"""Steady part of a run: which window is averaged, and whether it is stationary.

Transients are cut at both ends (:func:`.transient.transient_ends`), because a run also ends with the carriage
braking. A carriage speed channel, when there is one, limits the search to its plateau.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from ..core.errors import FitError
from .stationarity import Stationarity, stationarity
from .transient import require_samples, transient_ends

Rule = Literal["fraction", "mser", "key-times"]
Rows = slice

# Tolerance of the carriage-speed plateau: part of its level, and multiples of the channel's own noise.
PLATEAU_TOLERANCE = 0.01
PLATEAU_NOISE = 4.0
MOVING_SHARE = 0.5
LEVEL_NEIGHBOURHOOD = 0.05
# The speed is judged on means of about n/PLATEAU_BLOCKS samples, which quiets the channel.
PLATEAU_BLOCKS = 300


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
    require_samples(last - first, "between start and stop")
    if rule == "key-times":
        return _choice(time, channels, slice(first, last), rule, "between the given times")

    reasons = []
    if speed is not None:
        begin, end = speed_plateau(np.asarray(speed, dtype=float)[first:last])
        reasons.append(f"speed plateau {time[first + begin]:.4g} to {time[first + end - 1]:.4g} s")
        first, last = first + begin, first + end
        require_samples(last - first, "on the plateau of the carriage speed")
    begin, end = transient_ends(channels[first:last])
    first, last = first + begin, first + end
    reasons.append(f"steady by MSER {time[first]:.4g} to {time[last - 1]:.4g} s")
    if rule == "fraction":
        length = last - first
        first, last = first + math.ceil(lower * length), first + math.ceil(upper * length)
        reasons.append(f"{100 * lower:.0f}-{100 * upper:.0f} % of it")
    require_samples(last - first, "in the steady part")
    return _choice(time, channels, slice(first, last), rule, ", ".join(reasons))


def _choice(time: np.ndarray, channels: np.ndarray, window: Rows, rule: str, note: str) -> WindowChoice:
    begin, end = float(time[window.start]), float(time[window.stop - 1])
    return WindowChoice(window, rule, begin, end, note, time[window], channels[window])


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
