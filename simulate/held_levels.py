"""Stretches over which a channel is held: the rudder of a spiral, the yaw rate of a reverse spiral."""

from __future__ import annotations

import numpy as np

from .events import FloatArray

_LEAST_SAMPLES = 8
_LEAST_SHARE = 0.25
"""What is held for less than this share of the usual time is a passage between two levels."""

_ASTRAY = 3
"""So many samples outside the band end a level; fewer are noise."""

_MEDIAN = 5

_DRIFT = 0.2
"""Share of the band by which the mean of a level may change from its third quarter to its last."""

_RESOLUTION = np.radians(0.01)
"""Movements of the rudder smaller than this are none."""


def held_levels(values: FloatArray, band: float, rudder: FloatArray) -> list[slice]:
    """Samples of each level that a channel is held at, in the order of time.

    Parameters
    ----------
    values : ndarray, shape (n,)
        At about equal intervals.
    band : float
        A level is left by half of this; the levels differ by more.
    rudder : ndarray, shape (n,)
        Where the rudder begins to move away, the level ends.

    Returns
    -------
    list of slice
        A ramp from one level to the next belongs to neither.
    """
    stretches = [
        (first, _before_the_next_order(rudder, first, last))
        for first, last in _joined(values, _stretches(_median_filtered(values), 0.5 * band), 0.5 * band)
    ]
    if not stretches:
        return []
    lengths = np.sort([end - first for first, end in stretches])
    # the length of stretches in which half of the record lies: passages are many and short
    usual = lengths[np.searchsorted(np.cumsum(lengths), 0.5 * lengths.sum())]
    return [
        slice(first, end)
        for first, end in stretches
        if end - first >= max(_LEAST_SHARE * usual, _LEAST_SAMPLES) and _is_level(values[first:end], band)
    ]


def _is_level(level: FloatArray, band: float) -> bool:
    """True when the mean hardly changes from the third quarter to the last, noise allowed for."""
    quarter = len(level) // 4
    last, before = level[-quarter:], level[-2 * quarter : -quarter]
    chance = 3.0 * float(np.std(last - np.mean(last))) * (2.0 / quarter) ** 0.5
    return abs(float(np.mean(last) - np.mean(before))) < _DRIFT * band + chance


def _joined(values: FloatArray, stretches: list[tuple[int, int]], reach: float) -> list[tuple[int, int]]:
    """Stretches that are long enough; neighbours of one level, which noise has parted, as one."""
    found: list[tuple[int, int]] = []
    for first, last in stretches:
        if last - first < _LEAST_SAMPLES:
            continue
        if found and first - found[-1][1] < _LEAST_SAMPLES:
            before = float(np.mean(values[slice(*found[-1])]))
            if abs(float(np.mean(values[first:last])) - before) < reach:
                found[-1] = (found[-1][0], last)
                continue
        found.append((first, last))
    return found


def _before_the_next_order(rudder: FloatArray, first: int, last: int) -> int:
    """One after the last sample at which the rudder is where it was in the second half of a stretch."""
    half = rudder[(first + last) // 2 : last]
    middle = float(np.median(half))
    scatter = 1.4826 * float(np.median(np.abs(half - middle)))
    still = np.abs(half - middle) <= 4.0 * scatter + _RESOLUTION
    return last - int(np.argmax(still[::-1])) if still.any() else last


def settled_part(level: slice) -> slice:
    """Last quarter of a level, where the motion is steady."""
    return slice(level.stop - max((level.stop - level.start) // 4, 3), level.stop)


def _median_filtered(values: FloatArray) -> FloatArray:
    padded = np.pad(values, _MEDIAN // 2, mode="edge")
    return np.median(np.lib.stride_tricks.sliding_window_view(padded, _MEDIAN), axis=1)


def _stretches(values: FloatArray, reach: float) -> list[tuple[int, int]]:
    """First sample and one after the last of each stretch that stays within `reach` of its mean so far."""
    found = []
    first, mean, astray = 0, float(values[0]), 0
    for row, value in enumerate(values):
        if abs(float(value) - mean) > reach:
            astray += 1
            if astray < _ASTRAY and row - first >= _ASTRAY:
                continue
            found.append((first, row - astray + 1))
            first, mean, astray = row - astray + 1, float(value), 0
            continue
        astray = 0
        mean += (float(value) - mean) / (row - first + 1)
    found.append((first, len(values)))
    return found
