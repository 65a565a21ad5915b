"""Corrections by name on curves and records."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError, TowtankError
from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.named_corrections import CORRECTIONS, ShipInWater, correct_curve, correct_record
from towtank.squat.restricted_flow import kreitner, level_drop, raven_overspeed, wall_sinkage
from towtank.squat.sinkage_layout import SinkageLayout
from towtank.squat.sinkage_record import SinkageRecord
from towtank.squat.speed_corrections import lackenby_speed_loss, schuster_speed_loss
from towtank.squat.squat_curve import SquatCurve

DEPTH = 0.326
SPEED = np.array([0.327, 0.6, 0.872])
DTC = Ship("DTC", L=3.984, B=0.572, T=0.163, volume=0.2428, scale=89.11)
TANK = Fairway.canal(DEPTH, 7.0)
WATER = ShipInWater.of(
    DTC,
    TANK,
    viscous_share=0.8,
    gamma=1.02,
    waterline_gamma=1.04,
    outflow=0.01,
    volume_coefficient=0.5,
    wave_coefficient=0.01,
)


def curve():
    bow = np.array([0.88, 3.5, 8.34]) * 1e-3
    points = pd.DataFrame({"speed": SPEED, "sinkage_bow": bow, "sinkage_bow_se": 1e-5, "trim": 0.2 * bow})
    return SquatCurve(points, DEPTH, DTC.T, "DTC", DTC.scale)


SHARE = 0.98 * 0.572 * 0.163 / (7.0 * DEPTH)
FROUDE = SPEED / np.sqrt(9.80665 * DEPTH)


def test_overspeed_of_the_benchmark_tank():
    """Cross-check of the literature: gamma 1.043 and 1.057, drop of level 0.48 and 4.55 mm in C1 and C2."""
    assert abs(SHARE - 0.040) < 5e-4
    moved = correct_curve(curve(), "kreitner", WATER)
    np.testing.assert_allclose(moved.points["speed"] / SPEED, [1.043, 1.0481, 1.057], atol=1e-3)
    np.testing.assert_array_equal(moved.points["sinkage_bow"], curve().points["sinkage_bow"])
    raised = correct_curve(curve(), "kreitner", WATER, to="sinkages")
    drop = curve().points["sinkage_bow"] - raised.points["sinkage_bow"]
    np.testing.assert_allclose(drop.iloc[[0, 2]], [0.48e-3, 4.55e-3], rtol=0.02)
    np.testing.assert_array_equal(raised.points["speed"], SPEED)
    np.testing.assert_array_equal(raised.points["sinkage_bow_se"], 1e-5)
    np.testing.assert_array_equal(raised.points["trim"], curve().points["trim"])


def test_every_name_is_the_function_behind_it():
    walls = raven_overspeed(SHARE, FROUDE, 1.02, 0.01)
    influence = 7.04 * 0.572 / DTC.block_coefficient**0.85
    expected = {
        ("kreitner", "speeds"): kreitner(SHARE, FROUDE).gamma,
        ("kreitner", "sinkages"): level_drop(DEPTH, FROUDE, kreitner(SHARE, FROUDE).gamma),
        ("barrass-width", "speeds"): kreitner(0.98 * 0.572 * 0.163 / (influence * DEPTH), FROUDE).gamma,
        ("raven-width", "speeds"): (1.04 + walls) / 1.04,
        ("raven-width", "sinkages"): wall_sinkage(DEPTH, FROUDE, 1.04, walls),
        ("schuster", "speeds"): 1.0 + np.array([schuster_speed_loss(f, SHARE, 0.8) for f in FROUDE]),
        ("lackenby", "speeds"): 1.0
        + np.array([lackenby_speed_loss(v, DEPTH, 0.98 * 0.572 * 0.163) for v in SPEED]),
        ("tamura", "speeds"): 1.0 + 0.67 * SHARE * (3.984 / 7.0) ** 0.75 / (1.0 - FROUDE**2),
        ("tamura-ittc", "speeds"): 1.0 + 0.67 * SHARE * (3.984 / 0.572) ** 0.75 / (1.0 - FROUDE**2),
        ("scott", "speeds"): np.full(3, 1.0 + (0.5 * 0.2428 + 0.01 * 0.572 * 3.984**2) / (7.0 * DEPTH) ** 1.5),
    }
    for (name, form), value in expected.items():
        found = correct_curve(curve(), name, WATER, to=form).points
        change = (
            found["speed"] / SPEED if form == "speeds" else curve().points["sinkage_bow"] - found["sinkage_bow"]
        )
        np.testing.assert_allclose(change, value, rtol=1e-10, err_msg=f"{name} {form}")
    forms = {(key, form) for key, item in CORRECTIONS.items() for form in item.added_to}
    assert forms - set(expected) == {("barrass-width", "sinkages"), ("ittc-2017", "sinkages")}


def test_deep_water_has_no_sinkage_of_the_depth():
    deep = correct_curve(curve(), "ittc-2017", ShipInWater(length=3.984, volume=0.2428))
    drop = curve().points["sinkage_bow"] - deep.points["sinkage_bow"]
    fh, fd = FROUDE[2], SPEED[2] / np.sqrt(0.3 * 9.80665 * 3.984)
    by_hand = 1.46 * 0.2428 / 3.984**2 * (fh**2 / np.sqrt(1 - fh**2) - fd**2 / np.sqrt(1 - fd**2))
    assert drop.iloc[2] == pytest.approx(by_hand)
    assert (drop > 0.0).all()


def test_names_and_histories_say_what_was_done():
    assert correct_curve(curve(), "kreitner", WATER).name == "DTC, speeds by kreitner"
    found = correct_record(record(), "kreitner", WATER, to="sinkages")
    assert found.history == ("sinkages corrected by kreitner",)


def record(speed=None):
    time = np.arange(0.0, 10.0, 0.5)
    layout = SinkageLayout(3.984, heave="h", trim="t", speed="u")
    given = np.linspace(0.0, 0.872, time.size) if speed is None else speed
    return SinkageRecord(
        time, np.full(time.size, 6e-3), np.full(time.size, 1e-3), layout, speed=given, name="run.dat"
    )


@pytest.mark.parametrize("name", ["kreitner", "schuster", "lackenby", "tamura"])
def test_records_are_corrected_sample_by_sample_and_rest_stays_rest(name):
    found = correct_record(record(), name, WATER)
    assert found.speed[0] == 0.0
    assert (np.diff(found.speed) > 0.0).all()
    end = correct_curve(curve(), name, WATER).points["speed"].iloc[-1]
    assert found.speed[-1] == pytest.approx(end)


def test_a_record_loses_the_drop_of_level():
    found = correct_record(record(), "kreitner", WATER, to="sinkages")
    assert found.midship[0] == 6e-3
    assert found.midship[-1] == pytest.approx(6e-3 - 4.55e-3, abs=1e-4)
    np.testing.assert_array_equal(found.trim, record().trim)


@pytest.mark.parametrize(
    ("name", "water", "options", "error", "said"),
    [
        (
            "kreitner-width",
            WATER,
            {},
            TowtankError,
            "no correction 'kreitner-width' -> use one of kreitner, barrass",
        ),
        ("schuster", WATER, {"to": "sinkages"}, TowtankError, "is not added to sinkages -> it is added to speeds"),
        ("ittc-2017", WATER, {"to": "speeds"}, TowtankError, "is not added to speeds"),
        ("schuster", ShipInWater.of(DTC, TANK), {}, TowtankError, "'schuster' needs viscous_share"),
        ("kreitner", ShipInWater.of(DTC, Fairway(DEPTH)), {}, TowtankError, "'kreitner' needs section"),
        ("scott", ShipInWater.of(DTC, TANK), {}, TowtankError, "needs volume_coefficient"),
    ],
)
def test_unknown_names_and_missing_particulars_are_named(name, water, options, error, said):
    with pytest.raises(error, match=said):
        correct_curve(curve(), name, water, **options)


def test_no_flow_above_the_critical_speed_is_an_error_that_names_both_speeds():
    narrow = ShipInWater.of(DTC, Fairway.canal(DEPTH, 1.2))
    for form in ("speeds", "sinkages"):
        with pytest.raises(FitError, match=r"kreitner: 0\.872 m/s is above the critical speed 0\.7\d* m/s"):
            correct_curve(curve(), "kreitner", narrow, to=form)


def test_guards_of_the_authors_hold_unless_waived():
    deep = SquatCurve(curve().points, 2.0, DTC.T)
    water = ShipInWater(depth=2.0, midship_area=0.09)
    with pytest.raises(TowtankError, match="Lackenby: midship section over depth squared"):
        correct_curve(deep, "lackenby", water)
    assert correct_curve(deep, "lackenby", water, guarded=False).points["speed"].iloc[0] < SPEED[0]
    fast = ShipInWater(**{**vars(WATER), "length": 0.3})
    with pytest.raises(TowtankError, match=r"Scott: Froude number .* above 0.38"):
        correct_curve(curve(), "scott", fast)


def test_impossible_particulars_are_named():
    with pytest.raises(TowtankError, match="depth is zero"):
        ShipInWater(depth=0.0)
    with pytest.raises(TowtankError, match="section = -3 is impossible"):
        ShipInWater(section=-3.0)
    with pytest.raises(FitError, match=r"run.dat: a speed is missing"):
        correct_record(record(np.full(20, np.nan)), "kreitner", WATER)
    blind = SinkageRecord(np.arange(3.0), np.zeros(3), np.zeros(3), SinkageLayout(1.0, heave="h", trim="t"))
    with pytest.raises(FitError, match="a correction needs the speed"):
        correct_record(blind, "kreitner", WATER)
