"""Indices of any manoeuvre: simulated and measured ones are indexed alike."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.events import stack_events
from towtank.simulate.manoeuvre_indices import event_indices, indices


def test_simulated_and_measured_turn_are_indexed_alike(circle, turn_names):
    turn = circle()
    exact = {**turn_names, "maximum advance": 102.0, "maximum transfer": 192.0}
    measured = turn.trajectory()
    simulated = replace(measured, events=turn.events(exact))
    ours = indices(simulated).set_index("index")["value"]
    found = indices(measured, execute=0.0).set_index("index")["value"]
    for name in ours.index.drop(["drift direction 360-720", "drift direction 270-630"]):
        assert found[name] == pytest.approx(ours[name], abs=1e-4, rel=1e-4), name


def test_zigzag_by_its_name(zigzag):
    run = zigzag()
    table = indices(run.trajectory(step=0.25)).set_index("index")
    assert table.loc["overshoot 1", "value"] == pytest.approx(math.degrees(run.overshoot(1)), abs=1e-3)
    assert table.loc["overshoot 4", "value"] == pytest.approx(math.degrees(run.overshoot(4)), abs=1e-3)
    assert table["manoeuvre"].unique().tolist() == ["zigzag +10/10"]


def test_lengths_in_metres(circle):
    lengths = indices(circle().trajectory(), execute=0.0).set_index("index")
    metres = indices(circle().trajectory(), execute=0.0, lengths="m").set_index("index")
    assert metres.loc["advance", "value"] == pytest.approx(100.0 * lengths.loc["advance", "value"])
    assert metres.loc["advance", "unit"] == "m"


def test_draws_keep_their_order(circle, turn_names, hull):
    radii = [150.0, 200.0, 250.0]
    events = stack_events([circle(radius=radius).events(turn_names) for radius in radii])
    found = event_indices("turning +35", events, hull)
    np.testing.assert_allclose(found["steady diameter"], [3.0, 4.0, 5.0])


@pytest.mark.parametrize("name", ["initial turning +10", "pull-out", "crash stop", "williamson"])
def test_every_manoeuvre_has_its_indices(rows, hull, name):
    state = {"time": 0.0, "x": 0.0, "y": 0.0, "psi": 0.0, "u": 5.0, "v": 0.0, "r": 0.01}
    later = {**state, "time": 100.0, "x": 300.0}
    over = {**later, "psi": -3.2}
    events = rows(execute=state, heading_10=later, stopped=later, reciprocal=later, extreme=over, end=later)
    assert all(np.isfinite(values).all() for values in event_indices(name, events, hull).values())


def test_spiral_needs_its_steady_points(rows, hull):
    with pytest.raises(TowtankError, match="no events of a spiral: 'steady 1' is missing"):
        event_indices("spiral", rows(execute={"time": 0.0}), hull)
