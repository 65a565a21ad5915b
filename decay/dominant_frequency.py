"""Dominant frequency of a decay, and the derivatives of a smooth one."""

from __future__ import annotations

import numpy as np

from ..core.errors import FitError

#: Default cut-off of the low-pass over the frequency of the decay: it keeps the third harmonic of the damping moment.
CUTOFF_OVER_DECAY = 5.0
# The highest of thousands of lines of white noise is below this many medians.
NOISE_PEAKS = 4.0


def dominant_frequency(time: np.ndarray, value: np.ndarray) -> float:
    """Frequency in Hz of the strongest line of the velocity of a uniformly sampled record.

    The velocity is taken because drift and rest positions, which the coordinate is full of, hardly show in it.

    Raises
    ------
    FitError
        If the record holds no line: it is constant or too short.
    """
    n = value.size
    if n < 8 or not np.ptp(value) > 0.0:
        raise FitError("the record does not move", cure="check the channel and its unit")
    step = float(np.mean(np.diff(time)))
    length = 4 * n
    spectrum = np.abs(np.fft.rfft(np.diff(value), length))
    weight = 2.0 * np.sin(np.pi * np.arange(spectrum.size) / length)
    # White noise of the coordinate rises with the weight; the upper half of the spectrum tells its level.
    upper = slice(spectrum.size // 2, None)
    floor = NOISE_PEAKS * float(np.median(spectrum[upper] / weight[upper]))
    line = np.maximum(spectrum - floor * weight, 0.0)
    if not line.max() > 0.0:
        raise FitError("no oscillation stands out of the noise", cure="check that it is a free decay")
    best = int(np.argmax(line))
    if 1 <= best < line.size - 1:
        left, mid, right = line[best - 1 : best + 2]
        bend = left - 2.0 * mid + right
        shift = 0.5 * (left - right) / bend if bend < 0.0 else 0.0
    else:
        shift = 0.0
    frequency = (best + shift) / (length * step)
    if not frequency > 0.0:
        raise FitError("the record does not oscillate", cure="check that it is a free decay")
    return float(frequency)


def derivatives(time: np.ndarray, value: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative of a smooth series by a quintic interpolating spline, shape (n,) each."""
    from scipy.interpolate import make_interp_spline

    spline = make_interp_spline(time, value, k=5)
    return np.asarray(spline(time, 1)), np.asarray(spline(time, 2))
