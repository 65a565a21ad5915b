"""The file of a squat campaign: ship, fairway, channels, window, records, fit; checked key by key.

    [squat]
    name = "DTC in shallow water"
    scale = 89.11

    [ship]
    name = "DTC"
    L = 355.0
    B = 51.0
    T = 14.5
    volume = 173925.0

    [fairway]
    depth = 0.326
    width = 7.0

    [channels]
    time = "time"
    speed = "u"
    bow = "z_VF"
    stern = "z_VA"

    [window]
    rule = "fraction"

    [[records]]
    file = "C1.dat"

File names start from the folder of the campaign file. The ship is given at its own ``scale`` (1 when not given);
everything else is at the scale of the records, which is that of the ship unless ``[squat]`` says otherwise.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ..core.errors import CampaignError, TowtankError
from ..core.ship import Ship
from ..formats.checked_toml import read_toml, validated_sections
from .fairway import Fairway
from .named_corrections import CORRECTIONS
from .noise_filter import FILTERS
from .sinkage_layout import SinkageLayout
from .squat_curve import CurveModel
from .steady_squat import WindowRule


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid")


class Heading(_Section):
    """``[squat]``: what the report carries at its head, and the scale of the records."""

    name: str
    source: str = ""
    notes: str = ""
    scale: float | None = Field(default=None, gt=0)
    virtual: bool = False
    truth: dict[str, float] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _truth_is_virtual(self) -> Heading:
        if self.truth and not self.virtual:
            raise ValueError("only a virtual record has a known truth -> set virtual = true, or leave truth out")
        return self


class FairwayEntry(_Section):
    """``[fairway]``: water around the ship in m, at the scale of the records."""

    depth: float | None = None
    width: float | None = Field(default=None, gt=0)
    slope: float = Field(default=0.0, ge=0)
    bank_height: float | None = Field(default=None, gt=0)

    @model_validator(mode="after")
    def _whole(self) -> FairwayEntry:
        if self.depth is not None and not self.depth > 0.0:
            raise ValueError(f"a water depth of {self.depth:g} m is impossible -> give the depth in m, positive")
        if self.width is None and (self.slope or self.bank_height is not None):
            raise ValueError("banks without a bottom width -> add width in m")
        return self

    def make_fairway(self, depth: float) -> Fairway:
        """The water at a depth in m."""
        if self.width is None:
            return Fairway(depth)
        if self.bank_height is not None:
            return Fairway.trench(depth, self.width, self.bank_height, self.slope)
        return Fairway.canal(depth, self.width, self.slope)


class SquatChannels(_Section):
    """``[channels]``: columns of the record files, where they measure, and with which sign."""

    time: str = "time"
    speed: str = ""
    bow: str = ""
    stern: str = ""
    points: dict[str, tuple[float, float]] = Field(default_factory=dict)
    heave: str = ""
    heave_x: float = 0.0
    trim: str = ""
    trim_positive: Literal["bow-down", "bow-up"] | None = None
    trim_base: float | None = Field(default=None, gt=0)
    sinkage_positive: Literal["down", "up"] = "down"
    extra: list[str] = Field(default_factory=list)
    units: dict[str, str] = Field(default_factory=dict)
    places: dict[str, float] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _some(self) -> SquatChannels:
        if not (self.bow or self.stern or self.points or self.heave):
            raise ValueError(
                "no channel of sinkage is named -> name the columns at bow and stern, points, or heave and trim"
            )
        if self.trim and self.trim_positive is None:
            raise ValueError(
                f"which way '{self.trim}' is positive is not declared -> laboratories differ: give "
                "trim_positive (--trim-positive) bow-down or bow-up"
            )
        return self

    def make_layout(self, length: float, xG: float) -> SinkageLayout:
        """Layout on a ship with a length between perpendiculars and a centre of gravity, both in m."""
        ends = {self.bow: (0.5 * length, 0.0), self.stern: (-0.5 * length, 0.0)}
        points = {name: place for name, place in ends.items() if name} | self.points
        return SinkageLayout(
            length=length,
            points=points,
            heave=self.heave,
            heave_x=self.heave_x,
            trim=self.trim,
            trim_positive=self.trim_positive or "bow-down",
            trim_base=self.trim_base,
            sinkage_positive=self.sinkage_positive,
            time=self.time,
            speed=self.speed,
            extra=tuple(self.extra),
            xG=xG,
        )


class SquatWindow(_Section):
    """``[window]``: which part of a run is averaged; times in s."""

    rule: WindowRule = "fraction"
    begin: float = Field(default=0.30, ge=0, le=1)
    end: float = Field(default=0.95, ge=0, le=1)
    start: float | None = None
    stop: float | None = None

    @model_validator(mode="after")
    def _ordered(self) -> SquatWindow:
        if not self.begin < self.end:
            raise ValueError(f"the window {self.begin:g} to {self.end:g} is empty -> use 0 <= begin < end <= 1")
        if self.start is not None and self.stop is not None and not self.start < self.stop:
            raise ValueError(f"the window {self.start:g} to {self.stop:g} s is empty -> give start before stop")
        if self.rule == "key-times" and self.start is None and self.stop is None:
            raise ValueError("the rule key-times needs its times -> give start and stop in s")
        return self


class SquatRecordEntry(_Section):
    """``[[records]]``: one run."""

    file: str
    name: str = ""
    condition: str = ""
    depth: float | None = None
    speed: float | None = Field(default=None, ge=0)
    start: float | None = None
    stop: float | None = None
    waves: bool = False
    omega: float | None = Field(default=None, gt=0)

    @model_validator(mode="after")
    def _deep(self) -> SquatRecordEntry:
        if self.depth is not None and not self.depth > 0.0:
            raise ValueError(f"a water depth of {self.depth:g} m is impossible -> give the depth in m, positive")
        return self


class SpeedSteps(_Section):
    """``[steps]``: several speeds in one record; the last seconds of each stay are averaged."""

    last: float = Field(gt=0)
    shortest: float | None = Field(default=None, gt=0)


class SquatFilter(_Section):
    """``[filter]``: noise filter of sinkage and trim before the means; cut-off in Hz."""

    name: str = "none"
    cutoff: float | None = Field(default=None, gt=0)

    @field_validator("name")
    @classmethod
    def _known(cls, value: str) -> str:
        if value not in FILTERS:
            raise ValueError(f"'{value}' is no filter -> use one of {', '.join(FILTERS)}")
        return value


class SquatCorrection(_Section):
    """``[correction]``: what walls and bottom did, taken from the curve by name; particulars in SI."""

    name: str
    to: Literal["speeds", "sinkages"] | None = None
    guarded: bool = True
    viscous_share: float | None = None
    gamma: float | None = None
    waterline_gamma: float | None = None
    outflow: float | None = None
    volume_coefficient: float | None = None
    wave_coefficient: float | None = None

    @field_validator("name")
    @classmethod
    def _known(cls, value: str) -> str:
        if value not in CORRECTIONS:
            raise ValueError(f"'{value}' is no correction -> use one of {', '.join(CORRECTIONS)}")
        return value

    @property
    def particulars(self) -> dict[str, float]:
        """What ship and fairway do not tell."""
        given = self.model_dump(exclude={"name", "to", "guarded"})
        return {name: value for name, value in given.items() if value is not None}


class SquatFit(_Section):
    """``[fit]``: curves over speed, and when runs are repeats of one speed."""

    models: list[CurveModel] = Field(default=["depth-froude", "power"], min_length=1)
    same_speed: float = Field(default=0.005, ge=0, lt=0.2)
    order: int = Field(default=3, ge=1, le=8)


class SquatHull(_Section):
    """``[hull]``: what some formulas ask for beside the particulars."""

    midship_coefficient: float = Field(default=0.98, gt=0, le=1)
    propellers: Literal[1, 2] = 1
    bulb: bool = True
    transom: bool = True
    static_trim: float = 0.0


class SquatRestoring(_Section):
    """``[restoring]``: hydrostatics for the stern, at the scale of ``[ship]``; m2, m forward of midship, m."""

    waterplane_area: float = Field(gt=0)
    flotation: float = 0.0
    longitudinal_GM: float = Field(gt=0)


class HullFile(_Section):
    """A file with a ship for the formulas."""

    ship: dict[str, Any]
    hull: SquatHull = Field(default_factory=SquatHull)
    restoring: SquatRestoring | None = None


class SquatOutput(_Section):
    """``[output]``."""

    report: bool = True
    formulas: bool = True


class SquatCampaign(_Section):
    """A whole squat campaign."""

    squat: Heading
    ship: dict[str, Any]
    fairway: FairwayEntry = Field(default_factory=FairwayEntry)
    channels: SquatChannels
    window: SquatWindow = Field(default_factory=SquatWindow)
    records: list[SquatRecordEntry] = Field(min_length=1)
    steps: SpeedSteps | None = None
    filter: SquatFilter = Field(default_factory=SquatFilter)
    correction: SquatCorrection | None = None
    fit: SquatFit = Field(default_factory=SquatFit)
    hull: SquatHull = Field(default_factory=SquatHull)
    output: SquatOutput = Field(default_factory=SquatOutput)
    accept: list[str] = Field(default_factory=list)

    @model_validator(mode="after")
    def _one_name_each(self) -> SquatCampaign:
        names = [entry.name for entry in self.records if entry.name]
        twice = [name for name in names if names.count(name) > 1]
        if twice:
            raise ValueError(f"two records have the name '{twice[0]}' -> give each its own")
        stretches = [(entry.file, entry.start, entry.stop) for entry in self.records]
        again = [stretch[0] for stretch in stretches if stretches.count(stretch) > 1]
        if again:
            raise ValueError(f"'{again[0]}' is given twice -> a run is no repeat of itself; give it once")
        return self

    def make_ship(self) -> Ship | None:
        """The ship at the scale of the records; None when only its length is given."""
        if not {"B", "T"} <= set(self.ship):
            return None
        ship = Ship.from_dict(self.ship)
        return ship if self.squat.scale is None else ship.at_scale(self.squat.scale)

    @property
    def scale(self) -> float:
        """Scale of the records."""
        own = float(self.ship.get("scale", 1.0))
        return own if self.squat.scale is None else self.squat.scale

    @property
    def length(self) -> float:
        """Length between perpendiculars in m at the scale of the records."""
        return float(self.ship["L"]) * float(self.ship.get("scale", 1.0)) / self.scale

    def make_layout(self) -> SinkageLayout:
        """Channels on the ship at the scale of the records."""
        shift = float(self.ship.get("xG", 0.0)) * float(self.ship.get("scale", 1.0)) / self.scale
        return self.channels.make_layout(self.length, shift)

    def run_names(self) -> list[str]:
        """Name of each record: its own, or the stem of its file, or the path where stems repeat."""
        stems = [entry.name or Path(entry.file).stem for entry in self.records]
        return [
            name if stems.count(name) == 1 else entry.file for name, entry in zip(stems, self.records, strict=True)
        ]


_SECTIONS: dict[str, type[BaseModel]] = {
    "squat": Heading,
    "fairway": FairwayEntry,
    "channels": SquatChannels,
    "window": SquatWindow,
    "records": SquatRecordEntry,
    "steps": SpeedSteps,
    "filter": SquatFilter,
    "correction": SquatCorrection,
    "fit": SquatFit,
    "hull": SquatHull,
    "output": SquatOutput,
}


_OTHERS = {"campaign": "run", "decay": "decay", "voyage": "squat voyage"}
"""Command for a campaign of another kind, by the section that tells it."""


def load_squat_campaign(path: str | Path) -> SquatCampaign:
    """Read and check the file of a squat campaign.

    Raises
    ------
    CampaignError
        When the file is missing, is not TOML, or a key is wrong; the message names the key.
    """
    path = Path(path)
    return checked_squat_campaign(read_toml(path, CampaignError, what="squat campaign"), path)


def checked_squat_campaign(data: dict[str, Any], path: Path) -> SquatCampaign:
    """Squat campaign from a mapping, with errors that name the key; `path` stands in the messages."""
    if "squat" not in data:
        other = next((key for key in _OTHERS if key in data), "")
        raise CampaignError(
            f"this is a campaign with [{other}]" if other else "there is no section [squat]",
            cure=f"use towtank {_OTHERS[other]}" if other else "add [squat] with a name",
            file=path,
        )
    campaign = validated_sections(SquatCampaign, data, path, CampaignError, _SECTIONS)
    try:
        length = campaign.ship.get("L")
        if not isinstance(length, int | float) or not length > 0:
            raise CampaignError("the length L is missing or not positive", cure="give L in m")
        campaign.make_ship()
        campaign.make_layout()
    except (TowtankError, TypeError, ValueError) as error:
        known = isinstance(error, TowtankError)
        cause = error.cause if isinstance(error, TowtankError) else str(error)
        cure = error.cure if isinstance(error, TowtankError) and error.cure else "complete or correct [ship]"
        place = error.place if isinstance(error, TowtankError) else ""
        raise CampaignError(cause, cure=cure, file=path, place=place or ("" if known else "[ship]")) from None
    return campaign


def command_line_squat(
    files: Iterable[str | Path], *, record: dict[str, Any], sections: dict[str, Any], name: str = ""
) -> SquatCampaign:
    """Squat campaign of some files that share everything.

    Parameters
    ----------
    files : iterable of str or Path
    record : dict
        Keys of every ``[[records]]`` entry; those that are None are left out.
    sections : dict
        Other sections by name.
    name : str
        Heading; the first file's when not given.
    """
    paths = [Path(file) for file in files]
    given = {key: value for key, value in record.items() if value is not None}
    heading = {"name": name or paths[0].stem} | sections.get("squat", {})
    data = {
        **{key: value for key, value in sections.items() if value is not None},
        "squat": heading,
        "records": [{"file": str(path), **given} for path in paths],
    }
    return checked_squat_campaign(data, Path("command line"))
