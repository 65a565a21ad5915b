"""Trajectory: samples of one manoeuvre."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.trajectory import Trajectory


def test_speed_and_drift_angle_of_a_turn_to_starboard(circle):
    trajectory = circle().trajectory()
    assert trajectory.speed() == pytest.approx(5.0)
    assert np.degrees(trajectory.drift_angle()) == pytest.approx(12.0)
    assert np.degrees(circle(side=-1.0).trajectory().drift_angle()) == pytest.approx(-12.0)


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_speed_and_drift_follow_from_the_track_where_velocities_were_not_recorded(circle, side):
    whole = circle(side=side).trajectory()
    track = Trajectory(whole.frame.drop(columns=["u", "v"]), whole.ship, whole.manoeuvre)
    assert track.speed() == pytest.approx(whole.speed(), rel=3e-4)
    assert track.drift_angle() == pytest.approx(whole.drift_angle(), abs=2e-3)


def test_unknown_and_missing_columns_are_named(hull):
    with pytest.raises(TowtankError, match="unknown column 'heading'"):
        Trajectory(pd.DataFrame({"time": [0.0, 1.0], "heading": [0.0, 0.0]}), hull)
    with pytest.raises(TowtankError, match="'time' is missing"):
        Trajectory(pd.DataFrame({"psi": [0.0, 0.0]}), hull)


def test_one_sample_is_no_course(hull):
    with pytest.raises(TowtankError, match=r"1 sample.*at least two"):
        Trajectory.from_columns({"time": [0.0]}, hull)


def test_channel_that_was_not_recorded_is_named(zigzag):
    with pytest.raises(TowtankError, match=r"no channel 'phi'.*this trajectory has time, psi, delta, r"):
        zigzag().trajectory()["phi"]


def test_replaced_columns_are_noted_and_events_dropped(circle, turn_names):
    turn = circle()
    before = turn.trajectory()
    before = Trajectory(before.frame, before.ship, before.manoeuvre, events=turn.events(turn_names))
    after = before.with_columns("shifted by 1 m", x=before["x"] + 1.0)
    assert after.events is None
    assert after.provenance.history == ("shifted by 1 m",)
    assert after["x"][0] == before["x"][0] + 1.0


def test_track_is_drawn_in_ship_lengths_with_advance_upwards(circle):
    trajectory = circle().trajectory()
    axes = trajectory.plot_track()
    x, y = axes.lines[0].get_data()
    assert np.max(y) == pytest.approx(trajectory["x"].max() / 100.0)
    assert np.max(x) == pytest.approx(trajectory["y"].max() / 100.0)
    assert "/ L" in axes.get_xlabel()
    metres = trajectory.plot_track(lengths=False)
    assert np.max(metres.lines[0].get_data()[1]) == pytest.approx(trajectory["x"].max())
