"""Three ways side by side: the fit is right, the sinusoid ways show their bias, conventions agree."""

from __future__ import annotations

import math

import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.pmm.campaign_file import Fit
from towtank.pmm.hull_fit import HullFit, fit_hull
from towtank.pmm.multiple_run import multiple_run_derivatives
from towtank.pmm.run_types import Run
from towtank.pmm.single_run import average_over_runs
from towtank.pmm.three_ways import COLUMNS, three_ways

SPEED = 1.5311


def campaign(length: float) -> list[Run]:
    """Static drift, pure sway, pure yaw and yaw with drift, as at IIHR."""

    def path(r_max: float, w: float = 0.841) -> float:
        return r_max * SPEED**2 / (w**2 * length)

    runs = [
        Run(f"drift {b}", "static_drift", speed=SPEED, drift_angle=math.radians(b)) for b in (-8, -4, 0, 4, 8, 12)
    ]
    for v in (0.05, 0.1, 0.17):
        runs.append(Run(f"sway {v}", "pure_sway", speed=SPEED, frequency=0.841, sway_amplitude=v * SPEED / 0.841))
    for r in (0.15, 0.3, 0.6):
        runs.append(Run(f"yaw {r}", "pure_yaw", speed=SPEED, frequency=0.841, sway_amplitude=path(r)))
    for b in (4, 8, 11):
        runs.append(
            Run(
                f"yaw and drift {b}",
                "yaw_drift",
                speed=SPEED,
                frequency=0.841,
                sway_amplitude=path(0.3),
                drift_angle=math.radians(b),
            )
        )
    return runs


@pytest.fixture(scope="module")
def clean(reduced, hull) -> HullFit:
    runs = reduced(hull, campaign(hull.ship.L))
    return fit_hull(runs, Fit(), hull.ship, name="clean", terms=hull.terms)


@pytest.fixture(scope="module")
def noisy(reduced, hull) -> HullFit:
    runs = reduced(hull, campaign(hull.ship.L), noise=0.02, seed=5)
    return fit_hull(runs, Fit(), hull.ship, name="noisy", terms=hull.terms)


def test_one_row_a_derivative_of_the_fit(clean, hull) -> None:
    frame = three_ways(clean)
    assert tuple(frame.columns) == COLUMNS
    assert list(frame["name"]) == list(clean.derivatives.names)
    for row in frame.itertuples():
        assert row.fit == clean.derivatives[row.name]
        assert row.fit == pytest.approx(hull[row.name], rel=1e-9)


def test_sinusoid_ways_are_biased_where_the_motion_is_none(clean, hull) -> None:
    frame = three_ways(clean).set_index("name")
    # sway is nearly a sinusoid over a constant speed, yaw with eps = 0.34 is not
    assert abs(frame.loc["Yv", "single_minus_fit_percent"]) < 1.0
    assert abs(frame.loc["Yvdot", "multiple_minus_fit_percent"]) < 2.0
    assert abs(frame.loc["Yr", "single_minus_fit_percent"]) > 5.0
    assert abs(frame.loc["Yrrr", "single_minus_fit_percent"]) > 30.0
    assert abs(frame.loc["Yrrr", "multiple_minus_fit_percent"]) > 10.0
    # static tests have no motion to be wrong about
    assert frame.loc["Yvvv", "multiple_run_method"] == "static drift, mean"
    assert abs(frame.loc["Yvvv", "multiple_minus_fit_percent"]) < 1e-6


def test_entries_are_those_of_the_other_two_ways(noisy) -> None:
    frame = three_ways(noisy).set_index("name")
    single = average_over_runs(noisy.runs).set_index("name")
    multiple = multiple_run_derivatives(noisy.runs, noisy.derivatives.terms).drop_duplicates("name")
    multiple = multiple.set_index("name")
    for name in ("Yv", "Nvdot", "Xrr", "Yvvr", "Nvrr"):
        assert frame.loc[name, "single_run"] == single.loc[name, "value"]
        assert frame.loc[name, "single_run_std"] == single.loc[name, "std"]
        assert frame.loc[name, "single_runs"] == single.loc[name, "n"]
        assert frame.loc[name, "multiple_run"] == multiple.loc[name, "value"]
        assert frame.loc[name, "multiple_run_method"] == multiple.loc[name, "method"]


def test_resistance_is_compared_in_the_sign_of_the_fit(noisy) -> None:
    frame = three_ways(noisy).set_index("name")
    assert frame.loc["R0", "single_run"] == pytest.approx(0.018, rel=0.01)
    assert frame.loc["R0", "multiple_run"] == pytest.approx(0.018, rel=0.01)
    assert abs(frame.loc["R0", "single_minus_fit_percent"]) < 1.0


def test_differences(noisy) -> None:
    for row in three_ways(noisy).itertuples():
        if math.isnan(row.single_run):
            continue
        assert row.single_minus_fit == pytest.approx(row.single_run - row.fit, rel=1e-12)
        assert row.single_minus_fit_percent == pytest.approx(100 * row.single_minus_fit / abs(row.fit), rel=1e-12)
        combined = math.hypot(row.single_run_std, row.fit_std)
        assert row.single_minus_fit_in_std == pytest.approx(row.single_minus_fit / combined, rel=1e-12)


def test_the_fit_is_the_surest_way(noisy) -> None:
    frame = three_ways(noisy).set_index("name")
    for name in ("Yv", "Yvvv", "Yr", "Yrrr", "Nv", "Nvvv", "Nr", "Nrrr", "Yvvr", "Nvrr"):
        assert frame.loc[name, "fit_std"] < 1.05 * frame.loc[name, "multiple_run_std"]
        assert frame.loc[name, "fit_std"] < 1.05 * frame.loc[name, "single_run_std"]


def test_what_a_way_cannot_give_is_empty_and_said(reduced, hull) -> None:
    tests = [run for run in campaign(hull.ship.L) if run.name in ("sway 0.17", "yaw 0.3", "drift 0", "drift 8")]
    runs = reduced(hull, tests)
    terms = [term for term in hull.terms if term.name in ("R0", "Xvv", "Yv", "Yvvv", "Yvdot", "Yr")]
    fit = fit_hull(runs, Fit(), hull.ship, name="few", terms=terms)
    frame = three_ways(fit).set_index("name")
    # one point of the drift curve and one sway amplitude cannot separate Yv and Yvvv
    assert math.isnan(frame.loc["Yv", "multiple_run"])
    assert frame.loc["Yv", "multiple_run_method"] == ""
    assert any("pure sway, cos 1 of Y" in text for text in frame.attrs["multiple_run_left_out"])
    assert frame.loc["Yv", "single_runs"] == 1
    assert frame.attrs["single_run_left_out"] == []
    assert "Nvvv" in frame.attrs["not_in_fit"]
    assert "Yv" not in frame.attrs["not_in_fit"]


def test_modulus_terms_choose_the_modulus_relations(reduced, ship) -> None:
    values = {"Yv": -0.2, "Yv|v|": -0.6, "Yvdot": -0.12, "X0": -0.02}
    hull = DerivativeSet.from_values("modulus", ship, values, HOME.but(added_mass_coriolis="inside"))
    runs = [run for run in campaign(ship.L) if run.kind in ("static_drift", "pure_sway")]
    fit = fit_hull(reduced(hull, runs), Fit(), ship, name="modulus", terms=hull.terms)
    frame = three_ways(fit).set_index("name")
    assert frame.loc["Yv|v|", "single_run"] == pytest.approx(-0.6, rel=0.06)
    assert frame.loc["Yv|v|", "single_runs"] == 3


def test_rms_average(clean) -> None:
    mean, rms = three_ways(clean).set_index("name"), three_ways(clean, average="rms").set_index("name")
    assert rms.attrs["average"] == "rms"
    assert abs(rms.loc["Yrrr", "single_run"]) > abs(mean.loc["Yrrr", "single_run"])
    assert rms.loc["Yrrr", "single_run"] < 0
