"""Spreadsheets: ``.xls``, ``.xlsx`` (and ``.xlsm``, ``.xlsb``, ``.ods``) through calamine."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from .condition import header_entries
from .header_layout import HeaderLayout, lay_out
from .number_text import is_number, to_number
from .raw_table import RawTable, choose_columns
from .source_file import SourceFile
from .tolerant import LineFaults

_HEAD_ROWS = 200
_BULK_ROWS = 30


def read_spreadsheet(
    path: str | Path, sheet: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read one sheet of a workbook.

    Names, units and a preamble may stand above the data as in a text table. Numbers that are stored as text are
    read with a decimal point or comma, with a finding ``numbers-as-text``.

    Parameters
    ----------
    path : str or Path
        The workbook.
    sheet : str, optional
        Name of the sheet; default the first that holds a table.
    columns : iterable of str or int, optional
        Names, or numbers from 1, of the columns to keep; default all.

    Raises
    ------
    ReadError
        If the workbook cannot be opened, has no such sheet or no table, or if a number cell holds text.
    """
    return parse_spreadsheet(SourceFile.read(path), sheet, columns)


def parse_spreadsheet(
    source: SourceFile, sheet: str | None = None, columns: Iterable[str | int] | None = None
) -> RawTable:
    """Read a workbook from bytes in memory; see :func:`read_spreadsheet`."""
    from python_calamine import CalamineError, CalamineWorkbook

    try:
        workbook = CalamineWorkbook.from_filelike(io.BytesIO(source.data))
        names = workbook.sheet_names
        if sheet is not None and sheet not in names:
            raise ReadError(
                f"there is no sheet '{sheet}'", cure=f"the sheets are {', '.join(names)}", file=source.path
            )
        refusals = []
        for name in [sheet] if sheet is not None else names:
            rows = workbook.get_sheet_by_name(name).to_python(skip_empty_area=False)
            try:
                page = _lay_out_sheet(rows, name, source.path)
            except ReadError as error:
                refusals.append(error)
                continue
            others = names[names.index(name) + 1 :] if sheet is None else []
            return _table(page, source, columns, others)
    except CalamineError as error:
        raise ReadError(
            f"is no readable workbook ({error})",
            cure="open it in a spreadsheet program and save it again, without a password",
            file=source.path,
        ) from None
    if len(refusals) == 1:
        raise refusals[0]
    raise ReadError(
        f"none of the sheets {', '.join(names)} holds a table of numbers",
        cure="name the sheet, or export the run again",
        file=source.path,
    )


@dataclass
class _Sheet:
    name: str
    rows: list[list[Any]]
    layout: HeaderLayout
    width: int
    header: list[str] = field(default_factory=list)


def _lay_out_sheet(rows: list[list[Any]], name: str, file: str) -> _Sheet:
    while rows and not any(_text(cell) for cell in rows[-1]):
        rows.pop()
    if not rows:
        raise ReadError("the sheet is empty", cure="name another sheet", file=file, place=f"sheet '{name}'")
    used = [column for column in range(len(rows[0])) if any(row[column] != "" for row in rows)]
    width = len(used)
    # Columns without any cell are margins between or beside the table; a dead channel still has its name.
    rows = [[row[column] for column in used] for row in rows]
    head = [[_text(cell) for cell in row] for row in rows[:_HEAD_ROWS]]
    heads = [_cells_in_use(row) for row in head]
    body = rows[-max(1, min(_BULK_ROWS, len(rows) // 2)) :]
    bulk = [[_text(cell) for cell in row] for row in body]
    try:
        layout = lay_out(heads, [False] * len(heads), bulk, width, _is_cell_number)
    except ReadError as error:
        place = ", ".join(part for part in (f"sheet '{name}'", error.place) if part)
        raise ReadError(error.cause, cure=error.cure, file=file, place=place) from None
    header = ["\t".join(cell for cell in row if cell) for row in head[: layout.first_data]]
    return _Sheet(name, rows, layout, width, header)


def _cells_in_use(row: list[str]) -> list[str]:
    """The row as it is if most cells are filled; else, as a line of a preamble, its filled cells."""
    filled = [cell for cell in row if cell]
    return row if len(filled) > len(row) // 2 else filled


def _text(cell: Any) -> str:
    if isinstance(cell, str):
        return cell.strip()
    if isinstance(cell, bool):
        return str(cell)
    return f"{cell:.12g}" if isinstance(cell, (int, float)) else str(cell)


def _is_cell_number(text: str) -> bool:
    return is_number(text) or is_number(text, ",")


def _table(
    sheet: _Sheet, source: SourceFile, wanted: Iterable[str | int] | None, others: Sequence[str]
) -> RawTable:
    layout = sheet.layout
    text = [layout.names[column] for column in layout.text_columns]
    names = choose_columns(wanted, layout.names, text, file=source.path)
    body = sheet.rows[layout.first_data :]
    faults = LineFaults(blank=[n for n, row in enumerate(body, layout.first_data + 1) if not any(map(_text, row))])
    kept = [(n, row) for n, row in enumerate(body, layout.first_data + 1) if any(map(_text, row))]
    as_text: list[str] = []
    columns = {
        name: _numbers(
            kept, layout.names.index(name), f"sheet '{sheet.name}', column {name}", source.path, as_text
        )
        for name in names
    }
    findings = [replace(finding, file=source.path) for finding in layout.findings] + faults.findings(source.path)
    if as_text:
        findings.append(
            Finding(
                "numbers-as-text",
                "warning",
                f"{len(as_text)} numbers are stored as text, the first in {as_text[0]}",
                file=source.path,
                cure="check the decimal sign of the export",
            )
        )
    if others:
        findings.append(
            Finding(
                "first-sheet",
                "info",
                f"read sheet '{sheet.name}'; not read: {', '.join(others)}",
                file=source.path,
                cure="name the sheet if another is meant",
            )
        )
    start = layout.first_data - layout.headings
    preamble = [line.replace("\t", " = ", 1) if line.count("\t") == 1 else line for line in sheet.header[:start]]
    return RawTable(
        columns=columns,
        units=dict(zip(layout.names, layout.units)),
        header=tuple(sheet.header),
        metadata=header_entries(preamble) | {"sheet": sheet.name},
        path=source.path,
        sha256=source.sha256,
        findings=tuple(findings),
        file_columns=layout.names,
    )


def _numbers(
    rows: Sequence[tuple[int, list[Any]]], column: int, place: str, file: str, as_text: list[str]
) -> np.ndarray:
    values = np.empty(len(rows))
    for index, (number, row) in enumerate(rows):
        cell = row[column]
        if isinstance(cell, (int, float)) and not isinstance(cell, bool):
            values[index] = cell
            continue
        text = _text(cell)
        try:
            values[index] = to_number(text, "," if "," in text else ".")
        except ValueError:
            raise ReadError(
                f"'{text}' is not a number",
                cure="mend the cell, or leave it empty if the value is missing",
                file=file,
                place=f"{place}, row {number}",
            ) from None
        if text and not np.isnan(values[index]):
            as_text.append(f"{place}, row {number}")
    return values
