"""The free part of a decay record: after the release or the last push, before the noise or the next push."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .extremes import Extremes, find_extremes

# A swing larger than the one before by this factor, beyond the noise, is pushed.
GROWTH = 1.02
# The free part ends where the amplitude is below this many standard deviations of the noise.
NOISE_FLOOR = 3.0
# Before the release the record stands still within this part of the first amplitude.
HELD = 0.05
# A turning point before the release with less than this part of the first amplitude is no push.
SMALL_PUSH = 0.1
FEWEST_EXTREMES = 4
# A stretch that loses less than this part of its first swing does not decay.
SMALLEST_FALL = 0.01


@dataclass(frozen=True, eq=False)
class FreePart:
    """Rows of a record in which the ship moves freely.

    Attributes
    ----------
    rows : slice
    start, end : float
        Times in s.
    extremes : Extremes
        The turning points inside, the first of them at the start.
    pushes : tuple of float
        Times in s of the turning points that were taken for excitations by hand.
    held : bool
        Whether the model was held at an angle until it was let go.
    reason : str
        Why the part starts and ends there.
    """

    rows: slice
    start: float
    end: float
    extremes: Extremes
    pushes: tuple[float, ...]
    held: bool
    reason: str


def find_free_part(
    time: np.ndarray,
    value: np.ndarray,
    *,
    first_amplitude: float | None = None,
    last_amplitude: float | None = None,
    skip: int = 0,
) -> FreePart:
    """Release, pushes before it, and end of a decay.

    The turning points are split where a swing grows; the stretch with the largest product of first amplitude and
    number of half cycles is the decay. It starts at its first turning point when the model was held there or the record
    begins there, and at the second one otherwise: during the largest swing a hand may still have been on the model.

    Parameters
    ----------
    time, value : ndarray, shape (n,)
        Uniformly sampled times in s and coordinate in rad or m.
    first_amplitude : float, optional
        Start at the first turning point with less than this amplitude.
    last_amplitude : float, optional
        End at the last turning point with more; default three standard deviations of the noise.
    skip : int
        Half cycles dropped behind the start.

    Raises
    ------
    FitError
        If the record does not move, oscillate or decay, or too little is left.
    """
    found = find_extremes(time, value)
    if found.value.size < FEWEST_EXTREMES:
        raise FitError(
            f"the record has {found.value.size} turning point(s), which is no oscillation",
            cure="give a record of at least two periods; an overdamped motion has no decay to measure",
        )
    begin, stop = _decaying_stretch(found)
    reasons = ["the largest decaying stretch"]
    held = _held_before(time, value, found, begin)
    pushes = found.time[:begin][found.half_swing[: len(found.time[:begin])] > SMALL_PUSH * found.half_swing[begin]]
    if begin > 0 and not held:
        begin += 1
        reasons.append("its first half cycle dropped because it was pushed")
    begin += max(skip, 0)
    if skip:
        reasons.append(f"{skip} half cycle(s) skipped as asked")
    swings = found.half_swing
    if first_amplitude is not None:
        while begin < stop and swings[min(begin, swings.size - 1)] > first_amplitude:
            begin += 1
        reasons.append(f"from an amplitude of {first_amplitude:.4g}")
    floor = NOISE_FLOOR * found.noise if last_amplitude is None else last_amplitude
    below = np.flatnonzero(swings[begin:stop] < floor)
    if below.size:
        stop = begin + int(below[0])
        reasons.append(f"to the amplitude {floor:.4g}" + ("" if last_amplitude is not None else " of the noise"))
    if stop - begin + 1 < FEWEST_EXTREMES:
        raise FitError(
            f"{max(stop - begin + 1, 0)} turning point(s) of a free decay are left",
            cure="widen the amplitudes, skip fewer half cycles, or give a longer record",
        )
    part = found.part(slice(begin, stop + 1))
    first = _let_go(time, value, part) if held else int(part.index[0])
    last = int(part.index[-1])
    if stop == found.value.size - 1:
        # The last turning point that stands out: half a period behind it still belongs to the decay.
        last = min(int(np.searchsorted(time, time[last] + 0.5 * part.period)), time.size - 1)
    return FreePart(
        slice(first, last + 1),
        float(time[first]),
        float(time[last]),
        part,
        tuple(float(t) for t in pushes),
        held,
        ", ".join(reasons),
    )


def _decaying_stretch(found: Extremes) -> tuple[int, int]:
    """First and last turning point of the stretch in which no swing grows."""
    swings = found.half_swing
    grows = np.flatnonzero(swings[1:] > GROWTH * swings[:-1] + 2.0 * found.noise) + 1
    begins = np.concatenate([[0], grows])
    ends = np.concatenate([grows, [swings.size]])
    weight = swings[begins] * (ends - begins)
    best = int(np.argmax(weight))
    begin, end = int(begins[best]), int(ends[best])
    fall = swings[begin] - swings[end - 1]
    if end - begin < FEWEST_EXTREMES - 1 or not fall > SMALLEST_FALL * swings[begin]:
        raise FitError(
            "the swings of the record do not decay",
            cure="check that it is a free decay, and its direction of time",
            place=f"longest stretch without growth {found.time[begin]:.4g} to {found.time[end]:.4g} s",
        )
    return begin, end


def _held_before(time: np.ndarray, value: np.ndarray, found: Extremes, begin: int) -> bool:
    """Whether the record stands still at the height of the first turning point for a quarter period before it."""
    row = int(found.index[begin])
    if row == 0:
        return False
    amplitude = float(found.half_swing[begin])
    level = float(found.value[begin])
    first = int(np.searchsorted(time, time[row] - 0.25 * found.period))
    band = max(HELD * amplitude, NOISE_FLOOR * found.noise)
    before = np.abs(value[first:row] - level) < band
    after = np.searchsorted(time, time[row] + 0.25 * found.period)
    behind = np.abs(value[row : int(after)] - level) < band
    # A free turning point leaves this band within a seventh of a period on either side.
    return bool((before.all() and before.size > 2) or (behind.all() and behind.size > 2))


def _let_go(time: np.ndarray, value: np.ndarray, part: Extremes) -> int:
    """Row at which a held model starts to move: a quarter period before it passes the middle."""
    level, middle = float(part.value[0]), 0.5 * float(part.value[0] + part.value[1])
    first = int(part.index[0])
    passed = np.flatnonzero((value[first:] - middle) * np.sign(level - middle) < 0.0)
    crossing = time[first + int(passed[0])] if passed.size else time[first]
    return max(first, int(np.searchsorted(time, crossing - 0.25 * part.period)))
