"""Virtual records against formulas written out by hand, and the recovery of every model by plain least squares."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import CampaignError, ConventionError
from towtank.core.hull_models import hull_model
from towtank.core.motion import force_units, scaled_state
from towtank.core.ship import Ship
from towtank.pmm.campaign_file import Reduction
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.rigid_body import RigidBody
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import standard_matrix
from towtank.pmm.virtual_records import (
    as_measured,
    excited_terms,
    sets_by_depth,
    synthesize_records,
    virtual_campaign,
    zero_run,
)

INSIDE = HOME.but(added_mass_coriolis="inside")
SHORT = Laboratory(sampling_rate=10.0, duration=8.0, cycles=2)
BODY = RigidBody(mass=90.0, xG=0.05, Izz=60.0)
TOW = Run("tow", "static_drift", 1.5, drift_angle=math.radians(10))
TURN = Run("turn", "steady_yaw_drift", 1.5, drift_angle=math.radians(10), yaw_rate=0.2)
SWAY = Run("sway", "pure_sway", 1.5, frequency=0.9, sway_amplitude=0.3)
YAW = Run("yaw", "yaw_drift", 1.5, drift_angle=math.radians(5), frequency=0.9, sway_amplitude=0.4)


def record_of(truth, run, laboratory=SHORT, noise=None):
    return synthesize_records(truth, [run], laboratory, noise=noise or Noise())[0][1]


def random_set(model, conventions, ship):
    """Set of a ready-made model with coefficients of no particular size."""
    terms = hull_model(model)
    values = np.random.default_rng(11).uniform(0.05, 1.0, len(terms))
    return DerivativeSet(model, ship, terms, values, conventions)


def plain_least_squares(truth, records):
    """Coefficients of all terms from all samples of all runs at once, home laboratory, exact kinematics."""
    values = np.zeros(len(truth))
    blocks = {}
    for run, record in records:
        state, speed = scaled_state(
            prescribed_motion(run).at(record.time), truth.ship, truth.conventions, run.speed
        )
        for component in {term.component for term in truth.terms}:
            columns = [term.column(state) for term in truth.terms if term.component == component]
            unit = force_units(component, truth.ship, truth.conventions, speed)
            blocks.setdefault(component, []).append((np.column_stack(columns), record[component] / unit))
    for component, parts in blocks.items():
        design, response = (np.concatenate(part) for part in zip(*parts, strict=True))
        own = [i for i, term in enumerate(truth.terms) if term.component == component]
        values[own] = np.linalg.lstsq(design, response, rcond=None)[0]
    return values


# -- recovery ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("model", "matrix"),
    [
        ("mmg", "dtmb5512"),
        ("mmg", "general"),
        ("mmg-steady", "cmt"),
        ("mmg-drift", "dtmb5512"),
        ("abkowitz", "general"),
        ("modulus", "general"),
        ("heel", "pcc"),
        ("bank", "pcc-bank"),
    ],
)
def test_plain_least_squares_finds_every_coefficient_again(hull, model, matrix):
    truth = random_set(model, INSIDE, hull.ship)
    records = synthesize_records(truth, standard_matrix(matrix, hull.ship), SHORT)
    assert np.abs(plain_least_squares(truth, records) - truth.values).max() < 1e-9


def test_the_inland_model_is_found_again_with_its_own_drift_sign(hull):
    conventions = INSIDE.but(sway_variable="beta", drift_sign="+v")
    ship = Ship("inland", L=110.0, B=11.4, T=3.5, volume=3740.0)
    truth = random_set("inland", conventions, ship)
    records = synthesize_records(truth, standard_matrix("inland", ship), SHORT)
    assert np.abs(plain_least_squares(truth, records) - truth.values).max() < 1e-9
    towed = {run.name: record for run, record in records}
    # Y' = Yb b + Yb|b| b|b| with b = atan(v/u) = +20 deg
    beta = math.radians(20)
    unit = 0.5 * ship.rho * ship.L * ship.T * 3.5**2
    expected = unit * (truth["Yb"] * beta + truth["Yb|b|"] * beta**2)
    assert towed["drift -20 deg"]["Y"][0] == pytest.approx(expected, rel=1e-12)


def test_a_set_about_the_centre_of_gravity_scaled_by_the_approach_speed_is_found_again(hull):
    conventions = INSIDE.but(origin="cog", velocity_scale="approach", force_scaling="L2")
    terms = [name for name in hull.names if name[0] != "N"]
    truth = DerivativeSet.from_values("cog", hull.ship, dict.fromkeys(terms, 0.3), conventions)
    records = synthesize_records(truth, standard_matrix("dtmb5512", hull.ship), SHORT)
    assert np.abs(plain_least_squares(truth, records) - truth.values).max() < 1e-9


# -- forces and motion ---------------------------------------------------------------------------------------


def test_side_force_of_oblique_towing_is_that_of_the_polynomial(hull):
    truth, ship = hull, hull.ship
    v = -math.sin(math.radians(10))
    expected = 0.5 * 1000.0 * ship.L * ship.T * 1.5**2 * (-0.3 * v - 1.7 * v**3)
    record = record_of(truth, TOW)
    assert record["Y"] == pytest.approx(np.full(80, expected), rel=1e-12)
    assert expected > 0  # the bow to starboard of the path is pushed to starboard


def test_inertia_and_moment_arm_are_in_the_reading(hull):
    truth = hull
    laboratory = replace(SHORT, inertia=BODY, moment_x=0.4)
    bare, full = record_of(truth, TURN), record_of(truth, TURN, laboratory)
    u, v, r = 1.5 * math.cos(math.radians(10)), -1.5 * math.sin(math.radians(10)), 0.2
    side = bare["Y"] - 90.0 * u * r
    assert full["X"] == pytest.approx(bare["X"] + 90.0 * (v * r + 0.05 * r**2), rel=1e-12)
    assert full["Y"] == pytest.approx(side, rel=1e-12)
    assert full["N"] == pytest.approx(bare["N"] - 90.0 * 0.05 * u * r - 0.4 * side, rel=1e-12)


def test_a_run_in_air_reads_the_inertia_alone(hull):
    dry = Run("dry", "dry_sway", frequency=2.0, sway_amplitude=0.1)
    record = record_of(hull, dry, replace(SHORT, inertia=BODY))
    acceleration = -0.1 * 4.0 * np.sin(2.0 * record.time)
    assert record["Y"] == pytest.approx(-90.0 * acceleration, abs=1e-10)
    assert record["N"] == pytest.approx(-90.0 * 0.05 * acceleration, abs=1e-10)
    with pytest.raises(CampaignError, match="in air") as caught:
        record_of(hull, dry)
    assert "dry" in caught.value.place


@pytest.mark.parametrize("run", [TOW, TURN, SWAY, YAW], ids=lambda run: run.name)
@pytest.mark.parametrize("transient", [False, True], ids=["constant", "transient"])
def test_velocities_are_the_rates_of_the_path(hull, run, transient):
    laboratory = Laboratory(sampling_rate=200.0, duration=5.0, cycles=1)
    if transient:
        laboratory = replace(laboratory, rest=1.0, ramp=2.0, startup_cycles=1)
    record = record_of(hull, run, laboratory)
    inside = slice(2, -2)
    rates = {name: np.gradient(record[name], record.time)[inside] for name in ("x", "y", "psi", "u", "v", "r")}
    psi = record["psi"][inside]
    u = rates["x"] * np.cos(psi) + rates["y"] * np.sin(psi)
    v = -rates["x"] * np.sin(psi) + rates["y"] * np.cos(psi)
    assert record["u"][inside] == pytest.approx(u, abs=2e-4)
    assert record["v"][inside] == pytest.approx(v, abs=2e-4)
    assert record["r"][inside] == pytest.approx(rates["psi"], abs=2e-4)
    for velocity, acceleration in (("u", "udot"), ("v", "vdot"), ("r", "rdot")):
        assert record[acceleration][inside] == pytest.approx(rates[velocity], abs=2e-4)


def test_a_steady_run_with_transients_has_the_same_plateau_and_starts_from_rest(hull):
    laboratory = replace(SHORT, rest=1.0, ramp=2.0, inertia=BODY)
    record = record_of(hull, TURN, laboratory)
    level = record_of(hull, TURN, replace(SHORT, inertia=BODY))
    plateau = (record.time >= 3.0) & (record.time < 11.0)
    for name in ("X", "Y", "N"):
        assert record[name][plateau] == pytest.approx(np.full(80, level[name][0]), rel=1e-12)
        assert record[name][0] == pytest.approx(0.0, abs=1e-12)
    # while accelerating the balance feels the mass
    rising = (record.time > 1.5) & (record.time < 2.5)
    assert record["X"][rising].min() < level["X"][0] - 20.0
    assert record["speed"][plateau] == pytest.approx(np.full(80, 1.5))


def test_added_mass_is_felt_during_acceleration(hull):
    truth = DerivativeSet.from_values("surge", hull.ship, {"R0": 0.02, "Xudot": -0.01}, INSIDE)
    record = record_of(truth, replace(TOW, drift_angle=0.0), replace(SHORT, ramp=2.0))
    added_mass = 0.01 * 0.5 * 1000.0 * hull.ship.L**2 * hull.ship.T
    drag = 0.02 * 0.5 * 1000.0 * hull.ship.L * hull.ship.T
    expected = -drag * record["speed"] ** 2 - added_mass * record["udot"]
    assert record["X"] == pytest.approx(expected, rel=1e-12, abs=1e-12)
    assert np.abs(record["udot"]).max() > 0.5


# -- conventions ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "conventions",
    [
        HOME,
        HOME.but(axes="forward-port-up"),
        HOME.but(force_sign="by-ship"),
        HOME.but(axes="forward-port-up", force_sign="by-ship", origin=0.1),
    ],
    ids=["home", "port-up", "by-ship", "all"],
)
@pytest.mark.parametrize("run", [TURN, YAW], ids=lambda run: run.name)
def test_the_reduction_undoes_what_the_laboratory_does(hull, conventions, run):
    truth, ship = hull, hull.ship
    laboratory = replace(
        SHORT, conventions=conventions, inertia=BODY, balance_zero={"X": 1.0, "Y": -2.0, "N": 3.0}
    )
    settings = Reduction(
        window="key-times",
        start=0.0,
        skip_cycles=0,
        position_x=laboratory.path_point(ship),
        moment_x=laboratory.moment_point(ship),
    )
    zero = zero_run(ship, laboratory, ("X", "Y", "N")).record(Noise(), {})
    sign = {"X": 1.0, "Y": 1.0, "N": 1.0}
    if conventions.axes == "forward-port-up":
        sign |= {"Y": -1.0, "N": -1.0}
    if conventions.force_sign == "by-ship":
        sign = {name: -value for name, value in sign.items()}
    tare = {"zero": {name: sign[name] * zero[name][0] for name in sign}}
    assert tare["zero"] == {"X": 1.0, "Y": -2.0, "N": 3.0}
    plan = ReductionPlan(settings, ship, conventions, inertia=BODY, tare=tare, terms=truth.terms)
    reduced = reduce_run(record_of(truth, run, laboratory), replace(run, tare="zero"), plan)
    for component in ("X", "Y", "N"):
        own = [term for term in truth.terms if term.component == component]
        expected = reduced.design(own) @ [truth[term.name] for term in own]
        assert reduced.scaled[component] == pytest.approx(expected, abs=1e-12)


def test_velocities_are_those_of_the_origin(hull):
    forward = replace(SHORT, conventions=HOME.but(origin=0.25), position_x=0.0)
    home, moved = record_of(hull, TURN), record_of(hull, TURN, forward)
    assert moved["v"] - home["v"] == pytest.approx(np.full(80, 0.25 * hull.ship.L * 0.2))
    assert moved["u"] == pytest.approx(home["u"])


def test_a_set_with_added_mass_terms_outside_is_turned_into_what_a_balance_feels(hull):
    inside = hull.with_values(Xudot=-0.01)
    outside = inside.to(HOME, rigid_body_inertia="inside")
    assert as_measured(inside) is inside
    assert outside["Yr"] != pytest.approx(inside["Yr"])
    back = as_measured(outside)
    assert back.params[list(inside.names)].to_numpy() == pytest.approx(inside.values, abs=1e-12)
    assert record_of(outside, YAW)["Y"] == pytest.approx(record_of(inside, YAW)["Y"], abs=1e-9)


def test_a_set_that_cannot_be_turned_says_what_it_lacks(hull):
    outside = DerivativeSet.from_values("outside", hull.ship, {"Yv": -0.3, "Yr": 0.05}, HOME)
    with pytest.raises(ConventionError, match="Xudot") as caught:
        record_of(outside, TURN)
    assert "outside" in str(caught.value)


# -- campaigns -----------------------------------------------------------------------------------------------


def test_noise_is_drawn_again_without_changing_the_motion(hull):
    campaign = virtual_campaign(hull, [TOW, SWAY], SHORT)
    first, second = (campaign.records(Noise(white=0.02, seed=seed)) for seed in (1, 2))
    assert np.array_equal(first[1][1]["v"], second[1][1]["v"])
    assert not np.array_equal(first[1][1]["Y"], second[1][1]["Y"])
    clean = campaign.clean[1].forces["Y"]
    assert (first[1][1]["Y"] - clean).std() == pytest.approx(0.02 * campaign.reference["Y"], rel=0.2)
    alone = synthesize_records(hull, [SWAY], SHORT, noise=Noise(white=0.02, seed=1), reference=campaign.reference)
    assert np.array_equal(alone[0][1]["Y"], first[1][1]["Y"])


def test_each_depth_has_its_own_set(hull):
    deep = hull
    shallow = replace(deep, values=2.0 * deep.values)
    runs = [replace(TOW, name="deep"), replace(TOW, name="shallow", depth=0.2)]
    records = synthesize_records({math.inf: deep, 0.2: shallow}, runs, SHORT)
    assert records[1][1]["Y"] == pytest.approx(2.0 * records[0][1]["Y"], rel=1e-12)
    with pytest.raises(CampaignError, match=r"depth of 0\.3 m") as caught:
        synthesize_records({math.inf: deep}, [replace(TOW, depth=0.3)], SHORT)
    assert "tow" in caught.value.place


@pytest.mark.parametrize(("runs", "message"), [([], "no run"), ([TOW, TOW], "two runs are called 'tow'")])
def test_impossible_campaigns_are_refused(hull, runs, message):
    with pytest.raises(CampaignError, match=message):
        virtual_campaign(hull, runs)


def test_a_moment_cannot_be_moved_without_the_side_force(hull):
    moment = DerivativeSet.from_values("moment", hull.ship, {"Nv": -0.1}, INSIDE)
    with pytest.raises(ConventionError, match="needs Y"):
        record_of(moment, TOW, replace(SHORT, moment_x=0.2))


def test_terms_that_no_run_excites_are_told_apart(hull):
    def names(*runs):
        return [term.name for term in excited_terms(sets_by_depth(hull), runs)]

    assert names(TOW) == ["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"]
    assert names(Run("straight", "static_drift", 1.5)) == ["R0"]
    assert "Yvdot" in names(SWAY)
    assert not {"Yr", "Yvvr"} & set(names(SWAY))
    assert "Yvvr" in names(TURN)
    # a sailing forward along the path has no sway velocity, only yaw
    pure = Run("yaw", "pure_yaw", 1.5, frequency=0.9, sway_amplitude=0.4)
    assert {"Yr", "Yrrr", "Yrdot"} <= set(names(pure))
    assert not {"Yv", "Yvdot", "Yvrr"} & set(names(pure))
    assert set(names(TURN, SWAY, YAW)) == set(hull.names)
