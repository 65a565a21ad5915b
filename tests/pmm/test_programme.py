"""Expected standard errors against the scatter of fits to synthetic campaigns; what a programme cannot find."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import CampaignError, FitError, TermError
from towtank.identify.regression import fit_linear
from towtank.pmm.campaign_file import Fit, Reduction
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.programme import plan
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.rigid_body import RigidBody
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import standard_matrix
from towtank.pmm.virtual_records import virtual_campaign

LAB = Laboratory(sampling_rate=10.0, duration=20.0, cycles=2)
NOISE = Noise(ar1=0.02, rho=0.8)


@pytest.fixture(scope="module")
def matrix(hull):
    """A lean programme that determines the whole MMG model."""
    keep = ("drift -16", "drift -9", "drift +0", "drift +9", "drift +16", "sway v 0.266", "sway v 0.107")
    keep += ("yaw r 0.15 rad/s", "yaw r 0.375", "yaw r 0.3 rad/s drift -10", "yaw r 0.3 rad/s drift +10")
    runs = [run for run in standard_matrix("dtmb5512", hull.ship) if run.name.startswith(keep)]
    return [run for run in runs if run.name != "yaw r 0.15 rad/s drift -5 deg"]


def weighted_fits(programme, campaign, noise, seeds):
    """Coefficients of weighted least-squares fits to campaigns of several seeds, shape (seeds, p)."""
    solve = [
        np.linalg.solve(rows.covariance[name], rows.design[name]).T
        for rows in programme.rows
        for name in rows.design
    ]
    inverse = np.linalg.inv(programme.information)
    found = []
    for seed in seeds:
        records = campaign.records(replace(noise, seed=seed))
        right = np.zeros(len(programme.terms))
        weights = iter(solve)
        for (_, record), rows in zip(records, programme.rows, strict=True):
            for name, places in rows.places.items():
                right[places] += next(weights) @ rows.reduce(name, record[name])
        found.append(inverse @ right)
    return np.array(found)


def test_planned_errors_are_the_scatter_of_fits_to_synthetic_campaigns(hull, matrix):
    programme = plan(hull, matrix, NOISE, laboratory=LAB)
    campaign = virtual_campaign(hull, matrix, LAB)
    found = weighted_fits(programme, campaign, NOISE, range(200))
    assert found.mean(axis=0) == pytest.approx(hull.values, abs=5 * programme.standard_errors.max() / 20)
    ratio = found.std(axis=0, ddof=1) / programme.standard_errors
    assert ratio.min() > 0.85
    assert ratio.max() < 1.15


def test_the_default_pipeline_reaches_the_planned_errors(hull, matrix):
    programme = plan(hull, matrix, NOISE, laboratory=LAB)
    campaign = virtual_campaign(hull, matrix, LAB)
    # the window that was planned, so that the search for transients does not shorten it
    steady = Reduction(skip_cycles=0, window="key-times", start=6.0, stop=19.0 - 0.05)
    whole = Reduction(skip_cycles=0)
    plans = {True: ReductionPlan(whole, hull.ship, HOME), False: ReductionPlan(steady, hull.ship, HOME)}
    found = []
    for seed in range(16):
        records = campaign.records(replace(NOISE, seed=seed))
        runs = [reduce_run(record, run, plans[run.harmonic]) for run, record in records]
        result = fit_hull(runs, Fit(), hull.ship, name="fit", terms=hull.terms).derivatives
        found.append(result.subset(hull.names).values)
    ratio = np.std(found, axis=0, ddof=1) / programme.standard_errors
    # each ratio is uncertain by 18 %, their quadratic mean by much less
    assert math.sqrt(np.mean(ratio**2)) == pytest.approx(1.0, abs=0.15)


def test_shared_gain_is_the_scatter_that_campaigns_without_noise_have(hull, matrix):
    laboratory = replace(LAB, inertia=RigidBody(90.0, 0.05, 60.0), moment_x=0.4)
    noise = Noise(ar1=0.02, rho=0.8, gain_bias=0.02)
    programme = plan(hull, matrix, noise, laboratory=laboratory)
    assert np.diag(programme.bias).min() > 0
    reference = virtual_campaign(hull, matrix, laboratory)
    # readings of a gain error alone, with inertia and moment arm undone as the reduction does
    found = []
    for seed in range(200):
        gains = Noise(gain_bias=0.02, seed=seed).gains
        right = np.zeros(len(programme.terms))
        for clean, rows in zip(reference.clean, programme.rows, strict=True):
            error = {name: (gains[name] - 1.0) * clean.forces[name] for name in ("X", "Y", "N")}
            error["N"] = error["N"] + 0.4 * error["Y"]
            for name, places in rows.places.items():
                weighted = np.linalg.solve(rows.covariance[name], rows.design[name]).T
                right[places] += weighted @ rows.reduce(name, error[name])
        found.append(np.linalg.solve(programme.information, right))
    assert np.std(found, axis=0) == pytest.approx(np.sqrt(np.diag(programme.bias)), rel=0.15)


def test_without_inertia_a_shared_gain_is_a_share_of_each_value(hull, matrix):
    programme = plan(hull, matrix, replace(NOISE, gain_bias=0.02), laboratory=LAB)
    assert np.sqrt(np.diag(programme.bias)) == pytest.approx(0.02 * np.abs(hull.values), rel=1e-6)
    total = np.hypot(np.sqrt(np.diag(programme.covariance)), 0.02 * np.abs(hull.values))
    assert programme.standard_errors == pytest.approx(total, rel=1e-6)


def test_what_no_run_excites_is_named_and_the_rest_is_still_planned(hull, matrix):
    drift = [run for run in matrix if run.kind == "static_drift"]
    programme = plan(hull, drift, NOISE, laboratory=LAB)
    dead = {name for name in hull.names if "r" in name[1:] or "dot" in name}
    assert set(programme.not_excited) == dead
    errors = dict(zip(programme.names, programme.standard_errors, strict=True))
    assert all(math.isinf(errors[name]) for name in dead)
    alone = plan(hull.subset([name for name in hull.names if name not in dead]), drift, NOISE, laboratory=LAB)
    for name, error in zip(alone.names, alone.standard_errors, strict=True):
        assert errors[name] == pytest.approx(error, rel=1e-9)
    frame = programme.to_frame().set_index("name")
    assert frame.loc["Yr", "note"] == "no run excites it"
    with pytest.raises(FitError, match="Xvr"):
        programme.expected_set()


def test_terms_that_look_alike_in_every_run_are_named_together(hull):
    runs = [
        Run(f"turn {angle}", "steady_yaw_drift", 1.5, drift_angle=math.radians(angle), yaw_rate=0.2)
        for angle in (-12, -6, 0, 6, 12)
    ]
    # one yaw rate only: Yr r and Yrrr r^3 cannot be told apart, Yv can
    programme = plan(["Yv", "Yvvv", "Yr", "Yrrr"], runs, {"Y": 1e-4}, ship=hull.ship, laboratory=LAB)
    assert {frozenset(group) for group in programme.inseparable} >= {frozenset({"Yr", "Yrrr"})}
    speed = np.array(programme.standard_errors)
    assert np.isfinite(speed[:2]).all()
    assert "Yrrr" in programme.to_frame().set_index("name").loc["Yr", "note"]


def test_a_plan_from_terms_alone_has_no_relative_errors(hull, matrix):
    sd = {"X": 1e-4, "Y": 3e-4, "N": 1e-4}
    programme = plan(hull.names, matrix, sd, ship=hull.ship, laboratory=LAB)
    with_values = plan(hull, matrix, sd, laboratory=LAB)
    assert programme.standard_errors == pytest.approx(with_values.standard_errors)
    assert programme.to_frame()["relative_percent"].isna().all()
    with pytest.raises(FitError, match="expected values"):
        programme.expected_set()


def test_errors_fall_with_the_root_of_repeats_and_with_longer_runs(hull, matrix):
    once = plan(hull, matrix, NOISE, laboratory=LAB)
    again = [replace(run, name=f"{run.name} again") for run in matrix]
    twice = plan(hull, [*matrix, *again], NOISE, laboratory=LAB)
    assert twice.standard_errors == pytest.approx(once.standard_errors / math.sqrt(2))
    longer = plan(hull, matrix, NOISE, laboratory=replace(LAB, duration=80.0, cycles=8))
    assert longer.standard_errors == pytest.approx(once.standard_errors / 2, rel=0.02)
    assert longer.duration == pytest.approx(4 * once.duration, rel=0.01)


def test_frame_and_summary_hold_every_term(hull, matrix):
    programme = plan(hull, matrix, NOISE, laboratory=LAB)
    frame = programme.to_frame()
    assert list(frame["name"]) == list(hull.names)
    share = 100 * frame["std"] / frame["value"].abs()
    assert frame["relative_percent"].to_numpy() == pytest.approx(share.to_numpy())
    assert (frame["VIF"] >= 1 - 1e-9).all()
    text = programme.summary()
    assert text.count("\n") == len(hull) + 1
    assert f"{len(matrix)} runs" in text
    expected = programme.expected_set()
    assert expected.bse["Yv"] == pytest.approx(programme.standard_errors[programme.position("Yv")])


def test_variance_inflation_is_that_of_the_fit(hull, matrix):
    drift = [run for run in matrix if run.kind == "static_drift"]
    programme = plan(hull.subset(["R0", "Xvv", "Xvvvv"]), drift, NOISE, laboratory=LAB)
    design = np.vstack([rows.design["X"] for rows in programme.rows])
    fit = fit_linear(design, np.arange(len(design), dtype=float), programme.names)
    frame = programme.to_frame()
    assert frame["VIF"].to_numpy() == pytest.approx(fit.vif, rel=1e-6)
    assert programme.components["X"].condition_number == pytest.approx(fit.condition_number, rel=1e-6)


def test_a_set_of_another_scaling_is_planned_in_the_form_of_a_fit(hull, matrix):
    prime = hull.to("prime")
    programme = plan(prime, matrix, NOISE, laboratory=LAB)
    assert programme.values == pytest.approx(hull.values)
    assert programme.standard_errors == pytest.approx(plan(hull, matrix, NOISE, laboratory=LAB).standard_errors)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"runs": []}, "no run"),
        ({"runs": [Run("a", "static_drift", 1.0, depth=d) for d in (0.2, 0.3)]}, "differ in water depth"),
        ({"derivatives": ["Yv"]}, "ship is not known"),
        ({"noise": {"Y": 1e-4}}, "noise of N"),
    ],
)
def test_a_plan_that_lacks_something_says_what(hull, matrix, change, message):
    arguments = {"derivatives": hull, "runs": matrix, "noise": NOISE} | change
    with pytest.raises(CampaignError, match=message):
        plan(**arguments)


def test_an_unknown_term_is_refused(hull, matrix):
    with pytest.raises(TermError, match="Yphi"):
        plan(hull, matrix, NOISE, laboratory=LAB).position("Yphi")
