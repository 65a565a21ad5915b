"""Tracks of some draws of an ensemble on a common grid, with bands between quantiles."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import SimulationError
from .manoeuvre_names import read_manoeuvre_name
from .programme import Programme
from .sailing import sail
from .trajectory import Trajectory
from .vessel import Vessel

if TYPE_CHECKING:
    from .environment import Environment

FloatArray = np.ndarray

POINTS = 241
"""Points of the grid."""

SAILING = 0.9
"""Share of the tracks that have not ended at the end of the grid: beyond it a band would be that of slow ones."""


@dataclass(frozen=True, eq=False)
class TrackFan:
    """Tracks on a common grid.

    Attributes
    ----------
    manoeuvre : str
    length : float
        Ship length in m.
    along : {"heading", "time"}
        What the grid counts from the first order: degrees turned, in the direction of the manoeuvre, or seconds.
        Of turning circles tracks are compared at equal headings, of other manoeuvres at equal times.
    grid : ndarray, shape (m,)
    unperturbed : mapping of str to ndarray, shape (m,)
        Columns of a trajectory (SI, radians) of the unperturbed vessel.
    tracks : mapping of str to ndarray, shape (k, m)
        The same of the draws; NaN after the end of a track.
    numbers : ndarray of int, shape (k,)
        Numbers of the draws.
    """

    manoeuvre: str
    length: float
    along: Literal["heading", "time"]
    grid: FloatArray
    unperturbed: Mapping[str, FloatArray]
    tracks: Mapping[str, FloatArray]
    numbers: np.ndarray

    def band(self, column: str, low: float = 0.05, high: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Quantiles of one column over the tracks, two arrays of shape (m,)."""
        lower, upper = np.nanquantile(self.tracks[column], (low, high), axis=0)
        return lower, upper

    def track_band(self, low: float = 0.05, high: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Edges of a band about the track: two arrays (m, 2) of x and y in m.

        At each point of the grid the tracks' distances from the unperturbed one are measured across its direction.
        """
        middle = np.column_stack([self.unperturbed["x"], self.unperturbed["y"]])
        direction = np.gradient(middle, axis=0)
        size = np.linalg.norm(direction, axis=1, keepdims=True)
        normal = direction[:, ::-1] * (-1.0, 1.0) / np.where(size > 0.0, size, 1.0)
        across = (self.tracks["x"] - middle[:, 0]) * normal[:, 0] + (self.tracks["y"] - middle[:, 1]) * normal[
            :, 1
        ]
        lower, upper = np.nanquantile(across, (low, high), axis=0)
        return middle + lower[:, None] * normal, middle + upper[:, None] * normal


def sail_fan(
    vessel: Vessel,
    programme: Programme,
    draws: Sequence[Vessel],
    numbers: np.ndarray | None = None,
    *,
    environment: Environment | None = None,
) -> TrackFan:
    """Sail a manoeuvre with the unperturbed vessel and with some draws.

    Parameters
    ----------
    vessel : Vessel
    programme : Programme
    draws : sequence of Vessel
    numbers : ndarray of int, optional
        Their numbers in the ensemble.
    environment : Environment, optional

    Raises
    ------
    SimulationError
        When there is no draw, or one cannot complete the manoeuvre.
    """
    if not len(draws):
        raise SimulationError(f"no draw completed {programme.name}", cure="narrow the scatter")
    kind, rudder, _ = read_manoeuvre_name(programme.name)
    along: Literal["heading", "time"] = "heading" if kind == "turning" else "time"
    side = math.copysign(1.0, rudder if rudder is not None else 1.0)
    sailed = [sail(item, programme, environment=environment) for item in (vessel, *draws)]
    progress = [_progress(trajectory, along, side) for trajectory in sailed]
    ends = np.array([values[-1] for values in progress])
    # circles all end at the same heading, but for rounding
    last = ends.min() if along == "heading" else min(ends[0], np.quantile(ends[1:], 1.0 - SAILING, method="lower"))
    grid = np.linspace(0.0, float(last), POINTS)
    columns = [name for name in sailed[0].frame.columns if name != "time" or along == "heading"]
    rows = {
        name: np.array(
            [
                np.interp(grid, values, trajectory[name], right=np.nan)
                for trajectory, values in zip(sailed, progress, strict=True)
            ]
        )
        for name in columns
    }
    return TrackFan(
        manoeuvre=programme.name,
        length=vessel.ship.L,
        along=along,
        grid=grid,
        unperturbed={name: values[0] for name, values in rows.items()},
        tracks={name: values[1:] for name, values in rows.items()},
        numbers=np.arange(len(draws)) if numbers is None else np.asarray(numbers),
    )


def _progress(trajectory: Trajectory, along: Literal["heading", "time"], side: float) -> FloatArray:
    """Ascending values of the grid's quantity at the samples of a trajectory."""
    if along == "time":
        return trajectory["time"] - trajectory["time"][0]
    turned = np.degrees(side * (trajectory["psi"] - trajectory["psi"][0]))
    # repeated headings, before the ship answers, would make the interpolation take any of them
    return np.maximum.accumulate(turned) + 1e-9 * np.arange(len(turned))
