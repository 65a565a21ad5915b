"""Noise filters of records, by name, none of which delays anything.

The default is a Butterworth low-pass of order 4, run forward and backward, with a cut-off of ``3 sqrt(g/L)`` Hz: a
model of 4 m is cut at 4.7 Hz and a ship of 350 m at 0.5 Hz, above the third harmonic of head waves of half the ship's
length. Means over a steady window hardly change by it; what it is for is the look of a record, and extremes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..core.errors import FitError
from ..core.variables import GRAVITY
from ..identify.low_pass import FILTER_ORDER, is_uniform, low_pass
from .sinkage_record import SinkageRecord

DEFAULT = "butterworth"
CUTOFF_FACTOR = 3.0
"""Default cut-off in Hz over sqrt(g/L)."""

Smooth = Callable[[np.ndarray, float, float], np.ndarray]


@dataclass(frozen=True)
class NoiseFilter:
    """One filter.

    Attributes
    ----------
    key : str
    smooth : callable
        ``smooth(values, step, cutoff)`` of uniform samples, shape (n,).
    meaning : str
        One line for tables.
    """

    key: str
    smooth: Smooth
    meaning: str


def _butterworth(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    return low_pass(values, step, cutoff, FILTER_ORDER)


def _half_width(step: float, cutoff: float) -> int:
    """Samples on each side of a window whose mean lets half the power pass at the cut-off: 0.443 periods of it."""
    return max(round(0.5 * (0.443 / (cutoff * step) - 1.0)), 0)


def _moving_mean(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    # Windows shrink at the ends, so that they stay centred.
    half = np.minimum(_half_width(step, cutoff), np.minimum(np.arange(values.size), np.arange(values.size)[::-1]))
    total = np.concatenate([[0.0], np.cumsum(values - values[0])])
    rows = np.arange(values.size)
    return np.asarray(values[0] + (total[rows + half + 1] - total[rows - half]) / (2 * half + 1))


def _median(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    from scipy.ndimage import median_filter

    return np.asarray(median_filter(values, size=2 * max(_half_width(step, cutoff), 1) + 1, mode="mirror"))


def _none(values: np.ndarray, step: float, cutoff: float) -> np.ndarray:
    return np.array(values, dtype=float)


FILTERS: dict[str, NoiseFilter] = {
    item.key: item
    for item in (
        NoiseFilter("butterworth", _butterworth, "Butterworth low-pass, order 4, forward and backward"),
        NoiseFilter("moving-mean", _moving_mean, "centred mean that passes half the power at the cut-off"),
        NoiseFilter("median", _median, "centred median over the same width, against spikes"),
        NoiseFilter("none", _none, "the record as it is"),
    )
}
"""The filters by name."""


def default_cutoff(length: float) -> float:
    """Cut-off in Hz, ``3 sqrt(g/L)``, of a ship or model of a length in m."""
    return CUTOFF_FACTOR * float(np.sqrt(GRAVITY / length))


def filter_record(record: SinkageRecord, name: str = DEFAULT, *, cutoff: float | None = None) -> SinkageRecord:
    """A record without its noise.

    Parameters
    ----------
    record : SinkageRecord
        Uniformly sampled, without missing values.
    name : str
        A key of :data:`FILTERS`.
    cutoff : float, optional
        Frequency in Hz at which one pass halves the power; :func:`default_cutoff` of the ship when not given.

    Returns
    -------
    SinkageRecord
        Sinkage, trim and heel filtered; speed and extra channels as they were. Its history names filter and cut-off.

    Raises
    ------
    FitError
        For an unknown filter, a cut-off that is not positive, fewer than eight samples, or samples that are missing
        or not uniform.
    """
    if name not in FILTERS:
        raise FitError(f"there is no filter '{name}'", cure=f"use one of {', '.join(FILTERS)}")
    frequency = default_cutoff(record.layout.length) if cutoff is None else cutoff
    if not (frequency > 0.0 and np.isfinite(frequency)):
        raise FitError(f"a cut-off of {frequency:g} Hz is impossible", cure="give it in Hz, positive")
    channels = {"midship": record.midship, "trim": record.trim}
    if record.heel is not None:
        channels["heel"] = record.heel
    _require_uniform(record, channels)
    step = float(np.mean(np.diff(record.time)))
    smooth = FILTERS[name].smooth
    filtered = {channel: smooth(values, step, frequency) for channel, values in channels.items()}
    said = "not filtered" if name == "none" else f"{name} filter, {frequency:.4g} Hz"
    return replace(
        record,
        midship=filtered["midship"],
        trim=filtered["trim"],
        heel=filtered.get("heel"),
        history=(*record.history, said),
    )


def _require_uniform(record: SinkageRecord, channels: dict[str, np.ndarray]) -> None:
    file = record.name or None
    if record.time.size < 8:
        raise FitError(
            f"{record.time.size} samples are too few for a filter", cure="give the whole record", file=file
        )
    if not (np.isfinite(record.time).all() and (np.diff(record.time) > 0.0).all() and is_uniform(record.time)):
        raise FitError(
            "the steps of time differ: a filter would take a gap for one step",
            cure="cut the record at its gaps, or sample it uniformly",
            file=file,
            place="time",
        )
    for name, values in channels.items():
        missing = int(np.count_nonzero(~np.isfinite(values)))
        if missing:
            raise FitError(
                f"{missing} of {values.size} values are missing",
                cure="cut the record there",
                file=file,
                place=name,
            )
