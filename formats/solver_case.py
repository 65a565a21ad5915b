"""All histories of a computation, whatever solver wrote them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.errors import ReadError
from .channels import ChannelMap
from .force_monitors import holds_all, joined_by_map, with_named_forces
from .log_blocks import read_block_series
from .log_channels import through_channels
from .log_dialects import layout_of
from .log_files import runs_at
from .log_layout import LogLayout
from .log_series import merged, read_series
from .log_stream import Selection
from .openfoam_case import post_processing_folder, run_files
from .part_sums import missing_totals, with_totals
from .run_order import in_run_order
from .solver_log import EmptyLogError, SolverCase, SolverLog

_ENDINGS = {".csv", ".out", ".frp", ".dat", ".txt", ".tsv", ".plt"}


def read_solver_case(
    path: str | Path,
    *,
    objects: Iterable[str] | None = None,
    columns: Iterable[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
    block: float | None = None,
    channels: ChannelMap | Mapping[str, Any] | None = None,
) -> SolverCase:
    """Read the histories of a computation.

    Parameters
    ----------
    path : str or Path
        An OpenFOAM case, its ``postProcessing`` folder, one function object of it, a folder of monitor files, or one
        file.
    objects : iterable of str, optional
        Names of the function objects or files to read; default all.
    columns : iterable of str, optional
        Columns to read where they are; default all.
    start, stop : float, optional
        Range of the time (or iteration).
    block : float, optional
        Take means over blocks of this length, in the unit of the time: for histories that do not fit into memory.
        Each history says so in its notes. Default: every row.
    channels : ChannelMap or mapping, optional
        Columns of monitor files by name, with units and signs, in SI. Names such as ``Fx_total`` make a history of
        forces of it; columns that stand in several files of a folder are joined. Without a map, monitors whose own
        name and unit say what they are (``Force X (N)``, ``Moment Z (N-m)``) become the forces, and a note says so.

    Returns
    -------
    SolverCase
        Forces in the solver's own axes and units: incompressible OpenFOAM solvers may print force / density.

    Raises
    ------
    ReadError
        If there is nothing to read, an object is not there, or a file that is asked for by name cannot be read. In
        a folder, files that cannot be read are passed over and told in the notes, unless `objects` names them.
    """
    path = Path(path)
    selection = Selection(None if columns is None else tuple(columns), start, stop, block)
    mapped = ChannelMap.model_validate(channels) if channels is not None else None
    if not path.is_dir():
        log = _log(path, selection, mapped)
        logs = {log.name: log} if mapped is not None else with_named_forces({log.name: log})
        return SolverCase(path.stem, path.parent, logs)
    wanted = None if objects is None else tuple(objects)
    folder = post_processing_folder(path)
    if folder is not None and mapped is not None:
        raise ReadError(
            "a channel map is for monitor files; the columns of an OpenFOAM case have standard names",
            cure="leave the channels out, or name one file of the case",
            file=path,
        )
    logs, notes = (
        _openfoam_logs(folder, wanted, selection)
        if folder is not None
        else _monitor_logs(path, wanted, selection, mapped)
    )
    if not logs:
        raise ReadError(
            "holds no histories that can be read" + (f" ({notes[0]})" if notes else ""),
            cure="give an OpenFOAM case, its postProcessing folder, or a folder of monitor files",
            file=path,
        )
    whole = path.resolve()
    name = whole.parent.name if whole.name == "postProcessing" else whole.name
    return SolverCase(name, path, logs, tuple(notes))


def read_solver_log(
    path: str | Path,
    *,
    columns: Iterable[str] | None = None,
    start: float | None = None,
    stop: float | None = None,
    block: float | None = None,
    channels: ChannelMap | Mapping[str, Any] | None = None,
) -> SolverLog:
    """Read one history.

    Parameters
    ----------
    path : str or Path
        A file, or ``postProcessing/<object>/<file>`` for that file in all start times of an OpenFOAM object.
    columns, start, stop, block, channels
        As for :func:`read_solver_case`.

    Raises
    ------
    ReadError
        If the file is missing, empty, binary, of an unknown form, or holds no rows, or a column is not there.
    """
    selection = Selection(None if columns is None else tuple(columns), start, stop, block)
    return _log(Path(path), selection, ChannelMap.model_validate(channels) if channels is not None else None)


def _log(path: Path, selection: Selection, channels: ChannelMap | None) -> SolverLog:
    files, notes = _layouts(runs_at(path), path.parent, _index_column(channels))
    log = _history(files, path.stem, selection, channels)
    return replace(log, notes=(*log.notes, *notes))


def _history(
    files: list[tuple[Path, LogLayout]], name: str, selection: Selection, channels: ChannelMap | None = None
) -> SolverLog:
    """One history, forces with their totals."""
    layout = files[-1][1]
    # With a channel map, columns are named after it; it chooses them itself.
    wanted = None if channels is not None else selection.columns
    if wanted is not None and layout.kind == "forces":
        totals = missing_totals(layout.names)
        wanted = tuple(dict.fromkeys(part for name in wanted for part in totals.get(name, [name])))
    selection = replace(selection, columns=wanted)
    if selection.block is None:
        log = read_series(files, name, selection)
    else:
        log = read_block_series(files, name, selection.block, selection).log
    if channels is not None:
        log = through_channels(log, channels, layout.names)
    return with_totals(log)


def _openfoam_logs(
    folder: Path, wanted: tuple[str, ...] | None, selection: Selection
) -> tuple[dict[str, SolverLog], list[str]]:
    objects = run_files(folder)
    logs: dict[str, SolverLog] = {}
    notes: list[str] = []
    for name in _chosen(wanted, objects, folder):
        series: dict[str, SolverLog] = {}
        for stem, files in objects[name].items():
            with _passed_over(notes, f"{name}/{stem}", strict=wanted is not None):
                layouts, said = _layouts(files, folder)
                log = _history(layouts, stem, _present(selection, layouts[-1][1]))
                series[stem] = replace(log, notes=(*log.notes, *said))
        pair = [series.pop(stem) for stem in ("force", "moment") if stem in series]
        if pair:
            log = merged(pair, name)
            if len(pair) == 1:
                lacking = "moments" if pair[0].name == "force" else "forces"
                log = replace(log, notes=(*log.notes, f"there is no file of {lacking}"))
            logs[name] = log
        for stem, log in series.items():
            single = len(series) == 1 and not pair and log.kind != "probes"
            key = name if single else f"{name}/{stem}"
            logs[key] = replace(log, name=key)
    return logs, notes


def _monitor_logs(
    folder: Path, wanted: tuple[str, ...] | None, selection: Selection, channels: ChannelMap | None
) -> tuple[dict[str, SolverLog], list[str]]:
    files = {
        file.stem: file for file in sorted(folder.iterdir()) if file.is_file() and file.suffix.lower() in _ENDINGS
    }
    logs: dict[str, SolverLog] = {}
    notes: list[str] = []
    layouts: dict[str, list[tuple[Path, LogLayout]]] = {}
    for name in _chosen(wanted, files, folder):
        with _passed_over(notes, files[name].name, strict=wanted is not None):
            layouts[name], _ = _layouts([files[name]], folder, _index_column(channels))
            logs[name] = _history(layouts[name], name, _present(selection, layouts[name][-1][1]))
    if channels is None:
        return with_named_forces(logs), notes
    whole = [name for name, log in logs.items() if holds_all(log, channels)]
    if not whole and logs:
        return joined_by_map(logs, channels, folder), notes
    for name in whole:
        logs[name] = _history(layouts[name], name, selection, channels)
    return logs, notes


def _chosen(wanted: tuple[str, ...] | None, have: Iterable[str], folder: Path) -> list[str]:
    names = list(have)
    if wanted is None:
        return names
    asked = {name if name in names else name.rpartition("/")[0] for name in wanted}
    strangers = sorted(asked - set(names))
    if strangers:
        raise ReadError(
            f"there is no object '{strangers[0] or wanted[0]}'",
            cure=f"the case has {', '.join(names) or 'none'}",
            file=folder,
        )
    return [name for name in names if name in asked]


@contextmanager
def _passed_over(notes: list[str], name: str, *, strict: bool) -> Iterator[None]:
    """Note a history that cannot be read; raise if it was asked for by name."""
    try:
        yield
    except ReadError as error:
        if strict:
            raise
        notes.append(f"{name}: not read, {error.cause}")


def _layouts(
    files: list[Path], folder: Path, index: str | int | None = None
) -> tuple[list[tuple[Path, LogLayout]], list[str]]:
    """Layouts of the runs that wrote rows, the newest last, and notes on the order and on each that did not."""
    found = []
    notes = []
    for file in files:
        try:
            found.append((file, layout_of(file, index)))
        except EmptyLogError as error:
            notes.append(f"{file.relative_to(folder).as_posix()}: {error.cause}")
            if file == files[-1] and not found:
                raise
    ordered, said = in_run_order(found)
    return ordered, [*notes, *said]


def _present(selection: Selection, layout: LogLayout) -> Selection:
    """The selection with the columns that this history has; all of them if it has none of those asked for."""
    if selection.columns is None:
        return selection
    have = {*layout.names, *missing_totals(layout.names)}
    return replace(selection, columns=tuple(name for name in selection.columns if name in have) or None)


def _index_column(channels: ChannelMap | None) -> str | int | None:
    """Column that the channel map says is the time or the count of iterations."""
    if channels is None:
        return None
    mapped = channels.channels
    channel = mapped.get("time") or mapped.get("iteration")
    return channel.column if channel is not None else None
