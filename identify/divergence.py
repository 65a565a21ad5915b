"""Has a computation blown up: values that are no numbers, or a scatter that grows towards the end."""

from __future__ import annotations

import numpy as np

BLOCKS = 24
# The last blocks must grow one after the other, end this far above the usual range, and be no rounding noise.
GROWING = 3
BLOW_UP = 30.0
# A slower instability: the range grows in nearly every block of the second half, and in all by this factor.
SLOW_GROWTH = 8.0
SLOW_SHARE = 0.8
NOTICEABLE = 0.01


def divergence_row(x: np.ndarray) -> int | None:
    """Row from which on a channel is diverged; None when it is not.

    A channel diverges when a value is not finite; when the range of its last blocks grows one after the other to more
    than thirty times the median range; or when its range grows through nearly all of the second half, by a factor
    of eight or more. A range below 1 % of the level is no divergence: residual noise may grow in peace.

    Parameters
    ----------
    x : ndarray, shape (n,)
        One channel.
    """
    values = np.asarray(x, dtype=float)
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        return int(bad[0])
    blocks = min(BLOCKS, values.size // 4)
    if blocks < 2 * GROWING:
        return None
    length = values.size // blocks
    offset = values.size - blocks * length
    ranges = np.ptp(values[offset:].reshape(blocks, length), axis=1)
    level = abs(float(np.median(values)))
    if ranges[-1] <= NOTICEABLE * level or ranges[-1] <= 0.0:
        return None
    usual = float(np.median(ranges))
    tail = ranges[-GROWING - 1 :]
    if (np.diff(tail) > 0.0).all() and ranges[-1] > BLOW_UP * usual:
        first = int(np.flatnonzero(ranges <= BLOW_UP * usual)[-1]) + 1
        return offset + first * length
    half = ranges[blocks // 2 :]
    grows = float((np.diff(half) > 0.0).mean()) >= SLOW_SHARE
    if grows and half[-1] > SLOW_GROWTH * half[0] and ranges[-1] >= ranges.max():
        return offset + (blocks // 2) * length
    return None
