"""Delimited and aligned text tables.

The numbers are parsed by pyarrow, straight from the bytes in memory and without the interpreter lock, so that runs
can be read in parallel threads. Tables aligned with blanks or in fixed widths are given separators first. A
line that pyarrow refuses is looked at again by a patient parser, which mends what can be mended and names the line
and the column of what cannot.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.errors import ReadError
from .dialect import FIXED, Dialect, sniff
from .fixed_width import SEPARATOR, separate
from .raw_table import RawTable, choose_columns
from .source_file import SourceFile
from .text_bytes import as_single_bytes
from .tolerant import LineFaults, parse_patiently

__all__ = ["Dialect", "read_delimited", "sniff"]

_ENDS = (b"\n", b"\r", b" ", b"\t", b"\x1a")
_LARGEST_BLOCK = 2**30


def read_delimited(
    path: str | Path, dialect: Dialect | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read a text table.

    Parameters
    ----------
    path : str or Path
        The file.
    dialect : Dialect, optional
        How it is written, e.g. ``table.dialect`` of another run of the campaign. It is used if the headings
        are the same; otherwise, and by default, the file is sniffed.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to read; default all.

    Returns
    -------
    RawTable
        Numbers as float64; empty cells are NaN. Findings: ``ragged-last-line``, ``blank-rows``,
        ``comment-in-data``, ``units-fewer-than-columns``, ``names-fewer-than-columns``, ``duplicate-columns``,
        ``text-column``.

    Raises
    ------
    ReadError
        If the file is missing, empty, binary or without data rows, if a line other than the last has too few or
        too many values, or if a cell holds text.
    """
    return parse_delimited(SourceFile.read(path), dialect, columns)


def parse_delimited(
    source: SourceFile,
    dialect: Dialect | None = None,
    columns: Iterable[str | int] | None = None,
    *,
    compiled: bool = False,
) -> RawTable:
    """Read a text table from bytes in memory; see :func:`read_delimited`.

    With `compiled`, plain numbers are parsed by compiled code, whose start pays from some hundred megabytes on.
    """
    data = as_single_bytes(source.data)
    wanted = None if columns is None else list(columns)
    fault: ReadError | None = None
    for form in _possible_forms(data, dialect, source.path):
        names = choose_columns(wanted, form.names, form.text_names, file=source.path)
        try:
            body = _parse(data, form, names, source.path, compiled)
        except ReadError as error:
            fault = fault or error
        else:
            return _table(source, form, names, body)
    assert fault is not None
    raise fault


def _possible_forms(data: bytes, dialect: Dialect | None, file: str) -> Iterator[Dialect]:
    """Forms in which the file may be written, the likeliest first."""
    known = dialect.adapt(data) if dialect is not None else None
    if known is not None:
        yield known
    # The headings may agree with the run before and the body be exported otherwise.
    found = sniff(data, file)
    if found != known:
        yield found
    # The lines that were looked at may hold whole numbers only. A mixture of both signs stays an error.
    other = "," if found.decimal == "." else "."
    if other != found.delimiter:
        yield replace(found, decimal=other)


def _table(source: SourceFile, form: Dialect, names: Sequence[str], body: _Body) -> RawTable:
    findings = [replace(finding, file=source.path) for finding in form.findings] + body.faults.findings(
        source.path
    )
    return RawTable(
        columns=dict(zip(names, body.columns)),
        units=dict(zip(form.names, form.units)),
        header=form.header + tuple(text for _, text in body.faults.comments),
        metadata=dict(form.metadata),
        path=source.path,
        sha256=source.sha256,
        findings=tuple(findings),
        file_columns=form.names,
        dialect=form,
    )


@dataclass
class _Body:
    columns: list[np.ndarray]
    faults: LineFaults


def _parse(data: bytes, dialect: Dialect, names: Sequence[str], file: str, compiled: bool) -> _Body:
    """Numbers below the header: by pyarrow, and by the patient parser where pyarrow refuses."""
    import pyarrow as pa

    start = len(dialect.head)
    body = data[start : _end_of_rows(data, start)]
    if not body.isascii():
        # pyarrow hands refused lines over as UTF-8.
        body = body.decode(dialect.encoding, errors="replace").encode()
    first_line = dialect.first_data_row + 1
    faults = LineFaults()
    if compiled:
        plain = _parse_plain(body, dialect, names)
        if plain:
            return _Body(plain, faults)
    lines = _count_lines(body)
    cells = body
    if dialect.delimiter == " ":
        cells = _squeeze(body)
    elif dialect.delimiter == FIXED:
        cells, is_cut = separate(body, dialect.edges, file=file, first_line=first_line)
        faults.cut = first_line + lines - 1 if is_cut else 0
    refused: list[str] = []
    try:
        columns = _parse_fast(cells, dialect, names, refused)
    except pa.ArrowInvalid:
        return _Body(*parse_patiently(body, dialect, names, file))
    if refused:
        last = cells.splitlines()[-1]
        is_comment = bool(dialect.comment) and refused[0].lstrip().startswith(dialect.comment)
        if len(refused) > 1 or refused[0].encode() != last or is_comment:
            return _Body(*parse_patiently(body, dialect, names, file))
        faults.cut = first_line + lines - 1
    rows = len(columns[0]) if columns else 0
    if not rows or _has_empty_row(columns):
        return _Body(*parse_patiently(body, dialect, names, file))
    if rows + bool(faults.cut) < lines:
        faults.blank = _blank_lines(body, first_line)
    return _Body(columns, faults)


def _parse_plain(body: bytes, dialect: Dialect, names: Sequence[str]) -> list[np.ndarray] | None:
    """Columns of a table in which every cell is a plain number; None when one is not."""
    if len(dialect.delimiter) != 1 or dialect.delimiter in (" ", FIXED):
        return None
    from .plain_numbers import parse_plain

    wanted = [dialect.names.index(name) for name in names]
    return parse_plain(body, dialect.delimiter, dialect.decimal, len(dialect.names), wanted, int(dialect.trailing))


def _parse_fast(cells: bytes, dialect: Dialect, names: Sequence[str], refused: list[str]) -> list[np.ndarray]:
    """Columns of a separated table; lines of a wrong width are added to `refused`."""
    import pyarrow as pa
    from pyarrow import csv

    def refuse(row: csv.InvalidRow) -> str:
        refused.append(row.text)
        return "skip"

    every = list(dialect.names) + ["\0trailing"] * dialect.trailing
    convert = {
        "column_types": dict.fromkeys(names, pa.float64()),
        "include_columns": list(names),
        "decimal_point": dialect.decimal,
    }
    delimiter = dialect.delimiter
    if delimiter == FIXED:
        delimiter = SEPARATOR
        longest = max(stop - first for first, stop in dialect.edges)
        convert["null_values"] = ["", "nan", "NaN", *(" " * blanks for blanks in range(1, longest + 1))]
    table = csv.read_csv(
        pa.BufferReader(cells),
        read_options=csv.ReadOptions(
            use_threads=False, column_names=every, block_size=min(len(cells) + 1, _LARGEST_BLOCK)
        ),
        # Without quotes to look for, the parser is a tenth faster.
        parse_options=csv.ParseOptions(
            delimiter=delimiter, quote_char='"' if b'"' in cells else False, invalid_row_handler=refuse
        ),
        convert_options=csv.ConvertOptions(**convert),
    )
    return [table.column(name).to_numpy() for name in names]


def _end_of_rows(data: bytes, start: int) -> int:
    """End of the last line that is not blank, without its line end."""
    stop = len(data)
    if data[-1:] in _ENDS:
        # Only the tail is copied: blanks rarely fill more than a few bytes.
        tail = data[max(start, stop - 4096) :].rstrip(b"\r\n \t\x1a")
        stop = max(start, stop - 4096) + len(tail)
        if not tail:
            stop = start + len(data[start:].rstrip(b"\r\n \t\x1a"))
    # A last row may end in empty cells, whose tabs were just taken for blanks.
    while stop < len(data) and data[stop] in b" \t":
        stop += 1
    return stop


def _count_lines(body: bytes) -> int:
    return (body.count(b"\n") or body.count(b"\r")) + 1


def _has_empty_row(columns: Sequence[np.ndarray]) -> bool:
    """Whether all columns are NaN in one row: a row of separators only, or of a dead channel."""
    empty = np.isnan(columns[0])
    for column in columns[1:]:
        if not empty.any():
            return False
        empty &= np.isnan(column)
    return bool(empty.any())


def _blank_lines(body: bytes, first_line: int) -> list[int]:
    return [number for number, line in enumerate(body.splitlines(), start=first_line) if not line.strip()]


def _squeeze(body: bytes) -> bytes:
    """One blank for each run of blanks and tabs, none at the ends of lines."""
    return b"\n".join([b" ".join(line.split()) for line in body.splitlines()])
