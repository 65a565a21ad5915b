"""One history in memory, from the files of all its runs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from .divergence import DivergenceWatch
from .log_layout import LogLayout
from .log_stream import LogStream, Selection
from .solver_log import Restart, SolverLog

if TYPE_CHECKING:
    import pandas as pd


class _Gathering:
    """Rows kept in memory, and watched for a divergence."""

    def __init__(self, names: Sequence[str]) -> None:
        self.watch = DivergenceWatch(names)
        self._width = len(names)
        self._blocks: list[np.ndarray] = []

    def add(self, block: np.ndarray) -> None:
        self.watch.add(block)
        self._blocks.append(block)

    def array(self) -> np.ndarray:
        """All rows, shape (k, n); the blocks are given up."""
        values = np.empty((self._width, sum(block.shape[1] for block in self._blocks)))
        at = 0
        self._blocks.reverse()
        while self._blocks:
            # Each block is let go as soon as it is copied, so that the rows are not held twice.
            block = self._blocks.pop()
            values[:, at : at + block.shape[1]] = block
            at += block.shape[1]
        return values


def read_series(files: Sequence[tuple[Path, LogLayout]], name: str, selection: Selection) -> SolverLog:
    """Read one history from the files of its runs.

    Parameters
    ----------
    files : sequence of (Path, LogLayout)
        Oldest run first.
    name : str
        Name of the history.
    selection : Selection
        Columns and time range.

    Raises
    ------
    ReadError
        If there are no rows or no numbers, or too many lines are broken.
    """
    stream = LogStream(files, selection)
    gathered = stream.into(lambda: _Gathering(stream.names))
    values = gathered.array()
    rows = values.shape[1]
    diverged_at = check_numbers(gathered.watch, rows, selection, files[-1][0])
    if diverged_at is not None:
        values = values[:, : int(np.searchsorted(values[0], diverged_at))]
    notes = stream.notes + gathered.watch.notes(rows - values.shape[1])
    return as_log(stream, name, as_frame(values, stream.names), notes, diverged_at)


def check_numbers(watch: DivergenceWatch, rows: int, selection: Selection, file: Path) -> float | None:
    """Where the history diverged, None if it did not.

    Raises
    ------
    ReadError
        If there are no rows, or no number in any.
    """
    if not rows:
        ranged = selection.start is not None or selection.stop is not None
        raise ReadError(
            "there are no rows in the time range" if ranged else "there are no whole data rows",
            cure="check the run and the time range",
            file=file,
        )
    if watch.is_empty:
        raise ReadError(
            "every value is nan or inf from the first row on",
            cure="the run diverged at once: repeat it",
            file=file,
        )
    return watch.diverged_at


def as_log(
    stream: LogStream, name: str, frame: pd.DataFrame, notes: Iterable[str], diverged_at: float | None
) -> SolverLog:
    """The history that was read through `stream`."""
    layout = stream.newest
    return SolverLog(
        name=name,
        kind=layout.kind,
        frame=frame,
        units={str(one): layout.units.get(str(one), "") for one in frame.columns},
        files=tuple(path for path, _ in stream.files),
        restarts=tuple(stream.restarts),
        notes=tuple(notes),
        header=layout.header,
        points=layout.points,
        diverged_at=diverged_at,
    )


def as_frame(values: np.ndarray, names: Sequence[str]) -> pd.DataFrame:
    """The rows of `values` (shape (k, n)) as the columns of a frame, not copied."""
    import pandas as pd

    return pd.DataFrame(values.T, columns=pd.Index(names), copy=False)


def merged(logs: Sequence[SolverLog], name: str) -> SolverLog:
    """Histories of the same run, such as forces and moments, side by side at the times that all of them have."""
    first = logs[0]
    index = first.index_name
    frames = [log.frame for log in logs]
    times = [frame[index].to_numpy() for frame in frames]
    notes = [note for log in logs for note in log.notes]
    common = times[0]
    if any(not np.array_equal(common, other) for other in times[1:]):
        for other in times[1:]:
            common = np.intersect1d(common, other, assume_unique=True)
        if not common.size:
            raise ReadError(
                "forces and moments have no common times", cure="read the files one by one", file=first.files[-1]
            )
        lost = max(len(one) for one in times) - len(common)
        notes.append(f"{lost} row(s) that only some of {', '.join(log.name for log in logs)} have were left out")
        frames = [frame[np.isin(one, common, assume_unique=True)] for frame, one in zip(frames, times)]
    import pandas as pd

    parts = [
        frames[0].reset_index(drop=True),
        *(frame.drop(columns=index).reset_index(drop=True) for frame in frames[1:]),
    ]
    units: dict[str, str] = {}
    header: Mapping[str, str] = {}
    for log in logs:
        units.update(log.units)
        header = {**log.header, **header}
    ends = [log.diverged_at for log in logs if log.diverged_at is not None]
    return replace(
        first,
        name=name,
        frame=pd.concat(parts, axis=1),
        units=units,
        files=tuple(file for log in logs for file in log.files),
        restarts=_distinct(one for log in logs for one in log.restarts),
        notes=tuple(dict.fromkeys(notes)),
        header=header,
        diverged_at=min(ends, default=None),
    )


def _distinct(restarts: Iterable[Restart]) -> tuple[Restart, ...]:
    """Restarts by their start; files of the same run tell the same restart."""
    found: dict[tuple[float, float], Restart] = {}
    for restart in restarts:
        found.setdefault((restart.start, restart.previous_end), restart)
    return tuple(sorted(found.values(), key=lambda restart: restart.start))
