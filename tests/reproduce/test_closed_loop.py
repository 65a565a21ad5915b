"""A set through a virtual test and back."""

import math
from dataclasses import replace

import pytest

from towtank.datasets import load_set
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import pure_sway, static_drift
from towtank.reproduce.closed_loop import ROUND_TRIP, largest_difference, mean_forces, refitted, virtual_runs


def test_mean_force_is_the_polynomial():
    hull = load_set("dtc-drift-efd")
    angle = math.radians(10)
    forces = mean_forces(hull, Run("drift", "static_drift", 0.387, drift_angle=angle))
    v = -math.sin(angle)
    assert forces["X"] == pytest.approx(-hull["R0"] + hull["Xvv"] * v**2 + hull["Xvvvv"] * v**4)
    assert forces["Y"] == pytest.approx(hull["Yv"] * v + hull["Yvvv"] * v**3)
    assert forces["N"] == pytest.approx(hull["Nv"] * v + hull["Nvvv"] * v**3)


def test_steady_runs_are_points_and_oscillations_have_harmonics():
    hull = load_set("dtmb5512-sway-cfd")
    drift, sway = virtual_runs(hull, [*static_drift([4], 1.531), *pure_sway([0.266], 0.841, 1.531)])
    assert (drift.order, sway.order) == (0, 3)
    assert drift.velocity_scale == sway.velocity_scale == "approach"
    assert len(sway.scaled["Y"]) == 7
    amplitude = 0.266 / 1.531
    # v' = V cos(w t): the third cosine is Yvvv V^3 / 4
    assert sway.scaled["Y"][5] == pytest.approx(hull["Yvvv"] * amplitude**3 / 4)


def test_speed_of_the_scaling_follows_the_set():
    hull = load_set("dtc-drift-efd")
    (run,) = virtual_runs(hull, static_drift([4], 0.387))
    assert run.velocity_scale == "instantaneous"


def test_refit_returns_the_set_and_stages_do_too():
    hull = load_set("dtc-drift-efd")
    matrix = static_drift([0, 5, 10, 15, 20], 0.387)
    for staged in (False, True):
        assert largest_difference(hull, refitted(hull, matrix, staged=staged)) < ROUND_TRIP


def test_largest_difference_is_over_the_names_of_the_first():
    hull = load_set("dtc-drift-efd")
    other = replace(hull, values=hull.values + 0.25)
    assert largest_difference(hull.subset(["Yv"]), other) == pytest.approx(0.25)
