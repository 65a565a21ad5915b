"""Planned rows against the reduction of synthetic runs: same columns, and noise of the size that is planned."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import CampaignError
from towtank.pmm.campaign_file import Reduction
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.planned_rows import RowNoise, planned_rows
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.run_types import Run
from towtank.pmm.virtual_records import virtual_campaign

LAB = Laboratory(sampling_rate=20.0, duration=20.0, cycles=3, startup_cycles=1)
TURN = Run("turn", "steady_yaw_drift", 1.5, drift_angle=math.radians(10), yaw_rate=0.2)
YAW = Run("yaw", "yaw_drift", 1.5, drift_angle=math.radians(5), frequency=0.9, sway_amplitude=0.4)
REFERENCE = {"X": 20.0, "Y": 80.0, "N": 120.0}


def setting(hull, noise, laboratory=LAB, **more):
    values = {"velocity_scale": "instantaneous", "harmonics": 3, "fraction": (0.3, 0.95), "reference": REFERENCE}
    return RowNoise(hull.ship, laboratory, noise=noise, **(values | more))


@pytest.mark.parametrize("run", [TURN, YAW], ids=lambda run: run.name)
@pytest.mark.parametrize("scale", ["instantaneous", "approach"])
def test_columns_and_scaled_forces_are_those_of_the_reduction(hull, run, scale):
    truth = replace(hull, conventions=hull.conventions.but(velocity_scale=scale))
    campaign = virtual_campaign(truth, [run], LAB)
    ((_, record),) = campaign.records(Noise())
    settings = Reduction(skip_cycles=1, nondimensional_speed=scale)
    reduced = reduce_run(record, run, ReductionPlan(settings, hull.ship, HOME))
    rows = planned_rows(run, hull.terms, setting(hull, Noise(white=0.1), velocity_scale=scale))
    for component in ("X", "Y", "N"):
        own = [term for term in hull.terms if term.component == component]
        assert rows.design[component] == pytest.approx(reduced.design(own), abs=1e-12)
        scaled = rows.reduce(component, record[component])
        assert scaled == pytest.approx(reduced.scaled[component], abs=1e-12)
        expected = rows.design[component] @ [hull[term.name] for term in own]
        assert scaled == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("run", [TURN, YAW], ids=lambda run: run.name)
@pytest.mark.parametrize(
    "noise",
    [Noise(white=0.03), Noise(ar1=0.02), Noise(ar1=0.01, offset=0.02, drift=0.04)],
    ids=["white", "ar1", "zero error"],
)
def test_spread_of_means_and_harmonics_is_the_planned_one(hull, run, noise):
    rows = planned_rows(run, hull.terms, setting(hull, noise))
    campaign = virtual_campaign(hull, [run], LAB, reference=REFERENCE)
    draws = np.array(
        [rows.reduce("N", campaign.records(replace(noise, seed=seed))[0][1]["N"]) for seed in range(250)]
    )
    expected = np.sqrt(np.diag(rows.covariance["N"]))
    assert draws.std(axis=0) == pytest.approx(expected, rel=0.15)
    if noise.drift and run.harmonic:
        # A drifting zero leans on the sines, and links them
        measured = np.corrcoef(draws.T)[2, 4]
        planned = rows.covariance["N"][2, 4] / (expected[2] * expected[4])
        assert planned > 0.2
        assert measured == pytest.approx(planned, abs=0.1)


def test_information_is_that_of_the_whitened_rows(hull):
    rows = planned_rows(YAW, hull.terms, setting(hull, Noise(ar1=0.02, drift=0.05)))
    place = [i for i, term in enumerate(hull.terms) if term.component == "Y"]
    design = rows.design["Y"]
    expected = design.T @ np.linalg.inv(rows.covariance["Y"]) @ design
    assert rows.information[np.ix_(place, place)] == pytest.approx(expected, rel=1e-9)
    assert rows.information[0, place] == pytest.approx(np.zeros(len(place)), abs=0)


def test_moving_the_moment_to_midship_brings_in_the_noise_of_the_side_force(hull):
    noise = Noise(ar1=0.02)
    here = planned_rows(TURN, hull.terms, setting(hull, noise))
    there = planned_rows(TURN, hull.terms, setting(hull, noise, replace(LAB, moment_x=0.5)))
    ratio = math.hypot(120.0, 0.5 * 80.0) / 120.0
    assert there.covariance["N"][0, 0] == pytest.approx(ratio**2 * here.covariance["N"][0, 0])
    assert there.covariance["Y"] == pytest.approx(here.covariance["Y"])


def test_a_given_standard_deviation_is_that_of_each_row(hull):
    scaled = planned_rows(YAW, hull.terms, setting(hull, {"X": 1e-4, "Y": 2e-4, "N": 3e-4}))
    assert scaled.covariance["Y"] == pytest.approx(4e-8 * np.eye(7))
    newtons = planned_rows(TURN, hull.terms, setting(hull, {"X": 1.0, "Y": 2.0, "N": 3.0}, si=True))
    unit = 0.5 * hull.ship.rho * hull.ship.L * hull.ship.T * 1.5**2
    assert newtons.covariance["Y"] == pytest.approx((2.0 / unit) ** 2)


@pytest.mark.parametrize(
    ("noise", "reference", "message"),
    [
        ({"Y": 1e-4}, {}, "noise of N"),
        (Noise(white=0.01), {"Y": 1.0}, "noise of N"),
        (Noise(offset=0.01), REFERENCE, "without random noise"),
    ],
)
def test_unknown_noise_is_refused(hull, noise, reference, message):
    with pytest.raises(CampaignError, match=message):
        setting(hull, noise, reference=reference).require(["N", "Y"])
