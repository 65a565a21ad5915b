"""Audit of the time channel: order, repetition, rounding, gaps, uniformity."""

from __future__ import annotations

import math

import numpy as np

from ..core.findings import Finding
from .audit_rules import finding

FEWEST_SAMPLES = 10
UNIFORM = 0.02
"""Largest spread of the sampling interval, relative to it, that counts as uniform."""

_LONG_STEP = 1.5
_FEW = 0.005
_LONG_GAP = 10


def audit_time(time: np.ndarray) -> tuple[list[Finding], bool]:
    """Findings about the time channel, and whether the record can be audited further.

    Parameters
    ----------
    time : ndarray, shape (n,)
        In s.

    Returns
    -------
    findings : list of Finding
    usable : bool
        False when time does not order the samples.
    """
    n = len(time)
    if n < FEWEST_SAMPLES:
        return [finding("too-short", f"{n} sample(s), at least {FEWEST_SAMPLES} are expected")], False
    steps = time[1:] - time[:-1]
    smallest, largest = float(steps.min()), float(steps.max())
    if not math.isfinite(smallest + largest):
        bad = int(np.count_nonzero(~np.isfinite(time)))
        return [finding("missing-values", f"time is missing in {bad} of {n} samples", place="time")], False
    mean = float(time[-1] - time[0]) / (n - 1)
    if smallest > 0.0 and largest - smallest <= UNIFORM * mean:
        return [], True
    return _irregular(time, steps)


def _irregular(time: np.ndarray, steps: np.ndarray) -> tuple[list[Finding], bool]:
    forward = steps[steps > 0.0]
    if forward.size == 0:
        return [finding("time-not-increasing", "time never increases")], False
    usual = float(np.median(forward))
    back = np.flatnonzero(steps < 0.0)
    if back.size:
        return [_backwards(time, back)], False
    if (rounded := _rounding(time, steps)) is not None:
        return [rounded], True
    found = []
    repeated = np.flatnonzero(steps == 0.0)
    if repeated.size:
        share = repeated.size / len(steps)
        found.append(
            finding(
                "time-duplicated",
                f"{repeated.size} of {len(time)} time stamps repeat the one before, the first at "
                f"{time[repeated[0]]:.6g} s",
                severity="error" if share > 0.01 else "warning",
                place="time",
            )
        )
    long = np.flatnonzero(steps > _LONG_STEP * usual)
    if 0 < long.size <= max(5.0, _FEW * len(steps)):
        found.append(_gap(time, steps, long, usual))
        regular = np.delete(steps, np.concatenate([long, repeated]))
    else:
        regular = np.delete(steps, repeated)
    spread = float(regular.std()) / usual
    if spread > UNIFORM:
        found.append(
            finding(
                "non-uniform-sampling",
                f"the sampling interval varies between {regular.min():.4g} and {regular.max():.4g} s "
                f"(median {usual:.4g} s)",
                place="time",
            )
        )
    return found, True


def _backwards(time: np.ndarray, back: np.ndarray) -> Finding:
    row = int(back[0])
    if back.size <= max(3, len(time) // 1000):
        overlap = int(np.count_nonzero(time[: row + 1] >= time[row + 1]))
        return finding(
            "time-overlap",
            f"time jumps back {back.size} time(s), first from {time[row]:.6g} to {time[row + 1]:.6g} s after "
            f"sample {row + 1}: {overlap} sample(s) overlap the restarted run",
            place="time",
        )
    return finding(
        "time-not-increasing",
        f"time decreases in {back.size} places, first from {time[row]:.6g} to {time[row + 1]:.6g} s after "
        f"sample {row + 1}",
        place="time",
    )


def _rounding(time: np.ndarray, steps: np.ndarray) -> Finding | None:
    """Rounded stamps of an even clock: all are multiples of a decimal and none is off by more than rounding."""
    n = len(time)
    mean = float(time[-1] - time[0]) / (n - 1)
    sample = time[: min(n, 200)]
    for power in range(10):
        quantum = 10.0**-power
        if quantum < UNIFORM * mean / 2:
            return None
        ticks = sample / quantum
        if np.abs(ticks - np.rint(ticks)).max() < 1e-3:
            break
    else:
        return None
    even = time[0] + mean * np.arange(n)
    if np.abs(time - even).max() > 1.01 * quantum:
        return None
    equal = float(np.count_nonzero(steps == 0.0)) / (n - 1)
    return finding(
        "time-rounded",
        f"time stamps are rounded to {quantum:g} s while samples are {mean:.4g} s apart"
        + (f"; {equal:.0%} of them are equal" if equal else ""),
        severity="error" if equal > 0.5 else "warning",
        place="time",
    )


def _gap(time: np.ndarray, steps: np.ndarray, long: np.ndarray, usual: float) -> Finding:
    missing = np.rint(steps[long] / usual) - 1.0
    total, longest = int(missing.sum()), int(missing.max())
    worst = int(long[int(np.argmax(missing))])
    grave = longest >= _LONG_GAP or total > 0.02 * len(time)
    return finding(
        "gap",
        f"{max(total, 1)} sample(s) are missing in {long.size} gap(s), the longest after {time[worst]:.6g} s "
        f"({steps[worst]:.4g} s instead of {usual:.4g} s)",
        severity="error" if grave else "warning",
        place="time",
    )
