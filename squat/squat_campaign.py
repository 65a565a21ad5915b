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
from typing import Any

from pydantic import BaseModel, Field, model_validator

from ..core.errors import CampaignError, TowtankError
from ..core.ship import Ship
from ..formats.checked_toml import read_toml, validated_sections
from .campaign_sections import (
    CampaignSection,
    FairwayEntry,
    Heading,
    SpeedSteps,
    SquatChannels,
    SquatCorrection,
    SquatFilter,
    SquatFit,
    SquatHull,
    SquatOutput,
    SquatRecordEntry,
    SquatWindow,
)
from .sinkage_layout import SinkageLayout


class SquatCampaign(CampaignSection):
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

    def make_layout(self, *, waves: bool = False) -> SinkageLayout:
        """Channels on the ship at the scale of the records; the wave gauge is read in waves only."""
        shift = float(self.ship.get("xG", 0.0)) * float(self.ship.get("scale", 1.0)) / self.scale
        return self.channels.make_layout(self.length, shift, waves=waves)

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
