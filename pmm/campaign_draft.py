"""A first campaign file from a folder of run files: what the files say, filled in; the rest marked to be completed."""

from __future__ import annotations

import csv
import io
import json
import os
import re
from collections.abc import Sequence
from functools import partial
from pathlib import Path

from ..core.errors import CampaignError, TowtankError
from ..formats.raw_table import RawTable
from ..formats.read import FORMATS, read_table
from ..formats.write import atomic_path

_GUESSES = (
    # standard name, pattern of the printed name in any case; a force letter is told from a coordinate by its case
    ("time", r"(time|zeit|t)\b.*"),
    ("X", r"f_?x|x_?force|force_?x|surge_?force|fx_?tot.*|(?-i:X)"),
    ("Y", r"f_?y|y_?force|force_?y|sway_?force|fy_?tot.*|(?-i:Y)"),
    ("N", r"m_?z|n|n_?moment|yaw_?moment|moment_?z|mz_?tot.*"),
    ("K", r"m_?x|k|k_?moment|roll_?moment|moment_?x|mx_?tot.*"),
    ("psi", r"psi|heading|yaw|yaw_?angle"),
    ("y", r"y_?pos.*|sway|y_?carriage|(?-i:y)"),
    ("x", r"x_?pos.*|x_?carriage|(?-i:x)"),
    ("u", r"u|surge_?vel.*"),
    ("v", r"v|sway_?vel.*"),
    ("r", r"r|yaw_?rate|psi_?dot"),
    ("speed", r"speed|v_?carriage|carriage_?speed|u_?carriage"),
    ("rudder_angle", r"delta|rudder|rudder_?angle"),
)

_ENDINGS = frozenset(ending for one in FORMATS.values() for ending in one.endings)


def draft_campaign(folder: Path, target: Path, *, replace: bool = False) -> str:
    """Write a campaign file and a test matrix to be completed.

    Parameters
    ----------
    folder : Path
        Folder with run files.
    target : Path
        Campaign file to write; ``matrix.csv`` is written beside it.
    replace : bool
        Overwrite existing files.

    Returns
    -------
    str
        What was found and what is left to do.

    Raises
    ------
    CampaignError
        When there is no readable run file, or a file would be overwritten.
    """
    if not folder.is_dir():
        raise CampaignError("this is not a folder", cure="name a folder with run files", file=folder)
    matrix = target.with_name("matrix.csv")
    for path in (target, matrix):
        if path.exists() and not replace:
            raise CampaignError("the file exists", cure="choose another --out or add --force", file=path)
    files = sorted(
        path for path in folder.iterdir() if path.suffix.lower() in _ENDINGS and path != matrix and path.is_file()
    )
    table, unread = _first_table(files)
    if table is None:
        reason = f" ({unread[0]})" if unread else ""
        raise CampaignError(
            f"no run file could be read{reason}",
            cure=f"put files of {', '.join(sorted(_ENDINGS))} there",
            file=folder,
        )
    mapped = _guess_channels(table)
    base = target.parent
    names = [Path(os.path.relpath(path, base)) for path in files]
    with atomic_path(matrix) as rows, atomic_path(target) as text:
        rows.write_text(_matrix_text(names), encoding="utf-8")
        text.write_text(_campaign_text(folder, table, mapped, matrix.name), encoding="utf-8")
    columns = ", ".join(f"{name} [{table.units.get(name) or '?'}]" for name in table.columns)
    return "\n".join(
        [
            f"{len(files)} files; columns: {columns}",
            *(f"not readable: {reason}" for reason in unread),
            f"mapped: {', '.join(f'{ours} = {theirs}' for ours, theirs in mapped.items()) or 'none'}",
            f"written: {target} and {matrix}",
            f"next: complete [ship] in {target.name} and the columns of {matrix.name}, then: towtank run {target}",
        ]
    )


def _first_table(files: Sequence[Path]) -> tuple[RawTable | None, list[str]]:
    unread: list[str] = []
    for path in files:
        try:
            return read_table(path), unread
        except TowtankError as error:
            unread.append(str(error))
    return None, unread


def _guess_channels(table: RawTable) -> dict[str, str]:
    mapped: dict[str, str] = {}
    for standard, pattern in _GUESSES:
        for column in table.columns:
            name = column.strip().replace(" ", "_")
            if column not in mapped.values() and re.fullmatch(pattern, name, re.IGNORECASE):
                mapped.setdefault(standard, column)
    return mapped


def _matrix_text(names: Sequence[Path]) -> str:
    head = (
        "# type: static_drift, static_rudder, drift_rudder, pure_sway, pure_yaw, yaw_drift, sway_yaw, pure_surge,\n"
        "#   steady_yaw, steady_yaw_drift, static_heel; speed m/s, angles deg, amplitudes m, frequency_hz Hz\n"
        "file,type,speed,drift_angle,yaw_rate,frequency_hz,sway_amplitude,rudder_angle,heel\n"
    )
    text = io.StringIO(head)
    text.seek(0, io.SEEK_END)
    csv.writer(text, lineterminator="\n").writerows([name.as_posix(), *[""] * 8] for name in names)
    return text.getvalue()


def _campaign_text(folder: Path, table: RawTable, mapped: dict[str, str], matrix: str) -> str:
    # A JSON text is a TOML text.
    quoted = partial(json.dumps, ensure_ascii=False)
    lines = [
        "[campaign]",
        f"name = {quoted(folder.resolve().name)}",
        "",
        "[ship]                       # particulars of the model in SI: complete these",
        f"name = {quoted(folder.resolve().name)}",
        "L = nan                      # length between perpendiculars, m",
        "B = nan                      # breadth, m",
        "T = nan                      # draught, m",
        "# volume = 0.0               # displaced volume, m3",
        "# xG = 0.0                   # centre of gravity forward of midship, m",
        "rho = 1000.0                 # water density, kg/m3",
        "scale = 1.0                  # 50 for a model 1:50",
        "",
        "[conventions]",
        'angle_unit = "deg"           # of the test matrix',
        'drift_sign = "-v"            # drift angle = atan(-v/u); "+v" when it is atan(v/u)',
        'rudder_sign = "starboard"    # positive rudder turns the ship to starboard; or "port"',
        'force_sign = "on-ship"       # or "by-ship"',
        "",
        "[channels]                   # standard name = column and unit; sign, gain, offset where needed",
    ]
    for ours, theirs in mapped.items():
        unit = table.units.get(theirs)
        note = "" if unit else "   # the file names no unit: check"
        lines.append(f"{ours} = {{ column = {quoted(theirs)}, unit = {quoted(unit or 'SI')} }}{note}")
    spare = [name for name in table.columns if name not in mapped.values()]
    if spare:
        lines.append(f"# not mapped: {' '.join(', '.join(spare).split())}")
    lines += [
        "",
        "[inertia]",
        "inside = false               # true when the balance carries the model's mass in oscillating runs",
        "# mass = 0.0                 # of all that hangs on the balance, kg",
        "# xG = 0.0",
        "# Izz = 0.0                  # about its centre of gravity, kg m2",
        "",
        "[[runs]]",
        f"matrix = {quoted(matrix)}",
        "",
        "[fit]",
        '# model = "mmg"            # the run types choose the terms when this is left out',
        "",
    ]
    return "\n".join(lines)
