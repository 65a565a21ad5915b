"""Current, wind and waves from a TOML file.

    [current]
    speed = 0.25            # m/s
    direction = 90          # deg, where it flows to

    [wind]
    speed = 12.0            # m/s
    direction = 30          # deg, where it blows from
    type = "container ship, loaded"
    frontal_area = 820.0    # m2
    lateral_area = 5100.0   # m2

    [waves]
    height = 3.0            # m
    direction = 180         # deg, where they travel to

Angles are from the initial course, positive to starboard. In place of `type`, `coefficients` names a CSV table of wind
coefficients; `drift` names one of wave drift coefficients. File names start from the folder of the TOML file.
"""

from __future__ import annotations

import math
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, model_validator

from ..core.errors import ReadError, TowtankError
from ..core.ship import Ship
from ..formats.checked_toml import read_toml, validated_sections
from .environment import Current, Environment
from .wave_drift import AnkudinovDrift, DriftTable, Waves
from .wind import AIR_DENSITY, Wind, WindCoefficients, blendermann_coefficients


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid")

    speed: float = Field(ge=0)
    direction: float


class CurrentSection(_Section):
    """``[current]``: uniform and steady."""


class WindSection(_Section):
    """``[wind]``: steady; coefficients from a table or by the type of ship."""

    type: str | None = None
    coefficients: str | None = None
    frontal_area: float = Field(gt=0)
    lateral_area: float = Field(gt=0)
    length: float | None = Field(default=None, gt=0)
    overall_length: float | None = Field(default=None, gt=0)
    centroid_forward: float = 0.0
    centroid_height: float | None = Field(default=None, gt=0)
    air_density: float = Field(default=AIR_DENSITY, gt=0)

    @model_validator(mode="after")
    def _one_source(self) -> WindSection:
        if (self.type is None) == (self.coefficients is None):
            raise ValueError(
                "wind needs its coefficients once -> give type (of ship) or coefficients (a CSV file)"
            )
        return self


class WavesSection(BaseModel):
    """``[waves]``: long-crested, of one direction."""

    model_config = ConfigDict(extra="forbid")

    height: float = Field(ge=0)
    direction: float
    wavelength: float | None = Field(default=None, gt=0)
    drift: str | None = None

    @model_validator(mode="after")
    def _table_and_length(self) -> WavesSection:
        if self.drift is not None and self.wavelength is None:
            raise ValueError("a table of drift forces needs the wavelength -> give wavelength in m")
        return self


class EnvironmentFile(BaseModel):
    """A whole environment file."""

    model_config = ConfigDict(extra="forbid")

    current: CurrentSection | None = None
    wind: WindSection | None = None
    waves: WavesSection | None = None


_SECTIONS: dict[str, type[BaseModel]] = {"current": CurrentSection, "wind": WindSection, "waves": WavesSection}


def read_environment(path: str | Path, ship: Ship) -> Environment:
    """Environment of a TOML file.

    Parameters
    ----------
    path : str or Path
    ship : Ship
        The ship that sails: areas above water are at its scale.

    Raises
    ------
    ReadError
        When the file is missing or is not TOML, or a key is wrong; the message names it.
    TowtankError
        For tables and types of ship that are not found.
    """
    path = Path(path)
    file = validated_sections(EnvironmentFile, read_toml(path, ReadError), path, ReadError, _SECTIONS)
    current = wind = waves = None
    if file.current is not None:
        current = Current(file.current.speed, math.radians(file.current.direction))
    if file.wind is not None:
        coefficients = _wind_coefficients(file.wind, path, ship)
        wind = Wind(file.wind.speed, math.radians(file.wind.direction), coefficients, file.wind.air_density)
    if file.waves is not None:
        table = file.waves.drift
        drift = AnkudinovDrift() if table is None else DriftTable.from_csv(path.parent / table)
        waves = Waves(file.waves.height, math.radians(file.waves.direction), file.waves.wavelength, drift)
    return Environment(current, wind, waves)


def _wind_coefficients(wind: WindSection, path: Path, ship: Ship) -> WindCoefficients:
    areas = {"frontal_area": wind.frontal_area, "lateral_area": wind.lateral_area}
    if wind.coefficients is not None:
        return WindCoefficients.from_csv(path.parent / wind.coefficients, **areas, length=wind.length or ship.L)
    assert wind.type is not None
    try:
        return blendermann_coefficients(
            wind.type,
            ship,
            **areas,
            centroid_forward=wind.centroid_forward,
            centroid_height=wind.centroid_height,
            overall_length=wind.overall_length,
        )
    except TowtankError as error:
        raise ReadError(error.cause, cure=error.cure, file=path, place="key 'wind.type'") from None
