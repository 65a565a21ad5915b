"""A log that its solver still writes, read again from where it stopped."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from .log_dialects import layout_from, read_head
from .log_files import runs_at
from .log_layout import LogLayout
from .log_rows import Reading, row_blocks
from .log_series import as_frame
from .log_stream import wanted_columns
from .run_order import in_run_order
from .solver_log import EmptyLogError, Restart

if TYPE_CHECKING:
    import pandas as pd

_HEAD = 256


@dataclass
class _Place:
    """How far a file was read."""

    layout: LogLayout
    head: bytes
    end: int
    first: float = np.inf


class GrowingLog:
    """Rows of a history as they are written.

    Parameters
    ----------
    path : str or Path
        A file, or ``postProcessing/<object>/<file>`` for that file in all start times of the object, also in those
        that do not exist yet.
    columns : iterable of str, optional
        Columns besides the time; default all.

    Attributes
    ----------
    names : list of str
        Columns, the time (or iteration) first; empty as long as there is no row.
    restarts : list of Restart
        Places where the time went back. The rows that were handed out at and behind ``start`` are replaced by those
        that come now.
    """

    def __init__(self, path: str | Path, *, columns: Iterable[str] | None = None) -> None:
        self.path = Path(path)
        self.names: list[str] = []
        self.restarts: list[Restart] = []
        self._columns = None if columns is None else tuple(columns)
        self._places: dict[Path, _Place] = {}
        self._last = -np.inf

    def read(self) -> pd.DataFrame:
        """Rows that were finished since the last call; empty if there are none.

        A last line without a line end is left for the next call. Rows are handed out in the order of writing: when a
        run is restarted, they go back to an earlier time, which is told in `restarts`. A printed ``nan`` is NaN.

        Raises
        ------
        ReadError
            If the path does not exist, is of an unknown form, or too many lines are broken.
        """
        blocks = []
        begun = {path: place for path in runs_at(self.path) if (place := self._place(path)) is not None}
        for path, _ in in_run_order([(path, place.layout) for path, place in begun.items()])[0]:
            place = begun[path]
            places, names = wanted_columns(place.layout, self._columns)
            if self.names and names != self.names:
                raise ReadError(
                    "the columns are not those of the run before", cure="read the runs one by one", file=path
                )
            self.names = names
            reading = Reading()
            for block in row_blocks(path, place.layout, places, reading, begin=place.end, half_lines=True):
                block = block[:, np.isfinite(block[0])]
                block[1:][np.isinf(block[1:])] = np.nan
                if block.shape[1]:
                    self._note_restarts(path, block[0])
                    blocks.append(block)
            place.end = reading.end
        width = max(1, len(self.names))
        values = np.concatenate(blocks, axis=1) if blocks else np.empty((width, 0))
        return as_frame(values, self.names or ["time"])

    def _place(self, path: Path) -> _Place | None:
        """Where to go on in a file; None if it has no rows yet."""
        place = self._places.get(path)
        with open(path, "rb") as file:
            head = file.read(_HEAD)
            size = file.seek(0, 2)
        if place is not None and (size < place.end or not head.startswith(place.head)):
            # The file was written anew.
            place = None
        if place is None:
            try:
                # A last line without a line end may be half of a header or of a row.
                layout = layout_from(read_head(path).rpartition(b"\n")[0] + b"\n", path)
            except EmptyLogError:
                return None
            place = _Place(layout, head, layout.first_byte)
            self._places[path] = place
        return place

    def _note_restarts(self, path: Path, at: np.ndarray) -> None:
        steps = np.diff(at, prepend=self._last)
        ends = np.append(self._last, at[:-1])
        for row in np.flatnonzero(steps < 0):
            self.restarts.append(Restart(path, float(at[row]), float(ends[row]), 0))
        self._last = float(at[-1])
