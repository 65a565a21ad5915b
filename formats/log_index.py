"""The times of all rows of a log, for which the rest of each line is passed over."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import numpy as np

from .log_layout import LogLayout
from .log_rows import PIECE, Reading, in_order, pieces, places_of, plain_row, row_blocks, unfinished_row

_TAIL = 65_536
"""Bytes at the end of a file in which its last rows are looked for."""


def index_blocks(path: Path, layout: LogLayout, *, workers: int = 2) -> Iterator[np.ndarray]:
    """Times (or iterations) of the rows of a file, in blocks that are not empty.

    A line that is no row may slip in if its time is not before that of the line above it: so the time goes back at
    the same rows as in :func:`towtank.formats.log_rows.row_blocks`, unless the row above such a line does.

    Parameters
    ----------
    path : Path
        The file.
    layout : LogLayout
        Its columns.
    workers : int
        Threads.
    """
    if layout.names[0] != layout.index_name or path.stat().st_size <= PIECE:
        places, _ = places_of(layout, ())
        for block in row_blocks(path, layout, places, Reading()):
            at = block[0][np.isfinite(block[0])]
            if len(at):
                yield at
        return
    before = b""
    with open(path, "rb") as file:
        file.seek(layout.first_byte)
        for piece, at in in_order(pieces(file), partial(_times, layout=layout), workers):
            if at is None:
                places, _ = places_of(layout, ())
                row = unfinished_row(piece, before, layout, places)
                at = np.empty(0) if row is None else row[0][np.isfinite(row[0])]
            before = piece[-4096:]
            if len(at):
                yield at


def first_index(path: Path, layout: LogLayout) -> float | None:
    """Time (or iteration) of the first row of a file; None if it has no row."""
    places, _ = places_of(layout, ())
    with open(path, "rb") as file:
        file.seek(layout.first_byte)
        for raw in file:
            if not raw.endswith(b"\n"):
                break
            line = raw.decode("utf-8", errors="replace")
            if layout.comment and line.lstrip(' \t()"').startswith(layout.comment):
                continue
            values = plain_row(line, layout, places)
            if values is not None and np.isfinite(values[0]):
                return values[0]
    last = next(index_blocks(path, layout), None)
    return None if last is None else float(last[0])


def last_index(path: Path, layout: LogLayout) -> tuple[float, float]:
    """Times (or iterations) of the last two rows of a file; NaN where there is none."""
    places, _ = places_of(layout, ())
    with open(path, "rb") as file:
        size = file.seek(0, 2)
        begin = max(layout.first_byte, size - _TAIL)
        file.seek(begin)
        lines = file.read().split(b"\n")[:-1]
    # The tail may begin within a line.
    rows = lines[1:] if begin > layout.first_byte else lines
    found: list[float] = []
    for raw in reversed(rows):
        line = raw.decode("utf-8", errors="replace")
        values = plain_row(line, layout, places)
        if values is not None and np.isfinite(values[0]):
            found.append(values[0])
        if len(found) == 2:
            break
    last, before = (*found, np.nan, np.nan)[:2]
    return before, last


def _times(piece: bytes, layout: LogLayout) -> np.ndarray:
    """Times of the lines of a piece; those that go back are surely of whole rows."""
    from .decimal_rows import FAULT, character_kinds, first_cells, parse_rows

    text = np.frombuffer(piece, dtype=np.uint8)
    kinds = character_kinds(layout.delimiter)
    comment = ord(layout.comment) if layout.comment else 0
    cells, starts = first_cells(text, kinds, comment)
    result = np.empty((1, len(starts)))
    row = at = 0
    while True:
        row, at, reason = parse_rows(cells, at, kinds, False, 0, np.zeros(1, dtype=np.int64), result, row)
        if reason != FAULT:
            break
        # The rare number that the compiled parser does not cover, or a line of text.
        end = int(np.flatnonzero(cells[at:] == ord("\n"))[0]) + at
        try:
            result[0, row] = float(cells[at:end].tobytes())
        except ValueError:
            result[0, row] = np.nan
        row += 1
        at = end + 1
    timed = np.isfinite(result[0])
    times, starts = result[0, timed], starts[timed]
    places, _ = places_of(layout, ())
    while len(times):
        doubtful = np.flatnonzero(np.diff(times, prepend=sys.float_info.max) < 0)
        broken = [row for row in doubtful if not _is_row(piece, int(starts[row]), layout, places)]
        if not broken:
            break
        times, starts = np.delete(times, broken), np.delete(starts, broken)
    return times


def _is_row(piece: bytes, start: int, layout: LogLayout, places: np.ndarray) -> bool:
    line = piece[start : piece.index(b"\n", start)].decode("utf-8", errors="replace")
    return plain_row(line, layout, places) is not None
