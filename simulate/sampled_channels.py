"""Channels of a sampled trajectory between its samples, and where they cross a level or turn.

Noise-free samples are interpolated by cubics. Noisy ones are fitted by local cubics over the time in which the ship
turns through a few degrees: long enough to average noise, short beside anything that a hull can do.
"""

from __future__ import annotations

import numpy as np

from .events import COLUMNS, FloatArray
from .trajectory import Trajectory

SMOOTHED_HEADING = np.radians(3.0)
"""Half of the heading change over which noisy channels are smoothed."""

NEGLIGIBLE_NOISE = np.radians(0.005)
"""Heading noise (standard deviation) below which samples are taken as exact."""

NEGLIGIBLE_SCATTER = 1e-4
"""Position noise (standard deviation) in ship lengths below which samples are taken as exact."""

_FIFTH_DIFFERENCE = np.sqrt(252.0)


def white_noise(values: FloatArray) -> float:
    """Standard deviation of white noise in a smooth series, from its fifth differences; robust to outliers.

    Parameters
    ----------
    values : ndarray, shape (n,)
        At about equal intervals; 0 for fewer than 12.
    """
    if len(values) < 12:
        return 0.0
    jumps = np.diff(values, 5)
    return float(1.4826 * np.median(np.abs(jumps - np.median(jumps))) / _FIFTH_DIFFERENCE)


class SampledChannels:
    """Channels of a trajectory as functions of time.

    Parameters
    ----------
    trajectory : Trajectory
        With ``time`` and ``psi``; samples are complete and in order.
    half_width : float, optional
        Half of the smoothing window in s, 0 to interpolate; default 0 for clean samples, else the time of a
        heading change by `SMOOTHED_HEADING`.
    """

    def __init__(self, trajectory: Trajectory, half_width: float | None = None) -> None:
        self.time = trajectory["time"]
        self.channels: dict[str, FloatArray] = {
            name: trajectory[name] for name in COLUMNS if name != "time" and name in trajectory
        }
        self.half_width = self._window(trajectory.ship.L) if half_width is None else half_width
        self._complete()

    def _window(self, length: float) -> float:
        """Half width in s of the smoothing window: 0 for clean samples."""
        time, psi = self.time, self.channels["psi"]
        scatter = max(
            (white_noise(self.channels[name]) for name in ("x", "y") if name in self.channels), default=0.0
        )
        if white_noise(psi) < NEGLIGIBLE_NOISE and scatter < NEGLIGIBLE_SCATTER * length:
            return 0.0
        # Slow enough that noise does not look like turning: the heading over a hundredth of the record.
        stride = max(len(time) // 100, 1)
        turning = np.abs((psi[stride:] - psi[:-stride]) / (time[stride:] - time[:-stride]))
        fastest = float(np.quantile(turning, 0.9))
        return float(SMOOTHED_HEADING / fastest) if fastest > 0.0 else 0.0

    def _complete(self) -> None:
        """Yaw rate and velocities from heading and track where they were not recorded."""
        if "r" not in self.channels:
            self.channels["r"] = np.gradient(self.smooth("psi"), self.time, edge_order=2)
        if "u" not in self.channels and "x" in self.channels and "y" in self.channels:
            vx = np.gradient(self.smooth("x"), self.time, edge_order=2)
            vy = np.gradient(self.smooth("y"), self.time, edge_order=2)
            psi = self.channels["psi"]
            self.channels["u"] = vx * np.cos(psi) + vy * np.sin(psi)
            self.channels["v"] = vy * np.cos(psi) - vx * np.sin(psi)

    def add(self, name: str, values: FloatArray) -> None:
        """Add a channel of shape (n,)."""
        self.channels[name] = values

    def smooth(self, name: str) -> FloatArray:
        """A channel at its samples, smoothed by local cubics where the record is noisy; shape (n,)."""
        values = self.channels[name]
        step = float(np.median(np.diff(self.time)))
        # A cubic through fewer than five samples smooths nothing.
        width = 2 * max(round(self.half_width / step), 2) + 1
        if self.half_width == 0.0 or len(values) < width:
            return values
        from scipy.signal import savgol_filter

        uniform = np.linspace(
            self.time[0], self.time[-1], max(round((self.time[-1] - self.time[0]) / step) + 1, width)
        )
        filtered = savgol_filter(np.interp(uniform, self.time, values), width, 3)
        return np.interp(self.time, uniform, filtered)

    def cubic(self, name: str, moment: float) -> np.polynomial.Polynomial:
        """Local cubic of a channel in ``t - moment``."""
        rows = self._near(moment)
        time = self.time[rows] - moment
        scale = max(float(np.abs(time).max()), 1e-300)
        basis = np.vander(time / scale, min(4, len(time)), increasing=True)
        coefficients, *_ = np.linalg.lstsq(basis, self.channels[name][rows], rcond=None)
        return np.polynomial.Polynomial(coefficients / scale ** np.arange(len(coefficients)))

    def value(self, name: str, moment: float) -> float:
        """A channel at a moment; NaN if it was not recorded."""
        if name not in self.channels:
            return float("nan")
        return float(self.cubic(name, moment)(0.0))

    def state(self, moment: float) -> FloatArray:
        """All columns of an event at a moment, shape (11,); NaN for what was not recorded."""
        return np.array([moment, *(self.value(name, moment) for name in COLUMNS[1:])])

    def crossing(self, name: str, level: float, after: float, before: float, rising: bool = True) -> float:
        """First moment in an interval at which a channel passes a level upwards (or downwards); NaN if it does not."""
        sign = 1.0 if rising else -1.0
        distance = sign * (self.smooth(name) - level)
        rows = np.flatnonzero((self.time >= after) & (self.time <= before))
        inside = distance[rows]
        passed = np.flatnonzero((inside[1:] >= 0.0) & (inside[:-1] < 0.0))
        if len(passed) == 0:
            return float("nan")
        return self._root(name, level, rows[passed[0]], derivative=0)

    def highest(self, name: str, after: float, before: float) -> float:
        """Moment of the largest value of a channel inside an interval; NaN if the largest is at one of its ends."""
        rows = np.flatnonzero((self.time >= after) & (self.time <= before))
        if len(rows) < 3:
            return float("nan")
        peak = int(np.argmax(self.smooth(name)[rows]))
        if peak in (0, len(rows) - 1):
            return float("nan")
        return self._root(name, 0.0, rows[peak], derivative=1)

    def _near(self, moment: float) -> slice:
        """Samples of the smoothing window around a moment, at least four."""
        first, last = np.searchsorted(self.time, (moment - self.half_width, moment + self.half_width))
        if last - first < 5:
            middle = int(np.searchsorted(self.time, moment))
            first = min(max(middle - 2, 0), max(len(self.time) - 4, 0))
            last = first + 4
        return slice(int(first), int(last))

    def _root(self, name: str, level: float, row: int, derivative: int) -> float:
        """Moment near a sample at which a channel, or its slope, equals `level`."""
        low = self.time[max(row - 1, 0)] - self.half_width
        high = self.time[min(row + 2, len(self.time) - 1)] + self.half_width
        start = moment = 0.5 * (self.time[row] + self.time[min(row + 1, len(self.time) - 1)])
        # The window moves with the moment, so the root of one cubic is the centre of the next.
        for _ in range(6):
            curve = self.cubic(name, moment)
            curve = curve.deriv(derivative) if derivative else curve
            roots = (curve - level).roots()
            real = roots[np.abs(roots.imag) < 1e-9 * (1.0 + np.abs(roots.real))].real + moment
            real = real[(real >= low) & (real <= high)]
            if len(real) == 0:
                return float(moment)
            closest = float(real[np.argmin(np.abs(real - start))])
            if abs(closest - moment) <= 1e-12 * (1.0 + abs(moment)):
                return closest
            moment = closest
        return float(moment)
