"""What a run becomes: means or harmonics of the hydrodynamic forces, with the motion that belongs to them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.conventions import Conventions
from ..core.findings import Finding
from ..core.motion import scaled_state
from ..core.ship import Ship
from ..core.terms import Factor, Term
from ..core.variables import GRAVITY
from ..identify.harmonics import HarmonicProjector
from .planar_motion import PlanarMotion
from .run_types import Run
from .time_rows import TimeRows
from .window_motion import WindowMotion

FORCES = ("X", "Y", "N", "K")


@dataclass(frozen=True)
class Window:
    """Samples of a run that were used.

    Attributes
    ----------
    start : float
        Time of the first sample in s.
    step : float
        Sampling interval in s.
    count : int
        Number of samples; 1 for an already reduced point.
    note : str
        How the window was found.
    """

    start: float
    step: float
    count: int
    note: str = ""

    @property
    def stop(self) -> float:
        """Time of the last sample in s."""
        return self.start + (self.count - 1) * self.step

    @property
    def times(self) -> np.ndarray:
        """Times of the samples, shape (count,)."""
        return self.start + self.step * np.arange(self.count)


@dataclass(frozen=True, eq=False)
class ReducedRun:
    """One run after reduction, in home axes and signs about midship.

    Attributes
    ----------
    run : Run
    ship : Ship
        The ship in this run's water depth.
    motion : PlanarMotion
    window : Window
    order : int
        Highest harmonic; 0 for steady runs.
    forces : mapping of str to ndarray, shape (2 order + 1,)
        Hydrodynamic force in N and N m: mean, cos 1, sin 1, cos 2, ... (about w t).
    scaled : mapping of str to ndarray, shape (2 order + 1,)
        The same for the force over ``0.5 rho L T U**2`` (moments with another L), U at each moment as the
        campaign's velocity scale says.
    scaled_sd : mapping of str to ndarray, shape (2 order + 1,)
        Standard error of `scaled` from the noise within the run.
    noise_dof : mapping of str to ndarray
        Degrees of freedom behind `scaled_sd`.
    residual_sd : mapping of str to float
        Standard deviation in N of what mean and harmonics leave.
    velocity_scale : str
    steps : tuple of str
        What was done, in order.
    findings : tuple of Finding
    sha256 : str
    series : mapping of str to ndarray
        Force series of the window in N for the report; kept for a few runs only.
    zero_sd : mapping of str to float
        Standard error in N of the zero level that was subtracted; all runs with this zero share the error.
    speed_given : bool
        False for a non-dimensional point whose speed is not known; it then has a unit speed.
    samples : TimeRows or None
        All samples of the window, condensed for a fit in the time domain.
    ranges : mapping of str to (float, float)
        What :meth:`reach` gives, when it is known already.
    """

    run: Run
    ship: Ship
    motion: PlanarMotion
    window: Window
    order: int
    forces: Mapping[str, np.ndarray]
    scaled: Mapping[str, np.ndarray]
    scaled_sd: Mapping[str, np.ndarray]
    noise_dof: Mapping[str, np.ndarray] = field(default_factory=dict)
    residual_sd: Mapping[str, float] = field(default_factory=dict)
    velocity_scale: str = "instantaneous"
    steps: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    sha256: str = ""
    series: Mapping[str, np.ndarray] = field(default_factory=dict)
    zero_sd: Mapping[str, float] = field(default_factory=dict)
    speed_given: bool = True
    samples: TimeRows | None = None
    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict, repr=False)
    columns: dict[tuple[Factor, ...], np.ndarray] = field(default_factory=dict, repr=False)

    @property
    def name(self) -> str:
        """Name of the run."""
        return self.run.name

    def design(self, terms: Sequence[Term]) -> np.ndarray:
        """Mean and harmonics of each term's column over the window's own samples, shape (2 order + 1, p).

        The forces went through the same projection, so a truncated harmonic series does not bias the fit.
        """
        missing = [term for term in terms if term.factors not in self.columns]
        if missing:
            self.columns.update(
                project_terms(self.motion, self.window, self.order, missing, self.ship, self.velocity_scale)
            )
        if not terms:
            return np.zeros((2 * self.order + 1, 0))
        return np.column_stack([term.sign * self.columns[term.factors] for term in terms])

    def force_rows(
        self, component: str, terms: Sequence[Term]
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Regression rows of one component: design, response, standard errors, their dof, harmonic numbers.

        In the time domain there are as many rows as condensed columns, numbered -1, -2, ...
        """
        if self.samples is None:
            size = len(self.scaled[component])
            dof = self.noise_dof.get(component, np.full(size, np.inf))
            return self.design(terms), self.scaled[component], self.scaled_sd[component], dof, np.arange(size)
        design, response = self.samples.rows(component, terms)
        size = len(response)
        lowest = float(np.min(self.noise_dof[component]))
        return (
            design,
            response,
            self.samples.sd[component],
            np.full(size, lowest),
            -1 - np.arange(size),
        )

    def reach(self) -> Mapping[str, tuple[float, float]]:
        """Smallest and largest value of each non-dimensional variable, and of ``Fn`` where the speed is known."""
        if self.ranges:
            return self.ranges
        count = 24 if self.order else 1
        period = self.run.period if self.order else 0.0
        at = self.motion.at(self.window.start + period * np.arange(count) / count)
        found = motion_ranges(at, self.ship, self.velocity_scale, self.motion.speed)
        return found if self.speed_given else {name: one for name, one in found.items() if name != "Fn"}

    def state(self) -> dict[str, float]:
        """Mean non-dimensional state of the run: v, r, beta, phi, delta, eta."""
        times = self.window.times if self.order else np.array([self.window.start])
        values, _ = scaled_state(
            self.motion.at(times), self.ship, Conventions(velocity_scale=self.velocity_scale), self.motion.speed
        )
        return {name: float(np.mean(value)) for name, value in values.items()}


def motion_ranges(
    at: Mapping[str, np.ndarray], ship: Ship, velocity_scale: str, approach_speed: float
) -> dict[str, tuple[float, float]]:
    """Smallest and largest value of each non-dimensional variable of a motion, and of the Froude number ``Fn``."""
    state, speed = scaled_state(at, ship, Conventions(velocity_scale=velocity_scale), approach_speed)
    state["Fn"] = speed / math.sqrt(GRAVITY * ship.L)
    return {name: (float(np.min(values)), float(np.max(values))) for name, values in state.items()}


def project_terms(
    motion: PlanarMotion,
    window: Window,
    order: int,
    terms: Iterable[Term],
    ship: Ship,
    velocity_scale: str,
    projector: HarmonicProjector | None = None,
) -> dict[tuple[Factor, ...], np.ndarray]:
    """Mean and harmonics of each product of factors over a window.

    Parameters
    ----------
    motion, window, order
        As in :class:`ReducedRun`.
    terms : iterable of Term
    ship : Ship
    velocity_scale : {"instantaneous", "approach"}
    projector : HarmonicProjector, optional
        That of the window, when it is there already.
    """
    terms, times = tuple(terms), window.times if order else np.array([window.start])
    if order and projector is None:
        projector = HarmonicProjector(times, motion.omega, order)
    over = WindowMotion(motion, times, projector if order else None)
    return over.projections(lambda at: term_columns(at, terms, ship, velocity_scale, motion.speed))


def term_columns(
    at: Mapping[str, np.ndarray], terms: Iterable[Term], ship: Ship, velocity_scale: str, approach_speed: float
) -> dict[tuple[Factor, ...], np.ndarray]:
    """Product of factors of each term at every sample of a motion (sign of the term left out)."""
    terms = tuple(terms)
    wanted = {variable for term in terms for variable in term.variables}
    state, _ = scaled_state(
        at, ship, Conventions(velocity_scale=velocity_scale), approach_speed, only=wanted or {"v"}
    )
    return {term.factors: term.sign * term.column(state) for term in terms}
