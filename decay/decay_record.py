"""One decay record: its coordinate in SI, where it came from, and what was done to it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..core.errors import FitError, ReadError
from ..core.findings import Finding, accept, stop_on_error
from ..core.record import Record
from ..core.ship import Ship
from ..formats.units import SI_SYMBOLS, convertible
from .damping_models import MOTION_UNITS
from .decay_audit import audit_decay, repaired_time
from .extremes import Extremes, find_extremes
from .release import find_free_part
from .zero_phase_filter import CUTOFF_OVER_DECAY, FILTER_ORDER, derivatives, low_pass

if TYPE_CHECKING:
    import pandas as pd

#: Channel of each motion in a :class:`~towtank.core.record.Record`.
MOTION_CHANNELS = {"roll": "phi", "pitch": "theta", "heave": "heave"}

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

        Taken before the record is cut, the derivatives at the release are not falsified by the end of the record.

        Parameters
        ----------
        cutoff : float, optional
            Of the zero-phase Butterworth filter in Hz; five times the frequency of the decay when not given.
        order : int
            Order of one pass.
        """
        smooth = self.filtered(cutoff, order)
        rate, acceleration = derivatives(self.time, smooth.value)
        return replace(
            self,
            rate=rate,
            acceleration=acceleration,
            steps=(*self.steps, f"derivatives by a quintic spline after: {smooth.steps[-1]}"),
        )

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


def decay_from_table(
    data: Record | pd.DataFrame | Mapping[str, np.ndarray],
    *,
    time: str = "time",
    angle: str = "phi",
    unit: str | None = None,
    motion: str = "roll",
    rate: str | None = None,
    acceleration: str | None = None,
    name: str = "",
    speed: float = 0.0,
    scale: float = 1.0,
    ship: Ship | None = None,
    accepted: Iterable[str] = (),
) -> DecayRecord:
    """Decay record from a table.

    Parameters
    ----------
    data : Record, DataFrame or mapping of str to ndarray
        A :class:`~towtank.core.record.Record` is in SI already.
    time, angle : str
        Names of the columns with the time in s and the coordinate.
    unit : str
        Unit of the coordinate: ``rad``, ``deg``, ``m``, ``mm``, ... It must be given, except for a Record.
    motion : {"roll", "pitch", "heave"}
    rate, acceleration : str, optional
        Columns with its derivatives, in the same unit per s and s2, if they were measured or computed.
    name : str
    speed : float
        Forward speed in m/s.
    scale : float
        Scale of the record; 1 for full scale.
    ship : Ship, optional
        At any scale; it is brought to that of the record.
    accepted : iterable of str
        Audit rules that the user waives.

    Raises
    ------
    ReadError
        If a column is missing, the unit is missing or does not fit the motion.
    AuditError
        If the audit finds a fault that was not waived.
    """
    if motion not in MOTION_UNITS:
        raise ReadError(f"motion '{motion}' is unknown", cure=f"use one of {', '.join(MOTION_UNITS)}")
    source, sha256 = "", ""
    steps: tuple[str, ...] = ()
    if isinstance(data, Record):
        source, sha256, steps = data.source, data.sha256, data.steps
        unit = MOTION_UNITS[motion] if unit is None else unit
    columns = {key: _column(data, key, source) for key in (time, angle, rate, acceleration) if key is not None}
    if unit is None:
        raise ReadError(
            f"the unit of '{angle}' is not declared",
            cure="give unit = 'rad' or 'deg': the quadratic damping differs by 57.3"
            if motion != "heave"
            else "give unit = 'm' or 'mm'",
            file=source or None,
        )
    factor = convertible(unit, "length" if motion == "heave" else "angle")
    if factor is None:
        raise ReadError(
            f"unit '{unit}' does not measure {motion}",
            cure=f"give a unit of {SI_SYMBOLS['length' if motion == 'heave' else 'angle']}",
            file=source or None,
            place=f"channel {angle}",
        )
    instants, value = columns[time], columns[angle] * factor
    hull = ship if ship is None else ship.at_scale(scale)
    findings = accept(audit_decay(instants, value, motion=motion, unit=unit, ship=hull, file=source), accepted)
    stop_on_error(findings)
    derived = {
        key: columns[column] * factor
        for key, column in (("rate", rate), ("acceleration", acceleration))
        if column is not None
    }
    instants, series, mended = repaired_time(instants, {"value": value, **derived})
    if factor != 1.0:
        steps = (*steps, f"{angle}: {unit} -> {MOTION_UNITS[motion]}")
    return DecayRecord(
        time=instants,
        value=series["value"],
        motion=motion,
        name=name or Path(source).stem,
        speed=speed,
        scale=scale,
        ship=hull,
        rate=series.get("rate"),
        acceleration=series.get("acceleration"),
        unit=unit,
        source=source,
        sha256=sha256,
        steps=(*steps, *mended),
        findings=tuple(findings),
    )


def _column(data: Record | pd.DataFrame | Mapping[str, np.ndarray], name: str, source: str) -> np.ndarray:
    if isinstance(data, Record):
        return np.array(data[name], dtype=float)
    try:
        column = data[name]
    except KeyError:
        raise ReadError(
            f"there is no column '{name}'", cure=f"the table has {', '.join(map(str, data))}", file=source or None
        ) from None
    try:
        return np.array(column, dtype=float)
    except (TypeError, ValueError):
        raise ReadError(f"column '{name}' holds text", cure="give numbers only", file=source or None) from None


def read_decay(
    path: str | Path,
    *,
    time: str = "time",
    angle: str | None = None,
    unit: str | None = None,
    motion: str = "roll",
    rate: str | None = None,
    acceleration: str | None = None,
    **about: Any,
) -> DecayRecord:
    """Decay record from a file of any known format; the parameters are those of :func:`decay_from_table`.

    `about` is the name, speed, scale, ship and accepted audit rules. The column is by default that of the motion
    (``phi``, ``theta``, ``heave``). The unit may also stand in the file: ``phi [deg]``. A declared unit wins, and a
    finding says so when they differ.
    """
    from ..formats.read import read_table

    column = angle or MOTION_CHANNELS.get(motion, "phi")
    wanted = [one for one in (time, column, rate, acceleration) if one is not None]
    table = read_table(path, columns=wanted)
    printed = table.units.get(column, "")
    record = decay_from_table(
        Record(dict(table.columns), source=str(path), sha256=table.sha256),
        time=time,
        angle=column,
        unit=_declared(unit, printed, column, str(path)),
        motion=motion,
        rate=rate,
        acceleration=acceleration,
        **about,
    )
    findings = [*table.findings, *record.findings]
    if unit is not None and printed and printed != unit:
        findings.append(
            Finding(
                "unit-differs",
                "warning",
                f"'{column}' is declared [{unit}], the file prints [{printed}]",
                str(path),
            )
        )
    return replace(record, findings=tuple(findings))


def _declared(unit: str | None, printed: str, column: str, path: str) -> str:
    if unit is not None:
        return unit
    if printed:
        return printed
    raise ReadError(
        f"the unit of '{column}' is not declared and the file prints none",
        cure="give unit = 'rad' or 'deg' (heave: 'm')",
        file=path,
    )
