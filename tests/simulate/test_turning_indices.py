"""Indices of a turning circle against circles in closed form."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.events import Events, stack_events
from towtank.simulate.turning_indices import turning_indices


def exact(turn, names, beta):
    """Events of a circle with its two extremes of the track, at 90 and 180 degrees of course."""
    drift = math.degrees(beta)
    return turn.events({**names, "maximum advance": 90.0 + drift, "maximum transfer": 180.0 + drift})


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("heading", [0.0, 2.0])
def test_distances_of_a_drifting_ship(circle, turn_names, hull, side, heading):
    turn = circle(side=side, heading=heading)
    found = turning_indices(exact(turn, turn_names, turn.beta), hull)
    c, s = math.cos(turn.beta), math.sin(turn.beta)
    expected = {
        "advance": 2.0 * (c + s),
        "maximum advance": 2.0 * (1.0 + s),
        "transfer": 2.0 * (c - s),
        "maximum transfer": 2.0 * (1.0 + c),
        "tactical diameter": 4.0 * c,
        "steady diameter": 4.0,
        "steady drift angle": 12.0,
        "steady yaw rate": math.degrees(turn.rate),
        "steady yaw rate L/U": 0.5,
        "speed loss": 0.0,
        "unsteadiness": 0.0,
        "time to 90": 0.5 * math.pi / turn.rate,
        "time to 360": 2.0 * math.pi / turn.rate,
        "drift distance 360-720": 0.0,
    }
    assert {name: found[name][0] for name in expected} == pytest.approx(expected, abs=1e-9)


def test_maximum_advance_is_not_the_advance(circle, turn_names, hull):
    turn = circle()
    found = turning_indices(exact(turn, turn_names, turn.beta), hull)
    assert found["maximum advance"] > found["advance"]
    assert found["maximum transfer"] > found["tactical diameter"]


def test_approach_speed_gives_the_speed_loss(circle, turn_names, hull):
    found = turning_indices(circle().events(turn_names), hull, approach_speed=10.0)
    assert found["speed loss"] == pytest.approx(50.0)
    assert found["steady speed ratio"] == pytest.approx(0.5)
    assert found["steady yaw rate L/U0"] == pytest.approx(0.25)
    assert found["speed ratio at 180"] == pytest.approx(0.5)


def test_many_draws_are_each_as_alone(circle, turn_names, hull):
    turns = [circle(radius=150.0), circle(side=-1.0), circle(beta=0.1, heading=1.0)]
    together = turning_indices(stack_events([turn.events(turn_names) for turn in turns]), hull)
    for number, turn in enumerate(turns):
        alone = turning_indices(turn.events(turn_names), hull)
        for name, values in together.items():
            assert values.shape == (3,)
            assert values[number] == pytest.approx(alone[name][0], nan_ok=True)


def test_turn_that_ends_early_has_no_steady_phase(circle, turn_names, hull):
    short = {name: turned for name, turned in turn_names.items() if turned <= 180.0}
    found = turning_indices(circle().events({**short, "end": 200.0}), hull)
    assert found["tactical diameter"] == pytest.approx(4.0 * math.cos(math.radians(12.0)))
    assert np.isnan(found["steady diameter"])
    assert np.isnan(found["time to 270"])


def test_end_serves_as_the_last_heading(circle, turn_names, hull):
    names = {name: turned for name, turned in turn_names.items() if turned < 180.0}
    found = turning_indices(circle().events({**names, "end": 180.0}), hull)
    assert found["tactical diameter"] == pytest.approx(4.0 * math.cos(math.radians(12.0)))


def test_draw_that_did_not_turn_is_nan(circle, turn_names, hull):
    events = circle().events(turn_names)
    lost = Events({name: np.vstack([rows, rows if name == "execute" else np.nan * rows]) for name, rows in
                   events.mapping.items()})  # fmt: skip
    found = turning_indices(lost, hull)
    assert np.isfinite(found["advance"][0])
    assert np.isnan(found["advance"][1])


def test_change_of_the_yaw_rate_shows(circle, turn_names, hull):
    events = circle().events(turn_names)
    late = dict(events.mapping)
    late["end"] = late["heading 720"] = events["heading 720"] + np.eye(11)[0] * 2.0
    quarter = 0.5 * math.pi / circle().rate
    found = turning_indices(Events(late), hull)
    assert found["unsteadiness"] == pytest.approx(100.0 * (quarter / (quarter + 2.0) - 1.0))


def test_heel_is_in_degrees(circle, turn_names, hull):
    events = circle().events({**turn_names, "maximum heel": 45.0})
    rows = {name: value.copy() for name, value in events.mapping.items()}
    rows["maximum heel"][0, 7] = math.radians(-11.0)
    rows["end"][0, 7] = math.radians(-3.0)
    found = turning_indices(Events(rows), hull)
    assert (found["maximum heel"][0], found["steady heel"][0]) == pytest.approx((-11.0, -3.0))


def test_events_of_a_zigzag_are_refused(rows, hull):
    with pytest.raises(TowtankError, match="no events of a turning circle: 'execute' is missing"):
        turning_indices(rows(execute_1={"time": 0.0}), hull)
