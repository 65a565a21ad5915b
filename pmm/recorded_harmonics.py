"""Mean and first harmonic of all channels of a run at once, from a thinned window: quick, for the audit."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .run_types import Run

_CHANNELS = ("x", "y", "psi", "speed", "u", "v", "r", "udot", "vdot", "rdot", "X", "Y", "N")
_SAMPLES = 160
_MOST_CYCLES = 12
_BEGIN, _END = 0.45, 0.96


@dataclass(eq=False)
class RecordedHarmonics:
    """Least-squares mean and first harmonic of the channels of a run.

    Attributes
    ----------
    first : dict of str to complex
        ``a - i b`` of ``a cos wt + b sin wt``.
    mean : dict of str to float
    time : ndarray, shape (m,)
        Times of the window in s.
    basis : ndarray, shape (3, m)
        1, cos wt, sin wt.
    values : ndarray, shape (k, m)
        The channels in the order of `first`; ``x`` without its trend.
    """

    first: dict[str, complex]
    mean: dict[str, float]
    time: np.ndarray
    basis: np.ndarray
    values: np.ndarray

    def __contains__(self, name: str) -> bool:
        return name in self.first

    @property
    def length(self) -> float:
        """Length of the window in s."""
        return float(self.time[-1] - self.time[0])

    def channel(self, name: str) -> np.ndarray:
        """Values of a channel in the window."""
        return self.values[list(self.first).index(name)]

    def second(self, name: str) -> float:
        """Amplitude of the second harmonic of a channel, by projection."""
        cos, sin = self.basis[1], self.basis[2]
        values = self.channel(name) - self.mean[name]
        both = values @ (cos * cos - sin * sin), values @ (2.0 * sin * cos)
        return 2.0 / len(values) * math.hypot(*both)

    def fit_quality(self, name: str) -> tuple[float, float]:
        """Share of the variance that the harmonic explains, and by how much the frequency is off.

        Returns
        -------
        explained : float
            1 for a constant channel.
        slip : float
            Correction of the frequency in rad/s: one Gauss-Newton step on the phase along the window; 0 where the
            harmonic leaves too little for a slip that matters.
        """
        values, first, mean = self.channel(name), self.first[name], self.mean[name]
        about = values - mean
        total = float(about @ about)
        if total <= 1e-12 * len(values) * mean**2:
            return 1.0, 0.0
        rest = about - first.real * self.basis[1] + first.imag * self.basis[2]
        explained = 1.0 - float(rest @ rest) / total
        # A phase that is lost evenly, up to e at the ends, leaves e^2/3 of the variance.
        if explained > 0.999:
            return explained, 0.0
        since = self.time - 0.5 * (self.time[0] + self.time[-1])
        turning = since * (-first.real * self.basis[2] - first.imag * self.basis[1])
        return explained, float(rest @ turning) / float(turning @ turning)


def recorded_harmonics(channels: Mapping[str, np.ndarray], time: np.ndarray, run: Run) -> RecordedHarmonics | None:
    """Harmonics of the channels at the frequency of the test matrix.

    The window is made of whole cycles between 45 and 96 % of the record, twelve at most; of the last whole
    cycle when the record is short.

    Returns
    -------
    RecordedHarmonics or None
        None when there is no whole cycle or no channel.
    """
    names = [name for name in _CHANNELS if name in channels and (name != "x" or run.surge_amplitude)]
    rows = _whole_cycles(time, run.period)
    if not names or rows is None:
        return None
    t = time[rows]
    angle = run.frequency * t
    basis = np.ones((3, len(t)))
    np.cos(angle, out=basis[1])
    np.sin(angle, out=basis[2])
    values = np.array([channels[name][rows] for name in names])
    if "x" in names:
        since = t - t.mean()
        row = values[names.index("x")]
        row -= since * np.linalg.lstsq(np.vstack([basis, since]).T, row, rcond=None)[0][3]
    table = (values @ basis.T @ _inverse((basis @ basis.T).tolist())).tolist()
    return RecordedHarmonics(
        first={name: complex(a, -b) for name, (_, a, b) in zip(names, table)},
        mean={name: row[0] for name, row in zip(names, table)},
        time=t,
        basis=basis,
        values=values,
    )


def _inverse(m: list[list[float]]) -> np.ndarray:
    """Inverse of a symmetric 3 by 3 matrix; written out because the general routine costs as much as the rest."""
    (a, b, c), (_, d, e), (_, _, f) = m
    p, q, s = d * f - e * e, c * e - b * f, b * e - c * d
    determinant = a * p + b * q + c * s
    inverse = np.array([[p, q, s], [q, a * f - c * c, b * c - a * e], [s, b * c - a * e, a * d - b * b]])
    return inverse / determinant


def _whole_cycles(time: np.ndarray, period: float) -> slice | None:
    start, length = float(time[0]), float(time[-1] - time[0])
    begin, end = start + _BEGIN * length, start + _END * length
    cycles = min(math.floor((end - begin) / period), _MOST_CYCLES)
    if cycles < 1:
        end = start + length
        cycles = 1
    first = int(time.searchsorted(end - cycles * period, side="right"))
    last = int(time.searchsorted(end, side="right"))
    if last - first < 8 or time[last - 1] - time[first] < 0.8 * period:
        return None
    return slice(first, last, max(1, (last - first) // _SAMPLES))


def strongest_line(values: np.ndarray, time: np.ndarray) -> tuple[float, float]:
    """Frequency in Hz of the strongest line of a channel, and its share of the variance.

    The frequency is good to about a tenth of the reciprocal of the record's length, for three cycles or more.

    Parameters
    ----------
    values, time : ndarray, shape (n,)
        Time in s, nearly uniform.
    """
    step = max(1, len(values) // 4096)
    series = values[::step] - values[::step].mean()
    size = 8 * len(series)
    power = np.abs(np.fft.rfft(series * np.hanning(len(series)), size)) ** 2
    total = float(power.sum())
    if total == 0.0:
        return 0.0, 0.0
    peak = int(np.argmax(power))
    # The main lobe of the window is four bins wide, each eight points of the padded transform.
    lobe = power[max(peak - 16, 0) : peak + 17]
    share = float(lobe.sum()) / total
    offset = 0.0
    if 0 < peak < len(power) - 1:
        left, top, right = np.log(power[peak - 1 : peak + 2] + 1e-300).tolist()
        offset = 0.5 * (left - right) / (left - 2.0 * top + right) if left + right < 2.0 * top else 0.0
    interval = float(time[-1] - time[0]) / (len(time) - 1) * step
    return (peak + offset) / (size * interval), share
