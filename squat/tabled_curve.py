"""A squat curve from a table: one column of speeds and one of each sinkage and of the trim, units in the headings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError, TowtankError
from ..core.findings import Finding
from ..formats.raw_table import RawTable
from ..formats.read import read_table
from ..formats.units import conversion
from .si_channel import require_channels, si_channel
from .squat_curve import SquatCurve

if TYPE_CHECKING:
    import pandas as pd

_PLACES = ("bow", "stern", "midship", "cog")


@dataclass(frozen=True, eq=False)
class TabledCurve:
    """A curve and the file that it comes from.

    Attributes
    ----------
    curve : SquatCurve
    path, sha256 : str
    findings : tuple of Finding
    """

    curve: SquatCurve
    path: str
    sha256: str
    findings: tuple[Finding, ...] = ()


def read_squat_curve(
    path: str | Path,
    draught: float,
    *,
    depth: float | None = None,
    scale: float = 1.0,
    units: Mapping[str, str] | None = None,
) -> TabledCurve:
    """Read the squat curve of a ship or model, such as ``squat_curve.csv``.

    Parameters
    ----------
    path : str or Path
        Columns ``speed``, ``sinkage_bow`` (or ``bow``) and other places, positive down, and ``trim``, positive by the
        bow: an angle or a slope. Columns without a unit are taken as SI. Rows with a missing value are left out.
    draught : float
        In m, at the scale of the table.
    depth : float, optional
        Water depth in m, at that scale; from the column ``depth`` when not given.
    scale : float
        Full-scale length over that of the table.
    units : mapping of str to str, optional
        Units that the file does not give or gives wrongly.

    Raises
    ------
    ReadError
        When the file cannot be read, has no speed or no sinkage or trim, no depth or several, a unit of another
        quantity, or fewer than two whole rows.
    FitError
        When depth, draught or a speed is impossible.
    """
    table = read_table(path)
    require_channels(table, ("speed",))
    table = replace(table, units={**table.units, **(units or {})})
    names = {name: _quantity(name) for name in table.columns if _quantity(name)}
    if not names:
        raise ReadError(
            "there is no sinkage and no trim",
            cure="name the columns sinkage_bow, sinkage_stern, sinkage_midship or trim",
            file=path,
        )
    columns = {"speed": si_channel(table, "speed", ("velocity",))}
    for name, quantity in names.items():
        if quantity == "trim":
            values = si_channel(table, name, ("slope", "angle", "dimensionless"))
            columns[quantity] = np.tan(values) if _is_angle(table, name) else values
        else:
            columns[quantity] = si_channel(table, name, ("length",))
    points, dropped = _whole_rows(columns)
    findings = [*table.findings]
    unknown = [name for name in ("speed", *names) if not table.units.get(name)]
    if unknown:
        findings.append(
            Finding(
                "no-unit",
                "warning",
                f"{', '.join(unknown)} without a unit, taken as SI (trim as a slope)",
                str(path),
                cure="write units into the headings: speed [m/s]",
            )
        )
    if dropped:
        findings.append(
            Finding("missing-values", "warning", f"{dropped} row(s) with a missing value are left out", str(path))
        )
    if len(points) < 2:
        raise ReadError(f"{len(points)} whole row(s) make no curve", cure="give two speeds or more", file=path)
    try:
        curve = SquatCurve(points, _depth(table, depth, path), draught, Path(path).stem, scale)
    except TowtankError as error:
        raise type(error)(error.cause, cure=error.cure, file=path, place=error.place) from None
    return TabledCurve(curve, str(path), table.sha256, tuple(findings))


def _quantity(column: str) -> str:
    """Name of the house for a column; empty for what is no sinkage and no trim."""
    if column == "trim" or (column.startswith("sinkage_") and not column.endswith("_se")):
        return column
    return f"sinkage_{column}" if column in _PLACES else ""


def _is_angle(table: RawTable, name: str) -> bool:
    unit = table.units.get(name, "")
    return bool(unit) and conversion(unit).dimension == "angle"


def _whole_rows(columns: Mapping[str, np.ndarray]) -> tuple[pd.DataFrame, int]:
    import pandas as pd

    frame = pd.DataFrame(columns)
    whole = frame.dropna(ignore_index=True)
    return whole, len(frame) - len(whole)


def _depth(table: RawTable, depth: float | None, path: str | Path) -> float:
    if depth is not None:
        return depth
    if "depth" not in table.columns:
        raise ReadError("the water depth is not known", cure="give it, or a column depth [m]", file=path)
    known = si_channel(table, "depth", ("length",))
    known = known[np.isfinite(known)]
    if not known.size or np.ptp(known) > 1e-9 * float(np.abs(known).max()):
        raise ReadError("the column depth is empty or has several depths", cure="give one curve a file", file=path)
    return float(known[0])
