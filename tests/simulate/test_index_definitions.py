"""Units and definitions of indices."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.index_definitions import DEFINITIONS, definition_of, index_frame


@pytest.mark.parametrize(
    ("name", "unit", "words"),
    [
        ("advance", "L", "90 deg"),
        ("tactical diameter", "L", "180 deg"),
        ("overshoot 2", "deg", "heading extreme 2"),
        ("time to check yaw 1", "s", "heading extreme 1"),
        ("time of execute 3", "s", "execute 3"),
        ("time to 270", "s", "270 deg"),
        ("speed ratio at 180", "-", "180 deg"),
        ("drift distance 360-720", "L", "360 and 720 deg"),
        ("drift direction 270-630", "deg", "270 deg to one of 630 deg"),
    ],
)
def test_every_index_has_unit_and_definition(name, unit, words):
    found = definition_of(name)
    assert found.unit == unit
    assert words in found.definition


def test_unknown_index_is_named():
    with pytest.raises(TowtankError, match="no index 'overshot 1'"):
        definition_of("overshot 1")


def test_advance_and_maximum_advance_are_told_apart():
    assert DEFINITIONS["advance"].definition != DEFINITIONS["maximum advance"].definition


def test_table_of_one_run_leaves_out_what_did_not_occur(hull):
    values = {"advance": np.array([3.1]), "transfer": np.array([np.nan]), "overshoot 1": 5.0}
    table = index_frame(values, "turning +35", hull)
    assert table["index"].tolist() == ["advance", "overshoot 1"]
    assert list(table.columns) == ["manoeuvre", "index", "value", "unit", "definition"]
    metres = index_frame(values, "turning +35", hull, "m")
    assert metres["unit"].tolist() == ["m", "deg"]
    assert metres["value"].tolist() == pytest.approx([310.0, 5.0])


def test_metres_need_a_ship_and_a_table_one_run():
    with pytest.raises(TowtankError, match="need a ship"):
        index_frame({"advance": 3.0}, "turning", lengths="m")
    with pytest.raises(TowtankError, match="has 2 values; this table is of one run"):
        index_frame({"advance": np.array([3.0, 3.1])}, "turning")
