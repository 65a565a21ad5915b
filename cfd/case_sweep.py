"""A folder of computations as one campaign table: which case is which motion on which grid."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.errors import CampaignError
from ..core.findings import Finding
from ..formats.openfoam_case import post_processing_folder

if TYPE_CHECKING:
    import pandas as pd

PARAMETERS = ("drift_angle", "yaw_rate", "speed", "grid", "time_step", "cells")
"""Parameters of a case: deg, r L / U, m/s, name of the grid, s, number of cells."""

TOKENS: dict[str, str] = {
    "beta": "drift_angle",
    "drift": "drift_angle",
    "r": "yaw_rate",
    "yaw": "yaw_rate",
    "U": "speed",
    "speed": "speed",
    "grid": "grid",
    "mesh": "grid",
    "dt": "time_step",
    "cells": "cells",
}
"""Words in folder names and what they mean; the number follows, as in ``beta_-4_grid2`` or ``r0.3_U1.2``."""

_NUMBER = r"[-+m]?\d+(?:[.p]\d+)?(?:e[-+]?\d+)?"
_WORDS = "|".join(sorted((word for word in TOKENS if TOKENS[word] != "grid"), key=len, reverse=True))
_TOKEN = re.compile(
    rf"(?<![A-Za-z])(?:(?P<word>{_WORDS})[_=]?(?P<number>{_NUMBER})(?=[_,; ]|$)"
    r"|(?:grid|mesh)[_=]?(?P<grid>[A-Za-z0-9]+))"
)
MONITOR_ENDINGS = {".csv", ".out", ".frp", ".dat", ".txt", ".tsv", ".plt"}


@dataclass(frozen=True)
class SweepCase:
    """One computation of a sweep.

    Attributes
    ----------
    name : str
    path : Path
    drift_angle : float
        beta = atan(-v/u) in deg; 0 when not named.
    yaw_rate : float
        r' = r L / U; 0 when not named.
    speed : float
        Speed in m/s; nan when not named.
    grid : str
        Name of the grid; empty when there is one.
    time_step : float
        s; nan when not named.
    cells : float
        Number of cells of the grid; nan when not known.
    """

    name: str
    path: Path
    drift_angle: float = 0.0
    yaw_rate: float = 0.0
    speed: float = math.nan
    grid: str = ""
    time_step: float = math.nan
    cells: float = math.nan

    @property
    def condition(self) -> tuple[float, float, float]:
        """Motion: drift angle, yaw rate and speed, rounded; speed 0 when not named."""
        speed = 0.0 if math.isnan(self.speed) else self.speed
        return round(self.drift_angle, 9) + 0.0, round(self.yaw_rate, 9) + 0.0, round(speed, 9)

    @property
    def place(self) -> tuple[Any, ...]:
        """Motion, grid and time step: what must be unique in a sweep."""
        return (*self.condition, self.grid, 0.0 if math.isnan(self.time_step) else self.time_step)


@dataclass(frozen=True)
class CaseSweep:
    """Cases of a sweep and what was noticed about them.

    Attributes
    ----------
    cases : tuple of SweepCase
    findings : tuple of Finding
        Rules ``double-case``, ``missing-case``, ``case-name``.
    """

    cases: tuple[SweepCase, ...]
    findings: tuple[Finding, ...] = ()

    @property
    def grids(self) -> tuple[str, ...]:
        """Names of the grids in the order of their names; numbers by size."""
        return tuple(sorted({case.grid for case in self.cases}, key=_natural))

    def to_frame(self) -> pd.DataFrame:
        """One row a case: name, parameters with their units, path."""
        import pandas as pd

        return pd.DataFrame(
            {
                "case": [case.name for case in self.cases],
                "drift angle [deg]": [case.drift_angle for case in self.cases],
                "yaw rate r' [-]": [case.yaw_rate for case in self.cases],
                "speed [m/s]": [case.speed for case in self.cases],
                "grid": [case.grid for case in self.cases],
                "cells": [case.cells for case in self.cases],
                "time step [s]": [case.time_step for case in self.cases],
            }
        )


def find_cases(
    paths: Sequence[str | Path],
    *,
    pattern: str | None = None,
    table: str | Path | None = None,
    cells: Mapping[str, float] | None = None,
) -> CaseSweep:
    """Cases of a sweep with the parameters of each.

    Parameters
    ----------
    paths : sequence of path
        Cases; or one folder whose subfolders are cases.
    pattern : str, optional
        Pattern of the names with parameters in braces, as ``"b{drift_angle}_{grid}"``; the words of :data:`TOKENS`
        are looked for when not given. ``m`` stands for minus and ``p`` for the decimal point.
    table : path, optional
        Table with a column ``case`` and columns named after :data:`PARAMETERS` (or the words of :data:`TOKENS`)
        instead of the names; rows whose case is not there are an error.
    cells : mapping of str to float, optional
        Number of cells of each grid.

    Returns
    -------
    CaseSweep

    Raises
    ------
    CampaignError
        For no case, a name that a pattern does not fit, or a table that does not fit the folders.
    """
    found = _folders(paths)
    if table is not None:
        cases = _from_table(found, Path(table))
    else:
        compiled = None if pattern is None else _compiled(pattern)
        cases = [SweepCase(path.name, path, **_from_name(path, compiled, pattern)) for path in found]
    if cells:
        strangers = [grid for grid in cells if grid not in {case.grid for case in cases}]
        if strangers:
            raise CampaignError(
                f"cells are given for grid '{strangers[0]}', which no case has",
                cure=f"grids are {', '.join(sorted({case.grid or '(unnamed)' for case in cases}, key=_natural))}",
            )
        cases = [replace(case, cells=float(cells.get(case.grid, case.cells))) for case in cases]
    cases.sort(key=lambda case: (_natural(case.grid), case.speed, case.yaw_rate, case.drift_angle, case.name))
    return CaseSweep(tuple(cases), tuple(sweep_findings(cases)))


def sweep_findings(cases: Sequence[SweepCase]) -> list[Finding]:
    """Double and missing cases: each motion must be there once on each grid.

    Parameters
    ----------
    cases : sequence of SweepCase
    """
    findings: list[Finding] = []
    seen: dict[tuple[Any, ...], SweepCase] = {}
    plain = len(cases) > 1 and all(case.place == SweepCase("", Path()).place for case in cases)
    if plain:
        return [
            Finding(
                "case-name",
                "warning",
                f"{len(cases)} cases have no parameters in their names",
                cure="name them as beta_-4_grid2, or give a pattern or a table",
            )
        ]
    for case in cases:
        if case.place in seen:
            findings.append(
                Finding(
                    "double-case",
                    "error",
                    f"the same motion on the same grid as '{seen[case.place].name}'",
                    file=str(case.path),
                    place=case.name,
                    cure="leave one out, or tell them apart in their names",
                )
            )
        seen.setdefault(case.place, case)
    grids = sorted({case.grid for case in cases}, key=_natural)
    for condition in sorted({case.condition for case in cases}):
        there = {case.grid for case in cases if case.condition == condition}
        for grid in grids:
            if grid not in there:
                beta, rate, speed = condition
                motion = f"beta {beta:g} deg, r' {rate:g}" + (f", {speed:g} m/s" if speed else "")
                findings.append(
                    Finding(
                        "missing-case",
                        "warning",
                        f"there is no case of {motion} on grid '{grid}'",
                        place=f"grid {grid}",
                        cure="run it, or leave the motion out on all grids",
                    )
                )
    return findings


def _folders(paths: Sequence[str | Path]) -> list[Path]:
    """Cases among the paths; a folder that is no case itself stands for its subfolders."""
    found: list[Path] = []
    for item in paths:
        path = Path(item)
        if not path.exists():
            raise CampaignError("there is no such file or folder", cure="check the path", file=path)
        found += _cases_in(path)
    if not found:
        raise CampaignError(
            "there is no case in it",
            cure="give case folders, or a folder that holds them",
            file=Path(paths[0]) if paths else None,
        )
    return found


def _cases_in(path: Path) -> list[Path]:
    """The path itself when it is a case, else the cases in it."""
    if path.is_file() or path.name == "postProcessing" or (path / "postProcessing").is_dir():
        return [path]
    inside = sorted(child for child in path.iterdir() if child.is_dir() and not child.name.startswith("."))
    cases = [child for child in inside if (child / "postProcessing").is_dir()]
    if cases:
        return cases
    # Monitor files beside each other are one case; folders of them are one case each.
    if any(_is_monitor(child) for child in path.iterdir()):
        return [path]
    cases = [child for child in inside if any(_is_monitor(file) for file in child.iterdir())]
    return cases or ([path] if post_processing_folder(path) is not None else [])


def _is_monitor(path: Path) -> bool:
    return path.is_file() and path.suffix.lower() in MONITOR_ENDINGS


def _from_name(path: Path, compiled: re.Pattern[str] | None, pattern: str | None) -> dict[str, Any]:
    name = path.stem if path.is_file() else path.name
    if compiled is None:
        found: dict[str, Any] = {}
        for token in _TOKEN.finditer(name):
            key = "grid" if token["grid"] else TOKENS[token["word"]]
            found[key] = token["grid"] or _value(key, token["number"])
        return found
    match = compiled.fullmatch(name)
    if match is None:
        raise CampaignError(
            f"the name '{name}' does not fit the pattern '{pattern}'",
            cure="rename the case, or change the pattern",
            file=path,
        )
    return {key: _value(key, text) for key, text in match.groupdict().items()}


def _compiled(pattern: str) -> re.Pattern[str]:
    """Regular expression of a pattern with names in braces."""
    pieces = re.split(r"\{(\w+)\}", pattern)
    text = ""
    for number, piece in enumerate(pieces):
        if number % 2 == 0:
            text += re.escape(piece)
            continue
        key = TOKENS.get(piece, piece)
        if key not in PARAMETERS:
            raise CampaignError(
                f"the pattern names an unknown parameter '{piece}'",
                cure=f"parameters are {', '.join(PARAMETERS)}",
            )
        if f"(?P<{key}>" in text:
            raise CampaignError(f"the pattern names '{piece}' twice", cure="name each parameter once")
        text += f"(?P<{key}>{'[^_]+' if key == 'grid' else _NUMBER})"
    if len(pieces) == 1:
        raise CampaignError(
            f"the pattern '{pattern}' names no parameter", cure="put one in braces: beta_{drift_angle}_grid{grid}"
        )
    return re.compile(text)


def _value(key: str, text: str) -> float | str:
    if key == "grid":
        return text
    return float(text.replace("m", "-", 1).replace("p", ".")) if "e" not in text else float(text)


def _from_table(found: Sequence[Path], table: Path) -> list[SweepCase]:
    import csv

    import pandas as pd

    try:
        frame = pd.read_csv(table, sep=None, engine="python", comment="#", skipinitialspace=True, dtype=str)
    except OSError as error:
        raise CampaignError(
            f"the table cannot be read ({error.strerror})", cure="check the path of --table", file=table
        ) from None
    except (ValueError, csv.Error) as error:
        raise CampaignError(
            f"this is no table: {error}",
            cure="write a CSV file with a row of names and one row a case",
            file=table,
        ) from None
    frame.columns = [TOKENS.get(str(name).strip(), str(name).strip()) for name in frame.columns]
    frame = frame.apply(lambda column: column.str.strip())
    if "case" not in frame.columns:
        raise CampaignError(
            "the table has no column 'case'", cure=f"it has {', '.join(map(str, frame.columns))}", file=table
        )
    known = [name for name in PARAMETERS if name in frame.columns]
    if not known:
        raise CampaignError("the table has no parameter", cure=f"columns are {', '.join(PARAMETERS)}", file=table)
    rows = {str(row["case"]): row for row in frame.to_dict("records")}
    if len(rows) < len(frame):
        doubles = frame["case"].astype(str)
        first = doubles[doubles.duplicated()].iloc[0]
        raise CampaignError(f"the case '{first}' stands twice in the table", cure="leave one out", file=table)
    folders = {path.name: path for path in found} | {path.stem: path for path in found}
    cases = []
    for number, (name, row) in enumerate(rows.items(), start=1):
        if name not in folders:
            raise CampaignError(
                f"there is no case '{name}'",
                cure=f"found are {', '.join(sorted({path.name for path in found})[:6])}",
                file=table,
                place=f"row {number}",
            )
        cases.append(SweepCase(name, folders[name], **_table_values(row, known, table, number)))
    left = sorted({path.name for path in found} - {case.path.name for case in cases})
    if left:
        raise CampaignError(
            f"the case '{left[0]}' is not in the table", cure="add a row, or leave the case out", file=table
        )
    return cases


def _table_values(row: Mapping[str, Any], known: Sequence[str], table: Path, number: int) -> dict[str, Any]:
    values: dict[str, Any] = {}
    types = {item.name: item.type for item in fields(SweepCase)}
    for key in known:
        if types[key] == "str":
            values[key] = str(row[key])
            continue
        try:
            values[key] = float(row[key])
        except (TypeError, ValueError):
            raise CampaignError(
                f"{key} = '{row[key]}' is not a number", cure="correct the row", file=table, place=f"row {number}"
            ) from None
    return values


def _natural(text: str) -> tuple[int, float, str]:
    """Order of names: numbers by size before words."""
    try:
        return 0, float(text), text
    except ValueError:
        return 1, 0.0, text
