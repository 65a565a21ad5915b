"""The file of a voyage: ship, sensors, tide, density, rest, depth and the records; checked key by key.

    [voyage]
    name = "outbound, 20 June"

    [ship]
    name = "ULCS"
    L = 350.0
    B = 51.2
    T = 14.1
    volume = 172000.0

    [antennas.Z_port]
    x = 60.0
    y = -25.0
    z = 52.0

    [sensors]
    pitch = "pitch"
    pitch_positive = "bow-up"
    roll = "roll"
    roll_positive = "starboard-down"
    speed = "sog"

    [tide]
    file = "tide.csv"

    [static]
    start = 0.0
    stop = 300.0

    [[records]]
    file = "voyage.csv"

File names start from the folder of the file. Everything is at full scale, in SI; angles of the accuracy in degrees.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from ..core.errors import CampaignError, TowtankError
from ..core.ship import Ship
from ..formats.checked_toml import read_toml, validated_sections
from .rtk_antennas import Antenna, AntennaLayout
from .sensor_budget import Accuracies
from .steady_unsteady import STEADY_WINDOW


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid")


class VoyageHeading(_Section):
    """``[voyage]``."""

    name: str
    source: str = ""
    notes: str = ""
    virtual: bool = False


class AntennaEntry(_Section):
    """``[antennas.<channel>]``: place in m, x forward and y to starboard of midship, z above the keel."""

    x: float
    y: float = 0.0
    z: float = 0.0


class Sensors(_Section):
    """``[sensors]``: columns of the records beside the altitudes; an angle that is named needs its sign."""

    time: str = "time"
    speed: str = ""
    position: str = ""
    pitch: str = ""
    roll: str = ""
    pitch_positive: Literal["bow-down", "bow-up"] | None = None
    roll_positive: Literal["starboard-down", "port-down"] | None = None
    units: dict[str, str] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _signed(self) -> Sensors:
        for name, key, senses in (
            ("pitch", "pitch_positive", "bow-down or bow-up"),
            ("roll", "roll_positive", "starboard-down or port-down"),
        ):
            if getattr(self, name) and getattr(self, key) is None:
                raise ValueError(
                    f"which way '{getattr(self, name)}' is positive is not declared -> gyros differ: give "
                    f"{key} {senses}"
                )
        return self


class TableEntry(_Section):
    """A table over time in a file: one column, or several with their places along the fairway in m."""

    file: str = ""
    time: str = "time"
    column: str = ""
    places: dict[str, float] = Field(default_factory=dict)
    units: dict[str, str] = Field(default_factory=dict)


class TideEntry(TableEntry):
    """``[tide]``: a level in m above the datum, or a file."""

    level: float | None = None
    column: str = "level"
    correction: float = 0.0

    @model_validator(mode="after")
    def _one(self) -> TideEntry:
        if (self.level is None) == (not self.file):
            raise ValueError("the water level comes from a number or from a file -> give level or file")
        return self


class CurrentEntry(TableEntry):
    """``[current]``: along the ship in m/s, positive with it; a number or a file."""

    along: float | None = None
    column: str = "current"

    @model_validator(mode="after")
    def _one(self) -> CurrentEntry:
        if (self.along is None) == (not self.file):
            raise ValueError("the current comes from a number or from a file -> give along or file")
        return self


class StaticEntry(_Section):
    """``[static]``: when the ship lay still, in s, in a record of its own or in the first one."""

    start: float
    stop: float
    file: str = ""

    @model_validator(mode="after")
    def _ordered(self) -> StaticEntry:
        if not self.start < self.stop:
            raise ValueError(f"{self.start:g} to {self.stop:g} s is empty -> give start before stop")
        return self


class DensityEntry(_Section):
    """``[density]``: of the water in kg/m3 at the berth and under way, there as a number or a column; area in m2."""

    berth: float = Field(gt=0)
    under_way: float | None = Field(default=None, gt=0)
    column: str = ""
    waterplane_area: float = Field(gt=0)

    @model_validator(mode="after")
    def _one(self) -> DensityEntry:
        if (self.under_way is None) == (not self.column):
            raise ValueError("the density under way is a number or a column -> give under_way or column")
        return self


class BottomEntry(_Section):
    """``[bottom]``: depth below the datum in m, a number or a column, and its standard uncertainty."""

    charted_depth: float | None = None
    column: str = ""
    uncertainty: float = Field(default=0.0, ge=0)

    @model_validator(mode="after")
    def _one(self) -> BottomEntry:
        if (self.charted_depth is None) == (not self.column):
            raise ValueError("the depth is a number or a column -> give charted_depth or column")
        return self


class DraughtEntry(_Section):
    """``[draught]``: as read forward and aft at rest, in m, and its standard uncertainty."""

    forward: float = Field(gt=0)
    aft: float = Field(gt=0)
    uncertainty: float = Field(default=0.0, ge=0)


class AccuracyEntry(_Section):
    """``[accuracy]``: of the sensors in m, pitch in degrees; those of the source where not given."""

    altitude: float = Field(default=Accuracies().altitude, ge=0)
    geodetic: float = Field(default=Accuracies().geodetic, ge=0)
    water_level: float = Field(default=Accuracies().water_level, ge=0)
    pitch: float = Field(default=math.degrees(Accuracies().pitch), ge=0)

    def make_accuracies(self) -> Accuracies:
        """In SI."""
        return Accuracies(self.altitude, self.geodetic, self.water_level, math.radians(self.pitch))


class SteadyEntry(_Section):
    """``[steady]``: length in s of the mean that is called steady."""

    window: float = Field(default=STEADY_WINDOW, gt=0)


class VoyageRecord(_Section):
    """``[[records]]``: one voyage, or a part of it."""

    file: str
    name: str = ""


class VoyageFile(_Section):
    """A whole voyage."""

    voyage: VoyageHeading
    ship: dict[str, Any]
    antennas: dict[str, AntennaEntry] = Field(min_length=1)
    sensors: Sensors = Field(default_factory=Sensors)
    tide: TideEntry
    current: CurrentEntry | None = None
    static: StaticEntry
    density: DensityEntry | None = None
    bottom: BottomEntry | None = None
    draught: DraughtEntry | None = None
    accuracy: AccuracyEntry = Field(default_factory=AccuracyEntry)
    steady: SteadyEntry = Field(default_factory=SteadyEntry)
    records: list[VoyageRecord] = Field(min_length=1)
    accept: list[str] = Field(default_factory=list)

    def make_ship(self) -> Ship:
        """The ship at full scale."""
        return Ship.from_dict(self.ship)

    def make_layout(self) -> AntennaLayout:
        """Antennas and sensors on the ship."""
        ship = self.make_ship()
        return AntennaLayout(
            ship.L,
            ship.B,
            {name: Antenna(place.x, place.y, place.z) for name, place in self.antennas.items()},
            pitch=self.sensors.pitch,
            roll=self.sensors.roll,
            pitch_positive=self.sensors.pitch_positive or "bow-down",
            roll_positive=self.sensors.roll_positive or "starboard-down",
            time=self.sensors.time,
            speed=self.sensors.speed,
            position=self.sensors.position,
            extra=tuple(
                entry.column for entry in (self.density, self.bottom) if entry is not None and entry.column
            ),
            xG=ship.xG,
        )


_SECTIONS: dict[str, type[BaseModel]] = {
    "voyage": VoyageHeading,
    "antennas": AntennaEntry,
    "sensors": Sensors,
    "tide": TideEntry,
    "current": CurrentEntry,
    "static": StaticEntry,
    "density": DensityEntry,
    "bottom": BottomEntry,
    "draught": DraughtEntry,
    "accuracy": AccuracyEntry,
    "steady": SteadyEntry,
    "records": VoyageRecord,
}


def load_voyage(path: str | Path) -> VoyageFile:
    """Read and check the file of a voyage.

    Raises
    ------
    CampaignError
        When the file is missing, is not TOML, or a key is wrong; the message names the key.
    """
    path = Path(path)
    data = read_toml(path, CampaignError, what="voyage file")
    voyage = validated_sections(VoyageFile, data, path, CampaignError, _SECTIONS)
    try:
        ship = voyage.make_ship()
        voyage.make_layout()
    except TowtankError as fault:
        raise CampaignError(fault.cause, cure=fault.cure, file=path, place=fault.place) from fault
    if ship.scale != 1.0:
        raise CampaignError(
            f"the ship is at scale {ship.scale:g}",
            cure="give it at full scale",
            file=path,
            place="key 'ship.scale'",
        )
    if voyage.density is not None and ship.volume is None:
        raise CampaignError(
            "a change of density needs the displaced volume",
            cure="add volume in m3",
            file=path,
            place="key 'ship'",
        )
    return voyage
