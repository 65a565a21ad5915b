"""Already reduced points (mean forces, one a row) as runs."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import CampaignError
from ..core.scales import force_unit
from ..core.ship import Ship
from .campaign_file import Points
from .reduced_run import FORCES, ReducedRun
from .reduction import point_run
from .run_types import RUN_PARAMETERS, Run

if TYPE_CHECKING:
    import pandas as pd

_STATE = {"v": "v", "vprime": "v", "r": "r", "rprime": "r", "beta": "beta", "drift_angle": "beta"}


def read_points(
    points: Points, ship: Ship, conventions: Conventions, folder: Path, file: Path, velocity_scale: str
) -> tuple[list[ReducedRun], str]:
    """Runs of a table of reduced points.

    The table has a column for the motion (``v``, ``beta`` or both of ``r``) and one a force; ``[points.columns]``
    maps other names. Forces are scaled as ``scaling`` says, about the origin and with the signs of the campaign's
    conventions. Non-dimensional ``v`` and ``r`` are taken as printed.

    Returns
    -------
    runs : list of ReducedRun
    sha256 : str
        Hash of the table's file; empty for a shipped table.

    Raises
    ------
    CampaignError
        For a missing file, column or number, with its row.
    """
    frame, source, digest = _table(points, folder, file)
    frame = frame.rename(columns={theirs: ours for ours, theirs in points.columns.items()})
    columns = [str(column) for column in frame.columns]
    forces = [name for name in FORCES if name in columns]
    if not forces:
        raise CampaignError(
            "the table of points has no force column X, Y or N",
            cure=f"map them in [points.columns]; it has {', '.join(columns)}",
            file=file,
            place=source,
        )
    if not set(columns) & set(_STATE):
        raise CampaignError(
            "the table of points has no motion column v, beta or r",
            cure=f"map one in [points.columns]; it has {', '.join(columns)}",
            file=file,
            place=source,
        )
    runs = []
    for number, row in enumerate(frame.to_dict("records"), start=1):
        runs.append(
            _point(
                {str(k): v for k, v in row.items()},
                number,
                points,
                ship,
                conventions,
                file,
                source,
                forces,
                velocity_scale,
            )
        )
    return runs, digest


def _table(points: Points, folder: Path, file: Path) -> tuple[pd.DataFrame, str, str]:
    if points.table is not None:
        from ..datasets import load_table

        return load_table(points.table).frame, points.table, ""
    if points.file is None:
        raise CampaignError("neither file nor table is given", file=file, place="[points]")
    from ..formats.read import read_table

    table = read_table(folder / points.file)
    return table.frame, points.file, table.sha256


def _point(
    row: dict[str, Any],
    number: int,
    points: Points,
    ship: Ship,
    conventions: Conventions,
    file: Path,
    source: str,
    forces: list[str],
    velocity_scale: str,
) -> ReducedRun:
    place = f"{source}, row {number}"

    def value(name: str, default: float = 0.0) -> float:
        if name not in row or row[name] is None:
            return default
        try:
            result = float(row[name])
        except (TypeError, ValueError):
            raise CampaignError(f"{name} = '{row[name]}' is not a number", file=file, place=place) from None
        if not math.isfinite(result):
            raise CampaignError(f"{name} is missing", cure="drop the row or fill it", file=file, place=place)
        return result

    speed = value("speed", value("U", 1.0))
    angle = math.pi / 180.0 if conventions.angle_unit == "deg" else 1.0
    side = -1.0 if conventions.axes == "forward-port-up" else 1.0
    yaw = side * value("r", value("rprime"))
    if "v" in row or "vprime" in row:
        drift = -math.asin(side * value("v", value("vprime")))
    else:
        drift = angle * value("beta", value("drift_angle"))
        drift *= side * (1.0 if conventions.drift_sign == "-v" else -1.0)
    kind = "steady_yaw_drift" if yaw and drift else "steady_yaw" if yaw else "static_drift"
    more: dict[str, Any] = {
        name: value(name) * (angle if name in ("rudder_angle", "heel") else 1.0)
        for name in ("rudder_angle", "heel", "bank_position", "depth", "propeller_rate")
        if name in row and name in RUN_PARAMETERS
    }
    if conventions.rudder_sign == "port" and "rudder_angle" in more:
        more["rudder_angle"] = -more["rudder_angle"]
    # Non-dimensional yaw rate r' = r L / U; in SI tables the rate itself is given.
    rate = yaw if points.scaling == "dimensional" else yaw * speed / ship.L
    run = Run(
        name=str(row.get("name") or f"{Path(source).stem} {number}"),
        kind=kind,
        speed=speed,
        drift_angle=drift,
        yaw_rate=rate,
        **more,
    )
    sign = -1.0 if conventions.force_sign == "by-ship" else 1.0
    scaled: dict[str, float] = {}
    sd: dict[str, float] = {}
    for name in forces:
        unit = force_unit(name, points.scaling, ship, speed) / force_unit(name, "LT", ship, speed)
        turned = sign * (side if name in ("Y", "N") else 1.0)
        scaled[name] = turned * unit * value(name)
        spread = points.sd.get(name, math.nan)
        if f"{name}_sd" in row:
            spread = value(f"{name}_sd")
        if points.relative_sd is not None and not math.isfinite(spread):
            spread = abs(points.relative_sd * value(name))
        sd[name] = unit * spread
    if any(not np.isfinite(x) or x <= 0 for x in sd.values()):
        sd = dict.fromkeys(sd, math.nan)
    return point_run(run, ship, scaled, sd, velocity_scale)
