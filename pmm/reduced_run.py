"""What a run becomes: means or harmonics of the hydrodynamic forces, with the motion that belongs to them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from ..core.conventions import Conventions
from ..core.findings import Finding
from ..core.motion import scaled_state
from ..core.ship import Ship
from ..core.terms import Factor, Term
from ..identify.harmonic_basis import HarmonicProjector
from .planar_motion import PlanarMotion
from .run_types import Run

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

    def state(self) -> dict[str, float]:
        """Mean non-dimensional state of the run: v, r, beta, phi, delta, eta."""
        times = self.window.times if self.order else np.array([self.window.start])
        values, _ = scaled_state(
            self.motion.at(times), self.ship, Conventions(velocity_scale=self.velocity_scale), self.motion.speed
        )
        return {name: float(np.mean(value)) for name, value in values.items()}


def project_terms(
    motion: PlanarMotion,
    window: Window,
    order: int,
    terms: Iterable[Term],
    ship: Ship,
    velocity_scale: str,
    projector: HarmonicProjector | None = None,
    at: Mapping[str, np.ndarray] | None = None,
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
    at : mapping, optional
        Motion at the window's times, when it is there already.
    """
    steady = order == 0
    times = np.array([window.start]) if steady else window.times
    if at is None or steady:
        at = motion.at(times)
    state, _ = scaled_state(at, ship, Conventions(velocity_scale=velocity_scale), motion.speed)
    unique = {term.factors: term for term in terms}
    values = np.empty((len(times), len(unique)))
    for column, term in enumerate(unique.values()):
        values[:, column] = term.sign * term.column(state)
    if not steady:
        projector = projector or HarmonicProjector(times, motion.omega, order)
        values = projector.project(values)
    return {factors: values[:, column] for column, factors in enumerate(unique)}
