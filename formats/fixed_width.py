"""Tables in fixed-width columns, where cells may be blank or touch each other (Fortran ``F10.4``)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.errors import ReadError

#: First and last-but-one character of each column.
Edges = tuple[tuple[int, int], ...]

#: The separator that is put between the cells; it cannot occur in a text file.
SEPARATOR = "\x1f"


def column_edges(lines: Sequence[str], decimal: str) -> Edges:
    """Columns of a fixed-width table.

    A column ends where all lines are blank behind it, or, where numbers touch, a constant number of digits behind
    the decimal sign that all lines have in the same place.

    Parameters
    ----------
    lines : sequence of str
        Lines of the body, without line ends.
    decimal : str
        Decimal sign.

    Returns
    -------
    tuple of (int, int)
        Half-open character ranges that cover the line; empty if no columns are found.
    """
    width = max((len(line) for line in lines), default=0)
    if not width:
        return ()
    page = np.array([list(line.ljust(width)) for line in lines])
    inked = np.any(page != " ", axis=0)
    stops = {int(stop) for stop in np.flatnonzero(inked[:-1] & ~inked[1:]) + 1} | {width}
    # A blank or a sign in any line shows that the digits of the cell before have ended.
    digits = np.all(np.isin(page, list("0123456789")), axis=0)
    signs = np.all(page == decimal, axis=0)
    for point in np.flatnonzero(signs):
        stop = int(point) + 1
        while stop < width and digits[stop]:
            stop += 1
        if stop < width and not signs[stop]:
            stops.add(stop)
    edges = []
    start = 0
    for stop in sorted(stops):
        if inked[start:stop].any():
            edges.append((start, stop))
            start = stop
    return tuple(edges)


def cut(line: str, edges: Edges) -> list[str]:
    """Cells of one line, without blanks around them."""
    return [line[start:stop].strip() for start, stop in edges]


def separate(data: bytes, edges: Edges, *, file: str = "", first_line: int = 1) -> tuple[bytes, bool]:
    """Insert a separator between the columns of all lines of `data`; blank lines are left out.

    Returns
    -------
    separated : bytes
        The table with `SEPARATOR` between the cells.
    is_cut : bool
        Whether the last line is shorter than all others and was left out.

    Raises
    ------
    ReadError
        If a line is longer than the columns reach.
    """
    width = edges[-1][1]
    rows = [row.rstrip() for row in data.splitlines()]
    for offset, row in enumerate(rows):
        if len(row) > width:
            raise ReadError(
                f"the line has {len(row)} characters where the columns end at {width}",
                cure="export the run again with blanks or tabs between the columns",
                file=file or None,
                place=f"line {first_line + offset}",
            )
    filled = [row for row in rows if row]
    is_cut = len(filled) > 1 and len(filled[-1]) < min(map(len, filled[:-1]))
    if is_cut:
        filled.pop()
    page = np.array(filled, dtype=f"S{width}").view("S1").reshape(len(filled), width)
    page = np.where(page == b"", b" ", page)
    page = np.insert(page, [stop for _, stop in edges[:-1]], SEPARATOR.encode(), axis=1)
    page = np.hstack([page, np.full((len(filled), 1), b"\n")])
    return page.tobytes(), is_cut
