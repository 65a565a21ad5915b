"""The file of a decay campaign: ship, channels, records, reduction, fit, output; checked key by key.

    [decay]
    name = "tanker 1:68, roll decay"

    [ship]
    name = "tanker"
    L = 320.0
    B = 58.0
    T = 20.8
    volume = 312600.0
    KG = 18.6
    GM = 5.73

    [channels]
    time = "time"
    angle = "phi"
    unit = "deg"

    [[records]]
    file = "decay_1.csv"
    scale = 68.0

File names start from the folder of the campaign file. The ship is given at its own ``scale`` (1 when not given) and
brought to that of each record.
"""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path
from typing import Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ..core.errors import CampaignError, TowtankError
from ..core.ship import Ship
from ..formats.checked_toml import read_toml, validated_sections
from .compare import METHODS
from .damping_models import TERMS, DampingModel, damping_model
from .decay_record import Offset
from .restoring_curve import RestoringCurve

Motion = Literal["roll", "pitch", "heave"]
Term = Literal["b1", "b2", "b3", "c1", "c3", "c5"]
AUTO = "auto"
ALL = "all"
RANDOM_DECREMENT, JOINT_FIT, DISCRETE_SEARCH = "random decrement", "joint fit", "discrete search"
AT_SEA_METHODS = (RANDOM_DECREMENT, JOINT_FIT, DISCRETE_SEARCH)
"""Methods for records at sea."""


class _Section(BaseModel):
    model_config = ConfigDict(extra="forbid")


def _methods_among(value: list[str], known: tuple[str, ...]) -> list[str]:
    for method in value:
        if method != ALL and method not in known:
            close = get_close_matches(method, known, n=2, cutoff=0.4)
            cure = f"closest: {', '.join(close)}" if close else f"use all, or some of {', '.join(known)}"
            raise ValueError(f"'{method}' is no method -> {cure}")
    return value


class Heading(_Section):
    """``[decay]``: what the report carries at its head."""

    name: str
    source: str = ""
    notes: str = ""
    virtual: bool = False
    truth: dict[str, float] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _truth_is_virtual(self) -> Heading:
        strangers = [name for name in self.truth if name not in TERMS]
        if strangers:
            raise ValueError(f"truth names '{strangers[0]}' -> terms are {', '.join(TERMS)}")
        if self.truth and not self.virtual:
            raise ValueError("only a virtual record has a known truth -> set virtual = true, or leave truth out")
        return self


class DecayChannels(_Section):
    """``[channels]``: columns of the record files; a record may differ."""

    time: str = "time"
    angle: str | None = None
    unit: str | None = None
    rate: str | None = None
    acceleration: str | None = None


class RecordEntry(DecayChannels):
    """``[[records]]``: one file, at the scale that it was measured at."""

    file: str
    name: str = ""
    motion: Motion = "roll"
    time: str | None = None  # type: ignore[assignment]
    speed: float = 0.0
    depth: float | None = Field(default=None, gt=0)
    scale: float = Field(default=1.0, gt=0)
    start: float | None = None
    end: float | None = None


class DecayReduction(_Section):
    """``[reduction]``: rest position, filter of the derivation fit, and where the free part starts and ends.

    The cut-off is in Hz, amplitudes are in degrees (heave: m).
    """

    offset: Offset = "drift"
    cutoff: float | None = Field(default=None, gt=0)
    first_amplitude: float | None = Field(default=None, gt=0)
    last_amplitude: float | None = Field(default=None, gt=0)
    skip: int = Field(default=0, ge=0)


class DecayFit(_Section):
    """``[fit]``: models and methods."""

    models: list[str] = Field(default_factory=lambda: ["linear+quadratic"], min_length=1)
    restoring: str = AUTO
    methods: list[str] = Field(default_factory=lambda: [ALL], min_length=1)
    speed_terms: list[str] = Field(default_factory=list)
    fixed: dict[str, float] = Field(default_factory=dict)
    gz: list[tuple[float, float]] = Field(default_factory=list)

    @field_validator("methods")
    @classmethod
    def _known_methods(cls, value: list[str]) -> list[str]:
        return _methods_among(value, tuple(METHODS))

    @model_validator(mode="after")
    def _known_models(self) -> DecayFit:
        try:
            curve = self.curve
        except TowtankError as error:
            raise ValueError(f"gz: {error.cause} -> {error.cure or 'give pairs of deg and m'}") from None
        if curve is not None and self.restoring not in (AUTO, "linear"):
            raise ValueError("gz is the restoring moment -> leave restoring out")
        for words in self.models:
            try:
                self.make_model(
                    words, "linear" if self.gz else "quintic" if self.restoring == AUTO else self.restoring
                )
            except TowtankError as error:
                raise ValueError(
                    f"{error.cause} -> damping is some of linear, quadratic, cubic joined by +; restoring is auto, "
                    "linear, cubic or quintic"
                ) from None
        return self

    def make_model(self, words: str, restoring: str) -> DampingModel:
        """One of the models with the restoring terms."""
        terms = damping_model(words, restoring).names
        fixed = {name: value for name, value in self.fixed.items() if name in terms or name in self.speed_terms}
        return damping_model(words, restoring, speed=self.speed_terms, fixed=fixed, curve=self.curve)

    @property
    def curve(self) -> RestoringCurve | None:
        """Shape of the restoring moment by the levers; None for c1 x."""
        if not self.gz:
            return None
        angle, lever = np.radians([row[0] for row in self.gz]), np.array([row[1] for row in self.gz])
        return RestoringCurve.from_levers(angle, lever)

    @property
    def chosen_methods(self) -> tuple[str, ...]:
        """Names of the methods."""
        return tuple(METHODS) if ALL in self.methods else tuple(dict.fromkeys(self.methods))


class IkedaSettings(_Section):
    """``[ikeda]``: what the simplified Ikeda formula asks for beside the ship, in m at the scale of `[ship]`."""

    midship_coefficient: float = Field(gt=0, le=1)
    keel_breadth: float = Field(default=0.0, ge=0)
    keel_length: float = Field(default=0.0, ge=0)
    viscosity: float = Field(default=1.14e-6, gt=0)


class MemorySettings(_Section):
    """``[memory]``: table of radiation, and what is known of inertia and restoring, at the scale of the table.

    Columns are found by their usual names when they are not given; the scale is that of ``[ship]``.
    """

    table: str
    frequency: str | None = None
    damping: str | None = None
    added_mass: str | None = None
    infinite: float | None = None
    scale: float | None = Field(default=None, gt=0)
    inertia: float | None = Field(default=None, gt=0)
    restoring: float | None = Field(default=None, gt=0)
    free: list[Literal["inertia", "restoring"]] = Field(default_factory=list)
    order: int | None = Field(default=None, ge=2, le=20)


class AtSeaSettings(_Section):
    """``[at_sea]``: the records are of a ship at sea, under an unknown excitation; angles in degrees.

    ``guess`` holds rough values of terms (SI), ``period`` a rough roll period in s at the scale of the records.
    """

    methods: list[str] = Field(default_factory=lambda: [ALL], min_length=1)
    terms: list[Term] = Field(default=["b1", "b3", "c1", "c3", "c5"], min_length=1)
    guess: dict[str, float] = Field(default_factory=dict)
    period: float | None = Field(default=None, gt=0)
    least_amplitude: float = Field(default=0.0, ge=0)
    most: int = Field(default=30, ge=1)
    noise: float | None = Field(default=None, ge=0)
    levels: list[float] = Field(default_factory=list)
    steps: dict[str, float] = Field(default_factory=dict)

    @field_validator("methods")
    @classmethod
    def _known_methods(cls, value: list[str]) -> list[str]:
        return _methods_among(value, AT_SEA_METHODS)

    @model_validator(mode="after")
    def _known_terms(self) -> AtSeaSettings:
        for name in self.guess:
            if name not in TERMS:
                raise ValueError(f"guess names '{name}' -> terms are {', '.join(TERMS)}")
        if any(not level > 0.0 for level in self.levels):
            raise ValueError("a trigger level is not positive -> give levels in deg")
        return self

    @property
    def chosen_methods(self) -> tuple[str, ...]:
        """Names of the methods."""
        return AT_SEA_METHODS if ALL in self.methods else tuple(dict.fromkeys(self.methods))


class DecayOutput(_Section):
    """``[output]``."""

    report: bool = True
    points: int = Field(default=25, ge=2, le=1000)


class DecayCampaign(_Section):
    """A whole decay campaign."""

    decay: Heading
    ship: dict[str, Any] | None = None
    channels: DecayChannels = Field(default_factory=DecayChannels)
    records: list[RecordEntry] = Field(min_length=1)
    reduction: DecayReduction = Field(default_factory=DecayReduction)
    fit: DecayFit = Field(default_factory=DecayFit)
    ikeda: IkedaSettings | None = None
    memory: MemorySettings | None = None
    at_sea: AtSeaSettings | None = None
    output: DecayOutput = Field(default_factory=DecayOutput)
    accept: list[str] = Field(default_factory=list)

    @model_validator(mode="after")
    def _ship_for_ikeda(self) -> DecayCampaign:
        if self.ikeda is not None and self.ship is None:
            raise ValueError("[ikeda] needs the particulars of the ship -> add a section [ship]")
        return self

    @model_validator(mode="after")
    def _roll_at_sea(self) -> DecayCampaign:
        if self.at_sea is not None:
            if self.memory is not None:
                raise ValueError("[memory] belongs to free decays -> leave it out of a campaign with [at_sea]")
            others = [entry.file for entry in self.records if entry.motion != "roll"]
            if others:
                raise ValueError(f"'{others[0]}' is no roll record -> [at_sea] is for roll")
        return self

    def make_ship(self) -> Ship | None:
        """The ship at the scale that it is given at; None when it is not."""
        return None if self.ship is None else Ship.from_dict(self.ship)


_SECTIONS: dict[str, type[BaseModel]] = {
    "decay": Heading,
    "channels": DecayChannels,
    "records": RecordEntry,
    "reduction": DecayReduction,
    "fit": DecayFit,
    "ikeda": IkedaSettings,
    "memory": MemorySettings,
    "at_sea": AtSeaSettings,
    "output": DecayOutput,
}


def load_decay_campaign(path: str | Path) -> DecayCampaign:
    """Read and check the file of a decay campaign.

    Raises
    ------
    CampaignError
        When the file is missing, is not TOML, or a key is wrong; the message names the key.
    """
    path = Path(path)
    return checked_campaign(read_toml(path, CampaignError, what="decay campaign"), path)


def checked_campaign(data: dict[str, Any], path: Path) -> DecayCampaign:
    """Decay campaign from a mapping, with errors that name the key; `path` stands in the messages."""
    if "decay" not in data and "campaign" in data:
        raise CampaignError(
            "this is a captive-test campaign",
            cure="use towtank run, or give a campaign with a section [decay]",
            file=path,
        )
    campaign = validated_sections(DecayCampaign, data, path, CampaignError, _SECTIONS)
    try:
        campaign.make_ship()
    except (TowtankError, TypeError) as error:
        cause = error.cause if isinstance(error, TowtankError) else str(error)
        cure = error.cure if isinstance(error, TowtankError) and error.cure else "complete or correct [ship]"
        raise CampaignError(cause, cure=cure, file=path, place="[ship]") from None
    return campaign


def command_line_campaign(
    files: Iterable[str | Path],
    *,
    record: dict[str, Any],
    sections: dict[str, Any],
    each: dict[str, list[Any]] | None = None,
    name: str = "",
) -> DecayCampaign:
    """Decay campaign of some files that share nearly everything.

    Parameters
    ----------
    files : iterable of str or Path
    record : dict
        Keys of every ``[[records]]`` entry; those that are None are left out.
    sections : dict
        Other sections by name.
    each : dict of str to list, optional
        Keys in which the files differ, one value a file; those that are None are left out.
    name : str
        Heading; the first file's when not given.
    """
    paths = [Path(file) for file in files]
    given = {key: value for key, value in record.items() if value is not None}
    own = [
        {key: values[number] for key, values in (each or {}).items() if values[number] is not None}
        for number in range(len(paths))
    ]
    data = {
        "decay": {"name": name or paths[0].stem},
        "records": [{"file": str(path), **given, **mine} for path, mine in zip(paths, own)],
        **{key: value for key, value in sections.items() if value is not None},
    }
    return checked_campaign(data, Path("command line"))
