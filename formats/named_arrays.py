"""Arrays of a binary file, named and sometimes nested, to one table."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from .raw_table import RawTable, choose_columns, number_repeats
from .source_file import SourceFile


@dataclass
class NamedArray:
    """One variable of a file.

    Attributes
    ----------
    name : str
        Its name, with the names of the groups around it joined by dots.
    values : ndarray
        Any shape and type.
    columns : sequence of str
        Names of the columns of a two-dimensional array; empty if it has none.
    units : sequence of str
        One unit, or one for each column; empty if none is given.
    """

    name: str
    values: np.ndarray
    columns: Sequence[str] = ()
    units: Sequence[str] = ()


@dataclass
class _Gathered:
    columns: list[tuple[str, str, np.ndarray]] = field(default_factory=list)
    scalars: list[tuple[str, str, np.ndarray]] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)


def assemble(
    arrays: Iterable[NamedArray],
    source: SourceFile,
    *,
    wanted: Iterable[str | int] | None = None,
    metadata: dict[str, str | float] | None = None,
    findings: Sequence[Finding] = (),
) -> RawTable:
    """Make a table of the arrays of one length.

    Vectors are columns; a two-dimensional array gives one column for each of its named (else: shorter) dimension,
    named ``name_1``, ``name_2``, ... if it carries no names. Where lengths differ, the length of most columns is
    taken, or that of the `wanted` ones; the other arrays are left out with a finding ``left-out``. Single numbers
    become metadata, unless there is nothing else.

    Raises
    ------
    ReadError
        If there is no array of numbers, a wanted column is missing, or wanted columns differ in length.
    """
    gathered = _Gathered()
    for array in arrays:
        _gather(array, gathered)
    columns = gathered.columns or gathered.scalars
    if not columns:
        raise ReadError(
            "there are no arrays of numbers",
            cure="export the channels as vectors or as one matrix",
            file=source.path,
        )
    names, repeated = number_repeats([name for name, _, _ in columns])
    lengths = {name: len(values) for name, (_, _, values) in zip(names, columns)}
    chosen = choose_columns(wanted, names, file=source.path)
    if wanted is None:
        counts = Counter(lengths.values())
        length = max(counts, key=lambda size: (counts[size], size))
        gathered.left_out += [f"{name} ({lengths[name]} values)" for name in names if lengths[name] != length]
        chosen = [name for name in names if lengths[name] == length]
    if not lengths[chosen[0]]:
        raise ReadError("the arrays are empty", cure="export the run again", file=source.path)
    notes = list(findings)
    if gathered.left_out and wanted is None:
        notes.append(
            Finding(
                "left-out",
                "warning",
                f"not of the length or kind of the other channels: {', '.join(gathered.left_out)}",
                file=source.path,
                cure="name the columns to be read if others are meant",
            )
        )
    if repeated:
        notes.append(
            Finding(
                "duplicate-columns",
                "warning",
                f"column name(s) used more than once: {', '.join(repeated)}; numbered in order",
                file=source.path,
                cure="rename the channels, or map them by their new names",
            )
        )
    by_name = {name: (unit, values) for name, (_, unit, values) in zip(names, columns)}
    entries = dict(metadata or {})
    if gathered.columns:
        entries.update({name: float(values[0]) for name, _, values in gathered.scalars})
    return RawTable(
        columns={name: by_name[name][1] for name in chosen},
        units={name: by_name[name][0] for name in chosen},
        metadata=entries,
        path=source.path,
        sha256=source.sha256,
        findings=tuple(notes),
        file_columns=names,
    )


def _gather(array: NamedArray, gathered: _Gathered) -> None:
    values = np.asarray(array.values)
    if values.dtype.kind not in "fiub" or values.ndim > 2:
        gathered.left_out.append(f"{array.name} ({values.dtype.name}, {values.ndim} dimensions)")
        return
    values = values.astype(np.float64)
    if values.size == 1 and len(array.columns) <= 1:
        gathered.scalars.append((array.name, _unit(array.units, 0), values.reshape(1)))
    elif values.ndim == 1 or (1 in values.shape and len(array.columns) <= 1):
        gathered.columns.append((array.name, _unit(array.units, 0), values.ravel()))
    else:
        _gather_matrix(array, values, gathered)


def _gather_matrix(array: NamedArray, values: np.ndarray, gathered: _Gathered) -> None:
    rows, width = values.shape
    count = len(array.columns)
    # MATLAB users keep channels in rows as often as in columns; names decide, else there are more samples.
    if count == rows != width or (count not in (rows, width) and rows < width):
        values = values.T
    width = values.shape[1]
    names = array.columns if count == width else [f"{array.name}_{n}" for n in range(1, width + 1)]
    units = array.units if len(array.units) in (1, width) else ()
    for column, name in enumerate(names):
        gathered.columns.append((name, _unit(units, column), values[:, column]))


def _unit(units: Sequence[str], column: int) -> str:
    return "" if not units else units[column] if len(units) > column and len(units) > 1 else units[0]


def as_texts(value: Any) -> list[str]:
    """A text, a list or an array of texts as a list; empty if it holds anything else."""
    if isinstance(value, bytes):
        value = value.decode("utf-8", errors="replace")
    if isinstance(value, str):
        return [value.strip()]
    if isinstance(value, (list, tuple, np.ndarray)):
        texts = [as_texts(one) for one in np.ravel(np.asarray(value, dtype=object))]
        return [text[0] for text in texts] if all(len(text) == 1 for text in texts) else []
    return []


def as_entry(value: Any) -> str | float | None:
    """A text or a single number as metadata; None for anything else."""
    texts = as_texts(value)
    if texts:
        return ", ".join(texts)
    if isinstance(value, (bool, int, float, np.number, np.bool_)):
        return float(value)
    if isinstance(value, np.ndarray) and value.size == 1 and value.dtype.kind in "fiub":
        return float(value.ravel()[0])
    return str(value) if isinstance(value, np.datetime64) else None
