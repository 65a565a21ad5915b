"""Steering gear, engine, event location and sampling of the compiled kernel."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.simulate.manoeuvres import course_keeping, crash_stop, schedule, turning, zigzag
from towtank.simulate.sailing import sail, sail_events
from towtank.simulate.ships import named_ship
from towtank.simulate.vessel import Engine

KVLCC2 = named_ship("kvlcc2")


def test_rate_limited_gear_runs_at_its_rate_and_stops_at_the_order():
    track = sail(KVLCC2, turning(20, heading=60.0), interval=0.1)
    rate = KVLCC2.gear.rate
    expected = np.minimum(rate * track["time"], math.radians(20.0))
    assert track["delta"] == pytest.approx(expected, abs=1e-13)


def test_lagged_gear_leaves_its_largest_rate_and_then_decays():
    gear = replace(KVLCC2.gear, lag=0.5)
    track = sail(KVLCC2.but(gear=gear), turning(20, heading=60.0), interval=0.1)
    order, t = math.radians(20.0), track["time"]
    turn = (order - gear.rate * gear.lag) / gear.rate
    late = order - gear.rate * gear.lag * np.exp(-(t - turn) / gear.lag)
    expected = np.where(t < turn, gear.rate * t, late)
    assert track["delta"] == pytest.approx(expected, abs=1e-7)


def test_events_lie_on_their_condition():
    turn = sail_events(KVLCC2, turning(-35)).events
    for mark in (10, 90, 180, 450):
        assert turn.at(f"heading {mark}", "psi")[0] == pytest.approx(-math.radians(mark), abs=1e-11)
    assert turn.at("end", "psi")[0] == pytest.approx(-3.0 * math.pi, abs=1e-11)
    row = {name: turn.at("maximum advance", name)[0] for name in ("u", "v", "psi")}
    along = row["u"] * math.cos(row["psi"]) - row["v"] * math.sin(row["psi"])
    assert along == pytest.approx(0.0, abs=1e-10)
    weave = sail_events(KVLCC2, zigzag(10)).events
    for k in (1, 2, 3):
        assert weave.at(f"extreme {k}", "r")[0] == pytest.approx(0.0, abs=1e-12)
        assert abs(weave.at(f"execute {k + 1}", "psi")[0]) == pytest.approx(math.radians(10.0), abs=1e-11)


def test_located_events_agree_with_a_hundred_times_finer_integration():
    coarse, fine = (sail_events(KVLCC2, zigzag(10), tolerance=t).events for t in (1e-6, 1e-11))
    for name in fine.names:
        assert coarse.at(name, "time")[0] == pytest.approx(fine.at(name, "time")[0], abs=1e-3)


def test_samples_stand_at_the_interval_and_end_with_the_manoeuvre():
    track = sail(KVLCC2, turning(35), interval=0.5)
    t = track["time"]
    assert np.allclose(t[:-1], 0.5 * np.arange(len(t) - 1))
    assert t[-1] == track.events.at("end", "time")[0]


def test_schedule_is_followed_between_its_points():
    t = np.linspace(0.0, 30.0, 16)
    rudder = 15.0 * np.sin(0.3 * t)
    track = sail(KVLCC2, schedule(t, rudder, 10.0 + 0.1 * t), interval=0.37)
    assert np.degrees(track["delta"]) == pytest.approx(np.interp(track["time"], t, rudder), abs=1e-9)
    assert track["n"] == pytest.approx(10.0 + 0.1 * track["time"], abs=1e-9)


def test_autopilot_reaches_its_course():
    track = sail(KVLCC2, course_keeping(150.0, gain=1.0, yaw_gain=10.0, course=-15.0))
    assert math.degrees(track["psi"][-1]) == pytest.approx(-15.0, abs=0.05)
    assert np.abs(track["delta"]).max() <= KVLCC2.gear.limit


def test_crash_stop_stops_and_a_lag_of_the_engine_makes_it_longer():
    vessel = KVLCC2.but(propeller=replace(KVLCC2.propeller, astern_KT=0.2))
    quick = sail_events(vessel, crash_stop(0.7)).events
    slow = sail_events(vessel.but(engine=Engine(lag=3.0)), crash_stop(0.7)).events
    assert quick.at("stopped", "u")[0] == pytest.approx(0.0, abs=1e-10)
    assert quick.at("speed 50", "u")[0] == pytest.approx(0.59, abs=1e-10)
    assert slow.at("stopped", "x")[0] > quick.at("stopped", "x")[0] + 1.0
    assert slow.at("stopped", "n")[0] == pytest.approx(-0.7 * slow.at("execute", "n")[0], rel=1e-4)


def test_engine_of_constant_torque_slows_down_in_a_turn():
    propeller = replace(KVLCC2.propeller, KQ=(0.032, -0.022, -0.010))
    engine = Engine("constant torque", inertia=0.05)
    track = sail(KVLCC2.but(propeller=propeller, engine=engine), turning(35))
    n = track["n"]
    assert n[-1] < 0.95 * n[0]
    fixed = sail(KVLCC2.but(propeller=propeller), turning(35))
    assert np.all(fixed["n"] == fixed["n"][0])
    assert track.speed()[-1] < fixed.speed()[-1]
