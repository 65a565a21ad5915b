"""Squat of a voyage by its speed through the water: what was met in each range of speed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .full_scale import FullScaleSquat

if TYPE_CHECKING:
    import pandas as pd

KNOT_WIDE = 1852.0 / 3600.0
"""Default width of a range in m/s: one knot."""


def squat_by_speed(found: FullScaleSquat, width: float = KNOT_WIDE) -> pd.DataFrame:
    """Steady squat in ranges of speed through the water.

    A voyage does not hold its depth or its course, so that a range mixes them: the largest values tell what the ship
    did, the mean depth Froude number tells where.

    Parameters
    ----------
    found : FullScaleSquat
    width : float
        Of each range in m/s; ranges begin at multiples of it.

    Returns
    -------
    DataFrame
        One row a range that was met: speed (mean, m/s), duration (s), longitudinal_mean, longitudinal_max,
        lateral_max and corner_max (m), trim_mean (m/m), depth_froude_mean and clearance_min (m). What was not measured
        has no column; samples without a steady value are left out. ``attrs["units"]`` has the units.

    Raises
    ------
    FitError
        When the speed was not recorded, the width is not positive, or no sample has a steady value.
    """
    import pandas as pd

    speed = found.record.speed
    if speed is None:
        raise FitError("the speed was not recorded", cure="name its channel", file=found.record.name or None)
    if not width > 0.0:
        raise FitError(f"ranges of {width:g} m/s are impossible", cure="give their width in m/s, positive")
    kept = np.isfinite(found.steady.midship + found.steady.trim + speed)
    if not kept.any():
        raise FitError("no sample has a steady value", cure="give a longer record", file=found.record.name or None)
    columns = {
        "speed": speed,
        # the time that a sample stands for
        "duration": np.gradient(found.record.time),
        "longitudinal_mean": found.largest["longitudinal"],
        **{f"{name}_max": values for name, values in found.largest.items()},
        "trim_mean": found.steady.trim,
    }
    if found.depth_froude_number is not None:
        columns["depth_froude_mean"] = found.depth_froude_number
    if found.clearance is not None:
        columns["clearance_min"] = found.clearance.clearance
    units = {"speed": "m/s", "duration": "s", "trim_mean": "m/m", "depth_froude_mean": "-"}
    frame = pd.DataFrame({name: values[kept] for name, values in columns.items()})
    ranges = np.floor(frame["speed"] / width).astype(int)
    ways = {"max": "max", "min": "min", "duration": "sum"}
    how = {name: ways.get(name.rsplit("_", 1)[-1], "mean") for name in columns}
    table = frame.groupby(ranges).agg(how).reset_index(drop=True)
    table.attrs["units"] = {name: units.get(name, "m") for name in table.columns}
    return table
