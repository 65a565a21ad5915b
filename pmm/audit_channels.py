"""Audit of single channels: missing values, dead and saturated channels, spikes, runs that never settle."""

from __future__ import annotations

import math
from collections.abc import Mapping
from itertools import pairwise

import numpy as np

from ..core.findings import Finding, Severity
from ..core.terms import COMPONENTS as FORCES
from .audit_rules import finding

_SPIKE = 12.0
"""Steps between samples beyond this many robust standard deviations are spikes."""

_BLOCKS = 8
_CHANGES, _NEVER_SETTLES = 0.15, 0.50
_ROUNDING = 1e-9


def audit_channels(
    channels: Mapping[str, np.ndarray],
    time: np.ndarray,
    rows: slice,
    *,
    lively: frozenset[str] = frozenset(),
    force_unit: float = 0.0,
) -> list[Finding]:
    """Findings about single channels of one run.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
        In SI.
    time : ndarray, shape (n,)
        In s.
    rows : slice
        Samples at speed: what the forces do at rest does not matter.
    lively : frozenset of str
        Channels that this run must oscillate.
    force_unit : float
        Size of a force in N below which, times 1e-9, only rounding is seen.

    Returns
    -------
    list of Finding
    """
    found: list[Finding] = []
    dead: list[str] = []
    ranges: dict[str, tuple[float, float]] = {}
    for name, values in channels.items():
        if name == "time":
            continue
        if name not in FORCES:
            if not math.isfinite(float(np.dot(values, values))):
                found.append(_missing(name, values, time))
            elif name in lively and values[0] == values[len(values) // 3] and (values == values[0]).all():
                dead.append(name)
            continue
        # argmin and argmax are several times faster than min and max, and stop at NaN as well
        low, high = float(values[values.argmin()]), float(values[values.argmax()])
        if not math.isfinite(low + high):
            found.append(_missing(name, values, time))
        elif low == high:
            dead.append(name)
        else:
            ranges[name] = (low, high)
    largest = max([force_unit, *(abs(value) for limits in ranges.values() for value in limits)])
    alive = {name: high - low for name, (low, high) in ranges.items() if high - low > _ROUNDING * largest}
    for name, span in alive.items():
        found += _flat_tops(name, channels[name][rows])
        found += _spikes(name, channels[name][rows], time[rows], span)
    if dead:
        found += _dead_channels(channels, dead, list(alive), lively)
    return found


def _missing(name: str, values: np.ndarray, time: np.ndarray) -> Finding:
    bad = np.flatnonzero(~np.isfinite(values))
    return finding(
        "missing-values",
        f"{name} is missing in {bad.size} of {len(values)} samples, first at {time[bad[0]]:.6g} s"
        if bad.size
        else f"{name} holds values too large to be measured",
        severity="error" if name in FORCES else "warning",
        place=f"channel {name}",
    )


def _dead_channels(
    channels: Mapping[str, np.ndarray], dead: list[str], alive: list[str], lively: frozenset[str]
) -> list[Finding]:
    found = []
    # Noise-free records of steady runs are constant by right, and noise-free forces may vanish; a dead channel of
    # a balance stands out because the channels beside it are noisy.
    noisy = any(_is_noisy(channels[name]) for name in alive)
    for name in dead:
        if name not in lively and not (noisy and name in FORCES):
            continue
        reason = "the run oscillates it" if name in lively else "the other forces are not constant"
        text = f"{name} is {float(channels[name][0]):.6g} in all samples while {reason}"
        severity: Severity = "error" if noisy and name in FORCES else "warning"
        found.append(finding("constant-channel", text, severity=severity, place=f"channel {name}"))
    return found


def _is_noisy(values: np.ndarray) -> bool:
    steps = np.diff(values[-512:])
    return float(np.mean(steps[1:] * steps[:-1] < 0.0)) > 0.2 if len(steps) > 2 else False


def _flat_tops(name: str, values: np.ndarray) -> list[Finding]:
    highest, lowest = int(values.argmax()), int(values.argmin())
    high, low = values[highest], values[lowest]
    found = []
    for limit, later in ((high, values[highest + 1 :]), (low, values[lowest + 1 :])):
        if later.size and later[later.argmax() if limit == high else later.argmin()] == limit:
            share = _clipped_share(values, float(limit), float(high - low))
            if share:
                text = f"{name} stays at exactly {limit:.6g} in {share:.1%} of the samples"
                found.append(finding("saturated-channel", text, place=f"channel {name}"))
    return found


def _clipped_share(values: np.ndarray, limit: float, span: float) -> float:
    """Share of the samples at `limit` when they look clipped, else 0.

    A coarse converter also repeats its extreme value, but then the value beside it is nearly as frequent; a
    channel that settles on its extreme does so once.
    """
    at = values == limit
    count = int(np.count_nonzero(at))
    distance = np.abs(values - limit)
    others = distance[~at]
    if others.size == 0:
        return 0.0
    next_level = float(others.min())
    beside = int(np.count_nonzero(others <= next_level * (1 + 1e-9)))
    if count < max(10, 0.01 * len(values), 5 * beside) or count > 0.6 * len(values) or next_level > 0.2 * span:
        return 0.0
    # Episodes at the limit that are separated by a real departure from it.
    away = np.flatnonzero(distance > 0.05 * span)
    places = np.flatnonzero(at)
    episodes = len(np.unique(np.searchsorted(away, places)))
    return count / len(values) if episodes >= 2 else 0.0


def _spikes(name: str, values: np.ndarray, time: np.ndarray, span: float) -> list[Finding]:
    steps = values[1:] - values[:-1]
    sample = np.abs(steps[:: max(1, len(steps) // 200)])
    middle = len(sample) // 2
    sample.partition(middle)
    limit = max(_SPIKE * 1.4826 * float(sample[middle]), 0.1 * span)
    if steps[steps.argmax()] <= limit and steps[steps.argmin()] >= -limit:
        return []
    # One or two steps of a coarse converter are no spike.
    sizes = np.abs(steps)
    limit = max(limit, 3.5 * float(sizes[sizes > 1e-6 * span].min()))
    # A spike goes and comes back; a step only goes. What happens at the very start is the transient's.
    first = len(values) // 10
    there, back = steps[first:-1], steps[first + 1 :]
    rows = np.flatnonzero((np.abs(there) > limit) & (np.abs(there + back) < 0.5 * np.abs(there)))
    if rows.size == 0:
        return []
    row = int(rows[0]) + first + 1
    return [
        finding(
            "spikes",
            f"{name} has {rows.size} spike(s), the first at {time[row]:.6g} s: {values[row]:.5g} between "
            f"{values[row - 1]:.5g} and {values[row + 1]:.5g}",
            place=f"channel {name}",
        )
    ]


def audit_steadiness(channels: Mapping[str, np.ndarray], rows: slice) -> list[Finding]:
    """Finding when a steady run never settles.

    X and Y are averaged over eight blocks. The run is all transient when the means of one of them rise or fall
    from block to block to the very end, by more than 15 % of the force in all and by 5 % in the last quarter.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
    rows : slice
        Samples at constant carriage speed.
    """
    names = [name for name in ("X", "Y") if name in channels]
    length = (rows.stop - rows.start) // _BLOCKS
    if not names or length < 2:
        return []
    used = slice(rows.start, rows.start + length * _BLOCKS)
    means = np.array([np.add.reduce(channels[name][used].reshape(_BLOCKS, length), axis=1) for name in names])
    means /= length
    for name, blocks in zip(names, means.tolist()):
        steps = [after - before for before, after in pairwise(blocks)]
        if min(steps) * max(steps) <= 0:
            continue
        size = float(np.median(np.hypot.reduce(means, axis=0)))
        change, late = abs(blocks[-1] - blocks[0]), abs(blocks[-1] - blocks[-3])
        if change > _CHANGES * size and late > 0.05 * size:
            text = (
                f"{name} keeps changing to the end of the run, from {blocks[0]:.4g} N in its first eighth to "
                f"{blocks[-1]:.4g} N in its last"
            )
            return [
                finding("transient-only", text, severity="error" if change > _NEVER_SETTLES * size else "warning")
            ]
    return []
