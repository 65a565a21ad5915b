"""From the ``[[runs]]`` of a campaign file to runs in SI, radians and home signs."""

from __future__ import annotations

import csv
import glob
import math
import os
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.conventions import Conventions
from ..core.errors import CampaignError
from .campaign_file import RunGroup
from .run_types import ANGLES, RUN_PARAMETERS, Run, run_type

_ALIASES = {
    "frequency_hz": ("frequency", 2 * math.pi),
    "beta": ("drift_angle", 1.0),
    "delta": ("rudder_angle", 1.0),
    "phi": ("heel", 1.0),
    "r": ("yaw_rate", 1.0),
    "U": ("speed", 1.0),
    "eta": ("bank_position", 1.0),
}


def expand_runs(groups: list[RunGroup], folder: Path, conventions: Conventions, file: Path) -> list[Run]:
    """Every run of a campaign, in the order of the file.

    Parameters
    ----------
    groups : list of RunGroup
    folder : Path
        Folder that relative names start from.
    conventions : Conventions
        Give the unit of angles and the signs of drift and rudder in the test matrix.
    file : Path
        The campaign file, for messages.

    Raises
    ------
    CampaignError
        For a file that is missing, a parameter that is missing or unknown, or two runs of one name.
    """
    runs: list[Run] = []
    for number, group in enumerate(groups, start=1):
        place = f"runs[{number}]"
        if (group.files is None) == (group.matrix is None):
            raise CampaignError(
                "files and matrix are both given" if group.matrix else "neither files nor matrix is given",
                cure="give one of them",
                file=file,
                place=place,
            )
        rows = matrix_rows(group, folder, file, place) if group.matrix else _file_rows(group, folder, file, place)
        if not rows:
            raise CampaignError(
                f"test matrix '{group.matrix}' has no rows", cure="add one row a run", file=file, place=place
            )
        for row in rows:
            runs.append(make_run(row, group, folder, conventions, file, place))
    names: dict[str, int] = {}
    for run in runs:
        names[run.name] = names.get(run.name, 0) + 1
    for position, run in enumerate(runs):
        if names[run.name] > 1:
            if run.file is None or sum(other.file == run.file for other in runs) > 1:
                raise CampaignError(f"two runs are called '{run.name}'", cure="name each run once", file=file)
            runs[position] = replace(run, name=Path(os.path.relpath(run.file, folder)).as_posix())
    return runs


def matrix_rows(group: RunGroup, folder: Path, file: Path, place: str) -> list[dict[str, Any]]:
    """Rows of the test matrix of a group as mappings without blank cells; ``_place`` says where each stands.

    Raises
    ------
    CampaignError
        When the table is missing or not a test matrix.
    """
    import pandas as pd

    path = folder / str(group.matrix)
    try:
        frame = pd.read_csv(path, sep=None, engine="python", comment="#", skipinitialspace=True)
    except OSError as error:
        raise CampaignError(
            f"test matrix '{group.matrix}' cannot be read ({error.strerror})",
            cure="name a table; names start at the folder of the campaign file",
            file=file,
            place=place,
        ) from None
    except (ValueError, csv.Error) as error:
        raise CampaignError(
            f"test matrix '{group.matrix}' is not a table: {error}",
            cure="write a CSV file with a row of names and one row a run",
            file=file,
            place=place,
        ) from None
    frame.columns = [str(column).strip() for column in frame.columns]
    if "file" not in frame and "name" not in frame:
        raise CampaignError(
            f"test matrix '{group.matrix}' has no column 'file'",
            cure=f"it has {', '.join(frame.columns)}",
            file=file,
            place=place,
        )
    shared = dict(group.model_extra or {})
    rows = []
    for position, record in enumerate(frame.to_dict("records"), start=2):
        row = shared | {str(key): value for key, value in record.items() if not _blank(value)}
        row["_place"] = f"{group.matrix}, row {position}"
        rows.append(row)
    return rows


def _blank(value: Any) -> bool:
    return value is None or (isinstance(value, float) and math.isnan(value))


def _file_rows(group: RunGroup, folder: Path, file: Path, place: str) -> list[dict[str, Any]]:
    names: list[str] = []
    for pattern in [group.files] if isinstance(group.files, str) else group.files or []:
        found = sorted(glob.glob(pattern, root_dir=folder), key=_natural)
        if not found:
            raise CampaignError(
                f"no file matches '{pattern}'", cure=f"look in {folder}", file=file, place=f"{place}.files"
            )
        names += [name for name in found if name not in names]
    extra = dict(group.model_extra or {})
    rows = []
    for position, name in enumerate(names):
        row: dict[str, Any] = {"file": name, "_place": place}
        for key, value in extra.items():
            if isinstance(value, list):
                if len(value) != len(names):
                    raise CampaignError(
                        f"{key} has {len(value)} values for {len(names)} files",
                        cure="give one value a file, in the order of the sorted names",
                        file=file,
                        place=f"{place}.{key}",
                    )
                value = value[position]
            row[key] = value
        row |= _from_name(group.pattern, name, file, place)
        rows.append(row)
    return rows


def _from_name(pattern: str | None, name: str, file: Path, place: str) -> dict[str, Any]:
    if pattern is None:
        return {}
    try:
        match = re.search(pattern, name)
    except re.error as error:
        raise CampaignError(
            f"not a regular expression: {error}", cure="mend it", file=file, place=f"{place}.pattern"
        ) from None
    if match is None:
        raise CampaignError(
            f"the pattern does not match '{name}'",
            cure="mend it, or name fewer files",
            file=file,
            place=f"{place}.pattern",
        )
    return {key: value for key, value in match.groupdict().items() if value is not None}


def _natural(name: str) -> list[Any]:
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def make_run(
    row: dict[str, Any], group: RunGroup, folder: Path, conventions: Conventions, file: Path, place: str
) -> Run:
    """Run of one row, in SI, radians and home signs.

    Raises
    ------
    CampaignError
        For an unknown type or parameter, or a missing one, with its row.
    """
    where = str(row.pop("_place", place))
    kind = str(row.pop("type", group.type) or "")
    source = row.pop("file", None)
    name = str(row.pop("name", "") or (Path(str(source)).stem if source else ""))
    if not kind:
        raise CampaignError(
            "the run has no type", cure="add type = ...", file=file, place=f"{where}, run '{name}'"
        )
    try:
        required = run_type(kind).required
    except CampaignError as error:
        raise CampaignError(error.cause, cure=error.cure, file=file, place=f"{where}, run '{name}'") from None
    values: dict[str, Any] = {"tare": group.tare, "series": group.series}
    for key, value in row.items():
        key, factor = _ALIASES.get(key, (key, 1.0))
        if key == "period":
            key, value = "frequency", 2 * math.pi / (_number(value, "period", file, where) or math.inf)
        if key not in RUN_PARAMETERS:
            raise CampaignError(
                f"'{key}' is not a parameter of a run",
                cure=f"parameters are {', '.join(RUN_PARAMETERS)}",
                file=file,
                place=f"{where}, run '{name}'",
            )
        values[key] = str(value) if key in ("tare", "series") else factor * _number(value, key, file, where)
    missing = [key for key in required if key not in values]
    if missing:
        raise CampaignError(
            f"a {kind} run needs '{missing[0]}'",
            cure="add it to the group or the matrix",
            file=file,
            place=f"{where}, run '{name}'",
        )
    if conventions.angle_unit == "deg":
        values |= {key: math.radians(values[key]) for key in ANGLES if key in values}
    if conventions.drift_sign == "+v" and "drift_angle" in values:
        values["drift_angle"] = -values["drift_angle"]
    if conventions.rudder_sign == "port" and "rudder_angle" in values:
        values["rudder_angle"] = -values["rudder_angle"]
    if conventions.axes == "forward-port-up":
        for key in ("drift_angle", "yaw_rate", "sway_amplitude", "yaw_amplitude"):
            if key in values:
                values[key] = -values[key]
    path = folder / str(source) if source else None
    if path is not None and not path.is_file():
        raise CampaignError(
            f"run file '{source}' not found", cure=f"mend the name; look in {folder}", file=file, place=where
        )
    try:
        return Run(name=name, kind=kind, file=path, **values)
    except CampaignError as error:
        cure = error.cure or "correct the group or the matrix"
        raise CampaignError(error.cause, cure=cure, file=file, place=f"{where}, {error.place}") from None


def _number(value: Any, key: str, file: Path, place: str) -> float:
    try:
        number = float(value)
    except (TypeError, ValueError):
        raise CampaignError(
            f"{key} = '{value}' is not a number", cure="give one number a run", file=file, place=place
        ) from None
    if not math.isfinite(number):
        raise CampaignError(f"{key} = {number} is not finite", cure="give a number", file=file, place=place)
    return number
