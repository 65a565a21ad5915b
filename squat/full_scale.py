"""Squat of a ship at sea: satellite antennas and attitude against the tide, the density and the ship at rest.

``sinkage = (keel + water level) - the same at rest - what the density changed``; the speed is that through the water;
the steady part is a centred mean over a minute. Source: full-scale measurements of container ships, 5th MASHCON 2019.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from ..core.variables import GRAVITY
from .hull_points import corner_sinkage, lateral_sinkage, longitudinal_sinkage
from .rtk_antennas import AntennaLayout, AntennaRecord
from .sensor_budget import FROM_THE_SOURCE, Accuracies, SensorBudget, sensor_budget
from .sinkage_layout import SinkageLayout
from .sinkage_record import SinkageRecord
from .speed_through_water import speed_through_water
from .static_reference import StaticReference
from .steady_unsteady import STEADY_WINDOW, split_steady
from .tide import TideTable
from .under_keel import DynamicClearance, dynamic_clearance
from .water_density import density_sinkage

if TYPE_CHECKING:
    import pandas as pd

_ROUNDING = 1e-12
PLACES = ("bow", "stern", "midship", "cog")


@dataclass(frozen=True, eq=False)
class FullScaleSquat:
    """Squat of one voyage.

    Attributes
    ----------
    run : str
    record : SinkageRecord
        Sinkage, trim and heel over time without tide, density and what was there at rest; speed through the water.
        Every reduction of model tests takes it as well.
    steady : SinkageRecord
        Its steady part, nan near the ends and gaps.
    breadth : float
        In m.
    reference : StaticReference
    density : ndarray, shape (n,)
        Sinkage in m that the density brought, positive down; taken out of `record`.
    water_depth : ndarray, shape (n,), or None
        Charted depth and water level in m.
    clearance : DynamicClearance or None
        Of the deepest corner, the motions of the moment included; None without a depth.
    budgets : mapping of str to SensorBudget
        At bow, stern and midship.
    choices : mapping
        What was chosen, for the provenance.
    notes : tuple of str
        What is to be known about the numbers.
    """

    run: str
    record: SinkageRecord
    steady: SinkageRecord
    breadth: float
    reference: StaticReference
    density: np.ndarray
    water_depth: np.ndarray | None
    clearance: DynamicClearance | None
    budgets: Mapping[str, SensorBudget]
    choices: Mapping[str, Any] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def depth_froude_number(self) -> np.ndarray | None:
        """V / sqrt(g h) over time, shape (n,); None without speed or depth."""
        if self.record.speed is None or self.water_depth is None:
            return None
        return np.asarray(self.record.speed / np.sqrt(GRAVITY * self.water_depth))

    @cached_property
    def largest(self) -> dict[str, np.ndarray]:
        """Largest steady sinkage over time in m, each of shape (n,): longitudinal, lateral, corner."""
        of, length = self.steady, self.record.layout.length
        found = {"longitudinal": longitudinal_sinkage(of.midship, of.trim, length)}
        if of.heel is not None:
            found["lateral"] = lateral_sinkage(of.midship, of.heel, self.breadth)
            found["corner"] = corner_sinkage(of.midship, of.trim, of.heel, length, self.breadth)
        return found

    @cached_property
    def frame(self) -> pd.DataFrame:
        """One row a sample; ``attrs["units"]`` has the units.

        Columns: time, speed (through the water), ``sinkage_<place>``, trim, heel, each of these three also with
        ``_steady`` and ``_unsteady``; longitudinal, lateral and corner (largest steady sinkage); density_sinkage;
        water_depth, depth_froude, clearance and clearance_percent. What was not measured has no column.
        """
        import pandas as pd

        record = self.record
        columns: dict[str, np.ndarray] = {"time": record.time}
        units = {"time": "s"}
        if record.speed is not None:
            columns["speed"], units["speed"] = record.speed, "m/s"
        places = {name: x for name, x in record.layout.places.items() if name in PLACES}
        for name in (*(f"sinkage_{place}" for place in places), "trim", "heel"):
            whole, steady = (_quantity(of, name, places) for of in (record, self.steady))
            if whole is None or steady is None:
                continue
            for ending, values in (("", whole), ("_steady", steady), ("_unsteady", whole - steady)):
                columns[name + ending] = values
                units[name + ending] = "m/m" if name in ("trim", "heel") else "m"
        for name, values in (*self.largest.items(), ("density_sinkage", self.density)):
            columns[name], units[name] = values, "m"
        if self.water_depth is not None:
            columns["water_depth"], units["water_depth"] = self.water_depth, "m"
        if self.depth_froude_number is not None:
            columns["depth_froude"], units["depth_froude"] = self.depth_froude_number, "-"
        if self.clearance is not None:
            columns["clearance"], units["clearance"] = self.clearance.clearance, "m"
            columns["clearance_percent"] = self.clearance.percent_of_draught
            units["clearance_percent"] = "% of the draught"
        frame = pd.DataFrame(columns)
        frame.attrs["units"] = units
        return frame

    @cached_property
    def summary(self) -> pd.DataFrame:
        """The extremes of the voyage: quantity, value, at_time (s), speed (m/s), u_rss, u_linear, unit.

        ``u_rss`` is the standard uncertainty of independent sensors and ``u_linear`` the bound when all err to one
        side; nan for what the budget does not speak of.
        """
        import pandas as pd

        ends = max((self.budgets["bow"], self.budgets["stern"]), key=lambda budget: budget.linear)
        sides = {"longitudinal": ends, "lateral": self.budgets["midship"], "corner": ends}
        rows = [
            self._extreme(f"largest steady sinkage, {name}", values, "m", sides[name].rss, sides[name].linear)
            for name, values in self.largest.items()
        ]
        for sense, sign in (("by the bow", 1.0), ("by the stern", -1.0)):
            rows.append(self._extreme(f"largest steady trim {sense}", sign * self.steady.trim, "m/m"))
        if self.steady.heel is not None:
            rows.append(self._extreme("largest steady heel", np.abs(self.steady.heel), "m/m"))
        half = 0.5 * self.record.layout.length
        for name, x in (("bow", half), ("stern", -half)):
            rest = np.abs(self.record.sinkage_at(x) - self.steady.sinkage_at(x))
            rows.append(self._extreme(f"largest unsteady motion, {name}", rest, "m"))
        rows.append(self._extreme("largest density sinkage", self.density, "m"))
        rows.append(self._extreme("largest density rise", -self.density, "m"))
        if self.clearance is not None:
            known = self.clearance
            least = self._extreme("least clearance", -known.clearance, "m", known.uncertainty, known.bound)
            rows.append((least[0], -least[1], *least[2:]))
        return pd.DataFrame(rows, columns=["quantity", "value", "at_time", "speed", "u_rss", "u_linear", "unit"])

    def _extreme(
        self, name: str, values: np.ndarray, unit: str, rss: float = np.nan, linear: float = np.nan
    ) -> tuple[str, float, float, float, float, float, str]:
        if not np.isfinite(values).any():
            return name, np.nan, np.nan, np.nan, rss, linear, unit
        row = int(np.nanargmax(values))
        # What a mean leaves of its own reference is rounding.
        most = float(values[row]) if abs(values[row]) > _ROUNDING else 0.0
        speed = np.nan if self.record.speed is None else float(self.record.speed[row])
        return name, most, float(self.record.time[row]), speed, rss, linear, unit


def reduce_full_scale(
    record: AntennaRecord,
    reference: StaticReference,
    water_level: TideTable,
    *,
    rho: float | np.ndarray | None = None,
    volume: float | None = None,
    waterplane_area: float | None = None,
    current: float | np.ndarray | TideTable = 0.0,
    charted_depth: float | np.ndarray | None = None,
    draught: float | None = None,
    static_trim: float = 0.0,
    u_depth: float = 0.0,
    u_draught: float = 0.0,
    window: float = STEADY_WINDOW,
    accuracies: Accuracies = FROM_THE_SOURCE,
    run: str = "",
) -> FullScaleSquat:
    """Squat of a voyage.

    Parameters
    ----------
    record : AntennaRecord
        Under way.
    reference : StaticReference
        Of the same sensors at rest.
    water_level : TideTable
        Above the datum of the altitudes, along the voyage.
    rho : float or ndarray, shape (n,), optional
        Density of the water under way in kg/m3; that of the reference when not given.
    volume, waterplane_area : float, optional
        Displaced volume in m3 at the reference, and area in m2: needed when `rho` is given.
    current : float, ndarray of shape (n,), or TideTable
        Along the ship in m/s, positive with it.
    charted_depth : float or ndarray, shape (n,), optional
        Depth of the bottom below the datum in m; gives the clearance.
    draught, static_trim : float, optional
        As read at rest, the ship upright: at midship in m, and as a slope positive by the bow. What the sensors
        showed when no draught is given.
    u_depth, u_draught : float
        Standard uncertainties of depth and draught in m.
    window : float
        Length in s of the mean that is called steady.
    accuracies : Accuracies
        Of the sensors.
    run : str
        Name; that of the file when empty.

    Raises
    ------
    FitError
        When the record has no sample, the tables do not cover it, the density lacks the ship's particulars, the
        record is shorter than the window, or a speed is above the critical one of the depth.
    TowtankError
        For an impossible density, current, depth or draught.
    """
    layout, time = record.layout, record.time
    level = water_level.at(time, record.position)
    density = _density(record, reference, rho, volume, waterplane_area)
    midship = record.keel + level - reference.draught - density
    trim = record.trim - reference.trim
    heel = None if record.heel is None else record.heel - reference.heel
    if not np.isfinite(midship + trim).any():
        raise FitError("no sample has altitude and attitude", cure="check the channels", file=record.name or None)
    speed = None
    if record.speed is not None:
        along = current.at(time, record.position) if isinstance(current, TideTable) else current
        speed = speed_through_water(record.speed, along)
    whole = _record(record, layout, midship, trim, heel, speed, ("tide, density and static reference taken out",))
    columns = [midship, trim] if heel is None else [midship, trim, heel]
    parts, _ = split_steady(time, np.column_stack(columns), window)
    steady_heel = None if heel is None else parts[:, 2]
    said = f"mean over {window:g} s"
    steady = _record(record, layout, parts[:, 0], parts[:, 1], steady_heel, speed, (*whole.history, said))
    budgets = _budgets(layout, accuracies)
    water, clearance = None, None
    if charted_depth is not None:
        water = np.broadcast_to(np.asarray(charted_depth, dtype=float), time.shape) + level
        _require_subcritical(record, speed, water)
        clearance = _clearance(
            whole, layout, reference, density, water, draught, static_trim, u_depth, u_draught, budgets
        )
    return FullScaleSquat(
        run or record.name,
        whole,
        steady,
        layout.breadth,
        reference,
        density,
        water,
        clearance,
        budgets,
        {
            "steady mean, s": window,
            "static reference, s": [reference.start, reference.stop],
            "density": "as at rest" if rho is None else "given",
            "draught": "by the sensors" if draught is None else "as read",
            "water level": water_level.name or "constant",
        },
        _notes(record, reference, steady, rho, clearance),
    )


def _density(
    record: AntennaRecord,
    reference: StaticReference,
    rho: float | np.ndarray | None,
    volume: float | None,
    waterplane_area: float | None,
) -> np.ndarray:
    if rho is None:
        return np.zeros(record.time.shape)
    if volume is None or waterplane_area is None:
        raise FitError(
            "a density under way needs the ship's volume and waterplane",
            cure="give volume in m3 and waterplane_area in m2",
            file=record.name or None,
        )
    rises = density_sinkage(volume, waterplane_area, reference.rho, rho)
    return np.array(np.broadcast_to(rises, record.time.shape))


def _require_subcritical(record: AntennaRecord, speed: np.ndarray | None, water: np.ndarray) -> None:
    """No displacement ship outruns its own wave: such a speed is in knots, or the depth in another unit."""
    if speed is None:
        return
    above = np.flatnonzero(speed**2 >= GRAVITY * np.abs(water))
    if above.size:
        row = int(above[0])
        raise FitError(
            f"{speed[row]:.4g} m/s at {record.time[row]:.6g} s is not below the critical speed "
            f"of {water[row]:.4g} m of water",
            cure="check the units of speed and depth",
            file=record.name or None,
        )


def _record(
    record: AntennaRecord,
    layout: AntennaLayout,
    midship: np.ndarray,
    trim: np.ndarray,
    heel: np.ndarray | None,
    speed: np.ndarray | None,
    history: tuple[str, ...],
) -> SinkageRecord:
    home = SinkageLayout(layout.length, heave="sinkage", trim="trim", speed=layout.speed, xG=layout.xG)
    return SinkageRecord(
        record.time,
        midship,
        trim,
        home,
        heel,
        speed,
        misfit=record.misfit,
        findings=record.findings,
        name=record.name,
        sha256=record.sha256,
        history=history,
    )


def _budgets(layout: AntennaLayout, accuracies: Accuracies) -> dict[str, SensorBudget]:
    """Lever from the middle of the antennas; a trim that the antennas themselves tell has the same lever."""
    carried = float(np.mean([antenna.x for antenna in layout.antennas.values()]))
    half = 0.5 * layout.length
    places = {"bow": half, "stern": -half, "midship": 0.0}
    return {name: sensor_budget(x - carried, accuracies) for name, x in places.items()}


def _clearance(
    whole: SinkageRecord,
    layout: AntennaLayout,
    reference: StaticReference,
    density: np.ndarray,
    water: np.ndarray,
    draught: float | None,
    static_trim: float,
    u_depth: float,
    u_draught: float,
    budgets: Mapping[str, SensorBudget],
) -> DynamicClearance:
    """Of the deepest corner; trim and heel at rest are part of how deep it lies, and no part of squat."""
    at_rest = reference.draught if draught is None else draught
    trim = whole.trim + (reference.trim if draught is None else static_trim)
    heel = np.zeros_like(trim) if whole.heel is None else whole.heel + (reference.heel if draught is None else 0.0)
    deepest = corner_sinkage(whole.midship + density, trim, heel, layout.length, layout.breadth)
    worst = max(budget.rss for budget in budgets.values())
    return dynamic_clearance(water, at_rest, deepest, u_depth=u_depth, u_draught=u_draught, u_sinkage=worst)


def _notes(
    record: AntennaRecord,
    reference: StaticReference,
    steady: SinkageRecord,
    rho: float | np.ndarray | None,
    clearance: DynamicClearance | None,
) -> tuple[str, ...]:
    notes = list(reference.notes)
    if rho is None:
        notes.append("no density under way was given: a change of draught with density counts as squat")
    if record.heel is None:
        notes.append("the heel was not measured: nothing is known beside the centre line")
    if record.speed is None:
        notes.append("the speed was not recorded")
    missing = int(np.count_nonzero(~np.isfinite(steady.midship)))
    notes.append(
        f"{missing} of {record.time.size} samples lie within half a mean of an end or gap: no steady value"
    )
    if clearance is not None and clearance.touches().any():
        notes.append("the clearance is gone at times: check depth, datum and draught")
    return tuple(notes)


def _quantity(of: SinkageRecord, name: str, places: Mapping[str, float]) -> np.ndarray | None:
    if name == "trim":
        return of.trim
    return of.heel if name == "heel" else of.sinkage_at(places[name.removeprefix("sinkage_")])
