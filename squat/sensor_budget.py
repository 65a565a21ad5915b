"""What the sensors of a full-scale measurement leave uncertain: each contribution, their sum and their root of squares.

The linear sum is the bound when all contributions err to one side, as the source states its accuracies; the root sum
of squares is the standard uncertainty of independent ones. Source: full-scale measurements of container ships,
5th MASHCON 2019.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True)
class Accuracies:
    """Accuracies of the sensors; those of the source when not given.

    Attributes
    ----------
    altitude : float
        Of an antenna by real-time kinematics in m.
    geodetic : float
        Separation of ellipsoid and datum of the water levels in m.
    water_level : float
        Of tide tables with gauges in m.
    pitch : float
        Of a fibre-optic gyro in rad.
    """

    altitude: float = 0.03
    geodetic: float = 0.02
    water_level: float = 0.05
    pitch: float = math.radians(0.01)


FROM_THE_SOURCE = Accuracies()


@dataclass(frozen=True)
class Component:
    """One contribution.

    Attributes
    ----------
    name : str
    size : float
        In m for a length, in rad for an angle; not negative.
    kind : {"length", "angle"}
        An angle counts with the lever.
    """

    name: str
    size: float
    kind: Literal["length", "angle"] = "length"

    def __post_init__(self) -> None:
        if not (self.size >= 0.0 and math.isfinite(self.size)):
            raise TowtankError(
                f"an uncertainty of {self.size:g} is impossible", cure="give its size", place=self.name
            )


@dataclass(frozen=True)
class SensorBudget:
    """Uncertainty of the sinkage at one place.

    Attributes
    ----------
    components : tuple of Component
    lever : float
        Distance in m along the ship between the place and what carries the altitude.
    """

    components: tuple[Component, ...]
    lever: float

    @property
    def contributions(self) -> dict[str, float]:
        """Size of each contribution in m."""
        return {
            item.name: item.size * abs(self.lever) if item.kind == "angle" else item.size
            for item in self.components
        }

    @property
    def linear(self) -> float:
        """Sum in m: the bound."""
        return math.fsum(self.contributions.values())

    @property
    def rss(self) -> float:
        """Root of the sum of squares in m: independent contributions."""
        return math.hypot(*self.contributions.values())

    @property
    def frame(self) -> pd.DataFrame:
        """One row a contribution, then both sums: component, contribution, unit."""
        import pandas as pd

        rows = [*self.contributions.items(), ("linear sum", self.linear), ("root sum of squares", self.rss)]
        return pd.DataFrame(
            [(name, size, "m") for name, size in rows], columns=["component", "contribution", "unit"]
        )


def sensor_budget(
    lever: float, accuracies: Accuracies = FROM_THE_SOURCE, *, further: Iterable[Component] = ()
) -> SensorBudget:
    """Budget of the sinkage at a place.

    Parameters
    ----------
    lever : float
        Distance in m along the ship between the place and the antennas.
    accuracies : Accuracies
    further : iterable of Component
        What else a measurement leaves uncertain, e.g. the draught that was read.

    Raises
    ------
    TowtankError
        For a negative contribution, or a lever that is not a number.
    """
    if not math.isfinite(lever):
        raise TowtankError("the lever is not a number", cure="give it in m")
    components = (
        Component("altitude", accuracies.altitude),
        Component("geodetic", accuracies.geodetic),
        Component("water level", accuracies.water_level),
        Component("pitch", accuracies.pitch, "angle"),
        *further,
    )
    return SensorBudget(components, lever)
