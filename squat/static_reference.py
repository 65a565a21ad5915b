"""The ship at rest: what the sensors show without squat, against which a voyage is read.

Errors of the places of the antennas, of the datum and of the mounting of the attitude sensor are the same at rest and
under way, and leave with the reference. Source: full-scale measurements of container ships, 5th MASHCON 2019, where
the reference is a record of five minutes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from ..identify.autocorrelation import mean_with_error
from .audit_sinkage import FEWEST_SAMPLES
from .rtk_antennas import AntennaRecord
from .tide import TideTable

USUAL_LENGTH = 300.0
"""Length in s of the reference in the source."""
FASTEST_AT_REST = 0.3
"""Speed over ground in m/s that satellite noise explains."""


@dataclass(frozen=True)
class StaticReference:
    """Means of the record at rest.

    Attributes
    ----------
    draught : float
        Depth of the keel at midship below the water in m, as the sensors show it.
    trim, heel : float
        Slopes, positive by the bow and to starboard, as the sensors show them; heel 0 where nothing tells it.
    start, stop : float
        In s.
    rho : float
        Density of the water at the berth in kg/m3.
    se_draught, se_trim : float
        Standard errors of the means.
    notes : tuple of str
        What is to be known about the window.
    """

    draught: float
    trim: float
    heel: float
    start: float
    stop: float
    rho: float = 1025.0
    se_draught: float = 0.0
    se_trim: float = 0.0
    notes: tuple[str, ...] = ()


def static_reference(
    record: AntennaRecord, water_level: TideTable, *, start: float, stop: float, rho: float = 1025.0
) -> StaticReference:
    """Reference from the part of a record, or from a record of its own, at which the ship lies still.

    Parameters
    ----------
    record : AntennaRecord
    water_level : TideTable
        At the berth.
    start, stop : float
        In s.
    rho : float
        Density of the water at the berth in kg/m3.

    Raises
    ------
    FitError
        When the window holds less than ten samples or a missing value, the table does not cover it, or the ship makes
        way.
    """
    inside = (record.time >= start) & (record.time <= stop)
    count = int(np.count_nonzero(inside))
    place = f"static reference {start:g} to {stop:g} s"
    if count < FEWEST_SAMPLES:
        raise FitError(
            f"{count} samples, at least {FEWEST_SAMPLES} are needed",
            cure="widen the window or check its times",
            file=record.name or None,
            place=place,
        )
    if record.speed is not None:
        # A high quantile: a window that runs on into the departure is no reference, a spike does not matter.
        speed = float(np.nanquantile(record.speed[inside], 0.9))
        if speed > FASTEST_AT_REST:
            raise FitError(
                f"the ship makes {speed:.2f} m/s",
                cure="choose a time at the berth",
                file=record.name or None,
                place=place,
            )
    position = None if record.position is None else record.position[inside]
    draught = record.keel[inside] + water_level.at(record.time[inside], position)
    columns = [draught, record.trim[inside]]
    if record.heel is not None:
        columns.append(record.heel[inside])
    if not np.isfinite(np.column_stack(columns)).all():
        raise FitError(
            "a value is missing", cure="choose a window without gaps", file=record.name or None, place=place
        )
    means = [mean_with_error(column) for column in columns]
    length = float(record.time[inside][-1] - record.time[inside][0])
    notes = []
    if length < USUAL_LENGTH:
        notes.append(f"static reference of {length:.0f} s; {USUAL_LENGTH:.0f} s are usual")
    return StaticReference(
        float(means[0].mean),
        float(means[1].mean),
        float(means[2].mean) if len(means) > 2 else 0.0,
        start,
        stop,
        rho,
        float(means[0].se),
        float(means[1].se),
        tuple(notes),
    )
