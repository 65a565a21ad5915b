"""The ASCII form of captive tests that the SIMMAN workshops exchange.

One run is a table of time, forces on the model, position and heading, velocities and accelerations, in model scale
and SI; a model or condition file beside it gives the particulars.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.errors import ReadError, TowtankError
from ..core.findings import Finding
from .condition import read_condition
from .delimited import parse_delimited
from .dialect import Dialect
from .raw_table import RawTable
from .source_file import SourceFile
from .write import atomic_path, write_table

#: Columns in their order, and the unit of each where the file prints none.
SIMMAN_UNITS = {
    "Time": "s",
    "X": "N",
    "Y": "N",
    "N": "N m",
    "x": "m",
    "y": "m",
    "psi": "rad",
    "u": "m/s",
    "v": "m/s",
    "r": "rad/s",
    "udot": "m/s2",
    "vdot": "m/s2",
    "rdot": "rad/s2",
}

#: The channel map of such a file, for :class:`towtank.formats.channels.ChannelMap`.
SIMMAN_CHANNELS = {("time" if column == "Time" else column): column for column in SIMMAN_UNITS}

_CONDITION_ENDINGS = (".cond", ".inf", ".txt")
_CONDITION_NAMES = ("condition.txt", "model.txt")


def read_simman(
    path: str | Path,
    condition: str | Path | None = None,
    *,
    dialect: Dialect | None = None,
    columns: Iterable[str | int] | None = None,
) -> RawTable:
    """Read one run.

    Parameters
    ----------
    path : str or Path
        The table with the columns of `SIMMAN_UNITS`; more columns may follow. Units are those of its unit row,
        else SI with angles in radians.
    condition : str or Path, optional
        The model or condition file; default the one beside it, found by :func:`find_condition`.
    dialect : Dialect, optional
        How the table is written, from another run of the campaign.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to read; default all.

    Returns
    -------
    RawTable
        ``metadata`` holds the entries of the condition file in SI.

    Raises
    ------
    ReadError
        If a column of the form is missing, or a file cannot be read.
    """
    return parse_simman(SourceFile.read(path), condition, dialect, columns)


def parse_simman(
    source: SourceFile,
    condition: str | Path | None = None,
    dialect: Dialect | None = None,
    columns: Iterable[str | int] | None = None,
) -> RawTable:
    """Read one run from bytes in memory; see :func:`read_simman`."""
    table = parse_delimited(source, dialect, columns)
    missing = [name for name in SIMMAN_UNITS if name not in table.file_columns]
    if missing:
        raise ReadError(
            f"is not in the SIMMAN form: there is no column {', '.join(missing)}",
            cure=f"name the columns {', '.join(SIMMAN_UNITS)}, or read it as a plain table with a channel map",
            file=source.path,
        )
    units = {name: table.units[name] or SIMMAN_UNITS.get(name, "") for name in table.columns}
    found = Path(condition) if condition is not None else find_condition(source.path)
    if found is None:
        note = Finding(
            "no-condition-file",
            "warning",
            "there is no model or condition file",
            file=source.path,
            cure=f"put {Path(source.path).stem}.cond or condition.txt beside it",
        )
        return replace(table, units=units, findings=(*table.findings, note))
    metadata = {**table.metadata, **read_condition(found), "condition_file": str(found)}
    return replace(table, units=units, metadata=metadata)


def find_condition(path: str | Path) -> Path | None:
    """The model or condition file of a run.

    It has the name of the run with the ending ``.cond``, ``.inf`` or ``.txt``, or is called ``condition.txt`` or
    ``model.txt`` in the same folder; the first that exists counts.
    """
    run = Path(path)
    candidates = [run.with_suffix(ending) for ending in _CONDITION_ENDINGS]
    candidates += [run.with_name(name) for name in _CONDITION_NAMES]
    return next((one for one in candidates if one != run and one.is_file()), None)


def write_simman(record: Any, path: str | Path, metadata: Mapping[str, str | float] | None = None) -> None:
    """Write one run, and its condition file if there are `metadata`.

    Parameters
    ----------
    record : Record, DataFrame or mapping of str to array_like
        Holds ``time`` (or ``Time``) and the other columns of `SIMMAN_UNITS` in SI.
    path : str or Path
        The table; the condition file gets the same name with the ending ``.cond``.
    metadata : mapping of str to str or float, optional
        Entries of the condition file in SI, e.g. ``Lpp``, ``B``, ``T``, ``mass``, ``Izz``, ``xG``, ``rho``, ``U``.

    Raises
    ------
    TowtankError
        If a channel is missing, or an entry would not be read back as it is.
    """
    held = {name: _channel(record, name) for name in SIMMAN_UNITS}
    missing = [name for name, values in held.items() if values is None]
    if missing:
        raise TowtankError(
            f"the SIMMAN form needs {', '.join(missing)}", cure="compute or map the missing channels", file=path
        )
    lines = []
    for key, value in (metadata or {}).items():
        text = repr(float(value)) if isinstance(value, (int, float)) else str(value).strip()
        if not text or any(mark in f"{key}{text}" for mark in ("=", "\n", "#", "!", "//")):
            raise TowtankError(
                f"entry '{key}' = '{text}' cannot be written in one line",
                cure="leave out line ends and the signs = # ! //",
                file=path,
            )
        lines.append(f"{key} = {text}\n")
    write_table(path, {name: values for name, values in held.items() if values is not None}, SIMMAN_UNITS)
    if lines:
        with atomic_path(Path(path).with_suffix(".cond")) as temporary:
            temporary.write_text("".join(lines), encoding="utf-8")


def _channel(record: Any, name: str) -> Any:
    for spelling in (name, name.lower()) if name == "Time" else (name,):
        if spelling in record:
            return record[spelling]
    return None
