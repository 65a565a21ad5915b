"""A history in blocks of rows, joined from all its runs: where two runs have the same time, the newer one is right.

Every row replaces all rows written before it of its own or a later time, so that what is left is strictly increasing.
The rows before a restart can only be cut when its time is known: for runs in files of their own it is their first
row; a file that goes back in itself is looked through once more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Protocol, TypeVar

import numpy as np

from ..core.errors import ReadError
from .log_index import first_index, index_blocks
from .log_layout import LogLayout
from .log_rows import Reading, places_of, row_blocks
from .solver_log import Restart

_MOST_RESTARTS = 20
_BACK_SHARE = 0.01
_ANY_TIME = -np.inf
"""First time of the only run, which is not known yet."""
_OUTSIDE_MESH = -1e299
"""OpenFOAM prints -1e300 for a probe outside the mesh."""


@dataclass(frozen=True)
class Selection:
    """What is wanted of a history.

    Attributes
    ----------
    columns : tuple of str or None
        Names besides the index; None for all.
    start, stop : float or None
        Range of the time (or iteration), both ends included.
    block : float or None
        Length of the blocks over which means are taken; None for every row.
    """

    columns: tuple[str, ...] | None = None
    start: float | None = None
    stop: float | None = None
    block: float | None = None

    def __post_init__(self) -> None:
        if self.start is not None and self.stop is not None and self.start >= self.stop:
            raise ReadError(
                f"the time range from {self.start:g} to {self.stop:g} is empty", cure="give start < stop"
            )

    def inside(self, at: np.ndarray) -> np.ndarray | None:
        """Which times are in the range; None if all are."""
        if self.start is None and self.stop is None:
            return None
        inside = np.ones(len(at), dtype=bool)
        if self.start is not None:
            inside &= at >= self.start
        if self.stop is not None:
            inside &= at <= self.stop
        return None if inside.all() else inside


_EVERYTHING = Selection()


class RowConsumer(Protocol):
    """Something that takes the rows of a history block by block."""

    def add(self, block: np.ndarray) -> None:
        """Take rows, shape (k, n), the index first; the block may be changed."""


Consumer = TypeVar("Consumer", bound=RowConsumer)


class _GoesBackError(Exception):
    """The time goes back within a file."""


@dataclass
class _Runs:
    """The runs of a history: stretches in which the time does not go back.

    Attributes
    ----------
    firsts : list of float
        First time of each.
    files : list of Path
        File of each.
    """

    firsts: list[float] = field(default_factory=list)
    files: list[Path] = field(default_factory=list)

    def next(self, run: int, first: float) -> int:
        """The run behind `run` that begins at this time."""
        for later in range(run + 1, len(self.firsts)):
            if self.firsts[later] in (first, _ANY_TIME):
                return later
        raise _GoesBackError

    def limits(self) -> np.ndarray:
        """Time from which on the rows of each run were replaced."""
        later = np.array([*self.firsts[1:], np.inf])
        return np.minimum.accumulate(later[::-1])[::-1]


class LogStream:
    """A history in files of one or several runs.

    Parameters
    ----------
    files : sequence of (Path, LogLayout)
        Oldest run first.
    selection : Selection
        Columns and range.

    Attributes
    ----------
    names : list of str
        Columns that are read, the index first.
    restarts : list of Restart
        Where runs overlap; known after all rows were taken.
    notes : list of str
        What was left out; complete after all rows were taken.

    Raises
    ------
    ReadError
        If a column that is asked for is not there, or the runs have no index in common.
    """

    def __init__(self, files: Sequence[tuple[Path, LogLayout]], selection: Selection = _EVERYTHING) -> None:
        self.files = list(files)
        self.selection = selection
        self._header_notes = list(self.newest.notes)
        self.columns = self._columns()
        self.names = wanted_columns(self.newest, self.columns)[1]
        self._header_notes += _changes(self.files)
        self.restarts: list[Restart] = []
        self.notes: list[str] = []

    @property
    def newest(self) -> LogLayout:
        """Layout of the newest run."""
        return self.files[-1][1]

    def _columns(self) -> tuple[str, ...] | None:
        """Columns to be read: those asked for, of those that every run has."""
        layouts = [layout for _, layout in self.files]
        asked = self.selection.columns
        if asked is not None:
            for path, layout in self.files:
                stranger = next((name for name in asked if name not in layout.names), None)
                if stranger is not None:
                    have = ", ".join(name for name in layout.names if name)
                    raise ReadError(f"there is no column '{stranger}'", cure=f"the file has {have}", file=path)
        if len({layout.index_name for layout in layouts}) > 1:
            raise ReadError(
                "the runs count differently (time, iterations)",
                cure="read them one by one",
                file=self.files[-1][0],
            )
        if asked is not None or len({layout.names for layout in layouts}) == 1:
            return asked
        shared = [name for name in self.newest.names if name and all(name in layout.names for layout in layouts)]
        lost = sorted({name for layout in layouts for name in layout.names if name} - set(shared))
        if lost:
            self._header_notes.append(f"column(s) that not every run wrote are left out: {', '.join(lost)}")
        return tuple(shared)

    def into(self, consumer: Callable[[], Consumer]) -> Consumer:
        """Hand all rows to a new consumer, and return it.

        A consumer that already took rows which a restart within a file replaces is thrown away, and a second one
        takes the right ones.
        """
        taker = consumer()
        try:
            for block in self._rows(self._runs_by_files()):
                taker.add(block)
        except _GoesBackError:
            taker = consumer()
            for block in self._rows(self._runs_by_looking()):
                taker.add(block)
        return taker

    def blocks(self) -> Iterator[np.ndarray]:
        """The joined rows, shape (k, n), the index first; the files are looked through for restarts before."""
        return self._rows(self._runs_by_looking())

    def _runs_by_files(self) -> _Runs:
        """One run for each file that has rows."""
        if len(self.files) == 1:
            return _Runs([_ANY_TIME], [self.files[0][0]])
        runs = _Runs()
        for path, layout in self.files:
            first = first_index(path, layout)
            if first is not None:
                runs.firsts.append(first)
                runs.files.append(path)
        return runs

    def _runs_by_looking(self) -> _Runs:
        """All runs, also those within a file."""
        runs = _Runs()
        rows = 0
        for path, layout in self.files:
            last = np.inf
            for at in index_blocks(path, layout):
                steps = np.diff(at, prepend=last)
                for row in np.flatnonzero(steps < 0):
                    runs.firsts.append(float(at[row]))
                    runs.files.append(path)
                rows += len(at)
                last = float(at[-1])
                if len(runs.firsts) > _MOST_RESTARTS + _BACK_SHARE * rows:
                    raise ReadError(
                        f"the time goes back {len(runs.firsts)} times in {rows} rows",
                        cure="another column is the time: name it in the channel map",
                        file=path,
                    )
        return runs

    def _file_blocks(self, path: Path, layout: LogLayout, reading: Reading) -> Iterator[np.ndarray]:
        """Blocks of one file in the order of `names`, without rows that have no index."""
        places, names = wanted_columns(layout, self.columns)
        order = None if names == self.names else [names.index(name) for name in self.names]
        for block in row_blocks(path, layout, places, reading):
            if order is not None:
                block = block[order]
            timed = np.isfinite(block[0])
            if not timed.all():
                reading.untimed += int(np.count_nonzero(~timed))
                block = block[:, timed]
            if block.shape[1]:
                yield block

    def _rows(self, runs: _Runs) -> Iterator[np.ndarray]:
        """Rows that no later row replaces, in the range; fills `restarts` and `notes`."""
        limits = runs.limits()
        ends = np.full(len(limits), -np.inf)
        replaced = np.zeros(len(limits), dtype=np.int64)
        said: list[str] = []
        run, repeated = -1, 0
        held = np.empty((len(self.names), 0))
        for path, layout in self.files:
            reading = Reading()
            last = np.inf
            for block in self._file_blocks(path, layout, reading):
                steps = np.diff(block[0], prepend=last)
                last = float(block[0, -1])
                for number, piece in enumerate(np.split(block, np.flatnonzero(steps < 0), axis=1)):
                    if number:
                        yield from self._in_range(held)
                        held = held[:, :0]
                        run = runs.next(run, float(piece[0, 0]))
                    if not piece.shape[1]:
                        continue
                    ends[run] = piece[0, -1]
                    if ends[run] >= limits[run]:
                        stays = piece[0] < limits[run]
                        _count_replaced(piece[0, ~stays], run, runs.firsts, replaced)
                        piece = piece[:, stays]
                        if not piece.shape[1]:
                            continue
                    if held.shape[1] and held[0, 0] < piece[0, 0]:
                        yield from self._in_range(held)
                    elif held.shape[1]:
                        repeated += 1
                    twice = np.diff(piece[0]) == 0
                    if twice.any():
                        repeated += int(np.count_nonzero(twice))
                        piece = piece[:, np.append(~twice, True)]
                    # The first row of the next block may have the same time.
                    yield from self._in_range(piece[:, :-1])
                    held = piece[:, -1:].copy()
            notes = reading.notes()
            said += [f"{path.name}: {text}" for text in notes] if len(self.files) > 1 else notes
        yield from self._in_range(held)
        if repeated:
            said.append(f"{repeated} row(s) repeat the time of the next one, which is kept")
        self.restarts = [
            Restart(runs.files[k], runs.firsts[k], float(ends[k - 1]), int(replaced[k]))
            for k in range(1, len(limits))
            if runs.firsts[k] <= ends[:k].max()
        ]
        self.notes = self._header_notes + said

    def _in_range(self, block: np.ndarray) -> Iterator[np.ndarray]:
        inside = self.selection.inside(block[0])
        if inside is not None:
            block = block[:, inside]
        if block.shape[1]:
            if self.newest.kind == "probes":
                block[1:][block[1:] <= _OUTSIDE_MESH] = np.nan
            yield block


def wanted_columns(layout: LogLayout, columns: Sequence[str] | None) -> tuple[np.ndarray, list[str]]:
    """Places and names of the columns to be read, the index first."""
    places, names = places_of(layout, columns)
    first = names.index(layout.index_name)
    order = [first, *(i for i in range(len(names)) if i != first)]
    rank = {old: new for new, old in enumerate(order)}
    return np.array([rank.get(int(place), -1) for place in places], dtype=np.int64), [names[i] for i in order]


def _count_replaced(at: np.ndarray, run: int, firsts: Sequence[float], replaced: np.ndarray) -> None:
    """Add the replaced rows of a run to the first later run that reaches back to them."""
    for later in range(run + 1, len(firsts)):
        reached = at >= firsts[later]
        replaced[later] += np.count_nonzero(reached)
        at = at[~reached]


def _changes(files: Sequence[tuple[Path, LogLayout]]) -> list[str]:
    """Where an entry of the header differs from that of the run before."""
    said = []
    for (_, before), (path, after) in pairwise(files):
        for key, value in after.header.items():
            if before.header.get(key, value) != value:
                said.append(f"{key} changes from {before.header[key]} to {value} at {path.parent.name}")
    return said
