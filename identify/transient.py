"""Where a start-up transient ends.

Two rules, and the later of them decides. MSER (White 1997; White, Cobb and Spratt 2000) cuts where the marginal
standard error of what remains is smallest; it may leave the foot of a ramp where noise hides it. A broken line (ramp,
then level) fitted to the whole record with its break profiled out says how far that foot may reach: the upper
confidence limit of the break, with the noise's autocorrelation in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .autoregression import fit_autoregression

MIN_SAMPLES = 8
# MSER-5 averages five samples to a batch; longer records use longer batches so that the search of both
# ends stays within MAX_BATCHES squared trials.
MIN_BATCH = 5
MAX_BATCHES = 120
# A pass that cuts less than this part of the record ends the search.
SMALL_CUT = 0.1
MAX_PASSES = 4
# The search of the start alone is linear in the number of batches and may look more closely.
START_BATCHES = 250
# A broken line must explain this many times the noise density to count as a ramp (chi-square, two unknowns).
RAMP_GAIN = 12.0
# Scatter before the cut over the scatter behind it that counts as a transient about the level.
SCATTER_GAIN = 16.0
# Rise of the misfit that limits the break: three standard deviations, one unknown.
BREAK_GAIN = 9.0
# The break is looked for in this part of the record: behind it too little is left to tell a level.
BREAK_SEARCH = 0.85
# What is cut beyond the limit: a share of the ramp (real ramps end in a bend), and whole batches.
MARGIN_SHARE = 0.03
MARGIN_BATCHES = 2
# Batches behind a ramp in which another, smaller one is looked for.
MIN_LEVEL = 16
# A cut beyond this part of the record leaves too little to say that it is level.
LATEST_CUT = 0.85
# A record is quiet when its batches scatter by less than this part of the tolerance about their final level.
QUIET = 0.25


@dataclass(frozen=True)
class TransientCut:
    """Where the transient of a record ends.

    Attributes
    ----------
    first : int
        First row that is kept.
    mser, ramp : int
        Rows that MSER and the broken line ask for, of the channel that asks for most.
    at_limit : bool
        True when the transient reaches so far that what remains is no record: it has not settled.
    note : str
        One sentence for the report.
    """

    first: int
    mser: int
    ramp: int
    at_limit: bool
    note: str


def transient_cut(x: np.ndarray, tolerance: float | np.ndarray = 0.0) -> TransientCut:
    """First row behind the start-up transient: the later of MSER and the upper limit of a ramp's end.

    Nothing is cut where neither rule finds a transient that stands out of the autocorrelated noise, so that the mean
    of a record without a transient keeps its error.

    Parameters
    ----------
    x : ndarray, shape (n,) or (n, m)
        Uniformly sampled channels; the channel that settles last decides.
    tolerance : float or ndarray, shape (m,)
        Difference from the final level that does not matter, in the unit of each channel. A computation without noise
        approaches its level for ever; with 0 all of that is transient.

    Returns
    -------
    TransientCut

    Raises
    ------
    FitError
        If fewer than eight rows are given or a value is not finite.
    """
    channels = _checked(x)
    n = channels.shape[0]
    limits = np.broadcast_to(np.asarray(tolerance, dtype=float), (channels.shape[1],))
    found = [_channel_cut(column, float(limit)) for column, limit in zip(channels.T, limits)]
    mser, ramp = max(item[0] for item in found), max(item[1] for item in found)
    first = min(max(mser, ramp), n - MIN_SAMPLES)
    at_limit = first > LATEST_CUT * n
    if first == 0:
        note = "no transient stands out of the noise: nothing cut"
    else:
        by = "MSER" if mser >= ramp else "upper limit of the ramp's end"
        note = f"{first} of {n} samples cut by the {by}"
    return TransientCut(first, mser, ramp, at_limit, note)


def _channel_cut(column: np.ndarray, tolerance: float) -> tuple[int, int]:
    """Rows that MSER and the broken line cut from one channel."""
    n = column.size
    batch = max(min(MIN_BATCH, n // MIN_SAMPLES), math.ceil(n / START_BATCHES))
    count = n // batch
    offset = n - count * batch
    means = column[offset:].reshape(count, batch).mean(axis=1)
    means = means - np.median(means)
    if np.ptp(means) <= 1e-10 * np.abs(column).max():
        # Rounding of a constant channel is no transient.
        return 0, 0
    margin = MARGIN_BATCHES * batch
    harmless = offset + _harmless_from(means, tolerance) * batch + margin
    ramp = begin = 0
    for _ in range(MAX_PASSES):
        # An exponential tail shows as a new, smaller ramp when the steep part is gone.
        break_at, height, gain = _ramp_end(means[begin:])
        if gain <= RAMP_GAIN or height <= tolerance:
            break
        length = math.ceil((1.0 + MARGIN_SHARE) * break_at)
        begin += length
        ramp = min(offset + begin * batch + margin, n)
        if count - begin < MIN_LEVEL:
            break
    begin = _marginal_start(means)
    mser = offset + begin * batch if begin and _stands_out(means, begin) else 0
    return min(mser, harmless), min(ramp, harmless)


def _harmless_from(means: np.ndarray, tolerance: float) -> int:
    """Batch from which on a quiet record stays within the tolerance of its final level; all of them if it is loud."""
    last = means[-max(means.size // 8, 4) :]
    level = float(last.mean())
    if tolerance <= 0.0 or float(last.std()) > QUIET * tolerance:
        return means.size
    far = np.flatnonzero(np.abs(means - level) > tolerance)
    return int(far[-1]) + 1 if far.size else 0


def _marginal_start(means: np.ndarray) -> int:
    """Batch at which SSE/(batches kept)^2 is smallest, looked for in the first half, repeated after a large cut."""
    total = means.size
    first = 0
    for _ in range(MAX_PASSES):
        z = means[first:]
        count = z.size
        if count < MIN_SAMPLES:
            break
        begins = np.arange(count // 2 + 1)
        kept = count - begins
        sums = np.cumsum(z[::-1])[::-1][begins]
        squares = np.cumsum((z**2)[::-1])[::-1][begins]
        begin = int(np.argmin((squares - sums**2 / kept) / kept.astype(float) ** 2))
        first += begin
        if begin < SMALL_CUT * total:
            break
    return first


def _stands_out(means: np.ndarray, begin: int) -> bool:
    """True when the batches before `begin` lie apart from the rest by more than autocorrelated noise would."""
    kept = means[begin:]
    noise = fit_autoregression(kept)
    density = float(noise.density([0.0])[0, 0])
    level = float(kept.mean())
    gap = float(means[:begin].mean()) - level
    gap_variance = density * (1.0 / begin + 1.0 / kept.size)
    # An overshoot that oscillates about the level leaves its mean alone and shows in its scatter.
    scatter = float(((means[:begin] - level) ** 2).mean())
    return gap**2 > BREAK_GAIN * gap_variance or scatter > SCATTER_GAIN * float(kept.var())


def _ramp_end(means: np.ndarray) -> tuple[int, float, float]:
    """Upper limit of the break of a line that ends in a level, in batches; its height; how much it explains.

    Model a + c (tau - t)_+; the misfit is profiled over tau, and its rise over the noise density at frequency zero is
    a chi-square of one degree of freedom.
    """
    count = means.size
    centres = np.arange(count) + 0.5
    breaks = np.arange(2, max(int(BREAK_SEARCH * count), 2) + 1)
    shape = np.maximum(breaks[:, None] - centres, 0.0)
    shape -= shape.mean(axis=1, keepdims=True)
    power = np.einsum("ij,ij->i", shape, shape)
    about = means - means.mean()
    along = shape @ about
    misfit = float(about @ about) - along**2 / power
    best = int(np.argmin(misfit))
    left = about - along[best] / power[best] * shape[best]
    density = float(fit_autoregression(left, fitted=[(0.0, 3)]).density([0.0])[0, 0])
    density = max(density, 1e-20 * float(about @ about))
    gain = (float(about @ about) - float(misfit[best])) / density
    inside = np.flatnonzero(misfit <= misfit[best] + BREAK_GAIN * density)
    height = abs(float(along[best] / power[best])) * float(breaks[best])
    return int(breaks[inside[-1]]), height, gain


def _checked(x: np.ndarray) -> np.ndarray:
    channels = np.asarray(x, dtype=float)
    channels = channels[:, None] if channels.ndim == 1 else channels
    require_samples(channels.shape[0], "in the record")
    if not np.isfinite(channels).all():
        raise FitError("a channel holds values that are not finite", cure="fill or cut the gaps first")
    return channels


def require_samples(count: int, where: str) -> None:
    """Refuse fewer than eight samples.

    Raises
    ------
    FitError
        Saying how many there are and where.
    """
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
    channels = _checked(channels)
    n = channels.shape[0]
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
