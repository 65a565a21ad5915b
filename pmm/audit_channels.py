"""Audit of single channels: missing values, dead and saturated channels, spikes, runs that never settle."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..core.findings import Finding
from ..core.terms import COMPONENTS as FORCES
from .audit_rules import finding

_SPIKE = 12.0
"""Steps between samples beyond this many robust standard deviations are spikes."""

_BLOCKS, _PARTS = 8, 4
_SETTLED = 0.05
"""Change between blocks, relative to the force, that counts as settled."""


def audit_channels(
    channels: Mapping[str, np.ndarray], time: np.ndarray, *, harmonic: bool, lively: frozenset[str]
) -> list[Finding]:
    """Findings about single channels of one run.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
        In SI.
    time : ndarray, shape (n,)
        In s.
    harmonic : bool
        True for an oscillating run.
    lively : frozenset of str
        Channels that this run must move.

    Returns
    -------
    list of Finding
    """
    found: list[Finding] = []
    dead: list[str] = []
    alive: list[str] = []
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
        lowest, highest = int(values.argmin()), int(values.argmax())
        low, high = float(values[lowest]), float(values[highest])
        if not math.isfinite(low + high):
            found.append(_missing(name, values, time))
        elif low == high:
            dead.append(name)
        else:
            alive.append(name)
            for limit, later in ((high, values[highest + 1 :]), (low, values[lowest + 1 :])):
                if later.size and later[later.argmax() if limit == high else later.argmin()] == limit:
                    found += _flat_top(name, values, limit, high - low)
            found += _spikes(name, values, time, high - low)
    found += _dead_channels(channels, dead, alive, harmonic, lively)
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
    channels: Mapping[str, np.ndarray], dead: list[str], alive: list[str], harmonic: bool, lively: frozenset[str]
) -> list[Finding]:
    found = []
    if not dead:
        return []
    # Noise-free records of steady runs are constant by right, and a noise-free X may be; a dead channel stands
    # out because the channels beside it are noisy or oscillate.
    noisy = any(_is_noisy(channels[name]) for name in alive)
    for name in dead:
        suspicious = name in lively or (noisy and name in FORCES)
        if not suspicious:
            continue
        level = float(channels[name][0])
        other = "the run oscillates it" if name in lively and harmonic else "the other forces are not constant"
        found.append(
            finding(
                "constant-channel",
                f"{name} is {level:.6g} in all samples while {other}",
                severity="error" if name in FORCES else "warning",
                place=f"channel {name}",
            )
        )
    return found


def _is_noisy(values: np.ndarray) -> bool:
    steps = np.diff(values[-512:])
    return float(np.mean(steps[1:] * steps[:-1] < 0.0)) > 0.2 if len(steps) > 2 else False


def _flat_top(name: str, values: np.ndarray, limit: float, span: float) -> list[Finding]:
    share = _clipped_share(values, limit, span)
    if not share:
        return []
    text = f"{name} stays at exactly {limit:.6g} in {share:.1%} of the samples"
    return [finding("saturated-channel", text, place=f"channel {name}")]


def _clipped_share(values: np.ndarray, limit: float, span: float) -> float:
    """Share of the samples at `limit` when they look clipped, else 0.

    A coarse converter also repeats its extreme value, but then the value beside it is nearly as frequent; a
    channel that settles on its extreme does so once.
    """
    at = values == limit
    count = int(np.count_nonzero(at))
    distance = np.abs(values - limit)
    others = distance[~at]
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
    """Finding when no part of a steady run is steady.

    The forces X and Y are averaged over eight blocks; the run has a steady part when three blocks in a row agree
    within 5 % of the force or within four standard errors of their means.

    Parameters
    ----------
    channels : mapping of str to ndarray, shape (n,)
    rows : slice
        Samples at constant carriage speed.
    """
    names = [name for name in ("X", "Y") if name in channels]
    length = (rows.stop - rows.start) // (_BLOCKS * _PARTS)
    if not names or length < 2:
        return []
    used = slice(rows.start, rows.start + length * _BLOCKS * _PARTS)
    parts = np.array([np.add.reduce(channels[name][used].reshape(-1, length), axis=1) for name in names]) / length
    parts = parts.reshape(len(names), _BLOCKS, _PARTS)
    means = np.add.reduce(parts, axis=2) / _PARTS
    size = sorted(math.hypot(*block) for block in means.T.tolist())[_BLOCKS // 2]
    spread = np.array(
        [[max(row[i : i + 3]) - min(row[i : i + 3]) for i in range(_BLOCKS - 2)] for row in means.tolist()]
    )
    if (spread <= _SETTLED * size).all(axis=0).any():
        return []
    error = np.sqrt(np.median(parts.var(axis=2, ddof=1), axis=1) / _PARTS)
    allowed = np.maximum(_SETTLED * size, 4.0 * error)[:, None]
    if (spread <= allowed).all(axis=0).any():
        return []
    worst = int(np.argmax((spread / allowed).max(axis=1)))
    first, last = float(means[worst, 0]), float(means[worst, -1])
    text = (
        f"{names[worst]} keeps changing through the run, from {first:.4g} N in its first eighth to {last:.4g} N "
        "in its last; no part of it is steady"
    )
    return [finding("transient-only", text)]
