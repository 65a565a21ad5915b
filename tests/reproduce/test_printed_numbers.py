"""Rows of published tables."""

import math

import pytest

from towtank.core.errors import DatasetError
from towtank.reproduce.printed_numbers import KNOT, printed_by, printed_rows, ship_of


def test_rows_are_plain_mappings_in_the_order_of_the_print():
    rows = printed_rows("dtc-drift-points")
    assert [row["beta"] for row in rows] == [0, 3, 6, 9, 12]
    assert rows[1] == {"beta": 3, "v": -0.0523, "X": -0.0226, "Y": 0.0062, "N": 0.0057}
    assert type(rows[1]["v"]) is float


def test_empty_cells_are_nan():
    assert math.isnan(printed_by("dtc-yaw-harmonics", "harmonic")["X_0"]["rrr"])


def test_rows_by_a_column():
    assert printed_by("kcs-depth-grid-ratios", "quantity")["Y"]["R_G"] == -0.1043


def test_a_column_that_does_not_tell_rows_apart_is_an_error():
    with pytest.raises(DatasetError, match="share a value of motion"):
        printed_by("dtmb5512-pmm-programme", "motion")


def test_ship_of_a_table():
    assert ship_of("dtc-pmm-programme").L == 3.55
    with pytest.raises(DatasetError, match="has no ship"):
        ship_of("kcs-depth-grid-ratios")


def test_knot():
    assert pytest.approx(0.514444, abs=1e-6) == KNOT
