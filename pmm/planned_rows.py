"""Regression rows that a run will give, with the noise that is to be expected on them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core.errors import CampaignError
from ..core.scales import force_unit
from ..core.ship import Ship
from ..core.terms import Term
from ..identify.design_optimality import run_information
from ..identify.harmonics import HarmonicProjector, whole_cycle_window
from .laboratory import Laboratory
from .noise import Noise
from .planar_motion import prescribed_motion
from .reduced_run import FORCES, Window, project_terms
from .run_types import Run


@dataclass(frozen=True)
class RowNoise:
    """How runs are made and reduced, and how noisy their means and harmonics are.

    Attributes
    ----------
    ship : Ship
    laboratory : Laboratory
    velocity_scale : {"instantaneous", "approach"}
    harmonics : int
        Highest harmonic that is used of an oscillating run.
    fraction : tuple of float
        Part of a steady run that is averaged.
    noise : Noise or mapping of str to float
        Noise of the balance, or the standard deviation of one mean or harmonic of each channel.
    reference : mapping of str to float
        Reference force of each channel in N and Nm, when `noise` is a :class:`Noise`.
    si : bool
        True when the standard deviations of a mapping are in N and Nm, else they are scaled with L T.
    """

    ship: Ship
    laboratory: Laboratory
    velocity_scale: str
    harmonics: int
    fraction: tuple[float, float]
    noise: Noise | Mapping[str, float]
    reference: Mapping[str, float]
    si: bool = False

    def size(self, component: str) -> float:
        """Unit of the noise of a component at midship, N or Nm."""
        if not isinstance(self.noise, Noise):
            return float(self.noise[component])
        own = float(self.reference[component])
        lever = self.laboratory.moment_point(self.ship)
        if component == "N" and lever:
            # The moment is moved to midship with the measured side force.
            return math.hypot(own, lever * float(self.reference["Y"]))
        return own

    def require(self, components: Sequence[str]) -> None:
        """Raise :class:`CampaignError` when the noise of a component is not known or not positive."""
        for name in components:
            known = self.reference if isinstance(self.noise, Noise) else self.noise
            if not known.get(name, 0.0) > 0:
                raise CampaignError(
                    f"the noise of {name} is not known",
                    cure=f"give a positive number for {name}",
                    place="reference" if isinstance(self.noise, Noise) else "noise",
                )
        if isinstance(self.noise, Noise) and float(self.noise.density(np.zeros(1))[0]) <= 0:
            raise CampaignError(
                "without random noise there is nothing to plan", cure="give noise.white or noise.ar1"
            )


@dataclass(frozen=True, eq=False)
class PlannedRows:
    """Rows of one run.

    Attributes
    ----------
    run : Run
    duration : float
        Length of the whole record in s.
    window : slice
        Samples that are used.
    projector : HarmonicProjector or None
        Of an oscillating run.
    unit : mapping of str to ndarray
        N or Nm in one unit of each scaled force, at the samples that are used.
    places : mapping of str to ndarray of int
        Places of each component's terms among all.
    design : mapping of str to ndarray, shape (n, k)
        Term columns of each component.
    covariance : mapping of str to ndarray, shape (n, n)
        Covariance of the scaled means or harmonics.
    """

    run: Run
    duration: float
    window: slice
    projector: HarmonicProjector | None
    unit: Mapping[str, np.ndarray]
    places: Mapping[str, np.ndarray]
    design: Mapping[str, np.ndarray]
    covariance: Mapping[str, np.ndarray]

    @cached_property
    def whitened(self) -> dict[str, np.ndarray]:
        """Term columns for rows of unit variance, by component, shape (n, k)."""
        return {
            name: np.linalg.solve(np.linalg.cholesky(self.covariance[name]), design)
            for name, design in self.design.items()
        }

    @cached_property
    def information(self) -> np.ndarray:
        """Information about all terms, shape (p, p)."""
        p = sum(len(places) for places in self.places.values())
        total = np.zeros((p, p))
        for name, places in self.places.items():
            total[np.ix_(places, places)] = run_information(self.whitened[name])
        return total

    def reduce(self, component: str, force: np.ndarray) -> np.ndarray:
        """Scaled mean or harmonics of a force in N or Nm, given over the whole record."""
        scaled = np.asarray(force)[self.window] / self.unit[component]
        return np.array([scaled.mean()]) if self.projector is None else self.projector.project(scaled)


def planned_rows(run: Run, terms: Sequence[Term], plan: RowNoise) -> PlannedRows:
    """Rows that a run will give.

    Parameters
    ----------
    run : Run
    terms : sequence of Term
    plan : RowNoise
    """
    laboratory = plan.laboratory
    time = laboratory.times(run)
    window = _window(run, time, plan)
    used = time[window]
    motion = prescribed_motion(run, laboratory.path_point(plan.ship))
    at = motion.at(used)
    speed = np.full(len(used), run.speed)
    if plan.velocity_scale == "instantaneous":
        speed = np.hypot(at["surge"], at["v"])
    order = plan.harmonics if run.harmonic else 0
    projector = HarmonicProjector(used, run.frequency, order) if order else None
    span = Window(float(used[0]), 1.0 / laboratory.sampling_rate, len(used))
    columns = project_terms(motion, span, order, terms, plan.ship, plan.velocity_scale, projector)
    places = {
        name: np.array([i for i, term in enumerate(terms) if term.component == name], dtype=int)
        for name in FORCES
        if any(term.component == name for term in terms)
    }
    unit = {name: force_unit(name, "LT", plan.ship, 1.0) * speed**2 for name in places}
    design = {
        name: np.column_stack([terms[i].sign * columns[terms[i].factors] for i in own])
        for name, own in places.items()
    }
    covariance = {name: _covariance(plan, name, len(time), window, projector, unit[name]) for name in places}
    return PlannedRows(
        run, len(time) / laboratory.sampling_rate, window, projector, unit, places, design, covariance
    )


def _window(run: Run, time: np.ndarray, plan: RowNoise) -> slice:
    laboratory = plan.laboratory
    if run.harmonic:
        return whole_cycle_window(time, run.frequency, skip_cycles=laboratory.startup_cycles)
    begin = laboratory.rest + laboratory.ramp
    first, last = np.searchsorted(time, [begin - 1e-9, begin + laboratory.duration - 1e-9])
    low, high = plan.fraction
    return slice(first + math.ceil(low * (last - first)), first + math.ceil(high * (last - first)))


def _covariance(
    plan: RowNoise,
    component: str,
    length: int,
    window: slice,
    projector: HarmonicProjector | None,
    unit: np.ndarray,
) -> np.ndarray:
    """Covariance of the scaled mean or harmonics of one component."""
    p = 1 if projector is None else 2 * projector.order + 1
    size = plan.size(component)
    if not isinstance(plan.noise, Noise):
        scale = 1.0 / float(unit.mean()) if plan.si else 1.0
        return np.eye(p) * (size * scale) ** 2
    # The noise is scaled with the speed of each moment, so its mean square counts.
    scale = size * math.sqrt(float(np.mean(1.0 / unit**2)))
    n = window.stop - window.start
    harmonic = (np.arange(p) + 1) // 2
    gram = np.eye(1) / n if projector is None else projector.inverse_gram
    step = 0.0 if projector is None else projector.omega * projector.time_step / (2.0 * math.pi)
    root = np.sqrt(plan.noise.density(harmonic * step))
    total = gram * np.outer(root, root)
    ramp = np.linspace(0.0, 1.0, length)[window]
    slope = np.array([ramp.mean()]) if projector is None else projector.project(ramp)
    total = total + plan.noise.drift**2 * np.outer(slope, slope)
    total[0, 0] += plan.noise.offset**2
    return scale**2 * total
