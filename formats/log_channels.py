"""Monitor files of any tool through the channel map: standard names, SI units and signs."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

import pandas as pd

from ..core.errors import ReadError
from .channels import DIMENSIONS, ChannelMap
from .raw_table import RawTable
from .solver_log import SolverLog
from .units import SI_SYMBOLS, conversion, convertible

_FORCE = re.compile(r"^(?P<letter>[FM])[xyz]_(total|pressure|viscous|porous)$")


def through_channels(log: SolverLog, channels: ChannelMap, file_columns: Sequence[str]) -> SolverLog:
    """The mapped columns of `log` in SI, with its time (or iteration).

    Parameters
    ----------
    log : SolverLog
        As read.
    channels : ChannelMap
        Names such as ``Fx_total`` and ``Mz_viscous`` make a history of forces of it.
    file_columns : sequence of str
        Columns of the file from left to right, for channels that are given by number.

    Raises
    ------
    ReadError
        If a column is missing, or has no unit or one of the wrong dimension.
    """
    index = log.index_name
    values = {str(name): log.frame[name].to_numpy() for name in log.frame.columns}
    units = {name: log.units.get(name, "") for name in values}
    if index in channels.channels:
        # The index bears its standard name by now; the map may know it by the printed one.
        printed = channels.channels[index].column
        if isinstance(printed, str) and printed not in values:
            values[printed], units[printed] = values[index], units[index]
    _check_forces(channels, units, log)
    record = channels.apply(RawTable(values, units, path=str(log.files[-1]), file_columns=tuple(file_columns)))
    mapped = [name for name in channels.channels if name != index]
    columns = {
        index: record.channels.get(index, values[index]),
        **{name: record.channels[name] for name in mapped},
    }
    return replace(
        log,
        kind="forces" if any(map(_FORCE.match, mapped)) else log.kind,
        frame=pd.DataFrame(columns),
        units={index: log.units.get(index, ""), **{name: _si_unit(name, record.units[name]) for name in mapped}},
        notes=(*log.notes, *record.steps),
    )


def _check_forces(channels: ChannelMap, units: Mapping[str, str], log: SolverLog) -> None:
    """Refuse a force or moment whose unit is missing or of another dimension."""
    for name, channel in channels.channels.items():
        force = _FORCE.match(name)
        unit = units.get(str(channel.column), "") if channel.unit is None else channel.unit
        if force is None or unit.strip() == "SI" or isinstance(channel.column, int):
            continue
        if str(channel.column) not in units and channel.unit is None:
            continue
        wanted, likely = ("force", "N") if force["letter"] == "F" else ("moment", "N m")
        if not unit.strip():
            raise ReadError(
                f"column '{channel.column}' has no unit in the file",
                cure=f"give it with the name: {name}={channel.column} [{likely}]",
                file=log.files[-1],
                place=f"channel {name}",
            )
        if convertible(unit, wanted) is None:
            raise ReadError(
                f"unit '{unit}' of column '{channel.column}' is no {wanted}",
                cure=f"map another column, or give the right unit: {name}={channel.column} [{likely}]",
                file=log.files[-1],
                place=f"channel {name}",
            )


def _si_unit(name: str, unit: str) -> str:
    """SI symbol of a converted channel."""
    force = _FORCE.match(name)
    if force:
        return "N" if force["letter"] == "F" else "N m"
    if name in DIMENSIONS:
        return SI_SYMBOLS[DIMENSIONS[name]]
    if unit == "SI":
        return unit
    dimension = conversion(unit).dimension
    return SI_SYMBOLS.get(dimension, dimension)
