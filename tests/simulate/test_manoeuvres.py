"""Programmes of the standard manoeuvres: events, their order, and what they do."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.manoeuvres import (
    initial_turning,
    pull_out,
    reverse_spiral,
    schedule,
    spiral,
    turning,
    williamson,
    zigzag,
)
from towtank.simulate.sailing import sail, sail_events
from towtank.simulate.ships import named_ship
from towtank.simulate.zigzag_indices import zigzag_indices

KVLCC2 = named_ship("kvlcc2")


def test_names_of_the_events():
    assert turning(35, 360).event_names() == (
        "execute", "heading 10", "heading 20", "heading 30", "heading 60", "heading 90", "heading 180",
        "heading 270", "maximum advance", "maximum transfer", "maximum heel", "end",
    )  # fmt: skip
    names = set(zigzag(10, overshoots=2).event_names())
    assert names == {"execute 1", "execute 2", "execute 3", "extreme 1", "extreme 2", "return 1", "end"}
    assert zigzag(-20, 10).name == "zigzag -20/10"


def test_modified_zigzag_switches_at_its_heading():
    events = sail_events(KVLCC2, zigzag(20, 10)).events
    assert math.degrees(events.at("execute 2", "psi")[0]) == pytest.approx(10.0, abs=1e-9)
    assert math.degrees(events.at("extreme 1", "delta")[0]) == pytest.approx(-20.0, abs=1e-9)


def test_initial_turning_is_the_beginning_of_a_turn():
    first = sail_events(KVLCC2, initial_turning(10)).events
    turn = sail_events(KVLCC2, turning(10, 90)).events
    assert first["heading 10"][0] == pytest.approx(turn["heading 10"][0], rel=1e-3, abs=1e-3)


def test_pull_out_begins_in_the_steady_turn():
    events = sail_events(KVLCC2, pull_out(20)).events
    turn = sail_events(KVLCC2, turning(20, 1080)).events
    assert events.at("execute", "r")[0] == pytest.approx(turn.at("end", "r")[0], rel=2e-3)
    assert abs(events.at("end", "r")[0]) < 0.05 * events.at("execute", "r")[0]


def test_spiral_holds_each_angle_until_the_turn_is_steady():
    events = sail_events(KVLCC2, spiral((20, 10, -10), there_and_back=True)).events
    angles = [math.degrees(events.at(f"steady {k}", "delta")[0]) for k in range(1, 6)]
    assert angles == pytest.approx([20, 10, -10, 10, 20], abs=1e-9)
    turn = sail_events(KVLCC2, turning(20, 1080)).events
    assert events.at("steady 5", "r")[0] == pytest.approx(turn.at("end", "r")[0], rel=2e-3)


def test_reverse_spiral_finds_the_angle_of_a_steady_turn():
    rate = math.degrees(sail_events(KVLCC2, turning(10, 1080)).events.at("end", "r")[0])
    events = sail_events(KVLCC2, reverse_spiral([rate], gain=20.0, integral=2.0)).events
    assert math.degrees(events.at("steady 1", "delta")[0]) == pytest.approx(10.0, abs=0.1)


@pytest.mark.parametrize("rudder", [35, -35])
def test_williamson_turn_is_steadied_on_the_reciprocal_course_near_its_track(rudder):
    events = sail_events(KVLCC2, williamson(rudder)).events
    side = math.copysign(1.0, rudder)
    turned = {name: math.degrees(events.at(name, "psi")[0]) * side for name in events}
    assert turned["shift"] == pytest.approx(60.0, abs=1e-9)
    assert turned["reciprocal"] == pytest.approx(-179.0, abs=1e-9)
    assert -190.0 < turned["extreme"] < -180.0
    assert turned["end"] == pytest.approx(-180.0, abs=0.5)
    assert abs(events.at("end", "r")[0]) < 0.005 * KVLCC2.speed / KVLCC2.ship.L
    assert abs(events.at("end", "y")[0]) < 1.5 * KVLCC2.ship.L
    assert events.at("end", "u")[0] > 0.9 * KVLCC2.speed
    # still ahead of the place of the order, where a man overboard would be
    assert 0.0 < events.at("reciprocal", "x")[0] < 6.0 * KVLCC2.ship.L


def test_williamson_turn_of_a_ship_with_weather_helm_ends_on_the_course():
    mariner = named_ship("mariner")
    heading = {
        gain: sail_events(mariner, williamson(-35, integral=gain, steady=2e-3)).events.at("end", "psi")[0]
        for gain in (0.0, 0.05)
    }
    assert abs(math.degrees(heading[0.0]) - 180.0) > 1.0
    assert abs(math.degrees(heading[0.05]) - 180.0) < 0.3


def test_zigzag_returns_to_its_course_between_extreme_and_next_execute():
    events = sail_events(KVLCC2, zigzag(-20)).events
    for number in (1, 2):
        assert events.at(f"return {number}", "psi")[0] == pytest.approx(0.0, abs=1e-10)
        times = [events.at(f"{name}", "time")[0] for name in (f"extreme {number}", f"return {number}")]
        assert times[0] < times[1] < events.at(f"execute {number + 2}", "time")[0]
    assert np.isfinite(zigzag_indices(events, KVLCC2.ship)["reach"][0])


@pytest.mark.parametrize("rudder", [10, -10])
def test_largest_heel_of_a_turn_is_outward_and_at_rest(rudder):
    vessel = named_ship("s175-4dof")
    track = sail(vessel, turning(rudder, 180))
    events = track.events
    assert events.at("maximum heel", "p")[0] == pytest.approx(0.0, abs=1e-10)
    outward = -math.copysign(1.0, rudder) * track["phi"]
    assert -math.copysign(1.0, rudder) * events.at("maximum heel", "phi")[0] == pytest.approx(
        outward.max(), rel=2e-3
    )
    assert "maximum heel" not in sail_events(KVLCC2, turning(rudder, 90)).events


@pytest.mark.parametrize("make", [turning, zigzag, initial_turning, pull_out, williamson])
def test_rudder_of_zero_is_an_error(make):
    with pytest.raises(SimulationError, match="neither side"):
        make(0.0)


def test_schedule_with_blanks_or_without_order_is_an_error():
    with pytest.raises(SimulationError, match="without blanks"):
        schedule([0.0, 1.0], [0.0, np.nan])
    with pytest.raises(SimulationError, match="do not ascend"):
        sail_events(KVLCC2, schedule([0.0, 2.0, 1.0], [0.0, 1.0, 2.0]))
