"""Positions of sea trials in the axes of a manoeuvre."""

import math

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.simulate.found_events import find_events
from towtank.simulate.trajectory import Trajectory
from towtank.simulate.trial_axes import at_midship, local_position, on_original_course
from towtank.simulate.turning_indices import turning_indices


@pytest.mark.parametrize("latitude", [0.0, 45.0, 54.2, -60.0])
def test_a_minute_of_latitude_is_a_nautical_mile(latitude):
    start = math.radians(latitude)
    minute = math.radians(1.0 / 60.0)
    north, east = local_position(np.array([start, start + minute]), np.array([0.1, 0.1 + minute]))
    # The minute of the ellipsoid: 1852.2 m less 9.3 m times the cosine of twice the latitude.
    assert north[1] == pytest.approx(1852.2 - 9.3 * math.cos(2.0 * start), abs=0.3)
    assert east[1] == pytest.approx(1855.3 * math.cos(start + 0.5 * minute), rel=3.4e-3)
    assert (north[0], east[0]) == (0.0, 0.0)


def test_positions_across_the_date_line():
    _, east = local_position(np.array([0.5, 0.5]), np.radians([179.999, -179.999]))
    assert east[1] == pytest.approx(math.radians(0.002) * 6.378e6 * math.cos(0.5), rel=2e-3)


def test_no_positions_of_one_manoeuvre():
    with pytest.raises(ReadError, match="no positions of one manoeuvre"):
        local_position(np.array([54.0, 54.001]), np.array([7.9, 7.9]))
    with pytest.raises(ReadError, match="without outliers"):
        local_position(np.array([0.9, 0.9, 0.0]), np.array([0.1, 0.1, 0.0]))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_antenna_on_the_bridge_is_moved_to_midship(circle, hull, side):
    track = circle(side=side).trajectory()
    psi = track["psi"]
    bridge = track.with_columns(
        "antenna 35 m aft, 4 m to starboard",
        x=track["x"] - 35.0 * np.cos(psi) - 4.0 * np.sin(psi),
        y=track["y"] - 35.0 * np.sin(psi) + 4.0 * np.cos(psi),
    )
    moved = at_midship(bridge, -35.0, 4.0)
    np.testing.assert_allclose(moved["x"], track["x"], atol=1e-9)
    np.testing.assert_allclose(moved["y"], track["y"], atol=1e-9)
    wrong = turning_indices(find_events(bridge, execute=0.0), hull)["advance"]
    assert abs(wrong - turning_indices(find_events(moved, execute=0.0), hull)["advance"]) > 0.3
    assert "35 m forward" in moved.provenance.history[-1]


def test_course_in_any_direction(circle):
    north_east = circle(heading=0.9).trajectory()
    shifted = north_east.with_columns("far away", x=north_east["x"] + 5000.0, y=north_east["y"] - 300.0)
    home = on_original_course(shifted, execute=0.0)
    straight = circle().trajectory()
    for name in ("time", "x", "y", "psi"):
        np.testing.assert_allclose(home[name], straight[name], atol=1e-8)


def test_order_is_found_by_the_rudder(circle):
    record = circle().trajectory()
    steered = record.with_columns("rudder", delta=np.where(record["time"] > 20.0, 0.6, 0.0))
    home = on_original_course(steered)
    assert home["time"][20] == pytest.approx(0.0)
    assert (home["x"][20], home["y"][20], home["psi"][20]) == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)


def test_log_with_latitude_and_longitude(circle, hull, tmp_path):
    turn = circle().trajectory(turned=540.0)
    radius = 6371e3
    rows = np.column_stack(
        [
            turn["time"],
            54.0 + np.degrees(turn["x"] / radius),
            8.0 + np.degrees(turn["y"] / radius / math.cos(math.radians(54.0))),
            np.degrees(turn["psi"]) % 360.0,
        ]
    )
    path = tmp_path / "trial.csv"
    header = "time [s],lat [deg],lon [deg],heading [deg]"
    np.savetxt(path, rows, delimiter=",", header=header, comments="", fmt="%.9f")
    found = Trajectory.from_csv(path, hull, "turning +35")
    # The ellipsoid's radii differ from the sphere's by a few parts in a thousand.
    assert found["x"] == pytest.approx(turn["x"] - turn["x"][0], rel=5e-3, abs=1.5)
    assert found["y"] == pytest.approx(turn["y"] - turn["y"][0], rel=5e-3, abs=1.5)
    assert any("WGS 84" in step for step in found.provenance.history)
    assert turning_indices(find_events(found, execute=0.0), hull)["tactical diameter"] == pytest.approx(
        3.91, abs=0.03
    )
