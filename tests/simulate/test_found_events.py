"""Events found in samples against exact ones; noise, hunting rudders, and records that cannot be used."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError, TowtankError
from towtank.simulate.found_events import find_events, with_events
from towtank.simulate.manoeuvres import turning, williamson
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.trajectory import Trajectory
from towtank.simulate.turning_indices import turning_indices
from towtank.simulate.zigzag_indices import zigzag_indices


def noisy(trajectory: Trajectory, seed: int = 3, **levels: float) -> Trajectory:
    random = np.random.default_rng(seed)
    columns = {
        name: trajectory[name] + level * random.standard_normal(len(trajectory)) for name, level in levels.items()
    }
    return trajectory.with_columns("noise", **columns)


def only(trajectory: Trajectory, *names: str) -> Trajectory:
    return Trajectory(trajectory.frame[list(names)], trajectory.ship, trajectory.manoeuvre)


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("step", [0.2, 2.0])
def test_turn_is_found_between_the_samples(circle, turn_names, hull, side, step):
    turn = circle(side=side)
    found = find_events(turn.trajectory(step=step), execute=0.0)
    exact = turn.events({**turn_names, "maximum advance": 102.0, "maximum transfer": 192.0})
    for name in exact:
        if name != "end":
            for column in ("time", "x", "y", "psi", "r"):
                assert found.at(name, column) == pytest.approx(exact.at(name, column), abs=3e-3), (name, column)


def test_turn_from_track_and_heading_alone(circle, hull):
    turn = circle()
    found = turning_indices(find_events(only(turn.trajectory(), "time", "x", "y", "psi"), execute=0.0), hull)
    assert found["advance"] == pytest.approx(2.0 * (math.cos(turn.beta) + math.sin(turn.beta)), abs=1e-5)
    assert found["steady diameter"] == pytest.approx(4.0, rel=1e-3)
    assert found["steady drift angle"] == pytest.approx(12.0, abs=0.1)


def test_noise_of_a_sea_trial_hardly_moves_the_indices(circle, hull):
    turn = circle()
    record = noisy(only(turn.trajectory(), "time", "x", "y", "psi"), x=0.5, y=0.5, psi=math.radians(0.2))
    found = turning_indices(find_events(record, execute=0.0), hull)
    c, s = math.cos(turn.beta), math.sin(turn.beta)
    assert found["advance"] == pytest.approx(2.0 * (c + s), abs=0.02)
    assert found["tactical diameter"] == pytest.approx(4.0 * c, abs=0.02)
    assert found["maximum transfer"] == pytest.approx(2.0 * (1.0 + c), abs=0.02)
    assert found["steady diameter"] == pytest.approx(4.0, abs=0.04)
    assert found["steady yaw rate"] == pytest.approx(math.degrees(turn.rate), rel=0.01)


def test_extremes_are_missing_when_the_record_ends_before_them(circle):
    found = find_events(circle().trajectory(turned=95.0), execute=0.0)
    assert found.occurred("heading 90").all()
    assert not found.occurred("heading 180").any()
    assert not found.occurred("maximum transfer").any()


def test_first_heel_of_a_rolling_ship(circle):
    trajectory = circle().trajectory()
    t = trajectory["time"]
    # d/dt of exp(-t/40) sin(t/10) is zero at tan(t/10) = 4.
    heeled = trajectory.with_columns("heel", phi=-0.2 * np.exp(-t / 40.0) * np.sin(t / 10.0))
    found = find_events(heeled, execute=0.0)
    assert found.at("maximum heel", "time") == pytest.approx(10.0 * math.atan(4.0), abs=2e-2)
    assert found.at("maximum heel", "phi") < 0.0


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("step", [0.1, 0.5, 1.0])
def test_exact_zigzag_between_the_samples(zigzag, side, step):
    run = zigzag(side=side)
    found = find_events(run.trajectory(step=step))
    for number, (moment, psi) in enumerate(run.extremes, start=1):
        assert found.at(f"extreme {number}", "time") == pytest.approx(moment, abs=0.02)
        assert found.at(f"extreme {number}", "psi") == pytest.approx(psi, abs=2e-5)
    for number, moment in enumerate(run.moments[1:], start=2):
        assert found.at(f"execute {number}", "time") == pytest.approx(moment, abs=0.02)


@pytest.mark.parametrize("seed", range(4))
def test_noise_makes_no_extremes(zigzag, hull, seed):
    run = zigzag()
    found = find_events(run.trajectory(noise=math.radians(0.15), seed=seed))
    assert [name for name in found if name.startswith("extreme")] == [f"extreme {n}" for n in range(1, 6)]
    indices = zigzag_indices(found, hull)
    for number in range(1, 5):
        assert indices[f"overshoot {number}"] == pytest.approx(math.degrees(run.overshoot(number)), abs=0.25)


def test_hunting_rudder_is_no_reversal(zigzag):
    run = zigzag()
    clean = run.trajectory()
    hunting = clean["delta"] + math.radians(3.0) * np.sin(clean["time"]) * (clean["delta"] != 0.0)
    found = find_events(clean.with_columns("hunting", delta=hunting))
    assert sum(name.startswith("execute") for name in found) == len(run.moments)


def test_bump_of_the_heading_before_the_rudder_is_reversed_is_no_extreme(zigzag):
    run = zigzag()
    record = run.trajectory()
    # A wave turns the ship back for a moment on its way to the first switching heading.
    bump = -math.radians(2.0) * np.exp(-(((record["time"] - run.moments[1] + 12.0) / 3.0) ** 2))
    bumped = record.with_columns("bump", psi=record["psi"] + bump)
    found = find_events(only(bumped, "time", "psi", "delta"))
    assert found.at("extreme 1", "time") == pytest.approx(run.extremes[0][0], abs=0.05)


def test_last_extreme_needs_a_heading_that_comes_back(zigzag):
    run = zigzag()
    record = run.trajectory()
    last = run.extremes[-1][0]
    cut = Trajectory(record.frame[record["time"] < last - 1.0], record.ship, record.manoeuvre)
    found = find_events(cut)
    assert np.isnan(found.at("extreme 5", "time")).all()
    assert found.occurred("extreme 4").all()


def test_switching_heading_is_where_the_rudder_moves_when_the_name_does_not_say_it(zigzag):
    run = zigzag()
    record = run.trajectory(step=0.1)
    found = find_events(Trajectory(record.frame, record.ship, "zigzag"))
    assert found.at("execute 2", "psi") == pytest.approx(run.switch, abs=math.radians(0.1))


def test_reach_is_the_first_return_to_the_course(zigzag, hull):
    run = zigzag()
    found = find_events(run.trajectory())
    assert found.at("return 1", "psi") == pytest.approx(0.0, abs=1e-6)
    assert run.extremes[0][0] < found.at("return 1", "time")[0] < run.moments[2]


@pytest.mark.parametrize("before", [0.0, -60.0])
def test_pull_out_ends_with_the_residual_rate(hull, before):
    time = np.arange(before, 400.0, 1.0)
    after = np.clip(time - 50.0, 0.0, None)
    rate = 0.01 * np.exp(-after / 40.0)
    psi = np.cumsum(rate)
    # The longer record begins before the rudder was put over to the turn.
    delta = np.where((time > 50.0) | (time < -30.0), 0.0, math.radians(20.0))
    found = find_events(
        Trajectory.from_columns({"time": time, "psi": psi, "r": rate, "delta": delta}, hull, "pull-out")
    )
    assert found.at("execute", "time") == pytest.approx(50.0, abs=1.0)
    assert found.at("execute", "r") == pytest.approx(0.01)
    assert found.at("end", "r") == pytest.approx(rate[-1], abs=1e-6)


def test_crash_stop_is_found_from_propeller_and_speed(hull):
    time = np.arange(0.0, 300.0, 1.0)
    u = np.where(time < 20.0, 6.0, 6.0 - 0.03 * (time - 20.0))
    x = np.concatenate([[0.0], np.cumsum(0.5 * (u[1:] + u[:-1]))])
    n = np.where(time <= 20.0, 2.0, -1.5)
    columns = {"time": time, "x": x, "y": 0.0 * x, "psi": 0.0 * x, "u": u, "v": 0.0 * u, "n": n}
    found = find_events(Trajectory.from_columns(columns, hull, "crash stop"))
    assert found.at("execute", "time") == pytest.approx(20.0, abs=0.01)
    assert found.at("stopped", "time") == pytest.approx(220.0, abs=1e-6)
    assert found.at("speed 50", "u") == pytest.approx(3.0, abs=0.01)


def test_initial_turning(circle):
    found = find_events(circle().trajectory(turned=40.0, manoeuvre="initial turning +10"), execute=0.0)
    assert found.names == ("execute", "heading 10", "end")
    assert found.at("heading 10", "psi") == pytest.approx(math.radians(10.0))


def test_events_of_a_simulation_are_kept(circle, turn_names):
    turn = circle()
    known = Trajectory(turn.trajectory().frame, turn.trajectory().ship, "turning", events=turn.events(turn_names))
    assert with_events(known) is known
    assert with_events(turn.trajectory(), execute=0.0).events is not None


@pytest.mark.parametrize("rudder", [35.0, -35.0])
def test_williamson_turn_is_found_as_it_was_sailed(rudder):
    known = sail(named_ship("kvlcc2"), williamson(rudder))
    found = find_events(replace(known, events=None))
    for name in ("execute", "shift", "reciprocal", "extreme", "end"):
        for column in ("time", "x", "y", "psi"):
            assert found.at(name, column) == pytest.approx(known.events.at(name, column), abs=0.02), (name, column)


class TestFailures:
    def test_williamson_turn_that_is_not_finished(self):
        known = sail(named_ship("kvlcc2"), williamson(35.0))
        early = known.frame[known["time"] < known.events.at("reciprocal less", "time")[0]]
        with pytest.raises(ReadError, match=r"the record ends 20.6 deg beside the reciprocal course"):
            find_events(replace(known, frame=early, events=None))

    def test_williamson_turn_without_a_shift(self):
        turn = sail(named_ship("kvlcc2"), turning(35.0))
        with pytest.raises(ReadError, match="this is no Williamson turn"):
            find_events(replace(turn, manoeuvre="williamson", events=None))

    def test_two_samples(self, hull):
        columns = {"time": [0.0, 1.0], "x": [0.0, 1.0], "y": [0.0, 0.0], "psi": [0.0, 0.1]}
        record = Trajectory.from_columns(columns, hull, "turning")
        with pytest.raises(ReadError, match="2 samples do not describe a manoeuvre"):
            find_events(record, execute=0.0)

    def test_missing_channel(self, circle):
        with pytest.raises(ReadError, match=r"channels missing for a turning: y -> .*has time, x, psi"):
            find_events(only(circle().trajectory(), "time", "x", "psi"), execute=0.0)

    def test_missing_value(self, circle):
        record = circle().trajectory()
        psi = record["psi"].copy()
        psi[10:12] = np.nan
        with pytest.raises(ReadError, match=r"sample 11: 'psi' has no value in 2 of \d+ samples"):
            find_events(record.with_columns("hole", psi=psi), execute=0.0)

    def test_gap(self, circle):
        record = circle().trajectory()
        rows = (record["time"] < 100.0) | (record["time"] > 160.0)
        with pytest.raises(ReadError, match=r"a gap of 62 s after 99 s"):
            find_events(Trajectory(record.frame[rows], record.ship, record.manoeuvre), execute=0.0)

    def test_repeated_time(self, circle):
        record = circle().trajectory()
        time = record["time"].copy()
        time[5] = time[4]
        with pytest.raises(ReadError, match=r"sample 6: time does not increase: 4 s follows 4 s"):
            find_events(record.with_columns("stutter", time=time), execute=0.0)

    def test_no_heading_change(self, circle):
        with pytest.raises(ReadError, match=r"heading changes by 2 deg .* this is no turn"):
            find_events(circle().trajectory(turned=2.0, step=0.2), execute=0.0)

    def test_no_order(self, circle):
        with pytest.raises(ReadError, match=r"without the channel 'delta' .*execute=<time in s>"):
            find_events(circle().trajectory())
        still = circle().trajectory()
        with pytest.raises(ReadError, match="the rudder does not move"):
            find_events(still.with_columns("rudder", delta=0.0 * still["time"] + 0.6))

    def test_order_outside_the_record(self, circle):
        with pytest.raises(ReadError, match=r"execute = -5 s is outside the record from 0 to"):
            find_events(circle().trajectory(), execute=-5.0)

    def test_rudder_with_the_opposite_sign(self, zigzag):
        record = zigzag().trajectory()
        with pytest.raises(
            AuditError, match=r"turns to starboard with the rudder to port .*signs=\{'delta': -1\}"
        ):
            find_events(record.with_columns("sign", delta=-record["delta"]))

    def test_rudder_that_is_never_reversed(self, zigzag):
        record = zigzag().trajectory()
        with pytest.raises(ReadError, match="never reversed"):
            find_events(record.with_columns("once", delta=np.where(record["time"] > 20.0, 0.17, 0.0)))

    def test_manoeuvre_without_a_name(self, circle):
        with pytest.raises(TowtankError, match="names no known manoeuvre"):
            find_events(circle().trajectory(manoeuvre="run 7"))
