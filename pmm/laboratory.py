"""How a virtual laboratory runs its carriage, and what its channels mean."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from ..core.conventions import HOME, Conventions
from ..core.errors import CampaignError
from ..core.motion import origin_position
from ..core.ship import Ship
from .rigid_body import RigidBody
from .run_types import Run


@dataclass(frozen=True)
class Laboratory:
    """How a virtual laboratory runs its carriage and what its channels mean.

    Attributes
    ----------
    conventions : Conventions
        Axes, origin of velocities and moments, force sign, and the signs and angle unit of the test matrix.
    moment_x : float, optional
        Point that the yaw moment is about, m forward of midship; the origin of `conventions` when not given.
    position_x : float, optional
        Point that follows the prescribed path, m forward of midship; the origin when not given.
    inertia : RigidBody, optional
        Model and mount, when their inertia is in the forces.
    balance_zero : mapping of str to float
        Reading of each channel at rest in N or Nm (home axes), the same in every run; a zero run is added.
    sampling_rate : float
        Samples a second.
    duration : float
        Length in s of the part of a steady run at constant speed.
    cycles : int
        Cycles of an oscillating run at full amplitude.
    rest, ramp : float
        Length in s of the rest and of the acceleration before a steady run, and of braking and rest after it.
    startup_cycles : int
        Cycles in which an oscillation grows to its full amplitude.
    """

    conventions: Conventions = HOME
    moment_x: float | None = None
    position_x: float | None = None
    inertia: RigidBody | None = None
    balance_zero: Mapping[str, float] = field(default_factory=dict)
    sampling_rate: float = 20.0
    duration: float = 30.0
    cycles: int = 5
    rest: float = 0.0
    ramp: float = 0.0
    startup_cycles: int = 0

    def __post_init__(self) -> None:
        for name in ("sampling_rate", "duration", "cycles"):
            if not getattr(self, name) > 0:
                raise CampaignError(f"{name} = {getattr(self, name)} is not positive", place=f"laboratory.{name}")
        for name in ("rest", "ramp", "startup_cycles"):
            if getattr(self, name) < 0:
                raise CampaignError(f"{name} = {getattr(self, name)} is negative", place=f"laboratory.{name}")
        if self.rest and not self.ramp:
            raise CampaignError(
                "a carriage at rest needs time to accelerate", cure="give ramp in s", place="laboratory.ramp"
            )

    def moment_point(self, ship: Ship) -> float:
        """Point that the yaw moment is about, m forward of midship."""
        return origin_position(self.conventions, ship) * ship.L if self.moment_x is None else self.moment_x

    def path_point(self, ship: Ship) -> float:
        """Point that follows the prescribed path, m forward of midship."""
        return origin_position(self.conventions, ship) * ship.L if self.position_x is None else self.position_x

    def times(self, run: Run | None = None) -> np.ndarray:
        """Time in s of the samples of a run, or of the zero run."""
        length = self.duration
        if run is not None and run.harmonic:
            length = (self.startup_cycles + self.cycles) * run.period
        elif run is not None:
            length += 2.0 * (self.rest + self.ramp)
        return np.arange(max(math.ceil(length * self.sampling_rate - 1e-9), 2)) / self.sampling_rate


STANDARD_LABORATORY = Laboratory()
"""Home axes, 20 samples a second, 30 s of steady run, 5 cycles, no transients, no inertia in the forces."""
