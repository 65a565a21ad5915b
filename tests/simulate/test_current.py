"""Current from the track of a turning circle."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError, ReadError
from towtank.simulate.current import estimate_current, remove_current, steady_turn
from towtank.simulate.found_events import find_events
from towtank.simulate.trajectory import Trajectory
from towtank.simulate.turning_indices import turning_indices


def measured(turn, noise=0.0, seed=11):
    """Track over the ground and heading of a turn."""
    whole = turn.trajectory()
    scatter = noise * np.random.default_rng(seed).standard_normal((2, len(whole)))
    columns = {
        "time": whole["time"],
        "x": whole["x"] + scatter[0],
        "y": whole["y"] + scatter[1],
        "psi": whole["psi"],
    }
    return Trajectory.from_columns(columns, whole.ship, whole.manoeuvre)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("current", [(0.12, 0.0), (-0.3, 0.4), (0.5, 0.75)])
def test_current_and_radius_of_an_exact_turn(circle, side, current):
    found = estimate_current(measured(circle(side=side, current=current)))
    assert (found.along, found.across) == pytest.approx(current, abs=1e-7)
    assert found.radius == pytest.approx(200.0, abs=1e-4)
    assert found.roundness < 1e-4
    assert found.speed == pytest.approx(math.hypot(*current))
    assert 0.0 <= found.direction <= 2.0 * math.pi
    heading = found.speed * math.cos(found.direction), found.speed * math.sin(found.direction)
    assert heading == pytest.approx(current, abs=1e-7)


def test_standard_errors_cover_the_truth(circle):
    misses = []
    for seed in range(20):
        found = estimate_current(measured(circle(current=(0.2, -0.1)), noise=0.5, seed=seed))
        misses += [(found.along - 0.2) / found.along_error, (found.across + 0.1) / found.across_error]
    assert 0.7 < np.std(misses) < 1.4
    assert np.abs(misses).max() < 4.0


def test_indices_without_the_current_are_those_in_still_water(circle, hull):
    record = measured(circle(current=(0.4, -0.2)), noise=0.05)
    corrected = remove_current(record, estimate_current(record), execute=0.0)
    found = turning_indices(find_events(corrected, execute=0.0), hull)
    still = turning_indices(find_events(measured(circle()), execute=0.0), hull)
    drifting = turning_indices(find_events(record, execute=0.0), hull)
    for name in ("advance", "transfer", "tactical diameter", "steady diameter"):
        assert found[name] == pytest.approx(still[name], abs=5e-3)
        assert abs(drifting[name] - still[name]) > 0.05
    assert found["drift distance 360-720"] == pytest.approx(0.0, abs=5e-3)


def test_removal_is_noted_and_keeps_the_place_of_the_order(circle):
    record = measured(circle(current=(0.4, -0.2)))
    corrected = remove_current(record, (0.4, -0.2), execute=10.0)
    row = 10
    assert (corrected["x"][row], corrected["y"][row]) == pytest.approx((record["x"][row], record["y"][row]))
    assert "current of 0.4 m/s along x and -0.2 m/s along y removed" in corrected.provenance.history[-1]


def test_order_is_found_by_the_rudder(circle):
    turn = circle(current=(0.4, 0.0))
    record = turn.trajectory()
    steered = record.with_columns("rudder", delta=np.where(record["time"] > 5.0, 0.6, 0.0))
    corrected = remove_current(steered, (0.4, 0.0))
    assert corrected["x"][5] == pytest.approx(record["x"][5], abs=1e-9)
    nameless = Trajectory(record.frame, record.ship)
    assert remove_current(nameless, (0.4, 0.0))["x"][0] == record["x"][0]


def test_velocities_over_the_ground_are_corrected_on_request(circle):
    turn = circle(current=(0.3, -0.2))
    water = turn.trajectory()
    psi = water["psi"]
    ground = water.with_columns(
        "over ground",
        u=water["u"] + 0.3 * np.cos(psi) - 0.2 * np.sin(psi),
        v=water["v"] - 0.3 * np.sin(psi) - 0.2 * np.cos(psi),
    )
    corrected = remove_current(ground, (0.3, -0.2), execute=0.0, over_ground=True)
    assert corrected["u"] == pytest.approx(water["u"])
    assert corrected["v"] == pytest.approx(water["v"])
    assert remove_current(water, (0.3, -0.2), execute=0.0)["u"] == pytest.approx(water["u"])


def test_steady_part_begins_when_the_rate_is_constant(hull):
    time = np.arange(0.0, 900.0, 1.0)
    rate = 0.02 * (1.0 - np.exp(-time / 60.0))
    psi = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]))])
    begin, end = steady_turn(Trajectory.from_columns({"time": time, "psi": psi}, hull, "turning"))
    assert end == 899.0
    assert 100.0 < begin < 350.0


def test_turn_that_is_too_short(circle):
    with pytest.raises(FitError, match=r"covers 199 deg; a current needs 270 -> turn on"):
        estimate_current(measured(circle()), window=(0.0, math.radians(200.5) / circle().rate))
    turn = circle().trajectory(turned=300.0)
    with pytest.raises(FitError, match="the turn has no steady part"):
        estimate_current(turn)


def test_track_must_be_there(zigzag):
    with pytest.raises(ReadError, match="channels missing for a zigzag"):
        estimate_current(zigzag().trajectory())
