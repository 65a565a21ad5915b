"""Where the names, the units and the data of a table stand, found from its first rows.

The same rules serve text files and spreadsheets: both hand over rows of cells.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from ..core.errors import ReadError
from ..core.findings import Finding
from .raw_table import number_repeats
from .units import looks_like_unit, split_name, strip_brackets

#: A row of cells; empty where the line is blank.
Cells = Sequence[str]

_LOOK_AHEAD = 3


@dataclass(frozen=True)
class HeaderLayout:
    """What stands above the data.

    Attributes
    ----------
    first_data : int
        Row of the first data, counted from 0.
    names_row, units_row : int or None
        Rows of the names and the units.
    headings : int
        Number of rows from the names or units, whichever stand first, to the data.
    names : tuple of str
        One unique name for each column, units in brackets taken off.
    units : tuple of str
        One unit for each column as printed; empty if there is none.
    text_columns : tuple of int
        Columns, counted from 0, that hold text.
    findings : tuple of Finding
        Faults of the header.
    """

    first_data: int
    names_row: int | None
    units_row: int | None
    headings: int
    names: tuple[str, ...]
    units: tuple[str, ...]
    text_columns: tuple[int, ...]
    findings: tuple[Finding, ...]


def lay_out(
    rows: Sequence[Cells],
    is_comment: Sequence[bool],
    bulk: Sequence[Cells],
    width: int,
    is_number: Callable[[str], bool],
    *,
    file: str = "",
) -> HeaderLayout:
    """Find names, units and the first data row.

    Parameters
    ----------
    rows : sequence of sequences of str
        The first rows of the table, trailing empty cells taken off; comment rows without their mark.
    is_comment : sequence of bool
        Which of `rows` are comments and so never data.
    bulk : sequence of sequences of str
        Rows of `width` cells from the body of the table, which say what each column holds.
    width : int
        Number of columns.
    is_number : callable
        Whether a non-empty cell is a number.
    file : str
        Named in errors.

    Raises
    ------
    ReadError
        If there are no data rows, or more names than columns.
    """
    kinds = _column_kinds(bulk, width, is_number)
    first_data = _first_data_row(rows, is_comment, kinds, is_number, file)
    above = [index for index in range(first_data) if rows[index]]
    names_row, units_row = _heading_rows(rows, is_comment, above, width)
    start = min((row for row in (names_row, units_row) if row is not None), default=first_data)
    names, units, findings = _label(rows, names_row, units_row, above, width, file)
    text_columns = tuple(column for column, kind in enumerate(kinds) if kind == "text")
    if text_columns:
        listed = ", ".join(names[column] for column in text_columns)
        findings.append(
            Finding(
                "text-column",
                "warning",
                f"text column(s) left out: {listed}",
                cure="export numbers if they are needed",
            )
        )
    return HeaderLayout(
        first_data, names_row, units_row, first_data - start, names, units, text_columns, tuple(findings)
    )


def _column_kinds(bulk: Sequence[Cells], width: int, is_number: Callable[[str], bool]) -> list[str]:
    kinds = []
    for column in range(width):
        filled = [row[column] for row in bulk if row[column]]
        numbers = sum(map(is_number, filled))
        kinds.append("empty" if not filled else "number" if 2 * numbers >= len(filled) else "text")
    return kinds


def _first_data_row(
    rows: Sequence[Cells],
    is_comment: Sequence[bool],
    kinds: Sequence[str],
    is_number: Callable[[str], bool],
    file: str,
) -> int:
    width = len(kinds)

    def standing(index: int) -> str:
        """How a row stands to the columns: a heading, data, something between them, or neither."""
        row = rows[index]
        if not row:
            return "blank"
        # A short row may be units, ragged data or a line of a preamble; only its own cells can tell.
        relevant = row if len(row) != width else [row[c] for c in range(width) if kinds[c] == "number"]
        filled = [cell for cell in relevant if cell]
        texts = sum(not is_number(cell) for cell in filled)
        if is_comment[index]:
            return "comment of names" if len(row) == width and texts == len(filled) else "comment"
        if len(row) == width:
            return "data" if filled and not texts else "heading" if texts == len(filled) else "mixed"
        return "short heading" if texts == len(filled) else "other" if texts else "ragged"

    standings = [standing(index) for index in range(len(rows))]
    named = False
    for index, kind in enumerate(standings if "number" in kinds else ()):
        # A row of channel numbers above the names looks like data; under the names, numbers are data.
        is_numbering = any("heading" in ahead for ahead in standings[index + 1 : index + 1 + _LOOK_AHEAD])
        if kind == "data" and (named or not is_numbering):
            return index
        # Under the names, a mixed or ragged row is data with a fault; without names it is the row of names itself.
        if kind in {"mixed", "ragged"} and named and not is_numbering:
            return index
        named = named or kind in {"heading", "comment of names"} or (kind == "mixed" and not is_numbering)
    raise ReadError(
        "there are no data rows",
        cure="the file holds a header only or no columns of numbers; export the run again",
        file=file or None,
    )


def _heading_rows(
    rows: Sequence[Cells], is_comment: Sequence[bool], above: Sequence[int], width: int
) -> tuple[int | None, int | None]:
    """Rows of the names and of the units among the non-blank rows above the data."""
    worded = [index for index in above if _is_heading(rows[index])]
    candidates = [index for index in worded if len(rows[index]) == width]
    if not candidates:
        # One name may be missing or too many; a sentence in a comment must not be taken for names, though.
        candidates = [
            index
            for index in worded
            if 3 * len(rows[index]) >= 2 * width and not is_comment[index] and index >= above[-1] - 1
        ]
    units = [
        index for index in above if _unit_share(rows[index]) >= 0.6 and width <= 3 * len(rows[index]) <= 3 * width
    ]
    for units_row in reversed(units):
        before = [index for index in candidates if index < units_row]
        after = [index for index in candidates if index > units_row]
        if before or after:
            return (before[-1] if before else after[0]), units_row
    return (_best_names(rows, is_comment, candidates) if candidates else None), None


def _is_heading(row: Cells) -> bool:
    return any(cell and not cell.replace(".", "", 1).isdigit() for cell in row)


def _best_names(rows: Sequence[Cells], is_comment: Sequence[bool], candidates: Sequence[int]) -> int:
    """Row of unlike words in the block of heading rows that is nearest to the data."""
    plain = [index for index in candidates if not is_comment[index]]
    rest = plain or candidates
    block = [rest[-1]]
    while block[0] - 1 in rest:
        block.insert(0, block[0] - 1)
    unlike = [index for index in block if all(rows[index]) and len(set(rows[index])) == len(rows[index])]
    # Descriptions stand below plain names; among comments, remarks stand above the names.
    return (unlike or block)[0 if plain else -1]


def _unit_share(row: Cells) -> float:
    filled = [cell for cell in row if cell]
    return sum(map(looks_like_unit, filled)) / len(filled) if filled else 0.0


def _label(
    rows: Sequence[Cells],
    names_row: int | None,
    units_row: int | None,
    above: Sequence[int],
    width: int,
    file: str,
) -> tuple[tuple[str, ...], tuple[str, ...], list[Finding]]:
    findings: list[Finding] = []
    printed = list(rows[names_row]) if names_row is not None else []
    if len(printed) > width:
        raise ReadError(
            f"the header names {len(printed)} columns but the rows have {width} values",
            cure="name each column once, without blanks in the names or with quotes around them",
            file=file or None,
            place=f"row {names_row + 1}" if names_row is not None else "",
        )
    missing = width - sum(bool(name) for name in printed)
    if missing:
        findings.append(
            Finding(
                "names-fewer-than-columns",
                "warning",
                f"{missing} of {width} columns have no name; they are called column_1, column_2, ... by place",
                cure="name them in the header, or map them by their number",
            )
        )
    printed += [""] * (width - len(printed))
    split = [split_name(text) if text else (f"column_{n}", "") for n, text in enumerate(printed, start=1)]
    units = [unit for _, unit in split]
    if units_row is not None:
        row = rows[units_row]
        if len(row) < width:
            findings.append(
                Finding(
                    "units-fewer-than-columns",
                    "warning",
                    f"the unit row has {len(row)} entries for {width} columns; they are taken from the left",
                    place=f"row {units_row + 1}",
                    cure="give the units in the channel map",
                )
            )
        for column, text in enumerate(row):
            units[column] = strip_brackets(text) or units[column]
    else:
        # Some tables print single units in brackets in a second heading row, between other words.
        below_names = [index for index in above if names_row is not None and index > names_row]
        for index in below_names:
            for column, text in enumerate(rows[index][:width]):
                if text[:1] in {"[", "("} and looks_like_unit(text):
                    units[column] = units[column] or strip_brackets(text)
    names, repeated = number_repeats([name for name, _ in split])
    if repeated:
        findings.append(
            Finding(
                "duplicate-columns",
                "warning",
                f"column name(s) used more than once: {', '.join(repeated)}; numbered from the left",
                cure="rename the columns, or map them by their new names",
            )
        )
    return names, tuple(units), findings
