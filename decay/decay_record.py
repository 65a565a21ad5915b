"""One decay record: its coordinate in SI, where it came from, and what was done to it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..core.ship import Ship
from ..identify.low_pass import FILTER_ORDER, low_pass
from .damping_models import MOTION_UNITS
from .dominant_frequency import CUTOFF_OVER_DECAY, derivatives
from .extremes import Extremes, find_extremes
from .release import find_free_part

#: Channel of each motion in a :class:`~towtank.core.record.Record`.
MOTION_CHANNELS = {"roll": "phi", "pitch": "theta", "heave": "heave"}

#: Periods of the decay at both ends of a filtered record in which the filter sees beyond it.
END_PERIODS = 0.5
FEWEST_DERIVED = 8

Offset = Literal["constant", "drift", "none"]


@dataclass(frozen=True, eq=False)
class DecayRecord:
    """A decay in SI: s, and rad for roll and pitch or m for heave.

    Attributes
    ----------
    time, value : ndarray, shape (n,)
        Rising times and the coordinate.
    motion : {"roll", "pitch", "heave"}
    name : str
    speed : float
        Forward speed in m/s, at the scale of the record.
    scale : float
        Length of the full-scale ship over that of the record's model; 1 for full scale.
    ship : Ship, optional
        At the scale of the record.
    rate, acceleration : ndarray, shape (n,), optional
        Derivatives that came with the record; computed ones are not kept here.
    unit : str
        Unit of the coordinate before the conversion.
    source, sha256 : str
    steps : tuple of str
        What was done to it, in order.
    findings : tuple of Finding
    whole : DecayRecord, optional
        The record before it was cut to its free part.
    """

    time: np.ndarray
    value: np.ndarray
    motion: str = "roll"
    name: str = ""
    speed: float = 0.0
    scale: float = 1.0
    ship: Ship | None = None
    rate: np.ndarray | None = None
    acceleration: np.ndarray | None = None
    unit: str = ""
    source: str = ""
    sha256: str = ""
    steps: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    whole: DecayRecord | None = None

    def __len__(self) -> int:
        return self.time.size

    @property
    def time_step(self) -> float:
        """Mean sampling interval in s."""
        return float((self.time[-1] - self.time[0]) / (self.time.size - 1))

    @cached_property
    def extremes(self) -> Extremes:
        """Turning points of the record."""
        return find_extremes(self.time, self.value)

    @property
    def period(self) -> float:
        """Period of the decay in s."""
        return self.extremes.period

    def filtered(self, cutoff: float | None = None, order: int = FILTER_ORDER) -> DecayRecord:
        """Copy with a zero-phase Butterworth low-pass on the coordinate, forward and backward.

        Parameters
        ----------
        cutoff : float, optional
            In Hz; five times the frequency of the decay when not given.
        order : int
            Order of one pass.
        """
        chosen = CUTOFF_OVER_DECAY / self.period if cutoff is None else cutoff
        step = f"Butterworth low-pass of order {order}, {chosen:.4g} Hz, forward and backward"
        return replace(self, value=low_pass(self.value, self.time_step, chosen, order), steps=(*self.steps, step))

    def with_derivatives(self, cutoff: float | None = None, order: int = FILTER_ORDER) -> DecayRecord:
        """Copy with velocity and acceleration of the filtered coordinate; the coordinate stays as it was recorded.

        At both ends, where the filter sees beyond the record, one period of the cut-off and at least half a period
        of the decay are dropped. Taken before the record is cut, the derivatives at the release are not falsified by
        the end of the record; a record that begins at the release loses its first samples.

        Parameters
        ----------
        cutoff : float, optional
            Of the zero-phase Butterworth filter in Hz; five times the frequency of the decay when not given.
        order : int
            Order of one pass.

        Raises
        ------
        FitError
            If nothing is left between the ends.
        """
        chosen = CUTOFF_OVER_DECAY / self.period if cutoff is None else cutoff
        smooth = self.filtered(chosen, order)
        rate, acceleration = derivatives(self.time, smooth.value)
        lost = round(max(END_PERIODS * self.period, 1.0 / chosen) / self.time_step)
        if len(self) - 2 * lost < FEWEST_DERIVED:
            raise FitError(
                f"{max(len(self) - 2 * lost, 0)} sample(s) are left between the ends of the record, where the filter "
                "sees beyond it",
                cure="give a longer record",
                file=self.source or None,
                place=self.name,
            )
        derived = replace(
            self,
            rate=rate,
            acceleration=acceleration,
            steps=(*self.steps, f"derivatives by a quintic spline after: {smooth.steps[-1]}"),
        )
        return derived._rows(slice(lost, len(self) - lost), f"{lost} samples dropped at both ends")

    def free_part(
        self,
        *,
        first_amplitude: float | None = None,
        last_amplitude: float | None = None,
        skip: int = 0,
        start: float | None = None,
        end: float | None = None,
    ) -> DecayRecord:
        """Copy cut to the free decay.

        Parameters
        ----------
        first_amplitude, last_amplitude : float, optional
            Largest and smallest amplitude in rad or m; the noise decides when the latter is not given.
        skip : int
            Half cycles dropped after the release.
        start, end : float, optional
            Times in s instead of the automatic ones.

        Raises
        ------
        FitError
            If there is no free decay, or too little of it is left.
        """
        cut = self
        if start is not None or end is not None:
            cut = self._between(start, end)
            if start is not None and end is not None:
                return replace(cut, whole=self.whole or self)
        part = find_free_part(
            cut.time, cut.value, first_amplitude=first_amplitude, last_amplitude=last_amplitude, skip=skip
        )
        first = 0 if start is not None else part.rows.start
        last = len(cut) if end is not None else part.rows.stop
        step = f"cut to {cut.time[first]:.6g} ... {cut.time[last - 1]:.6g} s: {part.reason}"
        if part.pushes:
            step += f"; taken for pushes by hand: {', '.join(f'{t:.4g}' for t in part.pushes)} s"
        return replace(cut._rows(slice(first, last), step), whole=self.whole or self)

    def _between(self, start: float | None, end: float | None) -> DecayRecord:
        low = -np.inf if start is None else start
        high = np.inf if end is None else end
        inside = np.flatnonzero((self.time >= low) & (self.time <= high))
        if inside.size < 8:
            raise FitError(
                f"{inside.size} sample(s) lie between {low:g} and {high:g} s",
                cure=f"the record runs from {self.time[0]:g} to {self.time[-1]:g} s",
                file=self.source or None,
                place=self.name,
            )
        rows = slice(int(inside[0]), int(inside[-1]) + 1)
        return self._rows(
            rows, f"cut to {self.time[rows.start]:.6g} ... {self.time[rows.stop - 1]:.6g} s as asked"
        )

    def _rows(self, rows: slice, step: str) -> DecayRecord:
        return replace(
            self,
            time=self.time[rows],
            value=self.value[rows],
            rate=None if self.rate is None else self.rate[rows],
            acceleration=None if self.acceleration is None else self.acceleration[rows],
            steps=(*self.steps, step),
        )

    def centred(self, offset: Offset = "constant") -> DecayRecord:
        """Copy without its rest position.

        The rest position is fitted to the turning points beside an envelope of alternating sign, as a constant or as
        a straight line (``drift``).
        """
        if offset == "none":
            return self
        unit = MOTION_UNITS[self.motion]
        if offset in ("constant", "drift"):
            level = self.extremes.rest_line(drift=offset == "drift")(self.time)
            if offset == "constant":
                said = f"rest position {level[0]:.4g} {unit} taken off"
            else:
                said = f"straight line {level[0]:.4g} ... {level[-1]:.4g} {unit} taken off"
        else:
            raise FitError(f"offset '{offset}' is unknown", cure="use constant, drift or none")
        return replace(self, value=self.value - level, steps=(*self.steps, said))

    def at_scale(self, scale: float) -> DecayRecord:
        """The record at another scale by Froude's law: time and heave grow, angles stay.

        Raises
        ------
        FitError
            If the scale is not positive.
        """
        if not scale > 0.0:
            raise FitError(f"the scale {scale} is not positive", cure="give 1 for full scale, 68 for a model 1:68")
        length = self.scale / scale
        time = np.sqrt(length)
        x = length if self.motion == "heave" else 1.0
        return replace(
            self,
            time=self.time * time,
            value=self.value * x,
            speed=self.speed * time,
            scale=scale,
            ship=None if self.ship is None else self.ship.at_scale(scale),
            rate=None if self.rate is None else self.rate * x / time,
            acceleration=None if self.acceleration is None else self.acceleration * x / time**2,
            steps=(*self.steps, f"Froude's law from scale {self.scale:g} to {scale:g}"),
            whole=None if self.whole is None else self.whole.at_scale(scale),
        )
