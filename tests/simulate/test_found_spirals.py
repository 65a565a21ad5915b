"""Steady turns found in the record of a sailed spiral, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from towtank.core.errors import AuditError, ReadError
from towtank.simulate.found_events import find_events
from towtank.simulate.manoeuvre_indices import indices
from towtank.simulate.named_programmes import named_programme
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship
from towtank.simulate.trajectory import Trajectory


@cache
def sailed(kind: str, ship: str = "kvlcc2") -> Trajectory:
    vessel = named_ship(ship)
    return sail(vessel, named_programme(kind, vessel.ship.L / vessel.speed))


def as_measured(kind: str, ship: str = "kvlcc2", **noise: float) -> Trajectory:
    """Record without events, with noise on some channels (standard deviations; the yaw rate's in U0/L)."""
    known = sailed(kind, ship)
    frame = known.frame[["time", "x", "y", "psi", "r", "delta"]].copy()
    random = np.random.default_rng(2)
    for name, level in noise.items():
        frame[name] += level * random.standard_normal(len(frame))
    return replace(known, frame=frame, events=None)


def loop(trajectory: Trajectory, **more: float) -> dict[str, float]:
    return dict(indices(trajectory, **more).set_index("index")["value"])


@pytest.mark.parametrize("kind", ["spiral", "reverse spiral"])
def test_steady_turns_are_those_that_were_sailed(kind):
    exact, found = sailed(kind).events, find_events(as_measured(kind))
    assert [name for name in found if name.startswith("steady")] == [
        name for name in exact if name.startswith("steady")
    ]
    for name in found:
        if name.startswith("steady"):
            assert found.at(name, "r") == pytest.approx(exact.at(name, "r"), abs=2e-5), name
            assert found.at(name, "delta") == pytest.approx(exact.at(name, "delta"), abs=1e-4), name


@pytest.mark.parametrize("kind", ["spiral", "reverse spiral"])
def test_noise_hardly_moves_the_loop(kind):
    tick = 7.0 / 1.18
    record = as_measured(kind, psi=np.radians(0.1), delta=np.radians(0.1), r=0.001 / tick)
    exact, found = loop(sailed(kind)), loop(record, execute=0.0)
    assert found["loop width"] == pytest.approx(exact["loop width"], abs=0.05)
    assert found["loop height"] == pytest.approx(exact["loop height"], rel=0.03)
    assert found["neutral rudder"] == pytest.approx(exact["neutral rudder"], abs=0.05)


def test_the_approach_is_no_point_of_the_spiral():
    record = as_measured("spiral")
    step = float(np.median(np.diff(record["time"])))
    rows = 600
    straight = {name: np.zeros(rows) for name in ("y", "psi", "r", "delta")}
    before = {"time": -step * np.arange(rows, 0, -1), "x": -1.18 * step * np.arange(rows, 0, -1), **straight}
    whole = {name: np.concatenate([before[name], record[name]]) for name in before}
    found = find_events(Trajectory.from_columns(whole, record.ship, "spiral"))
    assert found.names == find_events(record).names
    assert found.at("execute", "time") == pytest.approx(0.0, abs=0.5 * step)


def test_a_turn_that_is_not_steady_is_refused():
    record = as_measured("spiral")
    drifting = record["r"] + 0.01 * np.sin(record["time"] / 20.0)
    with pytest.raises(
        AuditError, match=r"the yaw rate still changes, by .* deg/s before .* s -> hold each point"
    ):
        find_events(replace(record, frame=record.frame.assign(r=drifting)))


def test_noise_as_large_as_the_steps_is_refused():
    with pytest.raises(AuditError, match=r"'r' scatters by .* its levels cannot be told apart"):
        find_events(as_measured("reverse spiral", r=0.03 * 1.18 / 7.0), execute=0.0, half_width=0.0)


def test_a_zigzag_is_no_spiral():
    vessel = named_ship("kvlcc2")
    record = sail(vessel, named_programme("zigzag 20/20", 1.0))
    with pytest.raises(ReadError, match="no spiral has so few"):
        find_events(replace(record, manoeuvre="spiral", events=None))
