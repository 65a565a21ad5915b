"""What may be named where a ship is to be sailed."""

from __future__ import annotations

import math

import pytest

from towtank.cli.vessel_source import load_vessel
from towtank.core.errors import ReadError, TowtankError
from towtank.datasets import load_set


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "derivatives.json"
    load_set("kvlcc2").to_json(path)
    return path


def test_a_named_ship_has_its_own_speed_or_another():
    assert load_vessel("kvlcc2").speed == 1.18
    assert load_vessel("KVLCC2", speed=0.9).speed == 0.9


def test_a_file_and_its_folder_are_the_same_set(file):
    by_file = load_vessel(str(file), ship_from="kvlcc2", speed=1.18)
    by_folder = load_vessel(str(file.parent), ship_from="kvlcc2", speed=1.18)
    assert by_file.hull["Nv"] == by_folder.hull["Nv"] == -0.137
    assert by_file.sources["propeller"] == "kvlcc2"


def test_with_a_lender_a_name_is_that_of_a_published_set():
    assert load_vessel("kvlcc2", ship_from="kcs", speed=1.0).sources["rudder"] == "kcs"


def test_a_bare_hull_asks_for_a_lender(file):
    with pytest.raises(ReadError, match=r"cannot be sailed: it lacks a propeller.*--ship-from kvlcc2") as caught:
        load_vessel(str(file))
    assert "derivatives.json" in str(caught.value)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("kvlcc3", "did you mean kvlcc2"),
        ("zzzzzz", "see: towtank simulate --list"),
        ("nothing.json", "file not found"),
    ],
)
def test_what_does_not_exist_is_answered(name, said):
    with pytest.raises(TowtankError, match=said):
        load_vessel(name)


@pytest.mark.parametrize("speed", [0.0, -1.0, math.nan, math.inf])
def test_a_speed_is_positive_and_finite(speed):
    with pytest.raises(TowtankError, match=r"approach speed .* is not positive -> give --speed"):
        load_vessel("kvlcc2", speed=speed)
