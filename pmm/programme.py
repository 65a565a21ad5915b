"""Planning of a test programme: what each derivative will be known to, before a single run is made.

The rows of a run are those of the fit: the mean of a steady run, mean and harmonics of an oscillating run over
whole cycles of the exact kinematics. Their noise follows from that of the balance and the length of the record.
Information adds up over runs (Fedorov 1972).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.conventions import Conventions
from ..core.derivative_set import DerivativeSet
from ..core.errors import CampaignError, FitError, TermError
from ..core.ship import Ship
from ..core.terms import Term, parse_terms
from ..identify.collinearity import exact_dependencies, inseparable_terms, scaled_svd, variance_inflation
from .laboratory import STANDARD_LABORATORY, Laboratory
from .noise import Noise, reference_forces
from .planned_rows import PlannedRows, RowNoise, planned_rows
from .run_types import Run
from .virtual_records import EXCITED, as_measured, sets_by_depth, virtual_run

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class Programme:
    """A test programme and what it will yield.

    Attributes
    ----------
    terms : tuple of Term
    values : ndarray, shape (p,)
        Expected coefficients, scaled with L T in home axes; NaN when only terms were given.
    ship : Ship
    conventions : Conventions
        Of the values and standard errors.
    runs : tuple of Run
    noise : RowNoise
        Noise of the rows, for further runs.
    rows : tuple of PlannedRows
        One a run.
    bias : ndarray, shape (p, p)
        Covariance of what all runs share (gain of the balance); repeats do not reduce it.
    """

    terms: tuple[Term, ...]
    values: np.ndarray
    ship: Ship
    conventions: Conventions
    runs: tuple[Run, ...]
    noise: RowNoise
    rows: tuple[PlannedRows, ...]
    bias: np.ndarray

    @property
    def names(self) -> list[str]:
        """Names of the terms, in order."""
        return [term.name for term in self.terms]

    @cached_property
    def run_information(self) -> np.ndarray:
        """Information of each run, shape (runs, p, p)."""
        return np.array([rows.information for rows in self.rows])

    @cached_property
    def information(self) -> np.ndarray:
        """Information of the programme, shape (p, p)."""
        return self.run_information.sum(axis=0)

    @cached_property
    def components(self) -> dict[str, ComponentOutlook]:
        """What each force component will yield."""
        return {name: _outlook(self, name) for name in dict.fromkeys(term.component for term in self.terms)}

    @cached_property
    def covariance(self) -> np.ndarray:
        """Covariance from noise, shape (p, p); inf for a term that cannot be found."""
        joint = np.zeros((len(self.terms),) * 2)
        for part in self.components.values():
            joint[np.ix_(part.positions, part.positions)] = part.covariance
        return joint

    @property
    def standard_errors(self) -> np.ndarray:
        """Expected standard errors, noise and shared bias together, shape (p,)."""
        return np.sqrt(np.diag(self.covariance) + np.diag(self.bias))

    @property
    def inseparable(self) -> list[tuple[str, ...]]:
        """Groups of terms that the programme cannot tell apart."""
        return [group for part in self.components.values() for group in part.inseparable]

    @property
    def not_excited(self) -> list[str]:
        """Terms that no run excites."""
        return [name for part in self.components.values() for name in part.not_excited]

    @property
    def duration(self) -> float:
        """Length of all records together in s."""
        return sum(rows.duration for rows in self.rows)

    def position(self, name: str) -> int:
        """Position of a term.

        Raises
        ------
        TermError
            When the programme does not have it.
        """
        if name not in self.names:
            raise TermError(f"the programme has no '{name}'", cure=f"it has {', '.join(self.names)}")
        return self.names.index(name)

    def to_frame(self) -> pd.DataFrame:
        """Table with columns name, value, std, std_noise, std_shared, relative_percent, VIF, note."""
        import pandas as pd

        error = self.standard_errors
        with np.errstate(divide="ignore", invalid="ignore"):
            relative = 100.0 * error / np.abs(self.values)
        inflation = np.full(len(self.terms), np.nan)
        notes = [""] * len(self.terms)
        for part in self.components.values():
            inflation[part.positions] = part.vif
        for name in self.not_excited:
            notes[self.position(name)] = "no run excites it"
        for group in self.inseparable:
            for name in group:
                others = ", ".join(other for other in group if other != name)
                notes[self.position(name)] = f"hard to separate from {others}"
        return pd.DataFrame(
            {
                "name": self.names,
                "value": self.values,
                "std": error,
                "std_noise": np.sqrt(np.diag(self.covariance)),
                "std_shared": np.sqrt(np.diag(self.bias)),
                "relative_percent": relative,
                "VIF": inflation,
                "note": notes,
            }
        )

    def summary(self) -> str:
        """Text table of the expected standard errors."""
        condition = ", ".join(f"{name} {part.condition_number:.3g}" for name, part in self.components.items())
        head = [
            f"{len(self.runs)} runs, {self.duration:.0f} s of records; condition number {condition}",
            f"{'name':<12}{'value':>12}{'std':>12}{'std / value':>13}{'VIF':>9}  note",
        ]
        lines = [
            f"{row.name:<12}{row.value:>12.5g}{row.std:>12.3g}{row.relative_percent:>11.3g} %{row.VIF:>9.3g}"
            f"  {row.note}"
            for row in self.to_frame().itertuples(index=False)
        ]
        return "\n".join(line.rstrip() for line in [*head, *lines])

    def expected_set(self, name: str = "expected") -> DerivativeSet:
        """The set that the programme is expected to give, with its covariance.

        Raises
        ------
        FitError
            When values are not known or a term cannot be found.
        """
        lost = [n for n, error in zip(self.names, self.standard_errors) if not math.isfinite(error)]
        if lost:
            raise FitError(f"the programme does not determine {', '.join(lost)}", cure="add runs that do")
        if np.isnan(self.values).any():
            raise FitError("the expected values are not known", cure="plan with a derivative set")
        return DerivativeSet(
            name, self.ship, self.terms, self.values, self.conventions, covariance=self.covariance + self.bias
        )


@dataclass(frozen=True, eq=False)
class ComponentOutlook:
    """What a programme will yield for one force component.

    Attributes
    ----------
    positions : ndarray of int
        Places of its terms among all.
    covariance : ndarray, shape (k, k)
        From noise; inf on the diagonal and 0 beside it for a term that cannot be found.
    vif : ndarray, shape (k,)
    condition_number : float
        Of the excited terms, columns scaled to unit length.
    not_excited : tuple of str
    inseparable : tuple of tuple of str
    """

    positions: np.ndarray
    covariance: np.ndarray
    vif: np.ndarray
    condition_number: float
    not_excited: tuple[str, ...]
    inseparable: tuple[tuple[str, ...], ...]


def plan(
    derivatives: DerivativeSet | Sequence[Term | str],
    runs: Sequence[Run],
    noise: Noise | Mapping[str, float],
    *,
    ship: Ship | None = None,
    laboratory: Laboratory = STANDARD_LABORATORY,
    reference: Mapping[str, float] | None = None,
    si: bool = False,
    harmonics: int = 3,
    fraction: tuple[float, float] = (0.30, 0.95),
    velocity_scale: str | None = None,
) -> Programme:
    """What a test programme will yield.

    Parameters
    ----------
    derivatives : DerivativeSet, or sequence of Term or str
        Terms to be found. A set gives their expected sizes too, brought into the form of a fit: scaled with L T,
        home axes about midship, added-mass Coriolis terms inside.
    runs : sequence of Run
        Runs in one water depth; runs in air are left out.
    noise : Noise, or mapping of str to float
        Noise of the balance; or the standard deviation of one mean or harmonic of each channel.
    ship : Ship, optional
        Needed when only terms are given.
    laboratory : Laboratory
        Sampling, length of the runs, and the point that moments are about.
    reference : mapping of str to float, optional
        Reference forces of `noise` in N and Nm; the largest force of each channel in the programme, as the set
        has it, when not given.
    si : bool
        True when the standard deviations of a mapping are in N and Nm, else they are scaled with L T.
    harmonics : int
        Highest harmonic that the fit will use.
    fraction : tuple of float
        Part of a steady run that will be averaged.
    velocity_scale : {"instantaneous", "approach"}, optional
        Speed that scales the forces in the fit; that of the set when not given.

    Raises
    ------
    CampaignError
        When there is no run, runs differ in depth, or the noise of a channel is not known.
    FitError
        When a run is too short for the harmonics.
    """
    wet = tuple(run for run in runs if not run.dry)
    if not wet:
        raise CampaignError("there is no run to plan with", cure="give a test matrix")
    depths = {run.depth for run in wet}
    if len(depths) > 1:
        raise CampaignError("the runs differ in water depth", cure="plan the runs of each depth by themselves")
    if isinstance(derivatives, DerivativeSet):
        own = derivatives.conventions
        home = Conventions(
            velocity_scale=velocity_scale or own.velocity_scale,
            sway_variable=own.sway_variable,
            added_mass_coriolis="inside",
            scale=own.scale,
        )
        expected = as_measured(derivatives).to(home)
        terms, values, ship = expected.terms, np.asarray(expected.values), expected.ship
    else:
        terms, values = parse_terms(derivatives), np.full(len(derivatives), np.nan)
        home = Conventions(velocity_scale=velocity_scale or "instantaneous", added_mass_coriolis="inside")
        expected = None
    if ship is None:
        raise CampaignError("the ship is not known", cure="give ship, or a derivative set")
    if reference is None and isinstance(noise, Noise) and expected is not None:
        sets = sets_by_depth(expected)
        reference = reference_forces(virtual_run(sets, run, laboratory).forces for run in wet)
    setting = RowNoise(ship, laboratory, home.velocity_scale, harmonics, fraction, noise, reference or {}, si)
    setting.require(sorted({term.component for term in terms}))
    rows = tuple(planned_rows(run, terms, setting) for run in wet)
    programme = Programme(terms, values, ship, home, wet, setting, rows, np.zeros((len(terms),) * 2))
    if isinstance(noise, Noise) and noise.gain_bias and expected is not None:
        return replace(programme, bias=_gain_covariance(programme, expected, noise.gain_bias))
    return programme


def _gain_covariance(programme: Programme, expected: DerivativeSet, gain_bias: float) -> np.ndarray:
    """Covariance of the coefficients from a gain error of each channel that all runs share.

    A gain error adds its share of the reading, inertia and moment arm included, to every row.
    """
    laboratory, ship = programme.noise.laboratory, programme.ship
    sets = sets_by_depth(expected)
    lever = laboratory.moment_point(ship)
    effects: dict[str, np.ndarray] = {}
    for rows in programme.rows:
        reading = virtual_run(sets, rows.run, laboratory).forces
        for component, places in rows.places.items():
            sources = {component: reading[component]}
            if component == "N" and lever:
                sources["Y"] = lever * reading["Y"]
            weighted = np.linalg.solve(rows.covariance[component], rows.design[component]).T
            for source, force in sources.items():
                effect = effects.setdefault(source, np.zeros(len(programme.terms)))
                effect[places] += weighted @ rows.reduce(component, force)
    covariance = np.where(np.isfinite(programme.covariance), programme.covariance, 0.0)
    total = np.zeros_like(covariance)
    for effect in effects.values():
        change = gain_bias * (covariance @ effect)
        total += np.outer(change, change)
    return total


def _outlook(programme: Programme, component: str) -> ComponentOutlook:
    positions = programme.rows[0].places[component]
    design = np.vstack([rows.design[component] for rows in programme.rows])
    white = np.vstack([rows.whitened[component] for rows in programme.rows])
    names = [programme.terms[i].name for i in positions]
    excited = np.abs(design).max(axis=0, initial=0.0) > EXCITED
    covariance = np.diag(np.full(len(names), np.inf))
    vif = np.full(len(names), np.inf)
    live = np.flatnonzero(excited)
    dead = tuple(name for name, on in zip(names, excited) if not on)
    if not live.size:
        return ComponentOutlook(positions, covariance, vif, math.nan, dead, ())
    alive = [names[i] for i in live]
    svd, _ = scaled_svd(white[:, live], len(white), alive)
    lost = {name for group in exact_dependencies(svd, alive) for name in group}
    found = np.array([place for place, name in enumerate(alive) if name not in lost], dtype=int)
    right = svd.right[:, : svd.rank] / svd.singular[: svd.rank] / svd.scale[:, None]
    block = right @ right.T
    kept = live[found]
    covariance[np.ix_(kept, kept)] = block[np.ix_(found, found)]
    constant = np.flatnonzero((np.ptp(design, axis=0) == 0.0) & excited)
    level = white[:, constant[0]] if constant.size else np.ones(len(white))
    columns = white[:, kept]
    vif[kept] = variance_inflation(
        np.diag(block)[found], (columns**2).sum(axis=0), level @ columns, float(level @ level), bool(constant.size)
    )
    groups = tuple(tuple(name for name in alive if name in group) for group in inseparable_terms(svd, alive))
    return ComponentOutlook(positions, covariance, vif, svd.condition_number, dead, groups)
