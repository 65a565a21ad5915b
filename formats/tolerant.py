"""The patient line-by-line parser for text tables that a strict one refuses."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from .dialect import FIXED, Dialect
from .number_text import to_number


@dataclass
class LineFaults:
    """Lines of the body that are not rows of numbers, by their number from 1.

    Attributes
    ----------
    blank : list of int
        Lines without any value.
    comments : list of (int, str)
        Comment lines between the data.
    cut : int
        The last line if it was cut off, else 0.
    """

    blank: list[int] = field(default_factory=list)
    comments: list[tuple[int, str]] = field(default_factory=list)
    cut: int = 0

    def findings(self, file: str) -> list[Finding]:
        """One warning for each kind of fault that is there."""
        found = []
        if self.cut:
            found.append(
                Finding(
                    "ragged-last-line",
                    "warning",
                    "the last line is cut off and was dropped",
                    file=file,
                    place=f"line {self.cut}",
                    cure="check that the run was recorded to its end",
                )
            )
        if self.blank:
            found.append(
                Finding(
                    "blank-rows",
                    "warning",
                    f"{len(self.blank)} blank row(s) were dropped, the first at line {self.blank[0]}",
                    file=file,
                    place=f"line {self.blank[0]}",
                    cure="check that no samples are missing there",
                )
            )
        if self.comments:
            found.append(
                Finding(
                    "comment-in-data",
                    "warning",
                    f"{len(self.comments)} comment line(s) between the data were dropped: '{self.comments[0][1]}'",
                    file=file,
                    place=f"line {self.comments[0][0]}",
                    cure="check that the run is one continuous record",
                )
            )
        return found


def parse_patiently(
    body: bytes, dialect: Dialect, names: Sequence[str], file: str
) -> tuple[list[np.ndarray], LineFaults]:
    """Parse the lines below the header one by one.

    Parameters
    ----------
    body : bytes
        Everything from the first data line on, in UTF-8.
    dialect : Dialect
        How the table is written.
    names : sequence of str
        Columns to return.
    file : str
        Named in errors.

    Returns
    -------
    columns : list of ndarray of float64, shape (n,)
        One for each of `names`.
    faults : LineFaults
        Lines that were left out.

    Raises
    ------
    ReadError
        For a line other than the last with too few or too many values, for text in a cell, and if no row is left.
    """
    lines = body.decode(errors="replace").replace("\r\n", "\n").replace("\r", "\n").split("\n")
    while lines and not lines[-1].strip():
        lines.pop()
    places = [dialect.names.index(name) for name in names]
    faults = LineFaults()
    rows: list[list[float]] = []
    for offset, line in enumerate(lines):
        number = dialect.first_data_row + 1 + offset
        if dialect.comment and line.lstrip().startswith(dialect.comment):
            faults.comments.append((number, line.strip()))
            continue
        cells = dialect.split(line)
        if not any(cells):
            faults.blank.append(number)
            continue
        is_last = offset == len(lines) - 1
        if is_last and rows and _is_short(line, cells, lines, dialect):
            faults.cut = number
            continue
        try:
            rows.append(_row(cells, places, dialect, file, number))
        except _CutNumber as error:
            # The recorder stopped within a number: "12.", "-" or "1.5E" without a line end.
            if not is_last or not rows:
                raise error.fault from None
            faults.cut = number
    if not rows:
        raise ReadError("there are no data rows", cure="export the run again", file=file)
    return list(np.array(rows, dtype=np.float64).T), faults


class _CutNumber(Exception):
    def __init__(self, fault: ReadError) -> None:
        self.fault = fault


def _is_short(line: str, cells: Sequence[str], lines: Sequence[str], dialect: Dialect) -> bool:
    if dialect.delimiter == FIXED:
        return len(line.rstrip()) < min((len(one.rstrip()) for one in lines[:-1] if one.strip()), default=0)
    return len(cells) != dialect.width


def _row(cells: Sequence[str], places: Sequence[int], dialect: Dialect, file: str, number: int) -> list[float]:
    if len(cells) != dialect.width:
        raise ReadError(
            f"the line has {len(cells)} values where {dialect.width} columns are expected",
            cure="mend or remove the line",
            file=file,
            place=f"line {number}",
        )
    values = []
    for place in places:
        try:
            values.append(to_number(cells[place], dialect.decimal))
        except ValueError:
            again = cells[place] == dialect.names[place]
            fault = ReadError(
                f"'{cells[place]}' is not a number",
                cure="the header stands again, as after a restart: split the file there"
                if again
                else "mend the cell, or leave it empty if the value is missing",
                file=file,
                place=f"line {number}, column {dialect.names[place]}",
            )
            if place == len(dialect.names) - 1 and cells[place][:1] in set("+-.0123456789"):
                raise _CutNumber(fault) from None
            raise fault from None
    return values
