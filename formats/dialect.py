"""How a text table is written: separator, decimal sign, encoding, and where names, units and data stand."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

from ..core.errors import ReadError
from ..core.findings import Finding
from .condition import header_entries
from .fixed_width import Edges, column_edges, cut
from .header_layout import lay_out
from .number_text import is_number
from .text_bytes import as_single_bytes, encoding_of, refuse_binary

#: Marks of a comment line.
COMMENT_MARKS = ("#", "%", "!", "//", ";")
#: Separators in order of preference; a blank stands for any run of blanks and tabs.
DELIMITERS = ("\t", ";", "|", ",", " ")
#: Name of a dialect whose columns have fixed widths.
FIXED = "fixed"

_HEAD_BYTES = 65_536
_SAMPLE_BYTES = 8_192
_SAMPLE_LINES = 16
_SEARCHED_FOR_NAMES = 60
_SURELY_DATA = 5


@dataclass(frozen=True)
class Dialect:
    """The form of a text table; rows and columns are counted from 0.

    Attributes
    ----------
    delimiter : str
        One character; ``" "`` for runs of blanks and tabs; ``"fixed"`` for columns of fixed width.
    decimal : {".", ","}
        Decimal sign.
    encoding : str
        Encoding of the header.
    header_rows : int
        Lines from the names (or units, if these stand first) to the data; 0 if nothing names the columns.
    names_row, units_row : int or None
        Their lines.
    comment : str
        Mark of comment lines; empty if there are none.
    first_data_row : int
        Line of the first data.
    names : tuple of str
        Unique names of all columns, units in brackets taken off.
    units : tuple of str
        Their units as printed, empty where none is given.
    text_columns : tuple of int
        Columns that hold text and are not read.
    trailing : bool
        Whether each row ends in a separator.
    edges : tuple of (int, int)
        Character ranges of fixed-width columns.
    head : bytes
        All bytes above the data; a file that starts with the same bytes is written in the same dialect.
    header : tuple of str
        The same as lines.
    metadata : mapping of str to str or float
        Entries ``key: value`` of the header.
    findings : tuple of Finding
        Faults of the header, without a file name.
    """

    delimiter: str
    decimal: str = "."
    encoding: str = "utf-8"
    header_rows: int = 1
    names_row: int | None = 0
    units_row: int | None = None
    comment: str = ""
    first_data_row: int = 1
    names: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    text_columns: tuple[int, ...] = ()
    trailing: bool = False
    edges: Edges = ()
    head: bytes = b""
    header: tuple[str, ...] = ()
    metadata: Mapping[str, str | float] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()

    @property
    def width(self) -> int:
        """Number of cells in a row, with the empty one behind a trailing separator."""
        return len(self.names) + self.trailing

    @property
    def text_names(self) -> tuple[str, ...]:
        """Names of the columns that hold text."""
        return tuple(self.names[column] for column in self.text_columns)

    def split(self, line: str) -> list[str]:
        """Cells of a line of data, blanks around them taken off."""
        return cut(line, self.edges) if self.delimiter == FIXED else _split(line, self.delimiter)

    def adapt(self, data: bytes) -> Dialect | None:
        """This dialect for another file of the campaign; None if its headings differ.

        Lines above the names (date, run number) may differ: they are taken from `data`.
        """
        if data.startswith(self.head) and self.head:
            return self
        if self.names_row is None or not self.head:
            return None
        own = self.head.splitlines()
        other = data[: 4 * len(self.head) + 4096].splitlines(keepends=True)[: self.first_data_row]
        bare = [line.rstrip(b"\r\n") for line in other]
        start = self.first_data_row - self.header_rows
        if len(bare) < self.first_data_row or bare[start:] != own[start:]:
            return None
        try:
            header = tuple(line.decode(self.encoding) for line in bare)
        except UnicodeDecodeError:
            return None
        entries = _entries(header[:start], self.delimiter)
        return replace(self, head=b"".join(other), header=header, metadata=entries)


def sniff(data: bytes, path: str | Path = "") -> Dialect:
    """Find out how a text table is written.

    Parameters
    ----------
    data : bytes
        The file, or a beginning of it that holds some data rows.
    path : str or Path
        Named in errors.

    Returns
    -------
    Dialect

    Raises
    ------
    ReadError
        If `data` is empty or binary, has no data rows, or its header does not fit the rows.

    Notes
    -----
    Each separator is tried with each decimal sign on lines from three places of the file. The pair that gives most
    rows of one width and most numbers wins; a header row of the same width counts in its favour, which keeps a
    column without any value in a tab-separated file.
    """
    file = str(path)
    if not data.strip():
        raise ReadError("the file is empty", cure="export the run again or leave it out", file=file)
    refuse_binary(data, file)
    data = as_single_bytes(data)
    top = _complete_lines(data)
    encoding = encoding_of(b"".join(top))
    lines = [line.decode(encoding, errors="replace").rstrip("\r\n") for line in top]
    marked_line = next((line.lstrip() for line in lines if line.lstrip().startswith(COMMENT_MARKS)), "")
    comment = next((mark for mark in COMMENT_MARKS if marked_line.startswith(mark)), "")
    body = _body_sample(lines, data, comment, encoding)
    delimiter, decimal, edges = _form(body, lines)
    if comment == delimiter:
        comment = ""
    form = Dialect(delimiter, decimal, comment=comment, edges=edges)
    rows = [form.split(line) for line in body]
    width = _common_width(rows)
    bulk = [row for row in rows if len(row) == width]
    marked, heads = _top_cells(lines, form, width)
    last_named = any(len(row) == width and row[-1] for row in heads)
    trailing = width > 1 and not last_named and not any(row[-1] for row in bulk)
    if trailing:
        width -= 1
        heads = [row[:-1] if len(row) == width + 1 else row for row in heads]
    heads = [row if len(row) == width and any(row) else _strip_right(row) for row in heads]
    # LabVIEW names a last column for comments, which the rows leave out.
    heads = [row[:-1] if len(row) == width + 1 and row[-1] == "Comment" else row for row in heads]
    layout = lay_out(
        heads, marked, [row[:width] for row in bulk], width, lambda cell: is_number(cell, decimal), file=file
    )
    above = lines[: layout.first_data]
    return Dialect(
        delimiter=delimiter,
        decimal=decimal,
        encoding=encoding,
        header_rows=layout.headings,
        names_row=layout.names_row,
        units_row=layout.units_row,
        comment=comment,
        first_data_row=layout.first_data,
        names=layout.names,
        units=layout.units,
        text_columns=layout.text_columns,
        trailing=trailing,
        edges=edges,
        head=b"".join(top[: layout.first_data]),
        header=tuple(above),
        metadata=_entries(above[: layout.first_data - layout.headings], delimiter),
        findings=layout.findings,
    )


def _top_cells(lines: Sequence[str], form: Dialect, width: int) -> tuple[list[bool], list[list[str]]]:
    """Which of the first lines are comments, and the cells of each, down to some rows that are surely data."""
    marked: list[bool] = []
    cells: list[list[str]] = []
    data_rows = 0
    for line in lines:
        is_comment = bool(form.comment) and line.lstrip().startswith(form.comment)
        row = form.split(line)
        is_data = not is_comment and len(row) == width and all(is_number(c, form.decimal) for c in row if c)
        if not is_data:
            row = _split_heading(_unmarked(line) if is_comment else line, form.delimiter, width)
        marked.append(is_comment)
        cells.append(row)
        data_rows = data_rows + 1 if is_data and any(row) else 0
        if data_rows > _SURELY_DATA:
            break
    return marked, cells


def _unmarked(line: str) -> str:
    """A comment line without its marks."""
    return re.sub(r"^\s*(#|%|!|//|;)+", "", line).strip()


def _entries(lines: Sequence[str], delimiter: str) -> dict[str, str | float]:
    """Entries of the lines above the names; two cells of a separated table are a key and its value."""
    plain = []
    for line in map(_unmarked, lines):
        cells = [cell for cell in _split(line, delimiter) if cell] if delimiter not in (" ", FIXED) else []
        plain.append(f"{cells[0].rstrip(' :=')} = {cells[1]}" if len(cells) == 2 else line)
    return header_entries(plain)


def _complete_lines(data: bytes) -> list[bytes]:
    """The first lines of the file with their ends; at least all lines of a small file."""
    size = _HEAD_BYTES
    while True:
        piece = data[:size]
        if size < len(data):
            piece = piece[: max(piece.rfind(b"\n"), piece.rfind(b"\r")) + 1]
        lines = piece.splitlines(keepends=True)
        if len(lines) >= _SAMPLE_LINES or size >= len(data):
            return lines
        size *= 4


def _body_sample(lines: Sequence[str], data: bytes, comment: str, encoding: str) -> list[str]:
    """Lines that are likely to be data, from several places of the file."""

    def is_body(line: str) -> bool:
        return bool(line.strip()) and not (comment and line.lstrip().startswith(comment))

    first = [line for line in lines if is_body(line)]
    # A separator may double as a comment mark; then all lines seem to be comments.
    first = first or [line for line in lines if line.strip()]
    # The last line may be cut off.
    first = first[:-1] if len(first) > _SURELY_DATA else first
    sample = first[-max(1, min(_SAMPLE_LINES, len(first) // 2)) :]
    if len(data) > 2 * _HEAD_BYTES:
        for start in (len(data) // 2, len(data) - _SAMPLE_BYTES):
            piece = data[start : start + _SAMPLE_BYTES].decode(encoding, errors="replace").splitlines()[1:-1]
            sample += [line for line in piece if is_body(line)][-_SAMPLE_LINES // 2 :]
    return sample


def _form(body: Sequence[str], lines: Sequence[str]) -> tuple[str, str, Edges]:
    """Separator, decimal sign and, for fixed widths, column edges that make most sense of the body."""
    best: tuple[float, bool, int] | None = None
    delimiter, decimal, sense = " ", ".", 0.0
    for rank, candidate in enumerate(DELIMITERS):
        if candidate != " " and not any(candidate in line for line in body):
            continue
        rows = [_split(line, candidate) for line in body]
        width = _common_width(rows)
        named = any(_names_columns(line, candidate, width) for line in lines[:_SEARCHED_FOR_NAMES])
        for sign in (".", ",") if any("," in line for line in body) else (".",):
            share = _share_of_numbers(rows, width, sign)
            score = (round(share, 2) + 0.3 * named * (share > 0), width > 1, -rank)
            if best is None or score > best:
                best, delimiter, decimal, sense = score, candidate, sign, share
    if (delimiter == " " or not sense) and len({len(line.rstrip()) for line in body}) == 1:
        # Blank cells or touching numbers leave rows of different widths when they are split at blanks.
        for sign in (".", ","):
            edges = column_edges(body, sign)
            rows = [cut(line, edges) for line in body]
            if len(edges) > 1 and _share_of_numbers(rows, len(edges), sign) > sense:
                return FIXED, sign, edges
    return delimiter, decimal, ()


def _share_of_numbers(rows: Sequence[Sequence[str]], width: int, decimal: str) -> float:
    """Share of the rows that have `width` cells, times the share of numbers in their non-empty cells."""
    whole = [row for row in rows if len(row) == width]
    cells = [cell for row in whole for cell in row if cell]
    numbers = sum(is_number(cell, decimal) for cell in cells)
    return len(whole) / len(rows) * numbers / len(cells) if cells else 0.0


def _names_columns(line: str, delimiter: str, width: int) -> bool:
    """Whether a line could be the row of names of a table of `width` columns."""
    if width == 1 and any(mark in line for mark in DELIMITERS[:-1]):
        return False
    row = _strip_right(_split_heading(_unmarked(line), delimiter, width))
    words = sum(not is_number(cell) and not is_number(cell, ",") for cell in row)
    return len(row) == width and 2 * words >= width


def _split(line: str, delimiter: str) -> list[str]:
    if delimiter == " ":
        return line.split()
    if '"' in line:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))]
    return [cell.strip() for cell in line.split(delimiter)]


def _split_heading(line: str, delimiter: str, width: int) -> list[str]:
    """Cells of a heading; between blanks, names of two words and units in brackets are kept together."""
    if delimiter not in (" ", FIXED):
        return _split(line, delimiter)
    cells = line.split()
    if len(cells) == width:
        return cells
    attempts: list[Callable[[str], list[str]]] = [
        lambda text: re.split(r"\t+|\s{2,}", text.strip()),
        lambda text: re.findall(r'"[^"]*"|\S+(?:\s+[\[(][^\])]*[\])])?', text),
    ]
    for attempt in attempts:
        other = attempt(line)
        if len(other) == width:
            return [cell.strip('"') for cell in other]
    return cells


def _strip_right(cells: Sequence[str]) -> list[str]:
    end = len(cells)
    while end and not cells[end - 1]:
        end -= 1
    return list(cells[:end])


def _common_width(rows: Sequence[Sequence[str]]) -> int:
    counts = Counter(len(row) for row in rows)
    return max(counts, key=lambda width: (counts[width], width))
