"""The files of one history: one, or one for each run of an OpenFOAM case."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import ReadError
from .divergence import DivergenceWatch
from .log_blocks import LogBlocks, read_block_series
from .log_dialects import layout_of
from .log_layout import LogLayout
from .log_series import as_frame
from .log_stream import LogStream, Selection
from .openfoam_case import run_files
from .run_order import in_run_order
from .solver_log import EmptyLogError

if TYPE_CHECKING:
    import pandas as pd


def runs_at(path: Path) -> list[Path]:
    """Files of the history at `path`, oldest run first.

    ``postProcessing/forces/force.dat`` stands for ``force.dat`` in all start times of the function object.

    Raises
    ------
    ReadError
        If there is no such file.
    """
    if path.is_file():
        return [path]
    if path.parent.is_dir():
        stems = run_files(path.parent).get(path.parent.name, {})
        files = stems.get(path.name.removesuffix(".dat"))
        if files:
            return files
    raise ReadError(
        "there is no such file, in the folder or in folders of start times below it",
        cure="check the path",
        file=path,
    )


def runs_with_layouts(path: Path) -> list[tuple[Path, LogLayout]]:
    """The same with the columns of each, the newest run last; runs that wrote no rows are left out if others did."""
    files = runs_at(path)
    found = []
    for file in files:
        try:
            found.append((file, layout_of(file)))
        except EmptyLogError:
            if len(files) == 1:
                raise
    if not found:
        raise EmptyLogError("none of the runs wrote rows", cure="repeat the run", file=path)
    return in_run_order(found)[0]


def read_log_blocks(
    path: str | Path,
    width: float,
    *,
    columns: Iterable[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
) -> LogBlocks:
    """Means, deviations and extremes of a long history over blocks of time, in bounded memory.

    Every row counts; what is lost is the resolution within a block, which the result states.

    Parameters
    ----------
    path : str or Path
        A file of any solver, or ``postProcessing/<object>/<file>`` for all runs of a function object.
    width : float
        Length of a block, in the unit of the time (or in iterations).
    columns : iterable of str, optional
        Columns besides the time; default all.
    start, stop : float, optional
        Range of the time.

    Raises
    ------
    ReadError
        If the file cannot be read, holds no rows, or `width` is not positive.
    """
    path = Path(path)
    selection = Selection(None if columns is None else tuple(columns), start, stop)
    return read_block_series(runs_with_layouts(path), path.stem, width, selection)


def iter_solver_log(
    path: str | Path,
    *,
    columns: Iterable[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
) -> Iterator[pd.DataFrame]:
    """Rows of a long history at full resolution, some megabytes at a time.

    The files are looked through once before, so that the rows of restarted runs are joined as they should be.

    Parameters
    ----------
    path, columns, start, stop
        As for :func:`read_log_blocks`.

    Yields
    ------
    DataFrame
        The next rows; the time goes on from frame to frame. Rows behind a divergence come as NaN.

    Raises
    ------
    ReadError
        If the file cannot be read.
    """
    selection = Selection(None if columns is None else tuple(columns), start, stop)
    stream = LogStream(runs_with_layouts(Path(path)), selection)
    watch = DivergenceWatch(stream.names)
    for block in stream.blocks():
        watch.add(block)
        yield as_frame(block, stream.names)
