from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.cfd.case_loads import LoadChoices
from towtank.cfd.case_sweep import find_cases
from towtank.cfd.settled_loads import (
    SETTLED_COLUMNS,
    points_table,
    require_settled,
    settle_sweep,
    settled_table,
    settling_findings,
)
from towtank.core.errors import AuditError, FitError, ReadError

TIME = 0.1 * np.arange(1, 401)
NOISE = np.random.default_rng(0).standard_normal((3, 400))
STEADY = 10.0 + 0.1 * NOISE[0]
HOME = LoadChoices(axes="x-forward-z-down")


def settle_one(folder, **more):
    return settle_sweep(find_cases([folder]), HOME, **more)[0]


def test_settled_case(case):
    item = settle_one(case("beta_4", x=STEADY + 8.0 * np.exp(-TIME / 2.0), y=2.0 + 0.05 * NOISE[1]))
    assert item.verdict == "settled"
    assert item["X"].mean == pytest.approx(10.0, abs=4.0 * item["X"].se)
    assert item["Y"].mean == pytest.approx(2.0, abs=4.0 * item["Y"].se)
    assert 4.0 < item.settling.cut_time < 30.0
    frame = item.to_frame()
    assert tuple(frame.columns) == SETTLED_COLUMNS
    assert frame["cut_time"].nunique() == 1


def test_parts_share_window_and_verdict_and_add_up(case):
    item = settle_one(case("beta_4", x=STEADY + 8.0 * np.exp(-TIME / 2.0)))
    parts = item["X_pressure"].mean + item["X_viscous"].mean
    assert parts == pytest.approx(item["X"].mean, rel=1e-6)
    assert item["X_viscous"].verdict == item["X"].verdict
    assert item["X_viscous"].se == pytest.approx(0.2 * item["X"].se, rel=0.05)


def test_sway_force_near_zero_can_settle(case):
    # 1 % of almost nothing is nothing: the tolerance comes from X.
    y = 0.001 * NOISE[1] + 0.01 * np.exp(-TIME / 30.0)
    item = settle_one(case("straight", x=STEADY, y=y))
    assert item["Y"].verdict == "settled"


def test_drifting_case_stops_a_fit_unless_waived(case):
    folder = case("beta_4", x=STEADY + 6.0 * np.exp(-TIME / 30.0))
    item = settle_one(folder)
    assert item.verdict == "still drifting"
    assert item["X"].drift < -0.3
    with pytest.raises(FitError, match="still-drifting") as stopped:
        require_settled([item])
    assert "--waive beta_4" in str(stopped.value)
    with pytest.raises(FitError, match="still drifting"):
        points_table([item])
    waived = settle_one(folder, waive=["beta_4"])
    require_settled([waived])
    assert [finding.accepted for finding in settling_findings([waived])] == [True]
    # The drift to come is part of what the fit is told about the point.
    point = points_table([waived]).iloc[0]
    assert point["X_sd"] > abs(waived["X"].drift)


def test_diverged_case_cannot_be_waived(case):
    x = STEADY.copy()
    x[300:] = np.nan
    item = settle_one(case("beta_4", x=x), waive=["beta_4"])
    assert item.verdict == "diverged"
    assert math.isnan(item["X"].mean)
    assert "30.1" in item["X"].note
    with pytest.raises(FitError, match="diverged"):
        require_settled([item])


def test_short_case(case):
    item = settle_one(case("beta_4", x=STEADY[:20], time=TIME[:20]))
    assert item.verdict == "too short"
    with pytest.raises(FitError, match="too-short"):
        require_settled([item])


def test_forced_motion_gives_harmonics(case):
    omega = 2.0 * np.pi / 4.0
    y = 5.0 * np.cos(omega * TIME) + 3.0 * np.exp(-TIME / 2.0) + 0.01 * NOISE[1]
    item = settle_one(case("pure", y=y, x=STEADY), omega=omega)
    assert item["Y"].verdict == "periodic"
    assert item["Y"].amplitude == pytest.approx(5.0, abs=0.05)
    row = settled_table([item]).set_index("load").loc["Y"]
    assert row["period"] == pytest.approx(4.0)
    assert row["cycles_dropped"] >= 1


def test_points_in_home_signs(case):
    item = settle_one(case("beta_-4_U_1.5", x=STEADY))
    point = points_table([item]).iloc[0]
    assert (point["name"], point["beta"], point["rprime"], point["speed"]) == ("beta_-4_U_1.5", -4.0, 0.0, 1.5)
    assert point["X"] == pytest.approx(10.0, abs=0.05)
    assert point["N"] == pytest.approx(4.0)


def test_double_case_and_unknown_waiver_are_refused(case, tmp_path):
    case("beta_4_grid1", x=STEADY)
    case("beta_4.0_grid1", x=STEADY)
    with pytest.raises(AuditError, match="double-case"):
        settle_sweep(find_cases([tmp_path]), HOME)
    with pytest.raises(ReadError, match="no case 'beta_5' to waive"):
        settle_sweep(find_cases([tmp_path / "beta_4_grid1"]), HOME, waive=["beta_5"])


def test_given_start_names_the_case_when_it_leaves_nothing(case):
    folder = case("beta_4", x=STEADY)
    assert settle_one(folder, start=20.0).settling.cut_time == pytest.approx(20.0)
    with pytest.raises(FitError, match="beta_4"):
        settle_one(folder, start=39.5)
