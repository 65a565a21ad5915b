"""Loads of a computation in home conventions: density, half model, axes, reference point.

A solver prints forces in its own axes, about its own point, for the part of the hull that it meshed, and incompressible
solvers over the density. Each of these is a named choice here, and each that was made is told in the steps.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import ConventionError, ReadError
from ..formats import SolverCase, SolverLog

if TYPE_CHECKING:
    import pandas as pd

# Sign of each solver axis along the home axes x forward, y to starboard, z down; all right-handed.
AXES: dict[str, tuple[int, int, int]] = {
    "x-forward-z-down": (1, 1, 1),
    "x-aft-z-up": (-1, 1, -1),
    "x-forward-z-up": (1, -1, -1),
    "x-aft-z-down": (-1, -1, 1),
}
"""Solver axes by name; y follows from the right hand: to starboard, starboard, port, port."""

FORCES = ("X", "Y", "Z")
MOMENTS = ("K", "M", "N")
LOADS = (*FORCES, *MOMENTS)
PARTS = ("", "pressure", "viscous", "porous")
# A hull cut at its centre plane gives the whole hull's longitudinal loads; the others are those of one side.
HALF_MODEL_LOADS = ("X", "Z", "M")

_SOLVER_LOAD = re.compile(r"[FM][xyz]_(total|pressure|viscous|porous)")

Point = tuple[float, float, float]


@dataclass(frozen=True)
class LoadChoices:
    """What a solver's forces are, as the user says.

    Attributes
    ----------
    axes : str
        Solver axes, one of :data:`AXES`.
    density : float, optional
        Factor in kg/m3 for a solver that prints force / density; None when forces are in N already.
    half_model : bool
        Only one side of the hull was computed: X, Z and M are doubled, Y, K and N are left out.
    moment_point : tuple of float, optional
        Point that moments were taken about, in solver coordinates, m; that of the file's header (``CofR``) when not
        given.
    midship : tuple of float
        Midship in solver coordinates, m: moments are moved there.
    hull_turned : bool
        The hull was turned in the mesh by the drift angle and x runs along the track; forces are turned into the
        hull's axes.
    object : str, optional
        Name of the history of forces; needed when a case has several.
    columns : mapping of str to str
        Columns of monitor files by what they are: ``{"Fx_total": "Drag Monitor", "Mz_viscous": ...}``. Not needed for
        OpenFOAM, whose columns are known.
    """

    axes: str = "x-aft-z-up"
    density: float | None = None
    half_model: bool = False
    moment_point: Point | None = None
    midship: Point = (0.0, 0.0, 0.0)
    hull_turned: bool = False
    object: str | None = None
    columns: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.axes not in AXES:
            raise ConventionError(
                f"solver axes '{self.axes}' are not a choice", cure=f"use one of {', '.join(AXES)}"
            )
        if self.density is not None and not (self.density > 0.0 and math.isfinite(self.density)):
            raise ConventionError(f"the density {self.density} is not positive", cure="give kg/m3, e.g. 998.8")
        strangers = [name for name in self.columns if not _SOLVER_LOAD.fullmatch(name)]
        if strangers:
            raise ConventionError(
                f"'{strangers[0]}' is not a load of a solver",
                cure="name Fx_total ... Mz_total, Fx_pressure, Fx_viscous",
            )


@dataclass(frozen=True, eq=False)
class CaseLoads:
    """Loads of one computation at midship, in N and N m.

    Attributes
    ----------
    name : str
        Name of the case.
    time : ndarray, shape (n,)
        Time in s, or iteration number.
    index_name : {"time", "iteration"}
    channels : mapping of str to ndarray, shape (n,)
        ``X``, ``Y``, ``Z``, ``K``, ``M``, ``N`` as far as they are there, and their parts ``X_pressure``,
        ``X_viscous``, ``X_porous``.
    conventions : Conventions
        Home axes at midship, dimensional.
    steps : tuple of str
        What was done, in order.
    notes : tuple of str
        What the reader noticed.
    files : tuple of str
        Files that it was read from.
    restarts : int
        Places where runs were joined.
    diverged_at : float or None
        First time at which the solver printed no number.
    units : mapping of str to str
        Units of channels that are no loads, as the solver prints them; see :func:`.case_history.history_of`.
    history : str
        Name of the history that the channels are columns of; empty for loads.
    """

    name: str
    time: np.ndarray
    index_name: str
    channels: Mapping[str, np.ndarray]
    conventions: Conventions
    steps: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    restarts: int = 0
    diverged_at: float | None = field(default=None)
    units: Mapping[str, str] = field(default_factory=dict)
    history: str = ""

    def unit(self, channel: str) -> str:
        """Unit of a channel: N and N m for loads and their parts; empty if the solver prints none."""
        if self.history:
            return self.units.get(channel, "")
        return "N" if channel[0] in FORCES else "N m"

    def labelled(self, channel: str) -> str:
        """Name of a channel with its unit in brackets."""
        unit = self.unit(channel)
        return f"{channel} [{unit}]" if unit else channel

    @property
    def loads(self) -> tuple[str, ...]:
        """Total loads that are there, in the order X, Y, Z, K, M, N; all columns of another history."""
        if self.history:
            return tuple(self.channels)
        return tuple(name for name in LOADS if name in self.channels)

    def to_frame(self) -> pd.DataFrame:
        """Table with the time or iteration and all channels, units in the names."""
        import pandas as pd

        index = "time [s]" if self.index_name == "time" else "iteration"
        return pd.DataFrame(
            {index: self.time} | {self.labelled(name): values for name, values in self.channels.items()}
        )


def case_loads(case: SolverCase, choices: LoadChoices | None = None, *, drift_angle: float = 0.0) -> CaseLoads:
    """Loads of a case in home axes at midship.

    Parameters
    ----------
    case : SolverCase
    choices : LoadChoices, optional
    drift_angle : float
        beta = atan(-v/u) in rad; used when the hull was turned in the mesh.

    Returns
    -------
    CaseLoads

    Raises
    ------
    ReadError
        If the case has no forces, several histories of forces and no name, or moments that cannot be moved because
        the forces are not there.
    """
    chosen = choices or LoadChoices()
    monitors = case.of_kind("monitor")
    if monitors and not case.of_kind("forces"):
        units = {str(name): log.units.get(str(name), "") for log in monitors for name in log.frame.columns[1:]}
        have = [name for name in units if name != "time_step"]
        first = (have[0] + ("" if units[have[0]] else " [N]")) if have else "NAME"
        quoted = f'"Fx_total={first}"' if " " in first else f"Fx_total={first}"
        raise ReadError(
            "which of its columns are forces is not known",
            cure=f"say so with --column {quoted}; columns are {', '.join(have[:8])}",
            file=monitors[0].files[0],
        )
    log = case.log("forces", chosen.object)
    steps: list[str] = []
    channels: dict[str, np.ndarray] = {}
    for part in PARTS:
        found = _part(log, part or "total")
        if not found:
            continue
        loads = _in_home(found, log, chosen, drift_angle, steps if part == "" else [])
        channels |= {f"{name}_{part}" if part else name: values for name, values in loads.items()}
    if not any(name in channels for name in LOADS):
        raise ReadError(
            f"the history '{log.name}' has no total force",
            cure="map its columns to Fx_total, Fy_total, ... with a channel map",
            file=case.folder,
        )
    notes = [*case.notes, *log.notes, *(restart.text for restart in log.restarts)]
    missing = [part for part in ("pressure", "viscous") if f"X_{part}" not in channels]
    if missing and not any("part" in note for note in log.notes):
        notes.append(f"there is no {' and no '.join(missing)} part: totals only")
    return CaseLoads(
        name=case.name,
        time=log.frame.iloc[:, 0].to_numpy(),
        index_name=log.index_name,
        channels=channels,
        conventions=Conventions(force_scaling="dimensional"),
        steps=tuple(steps),
        notes=tuple(dict.fromkeys(notes)),
        files=tuple(str(file) for file in log.files),
        restarts=len(log.restarts),
        diverged_at=log.diverged_at,
    )


def _part(log: SolverLog, part: str) -> dict[str, np.ndarray]:
    """Solver's components Fx ... Mz of one part, as far as they are there."""
    names = [f"{kind}{axis}" for kind in "FM" for axis in "xyz"]
    return {name: log.frame[f"{name}_{part}"].to_numpy() for name in names if f"{name}_{part}" in log.frame}


def _in_home(
    found: Mapping[str, np.ndarray], log: SolverLog, chosen: LoadChoices, drift_angle: float, steps: list[str]
) -> dict[str, np.ndarray]:
    """Home loads of one part; each step is noted."""
    force = [found.get(f"F{axis}") for axis in "xyz"]
    moment = _moment_at_midship(found, force, log, chosen, steps)
    factor = 1.0
    if chosen.density is not None:
        factor *= chosen.density
        steps.append(f"force / density times {chosen.density:g} kg/m3")
    if chosen.half_model:
        factor *= 2.0
        steps.append("half model: X, Z and M doubled; Y, K and N left out")
    signs = AXES[chosen.axes]
    steps.append(f"axes {chosen.axes} to x forward, y to starboard, z down")
    loads = {
        name: factor * sign * values
        for names, three in ((FORCES, force), (MOMENTS, moment))
        for name, sign, values in zip(names, signs, three)
        if values is not None
    }
    if chosen.hull_turned:
        loads = _into_hull(loads, drift_angle)
        steps.append(f"turned into the hull's axes by the drift angle {math.degrees(drift_angle):g} deg")
    if chosen.half_model:
        loads = {name: values for name, values in loads.items() if name in HALF_MODEL_LOADS}
    return {name: loads[name] for name in LOADS if name in loads}


def _moment_at_midship(
    found: Mapping[str, np.ndarray],
    force: list[np.ndarray | None],
    log: SolverLog,
    chosen: LoadChoices,
    steps: list[str],
) -> list[np.ndarray | None]:
    """Moments about midship in solver axes: M + (point - midship) x F."""
    moment = [found.get(f"M{axis}") for axis in "xyz"]
    if all(values is None for values in moment):
        return moment
    point = chosen.moment_point
    if point is None:
        header = log.vector("CofR")
        point = (header[0], header[1], header[2]) if header is not None and len(header) == 3 else None
    if point is None:
        steps.append("moments taken as they are: no reference point in the file, none given")
        return moment
    lever = np.subtract(point, chosen.midship)
    if not lever.any():
        steps.append("moments are about midship already")
        return moment
    if any(values is None for values in force):
        raise ReadError(
            "moments cannot be moved to midship without all three forces",
            cure="write Fx, Fy and Fz, or give midship at the point that moments are about",
            file=log.files[0] if log.files else None,
        )
    x, y, z = (float(value) for value in lever)
    fx, fy, fz = (np.asarray(values) for values in force)
    shift = (y * fz - z * fy, z * fx - x * fz, x * fy - y * fx)
    steps.append(f"moments moved from {_place(point)} to midship {_place(chosen.midship)}")
    return [None if values is None else values + more for values, more in zip(moment, shift)]


def _into_hull(loads: dict[str, np.ndarray], drift_angle: float) -> dict[str, np.ndarray]:
    """Loads in axes along the track turned by beta: the track runs along (cos beta, -sin beta) of the hull."""
    c, s = math.cos(drift_angle), math.sin(drift_angle)
    turned = dict(loads)
    for along, across in (("X", "Y"), ("K", "M")):
        if along in loads and across in loads:
            turned[along] = c * loads[along] + s * loads[across]
            turned[across] = -s * loads[along] + c * loads[across]
    return turned


def _place(point: Point) -> str:
    return "(" + ", ".join(f"{value:g}" for value in point) + ") m"
