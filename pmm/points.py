"""Already reduced points (mean forces of steady runs, harmonics of oscillating ones) as runs."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import CampaignError, DatasetError
from ..core.findings import Finding
from ..core.scales import force_unit
from ..core.ship import Ship
from .audit_table import audit_table
from .campaign_file import Points, Reduction
from .harmonic_points import read_harmonic_points
from .planar_motion import prescribed_motion
from .reduced_run import FORCES, ReducedRun
from .reduction import point_run
from .run_types import RUN_PARAMETERS, Run

if TYPE_CHECKING:
    import pandas as pd

_MOTION = ("v", "vprime", "r", "rprime", "beta", "drift_angle")
_ANGLES = ("rudder_angle", "heel")


@dataclass(frozen=True)
class PointTable:
    """Reduced points of a campaign.

    Attributes
    ----------
    runs : tuple of ReducedRun
        One a row.
    findings : tuple of Finding
        What reader and audit noticed about the table.
    sha256 : str
        Hash of the table's file; empty for a shipped table.
    """

    runs: tuple[ReducedRun, ...]
    findings: tuple[Finding, ...]
    sha256: str


def read_points(
    points: Points, ship: Ship, conventions: Conventions, folder: Path, file: Path, reduction: Reduction
) -> PointTable:
    """Runs of a table of reduced points.

    The table has a column for the motion (``v``, ``beta`` or both of ``r``) and one a force; ``[points.columns]``
    maps other names. Forces are scaled as ``scaling`` says, with the signs of the campaign's conventions, the moment
    about ``reduction.moment_x``, the motion that of ``reduction.position_x``. ``v`` and ``r`` are non-dimensional
    unless the scaling is ``dimensional``; ``vprime`` and ``rprime`` always are.

    Parameters
    ----------
    points : Points
    ship : Ship
    conventions : Conventions
        Axes, signs and angle unit of the table.
    folder : Path
        Folder that the name of the table starts from.
    file : Path
        The campaign file, for messages.
    reduction : Reduction
        Gives the points of moment and motion, and the speed that scales forces.

    Raises
    ------
    CampaignError
        For a missing column or number, with its row.
    ReadError, DatasetError
        When there is no such table.
    """
    harmonics: list[ReducedRun] = []
    if points.harmonics is not None:
        harmonics = read_harmonic_points(points, ship, conventions, folder, file, reduction)
        if points.file is None and points.table is None:
            return PointTable(tuple(harmonics), (), "")
    frame, findings, source, digest = _table(points, ship, folder, file)
    frame = frame.rename(columns={theirs: ours for ours, theirs in points.columns.items()})
    columns = [str(column) for column in frame.columns]
    strangers = [theirs for ours, theirs in points.columns.items() if ours not in columns]
    if strangers:
        raise CampaignError(
            f"the table of points has no column '{strangers[0]}'",
            cure=f"it has {', '.join(columns)}",
            file=file,
            place=f"{source}, [points.columns]",
        )
    forces = [name for name in FORCES if name in columns]
    for missing, what in (
        (not forces, "force column X, Y or N"),
        (not set(columns) & set(_MOTION), "v, beta or r"),
    ):
        if missing:
            raise CampaignError(
                f"the table of points has no {what}",
                cure=f"map it in [points.columns]; the table has {', '.join(columns)}",
                file=file,
                place=source,
            )
    rows = []
    for number, values in enumerate(frame.to_dict("records"), start=1):
        row = _Row({str(key): value for key, value in values.items()}, file, f"{source}, row {number}")
        run = _run(row, points, ship, conventions, f"{Path(source).stem} {number}")
        rows.append(_reduced(row, run, points, ship, conventions, reduction, forces))
    return PointTable((*rows, *harmonics), tuple(findings), digest)


def _table(
    points: Points, ship: Ship, folder: Path, file: Path
) -> tuple[pd.DataFrame, Sequence[Finding], str, str]:
    if (points.table is None) == (points.file is None):
        raise CampaignError(
            "file and table are both given" if points.table else "neither file nor table is given",
            cure="give the file of a table, or the key of a published one (towtank sets --tables)",
            file=file,
            place="[points]",
        )
    if points.table is not None:
        from ..datasets import load_table

        try:
            return load_table(points.table).frame, (), points.table, ""
        except DatasetError as error:
            raise DatasetError(error.cause, cure=error.cure, file=file, place="[points] table") from None
    from ..formats.read import read_table

    table = read_table(folder / str(points.file))
    return table.frame, audit_table(table, None, ship=ship), str(points.file), table.sha256


@dataclass(frozen=True)
class _Row:
    """One row of the table and where it stands."""

    values: Mapping[str, Any]
    file: Path
    place: str

    def __contains__(self, name: str) -> bool:
        return name in self.values

    def number(self, name: str, default: float = 0.0) -> float:
        """Number in a column; the default when there is no such column."""
        if name not in self.values:
            return default
        try:
            result = float(self.values[name])
        except (TypeError, ValueError):
            raise CampaignError(
                f"{name} = '{self.values[name]}' is not a number",
                cure="correct the row",
                file=self.file,
                place=self.place,
            ) from None
        if not math.isfinite(result):
            raise CampaignError(
                f"{name} is missing", cure="drop the row or fill it", file=self.file, place=self.place
            )
        return result


def _run(row: _Row, points: Points, ship: Ship, conventions: Conventions, name: str) -> Run:
    """Motion of a row, in SI, radians and home signs."""
    speed = row.number("speed", row.number("U", 1.0))
    angle = math.pi / 180.0 if conventions.angle_unit == "deg" else 1.0
    side = -1.0 if conventions.axes == "forward-port-up" else 1.0
    own_unit = points.scaling == "dimensional"
    if "r" in row and own_unit:
        yaw_rate = side * row.number("r")
    else:
        yaw_rate = side * row.number("r", row.number("rprime")) * speed / ship.L
    if "v" in row or "vprime" in row:
        sway = row.number("v") / speed if "v" in row and own_unit else row.number("v", row.number("vprime"))
        if abs(sway) > 1.0:
            raise CampaignError(
                f"the sway velocity is {abs(sway):.4g} times the speed",
                cure="give v' = v/U, or v in m/s with scaling = 'dimensional' and a column speed",
                file=row.file,
                place=row.place,
            )
        drift = math.asin(-side * sway) + 0.0  # no -0 in tables
    else:
        drift = angle * row.number("beta", row.number("drift_angle"))
        drift *= side * (1.0 if conventions.drift_sign == "-v" else -1.0)
    more: dict[str, Any] = {
        name: row.number(name) * (angle if name in _ANGLES else 1.0)
        for name in ("rudder_angle", "heel", "bank_position", "depth", "propeller_rate")
        if name in row and name in RUN_PARAMETERS
    }
    if conventions.rudder_sign == "port" and "rudder_angle" in more:
        more["rudder_angle"] = -more["rudder_angle"]
    kind = "steady_yaw_drift" if yaw_rate and drift else "steady_yaw" if yaw_rate else "static_drift"
    try:
        return Run(
            name=str(row.values.get("name") or name),
            kind=kind,
            speed=speed,
            drift_angle=drift,
            yaw_rate=yaw_rate,
            **more,
        )
    except CampaignError as error:
        raise CampaignError(
            error.cause, cure=error.cure or "correct the row", file=row.file, place=row.place
        ) from None


def _reduced(
    row: _Row,
    run: Run,
    points: Points,
    ship: Ship,
    conventions: Conventions,
    reduction: Reduction,
    forces: Sequence[str],
) -> ReducedRun:
    """Forces of a row over ``0.5 rho L T U^2`` at midship, in home signs."""
    motion = prescribed_motion(run, reduction.position_x)
    at = motion.at(np.zeros(1))
    scale = run.speed
    if reduction.nondimensional_speed == "instantaneous":
        scale = float(np.hypot(at["surge"], at["v"])[0])
    scaled: dict[str, float] = {}
    sd: dict[str, float] = {}
    for name in forces:
        unit = force_unit(name, points.scaling, ship, run.speed) / force_unit(name, "LT", ship, scale)
        sign = -1.0 if conventions.force_sign == "by-ship" else 1.0
        if conventions.axes == "forward-port-up" and name in ("Y", "N"):
            sign = -sign
        scaled[name] = sign * unit * row.number(name)
        sd[name] = unit * _uncertainty(name, row, points)
    if reduction.moment_x and "N" in scaled:
        if "Y" not in scaled:
            raise CampaignError(
                "moving the moment to midship needs Y",
                cure="map Y in [points.columns]",
                file=row.file,
                place=row.place,
            )
        lever = reduction.moment_x / ship.L
        scaled["N"] += lever * scaled["Y"]
        sd["N"] = math.hypot(sd["N"], lever * sd["Y"])
    if any(not math.isfinite(x) or x <= 0 for x in sd.values()):
        sd = dict.fromkeys(sd, math.nan)
    reduced = point_run(run, ship, scaled, sd, reduction.nondimensional_speed)
    newtons = {name: np.array([value * force_unit(name, "LT", ship, scale)]) for name, value in scaled.items()}
    given = "speed" in row or "U" in row
    return replace(reduced, motion=motion, forces=newtons, speed_given=given)


def _uncertainty(name: str, row: _Row, points: Points) -> float:
    """Standard uncertainty of a force in the unit of the table; NaN where none is given."""
    if f"{name}_sd" in row:
        return row.number(f"{name}_sd")
    if name in points.sd:
        return points.sd[name]
    return math.nan if points.relative_sd is None else abs(points.relative_sd * row.number(name))
