"""Trajectories as text tables: a unit in each heading, degrees in files, radians in memory."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from ..core.errors import ReadError
from ..core.provenance import Provenance
from ..core.ship import Ship
from ..formats import RawTable, read_table, write_table
from ..formats.units import convertible, split_name
from .events import COLUMNS, FloatArray
from .trajectory import FILE_UNITS, Trajectory
from .trajectory_checks import audit_channels
from .trial_axes import local_position

DIMENSIONS = {
    "time": "time",
    **dict.fromkeys(("x", "y"), "length"),
    **dict.fromkeys(("psi", "phi", "delta"), "angle"),
    **dict.fromkeys(("u", "v"), "velocity"),
    **dict.fromkeys(("r", "p"), "angular velocity"),
    "n": "revolution rate",
    **dict.fromkeys(("latitude", "longitude"), "angle"),
}
"""Channels that are read. Latitude and longitude become x (north) and y (east)."""


ALIASES = {
    "t": "time", "time_s": "time", "north": "x", "east": "y", "x0": "x", "y0": "y", "advance": "x", "transfer": "y",
    "heading": "psi", "yaw": "psi", "hdg": "psi", "surge velocity": "u", "sway velocity": "v",
    "surge_velocity": "u", "sway_velocity": "v", "yaw rate": "r", "yaw_rate": "r", "rot": "r", "rate of turn": "r",
    "roll": "phi", "heel": "phi", "roll angle": "phi", "roll rate": "p", "roll_rate": "p", "rudder": "delta",
    "rudder angle": "delta", "rudder_angle": "delta", "propeller rate": "n", "propeller_rate": "n", "rpm": "n",
    "revolutions": "n", "lat": "latitude", "lon": "longitude", "long": "longitude",
}  # fmt: skip
"""Other names of the columns, in small letters."""


def write_trajectory(trajectory: Trajectory, path: str | Path) -> None:
    """Write the samples of a trajectory as CSV with headings such as ``psi [deg]``."""
    columns: dict[str, FloatArray] = {}
    for name in COLUMNS:
        if name in trajectory:
            unit = FILE_UNITS[name]
            values = trajectory[name]
            columns[f"{name} [{unit}]"] = np.degrees(values) if unit.startswith("deg") else values
    write_table(path, columns, delimiter=",")


def read_trajectory(
    path: str | Path,
    ship: Ship,
    manoeuvre: str = "",
    *,
    columns: Mapping[str, str] | None = None,
    signs: Mapping[str, int] | None = None,
    accept: bool = False,
) -> Trajectory:
    """Read a trajectory from a table of any format that :func:`towtank.formats.read_table` reads.

    Parameters
    ----------
    path : str or Path
        A table with the unit in each heading: ``time [s], x [m], y [m], psi [deg], u [kn], ...``. Columns that are no
        channel of a trajectory are passed over, and listed in the provenance. ``latitude [deg], longitude [deg]`` serve
        for x and y.
    ship : Ship
    manoeuvre : str
        E.g. ``"turning +35"``; needed to find events.
    columns : mapping of str to str, optional
        Channel -> heading in the file, with a unit if the file has none: ``{"psi": "Gyro [deg]"}``.
    signs : mapping of str to int, optional
        ``{"delta": -1}`` for a laboratory that counts rudder to port positive.
    accept : bool
        Read channels that contradict each other (see `audit_channels`).

    Returns
    -------
    Trajectory
        In SI and radians; a heading from 0 to 360 degrees is made continuous.

    Raises
    ------
    ReadError
        For a heading without a unit, a unit of another dimension, or a table without time or heading; says what
        is missing.
    AuditError
        For channels that contradict each other: units, signs, axes.
    """
    table = read_table(require_file(path))
    found = _assign(table, columns or {}, path)
    missing = [name for name in ("time", "psi") if name not in found]
    if missing:
        wanted = " and ".join(f"'{name} [{FILE_UNITS[name]}]'" for name in missing)
        raise ReadError(
            f"there is no column {wanted}; columns are {', '.join(table.columns)}",
            cure=f"rename one, or give columns={{'{missing[0]}': '<heading> [{FILE_UNITS[missing[0]]}]'}}",
            file=path,
        )
    steps, data = [], {}
    for name, (column, unit) in found.items():
        sign = (signs or {}).get(name, 1)
        data[name] = sign * _in_si(table, name, column, unit, path)
        steps.append(f"{name} from '{column}' in {unit}" + (", sign turned" if sign < 0 else ""))
    if np.abs(np.diff(data["psi"])).max(initial=0.0) > math.pi:
        data["psi"] = np.unwrap(data["psi"])
        steps.append("heading made continuous across 360 degrees")
    if "latitude" in data and "longitude" in data and "x" not in data and "y" not in data:
        data["x"], data["y"] = local_position(data["latitude"], data["longitude"])
        steps.append("x to the north and y to the east of the first position, WGS 84")
    unused = [column for column in table.columns if column not in {pair[0] for pair in found.values()}]
    if unused:
        steps.append(f"not read: {', '.join(unused)}")
    provenance = Provenance(
        source=str(path),
        inputs={str(path): table.sha256},
        findings=table.findings,
        history=tuple(steps),
    )
    trajectory = Trajectory.from_columns(
        {name: data[name] for name in COLUMNS if name in data},
        ship,
        manoeuvre,
        source=str(path),
        provenance=provenance,
    )
    if not accept:
        audit_channels(trajectory, path)
    return trajectory


def require_file(path: str | Path) -> Path:
    """Refuse a path at which there is nothing.

    Raises
    ------
    ReadError
    """
    if not Path(path).exists():
        raise ReadError("file not found", cure="give the path of a table with a unit in each heading", file=path)
    return Path(path)


def read_channels(table: RawTable, path: str | Path) -> dict[str, FloatArray]:
    """The channels of a trajectory that a table has, in SI and radians, each of shape (n,).

    Raises
    ------
    ReadError
        For a heading without a unit, or a unit of another dimension.
    """
    return {
        name: _in_si(table, name, column, unit, path) for name, (column, unit) in _assign(table, {}, path).items()
    }


def _in_si(table: RawTable, name: str, column: str, unit: str, path: str | Path) -> FloatArray:
    return _factor(name, unit, column, path) * np.asarray(table.columns[column], dtype=float)


def _assign(table: RawTable, given: Mapping[str, str], path: str | Path) -> dict[str, tuple[str, str]]:
    """Channel -> (heading, unit), by what the user says, then by name."""
    found: dict[str, tuple[str, str]] = {}
    for name, heading in given.items():
        if name not in DIMENSIONS:
            raise ReadError(
                f"'{name}' is no channel of a trajectory", cure=f"channels are {', '.join(DIMENSIONS)}", file=path
            )
        column, unit = (heading, "") if heading in table.columns else split_name(heading)
        if column not in table.columns:
            raise ReadError(
                f"there is no column '{column}' for '{name}'",
                cure=f"columns are {', '.join(table.columns)}",
                file=path,
            )
        found[name] = (column, unit or table.units[column])
    for column in table.columns:
        text = column.strip().lower()
        name = text if text in DIMENSIONS else ALIASES.get(text, "")
        if not name or name in given:
            continue
        if name in found:
            raise ReadError(
                f"columns '{found[name][0]}' and '{column}' are both '{name}'",
                cure=f"choose one with columns={{'{name}': '{column}'}}",
                file=path,
            )
        found[name] = (column, table.units[column])
    return found


def _factor(name: str, unit: str, column: str, path: str | Path) -> float:
    """Factor to SI of a channel.

    Raises
    ------
    ReadError
        Without a unit, or with one of another dimension.
    """
    if not unit:
        raise ReadError(
            f"column '{column}' has no unit",
            cure=f"write it in the heading, e.g. '{column} [{FILE_UNITS.get(name, 'deg')}]'",
            file=path,
            place=column,
        )
    factor = convertible(unit, DIMENSIONS[name])
    if factor is None:
        raise ReadError(
            f"'{unit}' is no unit of the {DIMENSIONS[name]} '{name}'",
            cure=f"write e.g. '{name} [{FILE_UNITS.get(name, 'deg')}]'",
            file=path,
            place=column,
        )
    return factor
