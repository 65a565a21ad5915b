"""TOML files: each fault is said with file, key, cause and cure."""

from __future__ import annotations

from pathlib import Path

import pytest
from pydantic import BaseModel, ConfigDict, Field, field_validator

from towtank.core.errors import CampaignError, ReadError
from towtank.formats.checked_toml import read_toml, validated_sections


class Wind(BaseModel):
    model_config = ConfigDict(extra="forbid")

    speed: float = Field(ge=0)
    direction: float = 0.0

    @field_validator("direction")
    @classmethod
    def _known(cls, value: float) -> float:
        if abs(value) > 360.0:
            raise ValueError(f"{value:g} deg is no direction -> give -360 to 360")
        return value


class Sea(BaseModel):
    model_config = ConfigDict(extra="forbid")

    name: str = ""
    wind: Wind | None = None


def checked(data: dict) -> Sea:
    return validated_sections(Sea, data, Path("sea.toml"), CampaignError, {"wind": Wind})


def test_contents_become_a_model(tmp_path):
    path = tmp_path / "sea.toml"
    path.write_text('name = "Nordsee"\n[wind]\nspeed = 2.5\n', encoding="utf-8")
    found = checked(read_toml(path, ReadError))
    assert (found.name, found.wind.speed, found.wind.direction) == ("Nordsee", 2.5, 0.0)


@pytest.mark.parametrize(
    ("content", "cause"),
    [
        (b"name = ", "not valid TOML: .*-> mend the syntax"),
        (b"\xff\xfe\x00", "not a text file -> a campaign.toml is TOML in utf-8"),
        (None, "file not found -> give the path of a campaign.toml"),
    ],
)
def test_files_that_are_no_toml(tmp_path, content, cause):
    path = tmp_path / "sea.toml"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(CampaignError, match=cause) as caught:
        read_toml(path, CampaignError, what="campaign.toml")
    assert "sea.toml" in str(caught.value)


def test_a_folder_is_no_file(tmp_path):
    with pytest.raises(ReadError, match="this is a folder"):
        read_toml(tmp_path, ReadError)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        ({"wnd": {}}, "key 'wnd': unknown key -> closest: wind"),
        ({"wind": {"speed": 1.0, "spede": 2.0}}, "key 'wind.spede': unknown key -> closest: speed"),
        ({"wind": {"speed": 1.0, "zzz": 2.0}}, "key 'wind.zzz': unknown key -> keys here are speed, direction"),
        ({"wind": {}}, "key 'wind.speed': the key is missing -> add it"),
        ({"wind": {"speed": -1.0}}, "key 'wind.speed': input should be greater than or equal to 0, not -1.0"),
        ({"wind": {"speed": 1.0, "direction": 400.0}}, "400 deg is no direction -> give -360 to 360"),
    ],
)
def test_the_key_the_cause_and_the_cure_are_named(data, said):
    with pytest.raises(CampaignError) as caught:
        checked(data)
    assert "sea.toml" in str(caught.value)
    assert said in str(caught.value)


def test_a_misspelt_key_is_told_before_the_one_that_it_leaves_missing():
    with pytest.raises(CampaignError, match=r"'wind.spd': unknown key \(and 1 more\) -> closest: speed"):
        checked({"wind": {"spd": 2.0}})
