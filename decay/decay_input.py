"""Decay records from tables and files: columns, declared units, audit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding, accept, stop_on_error
from ..core.record import Record
from ..core.ship import Ship
from ..formats.units import SI_SYMBOLS, convertible
from .damping_models import MOTION_UNITS
from .decay_audit import audit_decay, repaired_time
from .decay_record import MOTION_CHANNELS, DecayRecord

if TYPE_CHECKING:
    import pandas as pd


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
    try:
        factor = convertible(unit, "length" if motion == "heave" else "angle")
    except ReadError as error:
        raise ReadError(error.cause, cure=error.cure, file=source or None, place=f"channel {angle}") from None
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
