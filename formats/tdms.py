"""TDMS files of LabVIEW, through npTDMS (an optional extra)."""

from __future__ import annotations

import io
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from .named_arrays import NamedArray, as_entry, assemble
from .raw_table import RawTable
from .source_file import SourceFile

_UNIT_PROPERTIES = ("unit_string", "NI_UnitDescription", "unit", "units")
_TIME_NAMES = {"time", "t", "zeit"}


def read_tdms(path: str | Path, group: str | None = None, columns: Iterable[str | int] | None = None) -> RawTable:
    """Read the channels of one group of a TDMS file.

    Units come from ``unit_string``. Where the channels carry waveform properties and the group has no channel of
    time, ``time`` is made from ``wf_start_offset`` and ``wf_increment``. A channel of time stamps becomes seconds
    since its first one. Properties of the file and the group become metadata.

    Parameters
    ----------
    path : str or Path
        The file.
    group : str, optional
        Name of the group; default the only one with data.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to keep; default all.

    Raises
    ------
    ReadError
        If npTDMS is not installed, the file is damaged, there is no such group or several and none is named, or
        the channels were sampled at different rates.
    """
    return parse_tdms(SourceFile.read(path), group, columns)


def parse_tdms(
    source: SourceFile, group: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read a TDMS file from bytes in memory; see :func:`read_tdms`."""
    try:
        from nptdms import TdmsFile
    except ImportError:
        raise ReadError(
            "reading TDMS needs npTDMS", cure="install it: pip install 'towtank[tdms]'", file=source.path
        ) from None
    try:
        file = TdmsFile.read(io.BytesIO(source.data))
    # npTDMS raises errors of many kinds for a file that ends too early.
    except Exception as error:
        raise ReadError(
            f"is no readable TDMS file ({error})", cure="copy or export it again", file=source.path
        ) from error
    chosen = _group(file, group, source.path)
    metadata = _entries(file.properties) | _entries(chosen.properties)
    findings: list[Finding] = []
    arrays = []
    for channel in chosen.channels():
        values = np.asarray(channel[:])
        if values.dtype.kind == "M":
            values = (values - values[:1]) / np.timedelta64(1, "s")
            units = ["s"]
            findings.append(
                Finding(
                    "time-stamps",
                    "info",
                    f"channel {channel.name} holds time stamps; it is read as seconds since the first",
                    file=source.path,
                )
            )
        else:
            units = [str(channel.properties[one]) for one in _UNIT_PROPERTIES if one in channel.properties][:1]
        arrays.append(NamedArray(channel.name, values, units=units))
    time = _waveform_time(chosen.channels(), source.path)
    if time is not None:
        arrays.insert(0, NamedArray("time", time, units=["s"]))
    return assemble(arrays, source, wanted=columns, metadata=metadata, findings=findings)


def _group(file: Any, name: str | None, path: str) -> Any:
    filled = [group for group in file.groups() if any(len(channel) for channel in group.channels())]
    names = [group.name for group in filled]
    if name is not None:
        for group in filled:
            if group.name == name:
                return group
        raise ReadError(f"there is no group '{name}'", cure=f"the groups are {', '.join(names)}", file=path)
    if not filled:
        raise ReadError("there are no channels with data", cure="export the run again", file=path)
    if len(filled) > 1:
        raise ReadError(
            f"there are {len(filled)} groups with channels", cure=f"name one of {', '.join(names)}", file=path
        )
    return filled[0]


def _waveform_time(channels: list[Any], path: str) -> np.ndarray | None:
    waves = [one for one in channels if one.properties.get("wf_increment", 0) and len(one)]
    if not waves or any(one.name.strip().lower() in _TIME_NAMES for one in channels):
        return None
    clocks = {
        (float(one.properties.get("wf_start_offset", 0.0)), float(one.properties["wf_increment"]), len(one))
        for one in waves
    }
    if len(clocks) > 1:
        rates = ", ".join(f"{one.name} {1.0 / one.properties['wf_increment']:g} Hz" for one in waves)
        raise ReadError(
            f"the channels were sampled at different rates or for different times ({rates})",
            cure="resample them to one rate before export",
            file=path,
        )
    offset, increment, count = clocks.pop()
    return offset + increment * np.arange(count)


def _entries(properties: dict[str, Any]) -> dict[str, str | float]:
    entries = {name: as_entry(value) for name, value in properties.items()}
    return {name: value for name, value in entries.items() if value is not None}
