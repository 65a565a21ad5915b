"""The rows of a solver log as blocks of numbers, read piece by piece so that memory does not grow with the file."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import BinaryIO, NamedTuple, TypeVar

import numpy as np

from ..core.errors import ReadError
from .log_layout import LogLayout
from .number_text import WORDS, to_number

PIECE = 4 * 2**20
"""Bytes parsed at a time by one thread."""

_SMALL = 3 * 2**20
"""Bytes that are parsed without the compiled code, whose start takes longer than they do."""
_MOST_BROKEN = 10
_BROKEN_SHARE = 1e-3


@dataclass
class BrokenLines:
    """Lines that are no rows, by their number from 1.

    Attributes
    ----------
    count : int
        Lines with too few or too many values or with text in them.
    headers : int
        Headers that stand again between the rows.
    first : int
        First line of them.
    text : str
        Its beginning.
    cut : int
        The last line if it was cut off, else 0.
    """

    count: int = 0
    headers: int = 0
    first: int = 0
    text: str = ""
    cut: int = 0

    def add(self, number: int, line: str) -> None:
        """Count one more line."""
        if line.lstrip("\"'# (")[:1].isalpha() and not _starts_with_word(line):
            self.headers += 1
            return
        self.count += 1
        if not self.first:
            self.first, self.text = number, line.strip()[:60]

    def check(self, rows: int, layout: LogLayout, path: Path) -> None:
        """Raise :class:`ReadError` if so many lines are broken that the file is something else."""
        if self.count > _MOST_BROKEN + _BROKEN_SHARE * rows:
            raise ReadError(
                f"{self.count} lines are no rows of {len(layout.names)} values; the first reads '{self.text}'",
                cure="the columns change within the file: split it there, or leave the broken part out",
                file=path,
                place=f"line {self.first}",
            )

    def notes(self) -> list[str]:
        """What was left out, in words."""
        said = []
        if self.cut:
            said.append(f"the last line ({self.cut}) is cut off and was left out")
        if self.count:
            said.append(
                f"{self.count} broken line(s) were left out, the first at line {self.first}: '{self.text}'"
            )
        if self.headers:
            said.append(f"the header stands {self.headers} more time(s) between the rows")
        return said


@dataclass
class Reading:
    """What is known of a file after its rows were read.

    Attributes
    ----------
    rows : int
        Rows that were read.
    broken : BrokenLines
        Lines that were left out.
    end : int
        Byte behind the last whole line.
    untimed : int
        Rows that were left out because they have no time.
    """

    rows: int = 0
    broken: BrokenLines = field(default_factory=BrokenLines)
    end: int = 0
    untimed: int = 0

    def notes(self) -> list[str]:
        """What was left out, in words."""
        said = self.broken.notes()
        if self.untimed:
            said.append(f"{self.untimed} row(s) without a time were left out")
        return said


def places_of(layout: LogLayout, wanted: Sequence[str] | None) -> tuple[np.ndarray, list[str]]:
    """Where each column of the file goes, -1 for those not wanted, and the names that are read, in file order.

    The index (time or iteration) always is.
    """
    kept = [name for name in layout.names if name and (wanted is None or name in wanted)]
    if layout.index_name not in kept:
        kept.insert(0, layout.index_name)
    places = [kept.index(name) if name in kept else -1 for name in layout.names]
    return np.array(places, dtype=np.int64), kept


def row_blocks(
    path: Path,
    layout: LogLayout,
    places: np.ndarray,
    reading: Reading,
    *,
    begin: int | None = None,
    half_lines: bool = False,
    workers: int = 2,
) -> Iterator[np.ndarray]:
    """Yield the rows of a file in blocks.

    Parameters
    ----------
    path : Path
        The file.
    layout : LogLayout
        Its columns.
    places : ndarray of int64, shape (columns,)
        See :func:`places_of`.
    reading : Reading
        Filled while the blocks are taken.
    begin : int, optional
        Byte of the first row; default ``layout.first_byte``.
    half_lines : bool
        The file is still being written: leave a last line without a line end for later, silently.
    workers : int
        Threads that parse.

    Yields
    ------
    ndarray of float64, shape (wanted, rows)
        Printed ``nan`` and ``inf`` as infinities, missing values as NaN. The block is the caller's own.

    Raises
    ------
    ReadError
        If more lines are broken than a crash explains.
    """
    begin = layout.first_byte if begin is None else begin
    rest = before = b""
    line = 0
    reading.end = begin
    with open(path, "rb") as file:
        line = file.read(begin).count(b"\n") if begin == layout.first_byte else 0
        file.seek(0, 2)
        size = file.tell() - begin
        file.seek(begin)
        parse = partial(_parser(size), layout=layout, places=places)
        for piece, parsed in in_order(pieces(file), parse, workers if size > PIECE else 1):
            if parsed is None:
                rest = piece
                break
            for offset, text in parsed.faults:
                reading.broken.add(line + offset, text)
            line += parsed.lines
            reading.rows += parsed.block.shape[1]
            reading.end += len(piece)
            reading.broken.check(reading.rows, layout, path)
            before = piece[-4096:]
            yield parsed.block
    if half_lines or not rest.strip():
        return
    row = unfinished_row(rest, before, layout, places)
    if row is None:
        reading.broken.cut = line + 1
    else:
        reading.rows += 1
        yield row


@dataclass
class _Effort:
    """Bytes that were parsed without compiled code so far."""

    plain: int = 0


_EFFORT = _Effort()


def _parser(size: int) -> Callable[..., _Parsed]:
    """The plain parser for a few small files, the compiled one from some megabytes in all on."""
    _EFFORT.plain += size
    return _parse_plainly if _EFFORT.plain <= _SMALL else _parse_compiled


Parsed = TypeVar("Parsed")


class _Parsed(NamedTuple):
    block: np.ndarray
    faults: list[tuple[int, str]]
    lines: int


def pieces(file: BinaryIO) -> Iterator[bytes]:
    """Whole lines of the file, some megabytes at a time; last what stands behind the last line end, if anything."""
    carry = b""
    while data := file.read(PIECE):
        cut = data.rfind(b"\n") + 1
        if not cut:
            carry += data
            continue
        yield carry + data[:cut]
        carry = data[cut:]
    if carry:
        yield carry


def in_order(
    whole: Iterator[bytes], parse: Callable[[bytes], Parsed], workers: int
) -> Iterator[tuple[bytes, Parsed | None]]:
    """Pieces and what was parsed of them, a few ahead; None for a last piece without a line end."""
    if workers <= 1:
        for piece in whole:
            yield piece, parse(piece) if piece.endswith(b"\n") else None
        return
    waiting: deque[tuple[bytes, Future[Parsed] | None]] = deque()
    pool = ThreadPoolExecutor(workers, thread_name_prefix="towtank-log")
    try:
        for piece in whole:
            waiting.append((piece, pool.submit(parse, piece) if piece.endswith(b"\n") else None))
            del piece
            if len(waiting) > workers:
                done, future = waiting.popleft()
                yield done, future.result() if future is not None else None
                del done, future
        while waiting:
            done, future = waiting.popleft()
            yield done, future.result() if future is not None else None
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _parse_compiled(piece: bytes, layout: LogLayout, places: np.ndarray) -> _Parsed:
    """Rows of a piece of whole lines by compiled code; lines that it refuses are read one by one."""
    from .decimal_rows import FAULT, character_kinds, parse_rows

    lines = piece.count(b"\n")
    text = np.frombuffer(piece, dtype=np.uint8)
    result = np.empty((int(places.max()) + 1, lines))
    kinds = character_kinds(layout.delimiter)
    delimited = layout.delimiter != " "
    comment = ord(layout.comment) if layout.comment else 0
    faults: list[tuple[int, str]] = []
    row = at = 0
    while True:
        row, at, reason = parse_rows(text, at, kinds, delimited, comment, places, result, row)
        if reason != FAULT:
            break
        end = piece.index(b"\n", at)
        line = piece[at:end].decode("utf-8", errors="replace")
        values = plain_row(line, layout, places)
        if values is None:
            faults.append((piece.count(b"\n", 0, at) + 1, line))
        else:
            result[:, row] = values
            row += 1
        at = end + 1
    return _Parsed(result[:, :row], faults, lines)


def _parse_plainly(piece: bytes, layout: LogLayout, places: np.ndarray) -> _Parsed:
    """The same as :func:`_parse_compiled` without compiled code; only irregular lines are read cell by cell.

    A line of as many numbers as there are columns goes through ``float`` at once, which gives the nearest double as
    the compiled code does. Everything else, with ``nan``, missing values, text or another number of cells, is left to
    :func:`plain_row`.
    """
    text = piece.decode("utf-8", errors="replace")
    lines = text.split("\n")[:-1]
    regular = text.translate(_NO_GROUPS).split("\n")
    separator = None if layout.delimiter == " " else layout.delimiter
    width = len(places)
    wanted = [int(np.flatnonzero(places == place)[0]) for place in range(int(places.max()) + 1)]
    whole = wanted == list(range(width))
    # Python would read 1_000 as a number.
    underscores = "_" in text
    rows: list[list[float]] = []
    of_row: list[int] = []
    faults: list[tuple[int, str]] = []
    for number, line in enumerate(lines):
        cells = regular[number].split(separator)
        values: list[float] | None = None
        if len(cells) == width and not (underscores and "_" in line):
            try:
                values = list(map(float, cells if whole else [cells[column] for column in wanted]))
            except ValueError:
                values = None
        if values is None:
            bare = line.strip(' \t\r()"')
            if not bare or (layout.comment and bare.startswith(layout.comment)):
                continue
            values = plain_row(line, layout, places)
        if values is None:
            faults.append((number + 1, line))
        else:
            rows.append(values)
            of_row.append(number)
    block = np.array(rows, dtype=np.float64).reshape(len(rows), len(wanted))
    for row in np.flatnonzero(~np.isfinite(block).all(axis=1)):
        careful = plain_row(lines[of_row[row]], layout, places)
        if careful is not None:
            block[row] = careful
    return _Parsed(np.ascontiguousarray(block.T), faults, len(lines))


_NO_GROUPS = str.maketrans('()"', "   ")
_MISSING = {"", "-", "n/a", "na", "null", "#n/a"}


def plain_row(line: str, layout: LogLayout, places: np.ndarray) -> list[float] | None:
    """Wanted values of a line; None if it is no row of the table.

    As in the compiled parser, a printed ``nan`` or ``inf`` becomes an infinity and a missing value NaN.
    """
    line = line.translate(_NO_GROUPS)
    width = len(places)
    if "_" in line and layout.names.count("") == 0:
        # Python would read 1_000 as a number.
        return None
    if layout.delimiter == " ":
        cells = line.split()
    else:
        cells = [cell.strip() for cell in line.split(layout.delimiter)]
        while len(cells) > width and not cells[-1]:
            cells.pop()
    if len(cells) != width:
        return None
    row = [float("nan")] * (int(places.max()) + 1)
    for cell, place in zip(cells, places):
        if place < 0:
            continue
        word = cell.lower()
        if word in _MISSING:
            continue
        try:
            value = float(cell)
        except ValueError:
            try:
                value = to_number(cell)
            except ValueError:
                return None
        row[place] = float("-inf" if word.startswith("-") else "inf") if value != value else value
    return row


def unfinished_row(rest: bytes, before: bytes, layout: LogLayout, places: np.ndarray) -> np.ndarray | None:
    """The row of a last line without a line end, if it is certainly whole.

    It is if it closes its last parenthesis, or if its last number is as long as that of the line before: then the
    writer left the line end out.
    """
    line = rest.decode("utf-8", errors="replace")
    values = plain_row(line, layout, places)
    if values is None or line.count("(") != line.count(")"):
        return None
    if not line.rstrip().endswith(")"):
        above = before.decode("utf-8", errors="replace").rstrip("\r\n").rpartition("\n")[2]
        length, usual = (
            len(text.replace(layout.delimiter, " ").split()[-1]) if text.split() else 0 for text in (line, above)
        )
        if not usual or length < usual:
            return None
    return np.array(values, dtype=np.float64)[:, None]


def _starts_with_word(line: str) -> bool:
    """Whether a line begins with a word that stands for a number, as in ``nan nan nan``."""
    cells = line.split()
    return bool(cells) and cells[0].strip('"(),').lower() in WORDS
