"""Comparison of hull models and of fitting ranges."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import TermError
from towtank.core.hull_models import hull_model
from towtank.core.terms import parse_terms
from towtank.pmm.campaign_file import Fit
from towtank.pmm.force_rows import force_rows
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.model_comparison import COMPARISON_COLUMNS, RANGE_COLUMNS, compare_models, range_sensitivity
from towtank.pmm.run_types import Run

SPEED = 1.2
W = 0.9


def drifts(*angles: float) -> list[Run]:
    return [Run(f"drift {b}", "static_drift", speed=SPEED, drift_angle=math.radians(b)) for b in angles]


def yaws(length: float, *amplitudes: float) -> list[Run]:
    return [
        Run(f"yaw {r}", "pure_yaw", speed=SPEED, frequency=W, sway_amplitude=r * SPEED**2 / (W**2 * length))
        for r in amplitudes
    ]


ANGLES = (-12, -9, -6, -3, 0, 3, 6, 9, 12, 15)
CANDIDATES = {
    "linear": parse_terms(["R0", "Xvv", "Yv", "Nv"]),
    "cubic": parse_terms(["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"]),
    "modulus": parse_terms(["R0", "Xvv", "Yv", "Yv|v|", "Nv", "Nv|v|"]),
}


@pytest.fixture(scope="module")
def drift_runs(reduced, hull):
    return reduced(hull, drifts(*ANGLES), noise=0.02, seed=4)


def test_the_true_model_wins(drift_runs) -> None:
    frame = compare_models(drift_runs, CANDIDATES, Fit())
    assert tuple(frame.columns) == COMPARISON_COLUMNS
    best = frame.groupby("component", sort=False).first()
    assert best.loc["Y", "model"] == "cubic"
    assert best.loc["N", "model"] == "cubic"
    for _, group in frame.groupby("component"):
        assert group["n"].nunique() == 1
        assert group["delta_AICc"].min() == 0.0
        assert group["weight"].sum() == pytest.approx(1.0)
        assert list(group["AICc"]) == sorted(group["AICc"])
        delta = group["AICc"] - group["AICc"].min()
        np.testing.assert_allclose(group["weight"], np.exp(-delta / 2) / np.exp(-delta / 2).sum())


def test_figures_are_those_of_plain_least_squares(drift_runs) -> None:
    frame = compare_models(drift_runs, CANDIDATES, Fit(estimator="ols")).set_index(["component", "model"])
    v = np.array([run.state()["v"] for run in drift_runs])
    y = np.array([run.scaled["Y"][0] for run in drift_runs])
    keep = np.abs(v) > 0
    v, y = v[keep], y[keep]
    design = np.column_stack([v, v**3])
    residual = y - design @ np.linalg.lstsq(design, y, rcond=None)[0]
    row = frame.loc[("Y", "cubic")]
    assert row["n"] == len(y)
    assert row["terms"] == 2
    assert row["R2"] == pytest.approx(1 - residual @ residual / (y @ y), rel=1e-9)
    assert row["residual_rms"] == pytest.approx(math.sqrt(np.mean(residual**2)), rel=1e-9)
    n, k = len(y), 3
    aicc = n * math.log(2 * math.pi * np.mean(residual**2)) + n + 2 * k * n / (n - k - 1)
    assert row["AICc"] == pytest.approx(aicc, rel=1e-9)


def test_cross_validation_leaves_out_whole_runs(reduced, hull) -> None:
    runs = reduced(hull, yaws(hull.ship.L, 0.15, 0.2, 0.25, 0.3, 0.35), noise=0.03, seed=2)
    terms = parse_terms(["Yr", "Yrrr", "Yrdot"])
    row = compare_models(runs, {"yaw": terms}, Fit(estimator="ols")).iloc[0]
    squares, n = 0.0, 0
    rows = force_rows(runs, terms, "Y")
    for index in range(len(runs)):
        out = rows.run == index
        solution = np.linalg.lstsq(rows.design[~out], rows.response[~out], rcond=None)[0]
        squares += float(((rows.response[out] - rows.design[out] @ solution) ** 2).sum())
        n += int(out.sum())
    assert row["cv_rms"] == pytest.approx(math.sqrt(squares / n), rel=1e-9)
    assert row["cv_rms"] > row["residual_rms"]


def test_a_run_that_alone_determines_a_term(reduced, hull) -> None:
    runs = reduced(hull, [*drifts(-6, 0, 3, 6, 9), *yaws(hull.ship.L, 0.3)], noise=0.01)
    frame = compare_models(runs, {"both": parse_terms(["Yv", "Yvvv", "Yr"])}, Fit())
    assert math.isinf(frame.iloc[0]["cv_rms"])


def test_candidates_see_the_same_rows(reduced, hull) -> None:
    """A model without yaw terms must explain the yaw runs too, or it would win by looking away."""
    runs = reduced(hull, [*drifts(*ANGLES), *yaws(hull.ship.L, 0.2, 0.3)], noise=0.01, seed=1)
    candidates = {
        "drift only": parse_terms(["Yv", "Yvvv"]),
        "all": parse_terms(["Yv", "Yvvv", "Yr", "Yrrr", "Yrdot"]),
    }
    frame = compare_models(runs, candidates, Fit()).set_index("model")
    assert frame.loc["drift only", "n"] == frame.loc["all", "n"]
    assert frame.loc["all", "delta_AICc"] == 0.0
    assert frame.loc["drift only", "delta_AICc"] > 20


def test_unfit_candidates_have_a_note(drift_runs) -> None:
    candidates = {
        "cubic": CANDIDATES["cubic"],
        "with yaw": parse_terms(["Yv", "Yvvv", "Yr"]),
        "yaw alone": parse_terms(["Yr"]),
        "twins": parse_terms(["Yv", "Yb", "Yvvv", "Ybbb", "Yvvvvv"]),
        "unknown": parse_terms(["Yv", "Yp"]),
    }
    frame = compare_models(drift_runs[:6], candidates, Fit())
    frame = frame[frame["component"] == "Y"].set_index("model")
    assert frame.loc["with yaw", "note"] == "no run excites Yr"
    assert frame.loc["with yaw", "terms"] == 2
    assert frame.loc["with yaw", "AICc"] == frame.loc["cubic", "AICc"]
    assert math.isnan(frame.loc["yaw alone", "AICc"])
    assert frame.loc["yaw alone", "note"] != ""
    assert "'p'" in frame.loc["unknown", "note"]
    assert frame.loc["cubic", "note"] == ""


def test_component_without_candidates_is_not_listed(drift_runs) -> None:
    frame = compare_models(drift_runs, {"sway": parse_terms(["Yv", "Yvvv"])}, Fit())
    assert set(frame["component"]) == {"Y"}


def test_range_of_the_true_model_changes_nothing(reduced, hull) -> None:
    runs = reduced(hull, [*drifts(*ANGLES), *yaws(hull.ship.L, 0.1, 0.2, 0.3, 0.4)])
    terms = parse_terms(["Yv", "Yvvv", "Yr", "Yrrr", "Yrdot", "Nv", "Nvvv", "Nr", "Nrrr", "Nrdot"])
    frame = range_sensitivity(runs, terms, Fit(), [0.12, 0.18, 0.25])
    assert tuple(frame.columns) == RANGE_COLUMNS
    told = frame[frame["note"] == ""]
    for row in told.itertuples():
        assert row.value == pytest.approx(hull[row.name], rel=1e-6)
    assert (frame[frame["variable"] == ""]["limit"] == math.inf).all()


def test_range_counts_and_reference(drift_runs) -> None:
    terms = CANDIDATES["cubic"]
    frame = range_sensitivity(drift_runs, terms, Fit(), {"v": [math.sin(math.radians(9)), 0.5, 0.11]})
    reference = fit_hull(drift_runs, Fit(), drift_runs[0].ship, name="all", terms=terms).derivatives
    first = frame[frame["variable"] == ""].set_index("name")
    for name in reference.names:
        assert first.loc[name, "value"] == reference[name]
        assert first.loc[name, "std"] == pytest.approx(reference.bse[name], rel=1e-9)
        assert first.loc[name, "change_percent"] == 0.0
    runs = frame.groupby("limit", sort=False)["runs"].first()
    assert list(runs.index) == [math.inf, 0.11, math.sin(math.radians(9))]
    assert list(runs) == [10, 5, 7]
    row = frame[(frame["limit"] == 0.11) & (frame["name"] == "Yv")].iloc[0]
    change = row["value"] - reference["Yv"]
    assert row["change_percent"] == pytest.approx(100 * change / abs(reference["Yv"]), rel=1e-9)
    assert row["change_in_std"] == pytest.approx(change / math.hypot(row["std"], reference.bse["Yv"]), rel=1e-9)


def test_range_shows_a_model_that_is_too_low(reduced, ship) -> None:
    truth = DerivativeSet.from_values(
        "fifth", ship, {"Yv": -0.3, "Yvvv": -1.5, "Yvvvvv": -8.0}, HOME.but(added_mass_coriolis="inside")
    )
    runs = reduced(truth, drifts(-20, -15, -10, -5, 5, 10, 15, 20), noise=1e-4, seed=3)
    frame = range_sensitivity(runs, parse_terms(["Yv", "Yvvv"]), Fit(), {"beta": [math.radians(15)]})
    cut = frame[frame["variable"] == "beta"].set_index("name")
    assert cut.loc["Yvvv", "runs"] == 6
    assert abs(cut.loc["Yvvv", "change_in_std"]) > 3


def test_range_leaves_out_what_no_run_excites(reduced, hull) -> None:
    runs = reduced(hull, [*drifts(*ANGLES), *yaws(hull.ship.L, 0.2, 0.3, 0.4)])
    terms = parse_terms(["Yv", "Yvvv", "Yr", "Yrrr", "Yrdot"])
    frame = range_sensitivity(runs, terms, Fit(), {"r": [0.1]})
    cut = frame[frame["variable"] == "r"].set_index("name")
    assert cut.loc["Yr", "note"] == "no run excites it"
    assert math.isnan(cut.loc["Yr", "value"])
    assert cut.loc["Yv", "value"] == pytest.approx(hull["Yv"], rel=1e-8)
    assert cut.loc["Yv", "runs"] == 10


def test_range_with_too_few_runs_gives_the_reason(drift_runs) -> None:
    frame = range_sensitivity(drift_runs, parse_terms(["Yv", "Yvvv", "Yvvvvv"]), Fit(), {"v": [0.06]})
    cut = frame[frame["variable"] == "v"]
    assert cut["value"].isna().all()
    assert (cut["note"] != "").all()
    assert set(cut["runs"]) == {3}


def test_range_of_a_variable_that_is_not_there(drift_runs) -> None:
    with pytest.raises(TermError, match="the motion has no 'p'"):
        range_sensitivity(drift_runs, CANDIDATES["cubic"], Fit(), {"p": [0.1]})


def test_full_model_on_a_whole_campaign_ranks_the_cubic_first(reduced, hull) -> None:
    tests = [*drifts(*ANGLES), *yaws(hull.ship.L, 0.2, 0.3, 0.4)]
    tests += [
        Run(f"sway {v}", "pure_sway", speed=SPEED, frequency=W, sway_amplitude=v * SPEED / W) for v in (0.1, 0.2)
    ]
    runs = reduced(hull, tests, noise=0.02, seed=8)
    candidates = {"cubic": hull_model("mmg"), "modulus": hull_model("modulus")}
    frame = compare_models(runs, candidates, Fit())
    first = frame.drop_duplicates("component").set_index("component")
    assert first.loc["Y", "model"] == "cubic"
    # coupling terms are in the list and no run of this campaign excites them
    assert first.loc["Y", "note"] == "no run excites Yvvr, Yvrr"
