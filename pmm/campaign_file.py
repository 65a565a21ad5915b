"""The campaign file: a TOML description of a captive-test campaign, validated key by key."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ..core.conventions import Conventions, preset
from ..core.errors import CampaignError, TowtankError
from ..core.hull_models import HULL_MODELS, hull_model
from ..core.motion import origin_position
from ..core.ship import Ship
from ..core.terms import Term, parse_terms
from ..formats.channels import Channel, ChannelMap
from ..formats.checked_toml import read_toml, validated_sections
from .audit_rules import require_rules


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid", arbitrary_types_allowed=True)


class Heading(_Section):
    """``[campaign]``: what this is."""

    name: str
    source: str = ""
    virtual: bool = False
    notes: str = ""


class Reader(_Section):
    """``[reader]``: how files are read."""

    format: str = "auto"
    sheet: str | None = None
    group: str | None = None


class Inertia(_Section):
    """``[inertia]``: rigid-body inertia in the measured forces.

    ``inside`` says whether the balance carries the model's mass; ``mass``, ``xG`` and ``Izz`` (about the centre
    of gravity) are those of everything that hangs on the balance, mount included. ``dry_runs = true`` finds
    them from oscillation runs in air instead.
    """

    inside: bool = False
    mass: float | None = Field(default=None, gt=0)
    xG: float = 0.0
    Izz: float | None = Field(default=None, gt=0)
    mount_mass: float = Field(default=0.0, ge=0)
    dry_runs: bool = False

    @model_validator(mode="after")
    def _complete(self) -> Inertia:
        if self.inside and not self.dry_runs and (self.mass is None or self.Izz is None):
            raise ValueError("inside = true needs mass and Izz, or dry_runs = true")
        if self.dry_runs and not self.inside:
            raise ValueError("dry_runs = true needs inside = true")
        return self


class Reduction(_Section):
    """``[reduction]``: steps from records to means and harmonics, each with its default."""

    tare_window: tuple[float, float] | None = None
    lowpass: float = Field(default=0.0, ge=0)
    window: Literal["fraction", "mser", "key-times"] = "fraction"
    fraction: tuple[float, float] = (0.30, 0.95)
    start: float | None = None
    stop: float | None = None
    skip_cycles: int = Field(default=1, ge=0)
    max_cycles: int | None = Field(default=None, ge=1)
    harmonics: int = Field(default=3, ge=1, le=12)
    motion: Literal["prescribed", "measured"] = "prescribed"
    motion_harmonics: int = Field(default=5, ge=1, le=20)
    frequency: Literal["given", "found"] = "given"
    position_x: float = 0.0
    moment_x: float = 0.0
    nondimensional_speed: Literal["instantaneous", "approach"] = "instantaneous"

    @field_validator("fraction")
    @classmethod
    def _ordered(cls, value: tuple[float, float]) -> tuple[float, float]:
        if not 0 <= value[0] < value[1] <= 1:
            raise ValueError("two increasing numbers between 0 and 1 are expected")
        return value


class SharedBias(_Section):
    """``[fit.shared_bias]``: standard uncertainties that all runs share (type B).

    Gains and the carriage speed are relative; offsets are in N and N m, ``drift_angle`` in rad, ``moment_x`` in m.
    """

    gain: dict[str, float] = Field(default_factory=dict)
    offset: dict[str, float] = Field(default_factory=dict)
    speed: float = Field(default=0.0, ge=0)
    drift_angle: float = Field(default=0.0, ge=0)
    moment_x: float = Field(default=0.0, ge=0)


class Equality(_Section):
    """``[[fit.equalities]]``: a linear equation of derivatives of one force, ``sum factor * term = value``."""

    terms: dict[str, float]
    value: float = 0.0


class Fit(_Section):
    """``[fit]``: hull model and estimator."""

    model: str | None = None
    terms: list[str] | None = None
    domain: Literal["harmonic", "time"] = "harmonic"
    estimator: Literal["wls", "ols", "huber", "ridge", "tsvd", "lssvm", "constrained"] = "wls"
    covariance: Literal["model", "cluster", "bootstrap"] = "model"
    staged: bool = False
    group_by: tuple[Literal["depth", "speed", "heel"], ...] = ("depth",)
    candidates: list[str] = Field(default_factory=list)
    range_limits: list[float] = Field(default_factory=list)
    bounds: dict[str, tuple[float | None, float | None]] = Field(default_factory=dict)
    equalities: list[Equality] = Field(default_factory=list)
    fixed: dict[str, float] = Field(default_factory=dict)
    prior: str | None = None
    prior_relative_sd: float = Field(default=0.30, gt=0)
    huber_c: float = Field(default=1.345, gt=0)
    replicates: int = Field(default=1000, ge=100)
    seed: int = 0
    shared_bias: SharedBias = Field(default_factory=SharedBias)

    @model_validator(mode="after")
    def _readable(self) -> Fit:
        if self.model and self.terms:
            raise ValueError("give model or terms, not both")
        try:
            self.hull_terms()
            for name in self.candidates:
                candidate_terms(name)
        except TowtankError as error:
            raise ValueError(str(error)) from None
        return self

    @model_validator(mode="after")
    def _equalities_of_one_force(self) -> Fit:
        for number, item in enumerate(self.equalities, start=1):
            if len({name[0] for name in item.terms}) != 1:
                raise ValueError(f"equality {number} mixes forces; each component is fitted by itself")
        constraints = self.bounds or self.equalities or self.prior
        if constraints and self.estimator != "constrained":
            raise ValueError("bounds, equalities and prior need estimator = 'constrained'")
        return self

    @model_validator(mode="after")
    def _what_belongs_to_least_squares(self) -> Fit:
        least_squares = self.estimator in ("wls", "ols")
        if self.staged and not least_squares:
            raise ValueError(f"staged = true goes with estimator 'wls' or 'ols', not '{self.estimator}'")
        if self.covariance != "model" and (self.staged or not least_squares):
            what = "staged = true" if self.staged else f"estimator '{self.estimator}'"
            raise ValueError(f"covariance '{self.covariance}' is that of plain least squares, not of {what}")
        return self

    def hull_terms(self) -> tuple[Term, ...] | None:
        """Terms to fit, or None when the run types decide."""
        if self.terms is not None:
            return parse_terms(self.terms)
        return hull_model(self.model) if self.model else None


def candidate_terms(text: str) -> tuple[Term, ...]:
    """Terms of a candidate: the name of a model, or names of terms separated by spaces."""
    return hull_model(text) if text in HULL_MODELS else parse_terms(text.split())


class RunGroup(_Section):
    """``[[runs]]``: files of one kind, or a test matrix.

    Parameters of the runs are numbers, or lists with one entry a file; ``pattern`` is a regular expression whose
    named groups are parameters read from the file names. ``matrix`` names a table with a column ``file`` or
    ``name``, a column ``type`` and one column a parameter.
    """

    model_config = ConfigDict(extra="allow", arbitrary_types_allowed=True)

    type: str | None = None
    files: str | list[str] | None = None
    matrix: str | None = None
    pattern: str | None = None
    tare: str = ""
    series: str = ""


class Points(_Section):
    """``[points]``: already reduced runs, one a row, non-dimensional or SI.

    ``file`` or ``table`` holds mean forces of steady runs, ``harmonics`` those of oscillating runs.
    """

    file: str | None = None
    table: str | None = None
    harmonics: str | None = None
    scaling: Literal["LT", "L2", "dimensional"] = "LT"
    columns: dict[str, str] = Field(default_factory=dict)
    relative_sd: float | None = Field(default=None, gt=0)
    sd: dict[str, float] = Field(default_factory=dict)


class Output(_Section):
    """``[output]``: what is written."""

    report: bool = True
    series_in_report: int = Field(default=6, ge=0)
    scaling: str = "lt"

    @field_validator("scaling")
    @classmethod
    def _known(cls, value: str) -> str:
        try:
            preset(value, Conventions())
        except TowtankError as error:
            raise ValueError(str(error)) from None
        return value


class Simulate(_Section):
    """``[simulate]``: manoeuvres that the fitted set is sailed through.

    ``manoeuvres`` are names such as ``turning 35`` or ``zigzag 20/20``; empty for those of the IMO standards.
    ``environment`` is a TOML file beside the campaign.
    """

    ship_from: str | None = None
    manoeuvres: list[str] = Field(default_factory=list)
    speed: float | None = Field(default=None, gt=0)
    environment: str | None = None
    draws: int = Field(default=200, ge=0)
    percent: float | None = Field(default=None, gt=0)
    seed: int = Field(default=0, ge=0)


class CampaignFile(_Section):
    """A whole campaign file."""

    campaign: Heading
    ship: dict[str, Any]
    conventions: dict[str, Any] = Field(default_factory=dict)
    channels: ChannelMap | None = None
    reader: Reader = Field(default_factory=Reader)
    inertia: Inertia = Field(default_factory=Inertia)
    reduction: Reduction = Field(default_factory=Reduction)
    runs: list[RunGroup] = Field(default_factory=list)
    points: Points | None = None
    fit: Fit = Field(default_factory=Fit)
    simulate: Simulate | None = None
    output: Output = Field(default_factory=Output)
    accept: list[str] = Field(default_factory=list)

    @model_validator(mode="after")
    def _something_to_fit(self) -> CampaignFile:
        if not self.runs and self.points is None:
            raise ValueError("a campaign needs [[runs]] or [points]")
        if self.runs and self.channels is None:
            raise ValueError("[[runs]] need a [channels] map")
        if self.channels is not None and "time" not in self.channels.channels:
            raise ValueError('[channels] need a time -> add e.g. time = "Time [s]"')
        return self

    @field_validator("ship")
    @classmethod
    def _numbers(cls, value: dict[str, Any]) -> dict[str, Any]:
        for key, item in value.items():
            if key != "name" and (isinstance(item, bool) or not isinstance(item, int | float)):
                raise ValueError(f"{key} = {item!r} is not a number -> give it in SI units")
        return value

    @field_validator("accept")
    @classmethod
    def _rules(cls, value: list[str]) -> list[str]:
        try:
            require_rules(value)
        except TowtankError as error:
            raise ValueError(str(error)) from None
        return value

    def make_ship(self) -> Ship:
        """The ship of the campaign."""
        return Ship.from_dict(self.ship)

    def make_conventions(self) -> Conventions:
        """Conventions of the measured data and of the test matrix."""
        return Conventions.from_dict(self.conventions)


_SECTIONS: dict[str, type[BaseModel]] = {
    "campaign": Heading,
    "channels": Channel,
    "reader": Reader,
    "inertia": Inertia,
    "reduction": Reduction,
    "points": Points,
    "fit": Fit,
    "shared_bias": SharedBias,
    "equalities": Equality,
    "simulate": Simulate,
    "output": Output,
}


def load_campaign_file(path: str | Path) -> CampaignFile:
    """Read and validate a campaign file.

    Raises
    ------
    CampaignError
        When the file is missing, is not TOML, or a key is wrong; the message names the key.
    """
    path = Path(path)
    return validated(read_toml(path, CampaignError, what="campaign.toml"), path)


def validated(data: dict[str, Any], path: Path) -> CampaignFile:
    """Campaign from a mapping, with errors that name the key."""
    campaign = validated_sections(CampaignFile, data, path, CampaignError, _SECTIONS)
    for place, make in (("[ship]", campaign.make_ship), ("[conventions]", campaign.make_conventions)):
        try:
            make()
        except TowtankError as error:
            cure = error.cure or f"complete or correct {place}"
            raise CampaignError(error.cause, cure=cure, file=path, place=error.place or place) from None
    for key in campaign.conventions:
        if key in _ELSEWHERE:
            raise CampaignError(
                f"{key} is no convention of measured data", cure=_ELSEWHERE[key], file=path, place="[conventions]"
            )
    return _at_origin(campaign)


_ELSEWHERE = {
    "force_scaling": "give points.scaling for the input, output.scaling for the result",
    "velocity_scale": "give reduction.nondimensional_speed",
    "sway_variable": "fit terms of v or of the drift angle",
    "rigid_body_inertia": "give inertia.inside",
    "added_mass_coriolis": "leave it out: a balance feels them, and output.scaling converts the result",
    "scale": "give ship.scale: 1 for full scale, 46.6 for a model 1:46.6",
    "wave_heading": "leave it out: captive tests in calm water have none",
}
"""Conventions of derivative sets that measured data do not have, and the key that is meant."""


def _at_origin(campaign: CampaignFile) -> CampaignFile:
    """The campaign with moment and motion at the origin of its conventions where [reduction] names no point."""
    ship = campaign.make_ship()
    place = origin_position(campaign.make_conventions(), ship) * ship.L
    named = campaign.reduction.model_fields_set
    points = {key: place for key in ("moment_x", "position_x") if place and key not in named}
    return campaign.model_copy(update={"reduction": campaign.reduction.model_copy(update=points)})
