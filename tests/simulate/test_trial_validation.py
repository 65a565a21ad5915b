"""A measured manoeuvre against the simulated one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import ReadError, SimulationError
from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.named_programmes import named_programme
from towtank.simulate.parameter_scatter import scatter_of, vessel_of_draw
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.trajectory import Trajectory
from towtank.simulate.trial_alignment import from_order
from towtank.simulate.trial_validation import validate_trial

SHIP = named_ship("kvlcc2")


def measured(programme, vessel=SHIP) -> Trajectory:
    """Samples of a simulated manoeuvre without its events."""
    return replace(sail(vessel, programme, interval=0.25), events=None, source="trial.csv")


def test_the_model_agrees_with_itself():
    found = validate_trial(SHIP, measured(zigzag(10.0)))
    table = found.indices.set_index("index")
    assert abs(table.loc["overshoot 1", "error"]) < 0.02
    assert table["z"].isna().all()
    channels = found.channels.set_index("channel")
    assert channels.loc["psi", "rmse"] < 0.05
    assert channels.loc["psi", "correlation"] > 0.9999
    assert channels["coverage_pct"].isna().all()


@pytest.mark.parametrize(
    "name", ["crash stop", "pull-out 20", "williamson -35", "initial turning 10", "spiral", "reverse spiral"]
)
def test_every_manoeuvre_is_indexed_as_it_was_sailed(name):
    tick = SHIP.ship.L / SHIP.speed
    trial = replace(sail(SHIP, named_programme(name, tick)), events=None, source="trial.csv")
    found = validate_trial(SHIP, trial)
    assert len(found.indices) >= 3
    lengths = found.indices["unit"] == "L"
    np.testing.assert_allclose(found.indices["simulated"], found.indices["measured"], rtol=2e-3, atol=2e-4)
    assert lengths.any() == (name in ("crash stop", "williamson -35", "initial turning 10"))


def test_a_pull_out_is_compared_from_its_approach_on():
    trial = measured(named_programme("pull-out 20", 1.0))
    late = replace(trial, frame=trial.frame[trial["time"] > 60.0])
    with pytest.raises(ReadError, match="begins in the turn -> give it from the straight approach"):
        validate_trial(SHIP, late)


def test_a_draw_lies_inside_the_band_of_its_ensemble():
    scatter = scatter_of(SHIP, percent=3.0)
    inside = []
    for row in scatter.draws(6, seed=99):
        trial = measured(turning(35.0, 400.0), vessel_of_draw(SHIP, scatter.names, row))
        found = validate_trial(SHIP, trial.with_columns("as it is"), draws=40, percent=3.0, seed=1)
        inside += [bool(one) for one in found.indices["covered"] if one is not None]
        assert found.band("psi") is not None
    assert 0.5 < np.mean(inside) <= 1.0


def test_axes_time_and_course_of_the_trial_do_not_matter():
    trial = measured(turning(35.0))
    course = np.radians(200.0)
    x, y = trial["x"], trial["y"]
    moved = trial.with_columns(
        "moved",
        time=trial["time"] + 100.0,
        x=x * np.cos(course) - y * np.sin(course) + 50.0,
        y=x * np.sin(course) + y * np.cos(course) - 20.0,
        psi=trial["psi"] + course,
    )
    back = from_order(moved, 100.0)
    np.testing.assert_allclose(back["x"], x, atol=1e-9)
    np.testing.assert_allclose(back["y"], y, atol=1e-9)
    np.testing.assert_allclose(back["psi"], trial["psi"], atol=1e-12)


def test_the_rudder_of_the_trial_is_sailed_again():
    trial = replace(measured(zigzag(20.0)), manoeuvre="")
    found = validate_trial(SHIP, trial, replay=True)
    assert found.indices.empty
    assert found.channels.set_index("channel").loc["psi", "rmse"] < 0.2


def test_the_speed_is_that_of_the_trial():
    slow = measured(turning(35.0), SHIP.but(speed=0.9))
    found = validate_trial(SHIP, slow)
    assert found.simulated.provenance.choices["approach speed [m/s]"] == pytest.approx(0.9, abs=0.01)


def test_faults_are_named():
    trial = measured(turning(35.0))
    with pytest.raises(ReadError, match="to starboard first"):
        validate_trial(SHIP, replace(trial, manoeuvre="turning -35"))
    with pytest.raises(SimulationError, match="not known"):
        validate_trial(SHIP, replace(trial, manoeuvre=""))
    with pytest.raises(SimulationError, match="no spread"):
        validate_trial(SHIP, trial, draws=1, percent=5.0)
    without = replace(trial, frame=trial.frame.drop(columns="delta"), manoeuvre="")
    with pytest.raises(ReadError, match="no rudder angle"):
        validate_trial(SHIP, without, replay=True, execute=0.0)
