"""Distances and headings between events."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.event_geometry import (
    across_course,
    along_course,
    heading_change,
    require_events,
    speed_at,
    turning_side,
    with_last_heading,
)


def test_distances_are_along_and_across_the_first_heading(rows):
    events = rows(
        execute={"time": 0.0, "x": 1.0, "y": 2.0, "psi": math.radians(30.0)},
        end={
            "time": 9.0,
            "x": 1.0 + math.cos(math.radians(75.0)),
            "y": 2.0 + math.sin(math.radians(75.0)),
            "psi": 1.0,
        },
    )
    assert along_course(events, "execute", "end") == pytest.approx(math.cos(math.radians(45.0)))
    assert across_course(events, "execute", "end") == pytest.approx(math.sin(math.radians(45.0)))
    assert heading_change(events, "execute", "end") == pytest.approx(1.0 - math.radians(30.0))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_side_of_the_turn(circle, side):
    assert turning_side(circle(side=side).events({"execute": 0.0, "heading 10": 10.0})) == side
    assert turning_side(circle(side=side).events({"execute": 0.0, "end": 3.0})) == side
    assert np.isnan(turning_side(circle().events({"execute": 0.0})))


def test_speed_is_of_both_components(rows):
    assert speed_at(rows(end={"time": 0.0, "u": 3.0, "v": -4.0}), "end") == 5.0


def test_end_becomes_a_heading_only_where_it_falls_on_one(circle):
    whole = with_last_heading(circle().events({"execute": 0.0, "heading 90": 90.0, "end": 180.0}))
    assert whole.at("heading 180", "time") == whole.at("end", "time")
    between = with_last_heading(circle().events({"execute": 0.0, "end": 185.0}))
    assert between.names == ("execute", "end")


def test_missing_event_is_named(rows):
    with pytest.raises(TowtankError, match=r"no events of a turn: 'end' is missing -> watched were execute"):
        require_events(rows(execute={"time": 0.0}), ("execute", "end"), "turn")
