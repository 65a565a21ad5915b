"""Rows of a small text table with their line numbers, so that an error can name the line."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

from ..core.errors import ReadError


@dataclass(frozen=True)
class NumberedRows:
    """A table as it stands in its file.

    Attributes
    ----------
    names : tuple of str
        Headings.
    rows : tuple of (int, dict of str to str)
        Line number, and cells by heading.
    comments : tuple of (int, str)
        Lines that begin with ``#``, without it.
    """

    names: tuple[str, ...]
    rows: tuple[tuple[int, dict[str, str]], ...]
    comments: tuple[tuple[int, str], ...]


def numbered_rows(path: Path, columns: str) -> NumberedRows:
    """Read a table parted by commas, semicolons or tabulators.

    Parameters
    ----------
    path : Path
    columns : str
        The columns that a user should give, for messages.

    Raises
    ------
    ReadError
        When the file is missing, not text, empty, or a row has not as many cells as the heading.
    """
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise ReadError("file not found", cure=f"give a table with {columns}", file=path) from None
    except (OSError, UnicodeDecodeError) as error:
        raise ReadError(f"not readable as text: {error}", cure="give a table in utf-8", file=path) from None
    comments: list[tuple[int, str]] = []
    lines: list[tuple[int, str]] = []
    for number, line in enumerate(text.splitlines(), start=1):
        stripped = line.strip()
        if stripped.startswith("#"):
            comments.append((number, stripped.lstrip("# ")))
        elif stripped:
            lines.append((number, line))
    if not lines:
        raise ReadError("the table is empty", cure=f"give columns {columns}", file=path)
    delimiter = max(",;\t", key=lines[0][1].count)
    names = tuple(cell.strip() for cell in next(csv.reader([lines[0][1]], delimiter=delimiter)))
    rows = []
    for number, line in lines[1:]:
        cells = next(csv.reader([line], delimiter=delimiter))
        if len(cells) != len(names):
            raise ReadError(
                f"{len(cells)} cells for {len(names)} columns",
                cure="mend the row",
                file=path,
                place=f"line {number}",
            )
        rows.append((number, {name: cell.strip() for name, cell in zip(names, cells, strict=True)}))
    return NumberedRows(names, tuple(rows), tuple(comments))


def cell_number(text: str, what: str, path: Path, place: str) -> float:
    """Number in a cell.

    Raises
    ------
    ReadError
        When it holds something else.
    """
    try:
        return float(text)
    except ValueError:
        cure = (
            "write decimals with a point" if text.replace(",", "", 1).lstrip("+-").isdigit() else "mend the cell"
        )
        raise ReadError(f"{what} = '{text}' is not a number", cure=cure, file=path, place=place) from None
