"""Standard test matrices against what their papers print, their scaling, and matrices as tables."""

from __future__ import annotations

import math
from collections import Counter

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import CampaignError
from towtank.core.ship import Ship
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import STANDARD_MATRICES, matrix_frame, matrix_from_csv, standard_matrix

DTMB = Ship("DTMB 5512", L=3.048, B=0.41, T=0.136)
DTC = Ship("DTC", L=3.55, B=0.51, T=0.145)
KCS = Ship("KCS", L=3.0464, B=0.4265, T=0.143)


def degrees(runs):
    return [round(math.degrees(run.drift_angle), 9) for run in runs]


def extremes(run, name):
    values = prescribed_motion(run).at(np.linspace(0.0, run.period, 2000))[name]
    return values.min(), values.max()


def of_kind(runs, kind):
    return [run for run in runs if run.kind == kind]


def test_dtmb5512_is_the_programme_of_tables_10_and_11():
    runs = standard_matrix("dtmb5512", DTMB)
    positive = [2, 6, 9, 10, 11, 12, 16, 20]
    assert degrees(of_kind(runs, "static_drift")) == [*(-a for a in reversed(positive)), 0, *positive]
    assert {run.speed for run in runs} == {1.5311}
    sway, yaw = of_kind(runs, "pure_sway"), of_kind(runs, "pure_yaw")
    assert [run.frequency for run in sway] == [0.841] * 3
    assert [extremes(run, "v")[1] for run in sway] == pytest.approx([0.053, 0.107, 0.266], rel=1e-5)
    assert [run.frequency for run in yaw] == [0.841] * 3 + [1.08] * 3
    assert [extremes(run, "r")[1] for run in yaw] == pytest.approx(
        [0.025, 0.075, 0.15, 0.225, 0.3, 0.375], rel=1e-5
    )


def test_dtc_runs_have_the_heading_and_yaw_rate_of_table_2():
    runs = {run.name: run for run in standard_matrix("dtc-cfd", DTC)}
    for name, rate, low, high in (
        ("yaw r' 0.25", 0.25, -5.71, 5.71),
        ("yaw r' 0.35", 0.35, -7.97, 7.97),
        ("yaw r' 0.2 drift +2 deg", 0.20, -2.57, 6.57),
        ("yaw r' 0.2 drift +12 deg", 0.20, 7.43, 16.57),
    ):
        run = runs[name]
        assert np.degrees(extremes(run, "psi")) == pytest.approx([low, high], abs=0.006)
        assert extremes(run, "r")[1] * 3.55 / 0.3086 == pytest.approx(rate, abs=1e-5)
        assert run.frequency * 3.55 / 0.3086 == pytest.approx(2.5)
    assert len(runs) == 14


def test_pure_car_carrier_runs_are_189_a_depth_and_17_near_the_bank():
    ship = Ship("PCC", L=2.0, B=0.358, T=0.091)
    runs = standard_matrix("pcc", ship)
    points = {
        (degree, round(run.yaw_rate * 2.0 / run.speed, 9), round(math.degrees(run.heel), 9))
        for run, degree in zip(runs, degrees(runs))
    }
    assert points == {
        (beta, rate / 10, heel) for beta in range(-20, 21, 5) for rate in range(-3, 4) for heel in (0, 5, 10)
    }
    assert Counter(run.kind for run in runs) == {"static_drift": 27, "steady_yaw": 18, "steady_yaw_drift": 144}
    bank = standard_matrix("pcc-bank", ship)
    assert Counter(round(run.bank_position / 2.0, 9) for run in bank) == {
        0.09: 5,
        0.18: 5,
        0.27: 5,
        0.31: 1,
        0.36: 1,
    }


def test_inland_runs_have_the_drift_sign_of_marin():
    runs = standard_matrix("inland", Ship("inland", L=110.0, B=11.4, T=3.5))
    # atan(v/u) = 0:2:20 deg, and -10 and -20 deg with yaw
    assert [-a for a in degrees(of_kind(runs, "static_drift"))] == list(range(0, 21, 2))
    coupled = of_kind(runs, "steady_yaw_drift")
    assert Counter(-a for a in degrees(coupled)) == {-10: 6, -20: 6}
    rates = [run.yaw_rate * 110.0 / 3.5 for run in of_kind(runs, "steady_yaw")]
    assert rates == pytest.approx([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])


def test_kcs_runs_have_four_depths_and_two_speeds():
    runs = standard_matrix("kcs-depths", KCS, speed=1.4)
    assert Counter(round(run.depth / 0.143, 9) for run in runs) == {1.2: 3, 1.5: 3, 2.0: 3, 32.0: 3}
    assert {(run.depth > 1, round(run.speed, 9)) for run in runs} == {(True, 1.4), (False, 0.55)}
    sway = of_kind(runs, "pure_sway")
    assert {(run.frequency, run.sway_amplitude) for run in sway} == {(0.628, 0.3)}


@pytest.mark.parametrize("kind", list(STANDARD_MATRICES))
def test_another_ship_gets_the_same_motion_in_non_dimensional_form(kind):
    home = STANDARD_MATRICES[kind]
    model = Ship("model", L=home.length, B=0.2 * home.length, T=0.05 * home.length)
    large = Ship("large", L=9 * home.length, B=1.8 * home.length, T=0.45 * home.length)
    for a, b, c in zip(
        standard_matrix(kind, model), standard_matrix(kind, large), standard_matrix(kind, large, speed=2.0)
    ):
        assert b.speed == pytest.approx(3 * a.speed)
        assert c.speed / a.speed == pytest.approx(2.0 / home.speed)
        assert a.name == b.name == c.name
        for run in (b, c):
            assert run.drift_angle == a.drift_angle
            assert run.yaw_rate * large.L / run.speed == pytest.approx(a.yaw_rate * model.L / a.speed)
            assert run.frequency * large.L / run.speed == pytest.approx(a.frequency * model.L / a.speed)
            assert run.sway_amplitude / large.L == pytest.approx(a.sway_amplitude / model.L)
            assert run.surge_amplitude / large.L == pytest.approx(a.surge_amplitude / model.L)
            assert run.bank_position / large.L == pytest.approx(a.bank_position / model.L)
            if a.depth is not None:
                assert run.depth / large.T == pytest.approx(a.depth / model.T)


@pytest.mark.parametrize("kind", list(STANDARD_MATRICES))
def test_runs_of_a_programme_have_names_of_their_own(kind):
    names = [run.name for run in standard_matrix(kind, DTMB)]
    assert len(set(names)) == len(names) > 10


def test_an_unknown_programme_is_refused_with_the_known_ones():
    with pytest.raises(CampaignError, match="'iihr'") as caught:
        standard_matrix("iihr", DTMB)
    assert "dtmb5512" in caught.value.cure


@pytest.mark.parametrize(
    "conventions",
    [
        HOME,
        HOME.but(angle_unit="deg", drift_sign="+v", rudder_sign="port"),
        HOME.but(axes="forward-port-up", angle_unit="deg"),
    ],
    ids=["home", "degrees", "port-up"],
)
def test_a_matrix_goes_through_a_table_in_any_convention(tmp_path, conventions):
    runs = [
        *standard_matrix("general", DTMB),
        *standard_matrix("kcs-depths", KCS),
        Run("rudder", "drift_rudder", 1.0, drift_angle=0.1, rudder_angle=-0.3, propeller_rate=7.0),
        Run("heeled", "steady_yaw_drift", 1.0, drift_angle=0.0, yaw_rate=0.2, heel=0.1, bank_position=0.4),
        Run("tared", "static_drift", 1.0, tare="zero.txt"),
    ]
    file = tmp_path / "matrix.csv"
    matrix_frame(runs, conventions).to_csv(file, index=False)
    again = matrix_from_csv(file, conventions)
    for before, after in zip(runs, again, strict=True):
        for key, value in vars(before).items():
            expected = pytest.approx(value, rel=1e-14) if isinstance(value, float) else value
            assert getattr(after, key) == expected, key


def test_table_holds_degrees_and_signs_of_its_convention():
    run = Run("a", "drift_rudder", 1.0, drift_angle=math.radians(10), rudder_angle=math.radians(5))
    frame = matrix_frame([run], HOME.but(angle_unit="deg", drift_sign="+v", rudder_sign="port"))
    assert frame.loc[0, "drift_angle"] == pytest.approx(-10)
    assert frame.loc[0, "rudder_angle"] == pytest.approx(-5)
    assert "frequency" not in frame


def test_a_matrix_without_its_file_or_with_a_wrong_column_is_refused(tmp_path):
    with pytest.raises(CampaignError, match="not found"):
        matrix_from_csv(tmp_path / "none.csv")
    file = tmp_path / "matrix.csv"
    file.write_text("name,type,speed,drift\na,static_drift,1.0,0.1\n")
    with pytest.raises(CampaignError, match="'drift'") as caught:
        matrix_from_csv(file)
    assert "row 2" in caught.value.place
