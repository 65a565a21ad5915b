"""Trajectory: one manoeuvre as a time series, simulated or measured."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..core.errors import ReadError, TowtankError
from ..core.provenance import Provenance
from ..core.ship import Ship
from .events import COLUMNS, Events, FloatArray

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes

FILE_UNITS = {
    "time": "s", "x": "m", "y": "m", "psi": "deg", "u": "m/s", "v": "m/s", "r": "deg/s",
    "phi": "deg", "p": "deg/s", "delta": "deg", "n": "1/s",
}  # fmt: skip
"""Units in files; in memory angles are in radians."""


@dataclass(frozen=True, eq=False)
class Trajectory:
    """One manoeuvre.

    Attributes
    ----------
    frame : DataFrame
        Columns of ``time`` [s], ``x, y`` [m] (midship; x along the initial course, y to starboard of it), ``psi``
        [rad], ``u, v`` [m/s] (midship, through the water, along and to starboard of the ship), ``r`` [rad/s],
        ``phi`` [rad], ``p`` [rad/s], ``delta`` [rad] (positive turns to starboard), ``n`` [1/s]: those that are
        known. A row a sample, in the order of time.
    ship : Ship
        Particulars at the scale of the trajectory.
    manoeuvre : str
        What was sailed, e.g. ``"turning +35"``, ``"zigzag 10/10"``.
    events : Events or None
        Located by the integrator; None for a measured trajectory (see `find_events`).
    source : str
        File or model.
    provenance : Provenance
    """

    frame: pd.DataFrame
    ship: Ship
    manoeuvre: str = ""
    events: Events | None = None
    source: str = ""
    provenance: Provenance = field(default_factory=Provenance)

    def __post_init__(self) -> None:
        strangers = [str(name) for name in self.frame.columns if name not in COLUMNS]
        if strangers or "time" not in self.frame.columns:
            raise TowtankError(
                f"unknown column '{strangers[0]}'" if strangers else "the column 'time' is missing",
                cure=f"a trajectory has columns of {', '.join(COLUMNS)}",
                place=self.manoeuvre,
                file=self.source or None,
            )
        if len(self.frame) < 2:
            raise TowtankError(
                f"a trajectory of {len(self.frame)} sample(s) has no course",
                cure="give at least two samples, in practice ten or more a ship length",
                place=self.manoeuvre,
                file=self.source or None,
            )

    @classmethod
    def from_columns(
        cls, columns: Mapping[str, FloatArray], ship: Ship, manoeuvre: str = "", **about: Any
    ) -> Trajectory:
        """Trajectory from arrays of shape (n,) by column name, in SI and radians; `about` as the attributes."""
        import pandas as pd

        return cls(
            pd.DataFrame({name: np.asarray(v, float) for name, v in columns.items()}), ship, manoeuvre, **about
        )

    def __len__(self) -> int:
        return len(self.frame)

    def __contains__(self, name: str) -> bool:
        return name in self.frame.columns

    def __getitem__(self, name: str) -> FloatArray:
        if name not in self.frame.columns:
            raise ReadError(
                f"there is no channel '{name}'",
                cure=f"this trajectory has {', '.join(map(str, self.frame.columns))}",
                place=self.manoeuvre,
                file=self.source or None,
            )
        return self.frame[name].to_numpy(dtype=float)

    def speed(self) -> FloatArray:
        """Speed in m/s, shape (n,): of midship through the water; over the ground if only the track is known."""
        if "u" in self and "v" in self:
            return np.hypot(self["u"], self["v"])
        return np.hypot(*self.track_velocity())

    def drift_angle(self) -> FloatArray:
        """Drift angle beta = atan2(-v, u) at midship in radians, shape (n,); positive with the bow inside a
        starboard turn."""
        if "u" in self and "v" in self:
            return np.arctan2(-self["v"], self["u"])
        north, east = self.track_velocity()
        angle = self["psi"] - np.arctan2(east, north)
        return np.arctan2(np.sin(angle), np.cos(angle))

    def track_velocity(self) -> tuple[FloatArray, FloatArray]:
        """dx/dt and dy/dt of the track in m/s, each of shape (n,), by second-order differences."""
        order: Literal[1, 2] = 2 if len(self) > 2 else 1
        time = self["time"]
        return (
            np.gradient(self["x"], time, edge_order=order),
            np.gradient(self["y"], time, edge_order=order),
        )

    def with_columns(self, step: str, **columns: FloatArray) -> Trajectory:
        """Copy with columns replaced or added, events dropped, and `step` noted in the provenance."""
        frame = self.frame.assign(**columns)
        return replace(self, frame=frame, events=None, provenance=self.provenance.and_then(step))

    def to_csv(self, path: str | Path) -> None:
        """Write a text table with the unit in each heading (``psi [deg]``); angles in degrees."""
        from .trajectory_file import write_trajectory

        write_trajectory(self, path)

    @classmethod
    def from_csv(cls, path: str | Path, ship: Ship, manoeuvre: str = "", **choices: Any) -> Trajectory:
        """Read a table with a unit in each heading; see :func:`towtank.simulate.trajectory_file.read_trajectory`."""
        from .trajectory_file import read_trajectory

        return read_trajectory(path, ship, manoeuvre, **choices)

    def plot_track(self, ax: Axes | None = None, *, lengths: bool = True) -> Axes:
        """Track seen from above: transfer to the right, advance upwards, in ship lengths or metres."""
        if ax is None:
            from matplotlib.figure import Figure

            ax = Figure(figsize=(5.0, 5.0), layout="constrained").subplots()
        unit = self.ship.L if lengths else 1.0
        ax.plot(self["y"] / unit, self["x"] / unit, label=self.manoeuvre or None)
        ax.set_aspect("equal", adjustable="datalim")
        ax.set_xlabel("y / L [-]" if lengths else "y [m]")
        ax.set_ylabel("x / L [-]" if lengths else "x [m]")
        return ax
