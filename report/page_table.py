"""Tables of a page: columns with a kind, cells as text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Literal

from .typography import aligned

Kind = Literal["text", "short", "name", "number", "code"]
"""``short`` text is not broken into lines; a ``name`` is given room."""


@dataclass(frozen=True)
class Column:
    """Heading of a column and how its cells are set."""

    title: str
    kind: Kind = "text"
    note: str = ""


@dataclass(frozen=True)
class Table:
    """A table of a page.

    Attributes
    ----------
    columns : tuple of Column
    rows : tuple of tuple of str
        Cells as they are printed; markup in them must be :class:`markupsafe.Markup`.
    caption : str
    marks : tuple of str
        Class of each row; empty for none.
    """

    columns: tuple[Column, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""
    marks: tuple[str, ...] = field(default=())

    @property
    def marked_rows(self) -> list[tuple[str, tuple[str, ...]]]:
        """Rows with their marks."""
        marks = self.marks or ("",) * len(self.rows)
        return list(zip(marks, self.rows, strict=True))


def make_table(
    columns: Sequence[Column], rows: Iterable[Sequence[str]], caption: str = "", marks: Sequence[str] = ()
) -> Table:
    """Table whose number columns are aligned at the decimal point."""
    filled = [list(row) for row in rows]
    for index, column in enumerate(columns):
        if column.kind == "number":
            for row, cell in zip(filled, aligned([row[index] for row in filled]), strict=True):
                row[index] = cell
    return Table(tuple(columns), tuple(tuple(row) for row in filled), caption, tuple(marks))
