"""Means and first two harmonics of all channels of a run at once, from a thinned window: quick, for the audit."""

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


@dataclass(frozen=True, eq=False)
class RecordedHarmonics:
    """Least-squares mean and harmonics of the channels of a run.

    Attributes
    ----------
    first, second : mapping of str to complex
        ``a - i b`` of ``a cos kwt + b sin kwt``.
    mean : mapping of str to float
    length : float
        Length of the window in s.
    """

    first: Mapping[str, complex]
    second: Mapping[str, complex]
    mean: Mapping[str, float]
    length: float
    _rows: Mapping[str, int]
    _time: np.ndarray
    _basis: np.ndarray
    _values: np.ndarray
    _coefficients: np.ndarray

    def __contains__(self, name: str) -> bool:
        return name in self.first

    def fit_quality(self, name: str) -> tuple[float, float]:
        """Share of the variance that the harmonics explain, and by how much the frequency is off.

        Returns
        -------
        explained : float
            1 for a constant channel.
        slip : float
            Correction of the frequency in rad/s: one Gauss-Newton step on the phase along the window; 0 where the
            harmonics leave too little for a slip that matters.
        """
        row = self._rows[name]
        values, coefficients = self._values[row], self._coefficients[row]
        constant = len(values) * float(values.mean()) ** 2
        total = float(values @ values) - constant
        if total <= 1e-12 * constant:
            return 1.0, 0.0
        rest = values - coefficients @ self._basis
        explained = 1.0 - float(rest @ rest) / total
        # A phase that is lost evenly, up to e at the ends, leaves e^2/3 of the variance.
        if explained > 0.999:
            return explained, 0.0
        slope = self.first[name]
        since = self._time - 0.5 * (self._time[0] + self._time[-1])
        turning = since * (-slope.real * self._basis[2] - slope.imag * self._basis[1])
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
    cos, sin = np.cos(angle), np.sin(angle)
    basis = np.array([np.ones(len(t)), cos, sin, cos * cos - sin * sin, 2.0 * sin * cos])
    values = np.array([channels[name][rows] for name in names])
    if "x" in names:
        values[names.index("x")] -= run.speed * t
    # Sines and cosines over whole cycles are nearly orthogonal: the inverse is as good as a solution, and faster.
    coefficients = values @ (np.linalg.inv(basis @ basis.T) @ basis).T
    table = coefficients.tolist()
    return RecordedHarmonics(
        first={name: complex(row[1], -row[2]) for name, row in zip(names, table)},
        second={name: complex(row[3], -row[4]) for name, row in zip(names, table)},
        mean={name: row[0] for name, row in zip(names, table)},
        length=float(t[-1] - t[0]),
        _rows={name: row for row, name in enumerate(names)},
        _time=t,
        _basis=basis,
        _values=values,
        _coefficients=coefficients,
    )


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

    Parameters
    ----------
    values, time : ndarray, shape (n,)
        Time in s, nearly uniform.
    """
    step = max(1, len(values) // 4096)
    series = values[::step] - values[::step].mean()
    power = np.abs(np.fft.rfft(series * np.hanning(len(series)))) ** 2
    power[0] = 0.0
    peak = int(np.argmax(power[1:])) + 1
    total = float(power.sum())
    if total == 0.0:
        return 0.0, 0.0
    around = slice(max(peak - 2, 1), peak + 3)
    centre = float(np.arange(len(power))[around] @ power[around]) / float(power[around].sum())
    interval = float(time[-1] - time[0]) / (len(time) - 1) * step
    return centre / (len(series) * interval), float(power[around].sum()) / total
