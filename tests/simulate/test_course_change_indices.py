"""Initial turning, pull-out, Williamson turn."""

import math

import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.course_change_indices import initial_turning_indices, pull_out_indices, williamson_indices


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_initial_turning_of_a_circle(circle, hull, side):
    turn = circle(side=side)
    found = initial_turning_indices(turn.events({"execute": 0.0, "heading 10": 10.0}), hull)
    assert found["initial turning track"] == pytest.approx(2.0 * math.radians(10.0), rel=2e-6)
    assert found["initial turning advance"] < found["initial turning track"]
    assert found["time to heading 10"] == pytest.approx(math.radians(10.0) / turn.rate)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_residual_rate_counts_from_the_side_of_the_turn(rows, hull, side):
    events = rows(
        execute={"time": 0.0, "r": 0.02 * side}, end={"time": 300.0, "r": 0.005 * side, "u": 4.0, "v": 3.0}
    )
    found = pull_out_indices(events, hull)
    assert found["residual yaw rate"] == pytest.approx(math.degrees(0.005))
    assert found["residual yaw rate L/U"] == pytest.approx(0.005 * 100.0 / 5.0)
    assert found["yaw rate before"] == pytest.approx(math.degrees(0.02))


def test_residual_rate_to_the_other_side_is_negative(rows, hull):
    events = rows(execute={"time": 0.0, "r": 0.02}, end={"time": 300.0, "r": -0.001, "u": 5.0, "v": 0.0})
    assert pull_out_indices(events, hull)["residual yaw rate"] == pytest.approx(-math.degrees(0.001))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_williamson_turn_comes_back_beside_its_track(rows, hull, side):
    events = rows(
        execute={"time": 10.0, "x": 0.0, "y": 0.0, "psi": 0.0},
        shift={"time": 60.0, "x": 200.0, "y": 60.0 * side, "psi": math.radians(60.0) * side},
        reciprocal={"time": 400.0, "x": 350.0, "y": 45.0 * side, "psi": -math.radians(179.0) * side},
        extreme={"time": 420.0, "x": 280.0, "y": 41.0 * side, "psi": -math.radians(184.0) * side},
        end={"time": 500.0, "x": -80.0, "y": 40.0 * side, "psi": -math.pi * side},
    )
    found = williamson_indices(events, hull)
    assert found["side offset"] == pytest.approx(0.4)
    assert found["course overshoot"] == pytest.approx(4.0)
    assert found["time to steady course"] == pytest.approx(490.0)
    assert found["distance back"] == pytest.approx(3.5)
    assert found["time to reciprocal course"] == pytest.approx(390.0)


def test_events_of_other_manoeuvres_are_refused(rows, hull):
    other = rows(execute_1={"time": 0.0})
    for function in (initial_turning_indices, pull_out_indices, williamson_indices):
        with pytest.raises(TowtankError, match="'execute' is missing"):
            function(other, hull)
