"""Forces whose components stand in several monitors, one file each, as one history."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from ..core.errors import ReadError
from .channels import Channel, ChannelMap
from .log_channels import through_channels
from .log_series import merged
from .part_sums import with_totals
from .solver_log import SolverLog
from .units import convertible

FORCES = "forces"
"""Name of the history that the monitors are joined into."""

_PARTS = {"shear": "viscous", "friction": "viscous", "pressure": "pressure", "viscous": "viscous"}
_PART = "total|pressure|shear|viscous|friction"
_NAME = re.compile(
    rf"(?:(?P<before>{_PART})[ _-]+)?(?P<letter>force|moment|f|m)[ _-]?(?P<axis>[xyz])(?:[ _-]+(?P<behind>{_PART}))?",
    re.IGNORECASE,
)
_COUNTERS = {"time", "iteration", "time_step"}
_SAME_TIME = 1e-6
"""Share of a step by which the printed times of one row may differ between files."""


def names_of_forces(logs: Iterable[SolverLog]) -> dict[str, tuple[SolverLog, str]]:
    """Monitors whose own name and unit say which force they are.

    ``Force X (N)``, ``Fx (kN)``, ``Moment Z (N-m)``, ``Force X Pressure (N)``, ``Shear Force X (N)``. A column without
    a unit, or with one of another dimension, is not taken.

    Returns
    -------
    dict of str to (SolverLog, str)
        ``{"Fx_total": (log, "Force X")}``; a force that two monitors claim is left out, to be named by the user.
    """
    found: dict[str, list[tuple[SolverLog, str]]] = {}
    for log in logs:
        if log.kind != "monitor":
            continue
        for column in map(str, log.frame.columns[1:]):
            force = _force_of(column, log.units.get(column, ""))
            if force:
                found.setdefault(force, []).append((log, column))
    return {force: claims[0] for force, claims in found.items() if len(claims) == 1}


def _force_of(column: str, unit: str) -> str:
    """``Fx_total`` and so on of a column; empty if its name or unit does not say so."""
    match = _NAME.fullmatch(column.strip())
    if match is None or not unit.strip() or (match["before"] and match["behind"]):
        return ""
    letter = match["letter"][0].upper()
    try:
        factor = convertible(unit, "force" if letter == "F" else "moment")
    except ReadError:
        return ""
    part = (match["before"] or match["behind"] or "total").lower()
    return f"{letter}{match['axis'].lower()}_{_PARTS.get(part, 'total')}" if factor is not None else ""


def with_named_forces(logs: Mapping[str, SolverLog]) -> dict[str, SolverLog]:
    """The histories of a folder of monitors, those that name themselves a force joined into one of forces."""
    named = names_of_forces(logs.values())
    if not named or any(log.kind == "forces" for log in logs.values()):
        return dict(logs)
    told = ", ".join(f"{force} from {column} of {log.files[-1].name}" for force, (log, column) in named.items())
    note = f"forces by the names of the monitors: {told}; a channel map says otherwise"
    channels = {force: (log, Channel(column=column)) for force, (log, column) in named.items()}
    return _joined(logs, channels, (note,))


def joined_by_map(logs: Mapping[str, SolverLog], channels: ChannelMap, folder: Path) -> dict[str, SolverLog]:
    """The histories of a folder, the mapped columns of several files joined into one of forces.

    Parameters
    ----------
    logs : mapping of str to SolverLog
        Monitor files as read, by name.
    channels : ChannelMap
        A column is named as its file names it; the name of a file of one monitor stands for that monitor.
    folder : Path
        Named in errors.

    Raises
    ------
    ReadError
        If a column is in no file or in several, has no unit or one of the wrong dimension, or the files do not share
        their times.
    """
    wanted = {name: one for name, one in channels.channels.items() if name not in _COUNTERS}
    if channels.crosstalk is not None or channels.forces != "model-fixed":
        raise ReadError(
            "cross-talk and carriage axes cannot be applied to columns of several files",
            cure="export the monitors into one file",
            file=folder,
        )
    return _joined(logs, {name: _place(name, one, logs, folder) for name, one in wanted.items()}, ())


def holds_all(log: SolverLog, channels: ChannelMap) -> bool:
    """Whether one file has every mapped column."""
    columns = [one.column for one in channels.channels.values()]
    have = {*map(str, log.frame.columns), *_COUNTERS}
    printed = {channels.channels[name].column for name in _COUNTERS if name in channels.channels}
    return all(isinstance(column, int) or column in have | printed for column in columns)


def _place(name: str, channel: Channel, logs: Mapping[str, SolverLog], folder: Path) -> tuple[SolverLog, Channel]:
    """The file that a mapped column stands in."""
    column = str(channel.column)
    if column in logs and len(_histories(logs[column])) == 1:
        return logs[column], channel.model_copy(update={"column": _histories(logs[column])[0]})
    holders = [log for log in logs.values() if column in log.frame]
    if len(holders) == 1:
        return holders[0], channel
    if holders:
        raise ReadError(
            f"the column '{column}' stands in {len(holders)} files",
            cure=f"name the file instead: {', '.join(log.name for log in holders)}",
            file=folder,
            place=f"channel {name}",
        )
    have = [f"{one} ({log.files[-1].name})" for log in logs.values() for one in _histories(log)]
    raise ReadError(
        f"no file has the column '{column}'",
        cure=f"the folder has {', '.join(have[:12]) or 'no monitors'}",
        file=folder,
        place=f"channel {name}",
    )


def _histories(log: SolverLog) -> list[str]:
    """Columns that are no count of time or iterations."""
    return [str(name) for name in log.frame.columns if name not in _COUNTERS]


def _joined(
    logs: Mapping[str, SolverLog], channels: Mapping[str, tuple[SolverLog, Channel]], notes: tuple[str, ...]
) -> dict[str, SolverLog]:
    """The logs with the mapped columns taken out of them into one history of forces."""
    keys = {id(log): key for key, log in logs.items()}
    sources = {keys[id(log)]: log for log, _ in channels.values()}
    used = {
        key: {str(one.column) for log, one in channels.values() if log is source}
        for key, source in sources.items()
    }
    whole = [key for key, source in sources.items() if used[key] == set(_histories(source))]
    pieces = []
    for source in sources.values():
        mine = ChannelMap.model_validate({name: one for name, (log, one) in channels.items() if log is source})
        pieces.append(through_channels(source, mine, tuple(map(str, source.frame.columns))))
    left = {key: log for key, log in logs.items() if key not in whole}
    name = whole[0] if len(sources) == 1 and whole else FORCES if FORCES not in left else f"joined {FORCES}"
    joined = merged(_on_common_rows(pieces), name) if len(pieces) > 1 else replace(pieces[0], name=name)
    order = [str(joined.frame.columns[0]), *channels]
    joined = replace(joined, frame=joined.frame[order], notes=(*notes, *joined.notes))
    return left | {name: with_totals(joined)}


def _on_common_rows(logs: Sequence[SolverLog]) -> list[SolverLog]:
    """Monitors of one run at the rows that all of them have.

    Raises
    ------
    ReadError
        If they count differently, overlap nowhere, or have other times where they overlap.
    """
    first = logs[0]
    for other in logs[1:]:
        if other.index_name != first.index_name:
            raise ReadError(
                f"'{first.name}' counts {_counted(first)} and '{other.name}' {_counted(other)}",
                cure="export all monitors of a case over the same axis, or read the files one by one",
                file=other.files[-1],
            )
    times = [log.frame.iloc[:, 0].to_numpy() for log in logs]
    begin, end = max(at[0] for at in times), min(at[-1] for at in times)
    step = _SAME_TIME * min((log.dt for log in logs if np.isfinite(log.dt)), default=1.0)
    kept = [(at >= begin - step) & (at <= end + step) for at in times]
    common = times[0][kept[0]]
    for log, at, inside in zip(logs[1:], times[1:], kept[1:]):
        here = at[inside]
        if not common.size or len(here) != len(common) or np.abs(here - common).max() > step:
            raise ReadError(
                f"'{first.name}' (steps of {first.dt:.6g}) and '{log.name}' (steps of {log.dt:.6g}) have other "
                f"{'times' if first.index_name == 'time' else 'iterations'}",
                cure="export all monitors of a case at the same steps and from the same run",
                file=log.files[-1],
            )
    lost = max(len(at) for at in times) - len(common)
    said = (f"{lost} row(s) that only some of {', '.join(log.name for log in logs)} have were left out",)
    result = []
    for log, inside in zip(logs, kept):
        frame = log.frame[inside].reset_index(drop=True)
        frame.isetitem(0, common)
        result.append(replace(log, frame=frame, notes=(*log.notes, *(said if lost else ()))))
    return result


def _counted(log: SolverLog) -> str:
    return "time" if log.index_name == "time" else "iterations"
