"""The sections of a squat campaign file, each key checked: what may stand there, and what must stand together."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from .fairway import Fairway
from .named_corrections import CORRECTIONS
from .noise_filter import FILTERS
from .sinkage_layout import SinkageLayout
from .squat_curve import CurveModel
from .steady_squat import WindowRule


class CampaignSection(BaseModel):
    """A section of the file: a key that it does not know is an error."""

    model_config = ConfigDict(extra="forbid")


class Heading(CampaignSection):
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


class FairwayEntry(CampaignSection):
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


class SquatChannels(CampaignSection):
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
    wave: str = ""
    wave_x: float | None = None
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
        if self.wave and self.wave_x is None:
            raise ValueError(
                f"where the gauge '{self.wave}' is along the ship is not known -> give wave_x (--wave-x) in m forward "
                "of midship"
            )
        if self.wave_x is not None and not self.wave:
            raise ValueError("a place without a wave gauge -> name its channel, wave (--channels wave=...)")
        return self

    def make_layout(self, length: float, xG: float, *, waves: bool = False) -> SinkageLayout:
        """Layout on a ship with a length between perpendiculars and a centre of gravity, both in m.

        In waves the gauge is read too.
        """
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
            extra=tuple(dict.fromkeys([*self.extra, self.wave] if waves and self.wave else self.extra)),
            xG=xG,
        )


class SquatWindow(CampaignSection):
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


class SquatRecordEntry(CampaignSection):
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


class SpeedSteps(CampaignSection):
    """``[steps]``: several speeds in one record; the last seconds of each stay are averaged."""

    last: float = Field(gt=0)
    shortest: float | None = Field(default=None, gt=0)


class SquatFilter(CampaignSection):
    """``[filter]``: noise filter of sinkage and trim before the means; cut-off in Hz."""

    name: str = "none"
    cutoff: float | None = Field(default=None, gt=0)

    @field_validator("name")
    @classmethod
    def _known(cls, value: str) -> str:
        if value not in FILTERS:
            raise ValueError(f"'{value}' is no filter -> use one of {', '.join(FILTERS)}")
        return value


class SquatCorrection(CampaignSection):
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


class SquatFit(CampaignSection):
    """``[fit]``: curves over speed, and when runs are repeats of one speed."""

    models: list[CurveModel] = Field(default=["depth-froude", "power"], min_length=1)
    same_speed: float = Field(default=0.005, ge=0, lt=0.2)
    order: int = Field(default=3, ge=1, le=8)


class SquatHull(CampaignSection):
    """``[hull]``: what some formulas ask for beside the particulars."""

    midship_coefficient: float = Field(default=0.98, gt=0, le=1)
    propellers: Literal[1, 2] = 1
    bulb: bool = True
    transom: bool = True
    static_trim: float = 0.0


class SquatRestoring(CampaignSection):
    """``[restoring]``: hydrostatics for the stern, at the scale of ``[ship]``; m2, m forward of midship, m."""

    waterplane_area: float = Field(gt=0)
    flotation: float = 0.0
    longitudinal_GM: float = Field(gt=0)


class HullFile(CampaignSection):
    """A file with a ship for the formulas."""

    ship: dict[str, Any]
    hull: SquatHull = Field(default_factory=SquatHull)
    restoring: SquatRestoring | None = None


class SquatOutput(CampaignSection):
    """``[output]``."""

    report: bool = True
    formulas: bool = True
