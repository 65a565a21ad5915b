"""Turning points of a decay: found on the smoothed record, measured on the samples around them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from ..identify.low_pass import low_pass
from .dominant_frequency import dominant_frequency

# Cut-off of the smoothing that only decides where the turning points are, over the frequency of the decay.
DETECTION_CUTOFF = 2.5
# Half width in periods of the polynomial that measures a turning point, and its degree: the error for a cosine is
# below 3e-5 of the amplitude.
HALF_WIDTH = 0.125
DEGREE = 4
# A swing below this many standard deviations of the noise is no half cycle.
SMALLEST_SWING = 4.0
# A record that starts slower than this part of its largest velocity starts at a turning point.
START_AT_REST = 0.1
SAMPLES_A_PERIOD = 8.0


@dataclass(frozen=True, eq=False)
class Extremes:
    """Turning points in turn: maxima and minima alternate.

    Attributes
    ----------
    time, value : ndarray, shape (m,)
        Where and how high, between samples.
    index : ndarray of int, shape (m,)
        Nearest sample.
    noise : float
        Standard deviation of what the smoothing took away.
    period : float
        Period of the decay in s.
    """

    time: np.ndarray
    value: np.ndarray
    index: np.ndarray
    noise: float
    period: float

    @property
    def half_swing(self) -> np.ndarray:
        """Half the way from each turning point to the next, shape (m - 1,): the mean amplitude, whatever the offset."""
        return 0.5 * np.abs(np.diff(self.value))

    def rest_line(self, *, drift: bool = False) -> np.polynomial.Polynomial:
        """Rest position against time: a constant, or a straight line with `drift`.

        The turning points are fitted with it and an envelope of alternating sign, a polynomial of up to the seventh
        degree, so that a strong decay is not taken for an offset.

        Raises
        ------
        FitError
            If there are too few turning points.
        """
        m = self.value.size
        degree = min(7, m - 3 - int(drift))
        if degree < 1:
            raise FitError(f"{m} turning point(s) show no rest position", cure="use offset = 'none'")
        t = np.linspace(-1.0, 1.0, m)
        middle = 0.5 * (self.time[0] + self.time[-1])
        line = [np.ones(m)] + ([self.time - middle] if drift else [])
        sign = np.where(np.arange(m) % 2 == 0, 1.0, -1.0)[:, None]
        envelope = sign * np.polynomial.legendre.legvander(t, degree)
        solution = np.linalg.lstsq(np.column_stack([*line, envelope]), self.value, rcond=None)[0]
        slope = float(solution[1]) if drift else 0.0
        return np.polynomial.Polynomial([float(solution[0]) - slope * middle, slope])

    def amplitudes(self) -> np.ndarray:
        """Heights of the turning points above the rest position, shape (m,)."""
        return np.abs(self.value - self.rest_line()(self.time))

    def part(self, rows: slice) -> Extremes:
        """The turning points of `rows`."""
        return Extremes(self.time[rows], self.value[rows], self.index[rows], self.noise, self.period)


def find_extremes(time: np.ndarray, value: np.ndarray, *, frequency: float | None = None) -> Extremes:
    """Turning points of a uniformly sampled record.

    Parameters
    ----------
    time, value : ndarray, shape (n,)
        Times in s and coordinate.
    frequency : float, optional
        Frequency of the decay in Hz; the strongest line when not given.

    Raises
    ------
    FitError
        If the record does not move, or has fewer than eight samples a period.
    """
    f0 = dominant_frequency(time, value) if frequency is None else frequency
    step = float(np.mean(np.diff(time)))
    if f0 * step * SAMPLES_A_PERIOD > 1.0:
        raise FitError(
            f"the strongest oscillation has {1.0 / (f0 * step):.2g} samples a period",
            cure="give a record with at least eight samples a period; if it has more, it is all noise",
        )
    smooth = low_pass(value, step, DETECTION_CUTOFF * f0)
    # A jump or a push must not count as noise: the median does not see it.
    noise = 1.4826 * float(np.median(np.abs(value - smooth)))
    rows = _turns(smooth, max(SMALLEST_SWING * noise, 1e-9 * float(np.ptp(value))))
    rows = _with_first_sample(rows, time, value, f0, noise)
    half = max(round(HALF_WIDTH / (f0 * step)), DEGREE)
    measured = [_measure(time, value, row, half) for row in rows]
    return Extremes(
        np.array([one[0] for one in measured]),
        np.array([one[1] for one in measured]),
        np.array(rows, dtype=int),
        noise,
        1.0 / f0,
    )


def _turns(smooth: np.ndarray, swing: float) -> list[int]:
    """Rows of the turning points between which the record moves by more than `swing`."""
    change = np.diff(np.sign(np.diff(smooth)))
    candidates = (np.flatnonzero(change) + 1).tolist()
    turns: list[int] = []
    for row in candidates:
        if not turns:
            turns.append(row)
            continue
        rising = len(turns) >= 2 and smooth[turns[-1]] < smooth[turns[-2]]
        falling = len(turns) >= 2 and smooth[turns[-1]] > smooth[turns[-2]]
        further = (rising and smooth[row] < smooth[turns[-1]]) or (falling and smooth[row] > smooth[turns[-1]])
        if further:
            turns[-1] = row
        elif abs(smooth[row] - smooth[turns[-1]]) > swing:
            turns.append(row)
    return turns


def _with_first_sample(rows: list[int], time: np.ndarray, value: np.ndarray, f0: float, noise: float) -> list[int]:
    """Rows with the first sample in front when the record starts at rest, displaced."""
    if not rows:
        return rows
    quarter = np.searchsorted(time, time[0] + 0.25 / f0)
    if quarter < 4 or rows[0] < quarter:
        return rows
    head = slice(0, int(quarter))
    # Of the samples, not of the smoothed record, whose reflected end has a slope of its own.
    t = time[head] - time[0]
    weights = np.linalg.pinv((t / t[-1])[:, None] ** np.arange(4))[1] / t[-1]
    slope = float(weights @ value[head])
    uncertainty = 2.0 * noise * float(np.linalg.norm(weights))
    fastest = np.pi * f0 * abs(value[rows[0]] - value[0])
    return [0, *rows] if abs(slope) < START_AT_REST * fastest + uncertainty else rows


def _polynomial(time: np.ndarray, row: int, half: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, float]:
    """Rows of the samples that measure a turning point, powers and solver of the polynomial through them, and its unit.

    A record that starts at rest turns at its first sample: there the polynomial has no linear term.
    """
    first, last = max(row - half, 0), min(row + half + 1, time.size)
    if row > 0:
        last = max(last, min(2 * half + 1, time.size))
    first = min(first, max(time.size - 2 * half - 1, 0))
    rows = np.arange(first, last)
    t = time[first:last] - time[row]
    span = float(max(abs(t[0]), abs(t[-1])))
    powers = np.arange(min(DEGREE, t.size - 1) + 1)
    if row == 0:
        powers = powers[powers != 1]
    return rows, powers, np.linalg.pinv((t / span)[:, None] ** powers), span


def _measure(time: np.ndarray, value: np.ndarray, row: int, half: int) -> tuple[float, float]:
    """Time and height of the turning point near a row, from a polynomial through the samples around it."""
    rows, powers, solver, span = _polynomial(time, row, half)
    fit = np.zeros(DEGREE + 1)
    fit[powers] = solver @ value[rows]
    if row == 0:
        return float(time[0]), float(fit[0])
    polynomial = np.polynomial.Polynomial(fit)
    slope, bend = polynomial.deriv(), polynomial.deriv(2)
    low, high = (time[rows[0]] - time[row]) / span, (time[rows[-1]] - time[row]) / span
    x = 0.0
    for _ in range(20):
        curvature = bend(x)
        if curvature == 0.0:
            break
        new = float(np.clip(x - slope(x) / curvature, low, high))
        moved, x = abs(new - x), new
        if moved < 1e-12:
            break
    return float(time[row] + x * span), float(polynomial(x))


def extreme_influences(time: np.ndarray, found: Extremes) -> tuple[np.ndarray, np.ndarray]:
    """What a unit error of each sample does to the times and the heights of turning points, to first order.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Times of the samples that the turning points were found in.
    found : Extremes

    Returns
    -------
    times, heights : ndarray, shape (m, n)
    """
    step = float(np.mean(np.diff(time)))
    half = max(round(HALF_WIDTH * found.period / step), DEGREE)
    times, heights = np.zeros((found.time.size, time.size)), np.zeros((found.time.size, time.size))
    swing = found.half_swing
    # Amplitude of each turning point with its sign, from the swings on either side.
    near = 0.5 * (np.append(swing, swing[-1]) + np.insert(swing, 0, swing[0]))
    signed = near * np.append(-np.sign(np.diff(found.value)), np.sign(found.value[-1] - found.value[-2]))
    for k, row in enumerate(found.index):
        rows, powers, solver, span = _polynomial(time, int(row), half)
        x = (found.time[k] - time[row]) / span
        heights[k, rows] = x**powers @ solver
        slope = np.where(powers > 0, powers * x ** np.maximum(powers - 1, 0), 0.0)
        # The curvature of a cosine is enough for a first order.
        curvature = -signed[k] * (2.0 * np.pi / found.period) ** 2
        if row > 0:
            times[k, rows] = -(slope @ solver) / span / curvature
    return times, heights
