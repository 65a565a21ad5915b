"""Crash stop in closed form: a straight track at constant deceleration."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.stopping_indices import stopping_indices


def straight_stop(rows, speed=6.0, deceleration=0.02, shares=(90, 70, 50, 30, 10)):
    def state(share):
        u = 0.01 * share * speed
        return {
            "time": (speed - u) / deceleration,
            "x": 0.5 * (speed**2 - u**2) / deceleration,
            "y": 0.0,
            "psi": 0.0,
            "u": u,
            "v": 0.0,
        }

    on_the_way = {f"speed_{share}": state(share) for share in shares}
    return rows(execute=state(100), **on_the_way, stopped=state(0))


def test_straight_stop(rows, hull):
    found = {name: values[0] for name, values in stopping_indices(straight_stop(rows), hull).items()}
    assert found == pytest.approx(
        {
            "track reach": 9.0,
            "head reach": 9.0,
            "side reach": 0.0,
            "stopping time": 300.0,
            "heading change at stop": 0.0,
        }
    )


def test_track_that_was_integrated_is_taken(rows, hull):
    assert stopping_indices(straight_stop(rows), hull, track=1234.0)["track reach"] == pytest.approx(12.34)


def test_side_reach_is_positive_to_starboard(rows, hull):
    events = rows(
        execute={"time": 0.0, "x": 0.0, "y": 0.0, "psi": 0.0, "u": 5.0, "v": 0.0},
        stopped={"time": 200.0, "x": 400.0, "y": 150.0, "psi": 0.9, "u": 0.0, "v": 0.1},
    )
    found = stopping_indices(events, hull)
    assert found["side reach"] == pytest.approx(1.5)
    assert found["heading change at stop"] == pytest.approx(np.degrees(0.9))
    assert found["track reach"] > np.hypot(4.0, 1.5)


def test_ship_that_does_not_stop_has_no_reach(rows, hull):
    events = rows(execute={"time": 0.0, "x": 0.0, "y": 0.0, "psi": 0.0, "u": 5.0, "v": 0.0}, stopped={})
    found = stopping_indices(events, hull, track=1234.0)
    assert all(np.isnan(values).all() for values in found.values())
    with pytest.raises(TowtankError, match="no events of a crash stop"):
        stopping_indices(rows(execute={"time": 0.0}), hull)
