"""Groups of runs that are fitted by themselves, and the runs that a report shows."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from towtank.pmm.reduction import point_run
from towtank.pmm.run_groups import group_runs, shown_runs
from towtank.pmm.run_types import Run


@pytest.fixture
def point(ship):
    def make(name: str, depth: float | None = None, speed: float = 1.5, heel: float = 0.0):
        run = Run(name, "static_drift", speed, heel=math.radians(heel), depth=depth)
        return point_run(run, ship, {"Y": 0.1}, {})

    return make


def names(groups):
    return {label: [run.name for run in runs] for label, runs in groups.items()}


def test_one_group_has_no_label(point):
    assert names(group_runs([point("a"), point("b")], ["depth"])) == {"": ["a", "b"]}
    assert names(group_runs([point("a", 0.2), point("b", 0.3)], [])) == {"": ["a", "b"]}


def test_depths_in_their_order_with_rounding_forgiven(point, ship):
    runs = [point("deep"), point("b", 1.5 * ship.T), point("a", 1.2 * ship.T), point("c", 1.5 * ship.T + 1e-6)]
    assert names(group_runs(runs, ["depth"])) == {"h/T 1.2": ["a"], "h/T 1.5": ["b", "c"], "deep water": ["deep"]}


def test_several_properties_make_one_label(point):
    runs = [point("a"), point("b", speed=2.0), point("c", heel=-5.0), point("d", heel=0.0)]
    assert names(group_runs(runs, ["speed", "heel"])) == {
        "Fn 0.274, heel -5 deg": ["c"],
        "Fn 0.274, heel 0 deg": ["a", "d"],
        "Fn 0.366, heel 0 deg": ["b"],
    }


def test_runs_of_an_infinitely_deep_ship_and_depth_are_one_group(point, ship):
    shallow = replace(point("x"), ship=replace(ship, depth=0.2))
    assert list(group_runs([shallow, point("deep", math.inf)], ["depth"])) == ["h/T 1.471", "deep water"]


def test_shown_runs_are_the_largest_motions_of_each_kind_in_turn():
    runs = [Run(f"drift {b}", "static_drift", 1.0, drift_angle=math.radians(b)) for b in (2, -12, 6)]
    runs += [Run(f"sway {a}", "pure_sway", 1.0, frequency=1.0, sway_amplitude=a) for a in (0.1, 0.3)]
    assert shown_runs(runs, 0) == frozenset()
    assert shown_runs(runs, 2) == {"drift -12", "sway 0.3"}
    assert shown_runs(runs, 3) == {"drift -12", "sway 0.3", "drift 6"}
    assert len(shown_runs(runs, 99)) == 5
