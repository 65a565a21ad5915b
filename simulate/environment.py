"""Current, wind and waves around a ship; each is off unless it is given."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass, replace

import numpy as np

from ..core.errors import TowtankError, TowtankWarning
from ..core.ship import Ship
from .environment_layout import CURRENT_X, CURRENT_Y, HEADER, WAVES_AT, WIND_AT
from .wave_drift import Waves
from .wind import Wind


@dataclass(frozen=True)
class Current:
    """Uniform steady current.

    Attributes
    ----------
    speed : float
        In m/s.
    direction : float
        Direction that it flows to, from x0, positive to starboard, rad.
    """

    speed: float
    direction: float

    def __post_init__(self) -> None:
        if not self.speed >= 0:
            raise TowtankError(
                f"current: a speed of {self.speed} m/s", cure="give its size; the sign is a direction"
            )

    @property
    def velocity(self) -> tuple[float, float]:
        """Velocity of the water over ground along x0 and y0, m/s."""
        return self.speed * math.cos(self.direction), self.speed * math.sin(self.direction)


@dataclass(frozen=True, eq=False)
class Environment:
    """What acts on a ship beside the still water.

    Attributes
    ----------
    current : Current, optional
        Acts through the kinematics alone: hull forces are those of the velocity through the water.
    wind : Wind, optional
    waves : Waves, optional
    """

    current: Current | None = None
    wind: Wind | None = None
    waves: Waves | None = None

    def packed(self, ship: Ship) -> np.ndarray:
        """Flat array for the compiled right-hand side; the layout is that of ``environment_layout``.

        Parameters
        ----------
        ship : Ship
            The ship that sails; areas and coefficients are made dimensional with its particulars.

        Warns
        -----
        TowtankWarning
            For each of :meth:`doubts`.
        """
        for doubt in self.doubts(ship):
            warnings.warn(doubt, TowtankWarning, stacklevel=2)
        header = np.zeros(HEADER)
        blocks = [header]
        place = HEADER
        if self.current is not None:
            header[CURRENT_X], header[CURRENT_Y] = self.current.velocity
        if self.wind is not None:
            table = self.wind.coefficients.table.packed(self.wind.coefficients.units(ship, self.wind.air_density))
            blocks.append(np.concatenate([self.wind.velocity, table]))
            header[WIND_AT] = place
            place += len(blocks[-1])
        if self.waves is not None:
            blocks.append(np.concatenate([[self.waves.direction], self.waves.drift.packed(ship, self.waves)]))
            header[WAVES_AT] = place
        return np.concatenate(blocks)

    def doubts(self, ship: Ship) -> list[str]:
        """Sentences for what lies outside the data: waves beyond the wavelengths of a table."""
        return [] if self.waves is None else self.waves.drift.doubts(ship, self.waves)

    def mirrored(self) -> Environment:
        """The same environment with port and starboard exchanged."""
        return Environment(
            current=None if self.current is None else replace(self.current, direction=-self.current.direction),
            wind=None if self.wind is None else replace(self.wind, direction=-self.wind.direction),
            waves=None if self.waves is None else replace(self.waves, direction=-self.waves.direction),
        )


CALM = Environment()
"""Still air and still water."""
