"""Drift of a turning circle and the safety index."""

import math

import numpy as np
import pytest

from towtank.simulate.turning_drift import (
    drift_indices,
    relative_drift_direction,
    safety_index,
    safety_index_of_turns,
    turning_direction,
    turning_distance,
)


@pytest.mark.parametrize(("start", "end"), [(360, 720), (270, 630)])
def test_a_current_drifts_the_circle_by_its_path_in_one_turn(circle, turn_names, hull, start, end):
    turn = circle(current=(-0.3, 0.4))
    found = drift_indices(turn.events(turn_names), hull, start, end)
    period = 2.0 * math.pi / turn.rate
    assert found[f"drift distance {start}-{end}"] == pytest.approx(0.5 * period / 100.0)
    assert found[f"drift direction {start}-{end}"] == pytest.approx(math.degrees(math.atan2(0.4, -0.3)))


def test_mirrored_turns_drift_alike(circle, turn_names, hull):
    starboard = drift_indices(circle(current=(-0.3, 0.4)).events(turn_names), hull)
    port = drift_indices(circle(side=-1.0, current=(-0.3, -0.4)).events(turn_names), hull)
    assert {k: v[0] for k, v in port.items()} == pytest.approx({k: v[0] for k, v in starboard.items()})


def test_direction_counts_from_the_original_course(circle, turn_names, hull):
    heading = 0.7
    along = circle(heading=heading, current=(0.2 * math.cos(heading), 0.2 * math.sin(heading)))
    found = drift_indices(along.events(turn_names), hull)["drift direction 360-720"][0]
    assert min(found, 360.0 - found) == pytest.approx(0.0, abs=1e-8)


def test_relative_direction_is_wrapped():
    found = relative_drift_direction([270.0, 10.0, 180.0], [272.0, 350.0, 0.0])
    assert found == pytest.approx([-2.0, 20.0, -180.0])


def test_safety_index_is_zero_in_calm_water_and_rises_when_the_ship_turns_aside():
    assert safety_index_of_turns(3.0, 1.5, 3.0, 1.5) == pytest.approx(0.0)
    assert safety_index_of_turns(2.5, 1.5, 3.0, 1.5) > 0.0
    assert safety_index_of_turns(3.5, 1.2, 3.0, 1.5) < 0.0
    assert safety_index([1.2, 0.9], [0.8, 1.0]) == pytest.approx([0.5, -0.1])


def test_distance_and_direction_at_ninety_degrees():
    assert turning_distance([3.0, 6.0], [4.0, 8.0]) == pytest.approx([5.0, 10.0])
    assert turning_direction(1.0, 1.0) == pytest.approx(45.0)
    assert np.shape(turning_direction([1.0, 2.0], [1.0, 2.0])) == (2,)
