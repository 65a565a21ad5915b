"""Means of a long history over blocks of time: what is left of gigabytes when every row was taken into account."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from .divergence import DivergenceWatch
from .log_layout import LogLayout
from .log_series import as_frame, as_log, check_numbers
from .log_stream import LogStream, Selection
from .part_sums import force_unit, missing_totals, totals_note
from .solver_log import SolverLog

if TYPE_CHECKING:
    import pandas as pd

_ON_THE_EDGE = 1e-6
"""Share of a block by which a rounded time may miss its edge."""


@dataclass(frozen=True, eq=False)
class LogBlocks:
    """A history reduced to blocks of equal length.

    Attributes
    ----------
    log : SolverLog
        Means of the blocks; its time (or iteration) is the mean of that of their rows. Blocks without rows are left
        out, as is the one in which the solver diverged.
    deviations : DataFrame
        Standard deviation of the rows within each block, about its mean, divided by their number.
    lows, highs : DataFrame
        Least and greatest value within each block.
    counts : ndarray of int64, shape (n,)
        Rows of each block.
    width : float
        Length of a block, in the unit of the time or in iterations.
    """

    log: SolverLog
    deviations: pd.DataFrame
    lows: pd.DataFrame
    highs: pd.DataFrame
    counts: np.ndarray
    width: float


class _Sums:
    """Sums over the rows of each block, about the first value of each column so that digits are not lost."""

    def __init__(self, names: Sequence[str], width: float, totals: dict[str, list[str]]) -> None:
        self.watch = DivergenceWatch(names)
        self.names = [*names, *totals]
        self.rows = 0
        self.origin = np.nan
        self._width = width
        self._parts = [[names.index(part) for part in parts] for parts in totals.values()]
        self._shift = np.full(len(self.names), np.nan)
        self._finished: list[tuple[np.ndarray, np.ndarray]] = []
        self._open: tuple[np.ndarray, np.ndarray] | None = None

    def add(self, block: np.ndarray) -> None:
        self.watch.add(block)
        if self._parts:
            block = np.vstack([block, *(block[rows].sum(axis=0, keepdims=True) for rows in self._parts)])
        if not self.rows:
            self.origin = float(block[0, 0])
        self.rows += block.shape[1]
        self._find_shift(block)
        numbers = np.floor((block[0] - self.origin) / self._width + _ON_THE_EDGE).astype(np.int64)
        starts = np.concatenate([[0], np.flatnonzero(np.diff(numbers)) + 1])
        sums = self._sums(block, starts)
        ids = numbers[starts]
        if self._open is not None:
            if self._open[0][0] == ids[0]:
                sums[:, :, :1] = _together(self._open[1], sums[:, :, :1])
            else:
                self._finished.append(self._open)
        self._finished.append((ids[:-1], sums[:, :, :-1]))
        self._open = (ids[-1:], sums[:, :, -1:].copy())

    def _find_shift(self, block: np.ndarray) -> None:
        for column in np.flatnonzero(np.isnan(self._shift)):
            found = np.flatnonzero(~np.isnan(block[column]))
            if found.size:
                self._shift[column] = block[column, found[0]]

    def _sums(self, block: np.ndarray, starts: np.ndarray) -> np.ndarray:
        """Number, sum, sum of squares, least and greatest of each column in each block, shape (5, k, blocks)."""
        result = np.empty((5, len(block), len(starts)))
        sizes = np.diff(np.append(starts, block.shape[1]))
        for column, values in enumerate(block):
            about = values - self._shift[column]
            missing = np.isnan(about)
            low = high = about
            result[0, column] = sizes
            if missing.any():
                result[0, column] -= np.add.reduceat(missing, starts, dtype=np.int64)
                low, high = np.where(missing, np.inf, about), np.where(missing, -np.inf, about)
                about = np.where(missing, 0.0, about)
            result[1, column] = np.add.reduceat(about, starts)
            result[2, column] = np.add.reduceat(about * about, starts)
            result[3, column] = np.minimum.reduceat(low, starts)
            result[4, column] = np.maximum.reduceat(high, starts)
        return result

    def table(self) -> tuple[np.ndarray, np.ndarray]:
        """Numbers of the blocks, and means, deviations, lows, highs and counts, shape (5, k, blocks)."""
        parts = [*self._finished, self._open] if self._open is not None else self._finished
        ids = np.concatenate([part for part, _ in parts])
        sums = np.concatenate([part for _, part in parts], axis=2)
        count = np.where(sums[0] > 0, sums[0], np.nan)
        about = sums[1] / count
        shift = self._shift[:, None]
        deviation = np.sqrt(np.maximum(sums[2] / count - about**2, 0.0))
        empty = np.isnan(count)
        lows, highs = (np.where(empty, np.nan, part + shift) for part in (sums[3], sums[4]))
        return ids, np.stack([about + shift, deviation, lows, highs, sums[0]])


def _together(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Sums of a block of which the rows came in two parts."""
    result = one + other
    result[3] = np.minimum(one[3], other[3])
    result[4] = np.maximum(one[4], other[4])
    return result


def read_block_series(
    files: Sequence[tuple[Path, LogLayout]], name: str, width: float, selection: Selection
) -> LogBlocks:
    """Means over blocks of one history, from the files of its runs, in memory that does not grow with the rows.

    Parameters
    ----------
    files : sequence of (Path, LogLayout)
        Oldest run first.
    name : str
        Name of the history.
    width : float
        Length of a block, in the unit of the time or in iterations; the first begins at the first row.
    selection : Selection
        Columns and time range.

    Raises
    ------
    ReadError
        If `width` is not positive, there are no rows or no numbers, or too many lines are broken.
    """
    if not width > 0.0:
        raise ReadError(f"blocks of length {width:g} are no blocks", cure="give a positive length")
    stream = LogStream(files, selection)
    totals = missing_totals(stream.names) if stream.newest.kind == "forces" else {}
    sums = stream.into(lambda: _Sums(stream.names, width, totals))
    diverged_at = check_numbers(sums.watch, sums.rows, selection, files[-1][0])
    ids, table = sums.table()
    kept = len(ids)
    if diverged_at is not None:
        kept = int(np.searchsorted(ids, np.floor((diverged_at - sums.origin) / width + _ON_THE_EDGE)))
        if not kept:
            raise ReadError(
                f"the run diverged at {diverged_at:.9g}, within the first block",
                cure=f"take blocks shorter than {width:g}",
                file=files[-1][0],
            )
    counts = table[4, 0, :kept].astype(np.int64)
    means, deviations, lows, highs = (as_frame(part[:, :kept], sums.names) for part in table[:4])
    left_out = sums.rows - int(counts.sum())
    notes = [
        f"means over blocks of {width:g}: {len(counts)} blocks of {counts.min()} to {counts.max()} rows",
        *stream.notes,
        *sums.watch.notes(left_out),
    ]
    if totals:
        notes.append(totals_note(totals))
    log = as_log(stream, name, means, notes, diverged_at)
    units = {**log.units, **{total: force_unit(total) for total in totals}}
    return LogBlocks(replace(log, units=units), deviations, lows, highs, counts, width)
