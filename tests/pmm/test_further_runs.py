"""Repeats and next runs: checked by planning the enlarged programme from the beginning."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import CampaignError, FitError, TermError
from towtank.pmm.further_runs import best_next_run, repeats_for
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import Noise
from towtank.pmm.programme import plan
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import standard_matrix

LAB = Laboratory(sampling_rate=10.0, duration=20.0, cycles=2)
NOISE = Noise(ar1=0.05, rho=0.9)


LEAN = ("drift -16", "drift -9", "drift +0", "drift +9", "drift +16", "sway v 0.266", "sway v 0.107")
LEAN += ("yaw r 0.15 rad/s", "yaw r 0.375", "yaw r 0.3 rad/s drift")


@pytest.fixture(scope="module")
def matrix(hull):
    """A lean programme that determines the whole MMG model."""
    return [run for run in standard_matrix("dtmb5512", hull.ship) if run.name.startswith(LEAN)]


@pytest.fixture(scope="module")
def programme(hull, matrix):
    return plan(hull, matrix, NOISE, laboratory=LAB)


def repeated(runs, counts):
    return [
        *runs,
        *(replace(run, name=f"{run.name} #{i}") for run in runs for i in range(counts.get(run.name, 0))),
    ]


@pytest.mark.parametrize("name", ["Nv", "Yrrr", "Yvdot"])
def test_the_repeats_reach_the_target_and_one_less_does_not(hull, matrix, programme, name):
    need = repeats_for(programme, name, 0.03)
    assert need.target == pytest.approx(0.03 * abs(hull[name]) / 1.959964, rel=1e-6)
    present = programme.standard_errors[programme.position(name)]
    assert need.present == pytest.approx(present)
    assert need.whole_programme > 1
    assert present / math.sqrt(need.whole_programme) <= need.target
    assert present / math.sqrt(need.whole_programme - 1) > need.target
    enlarged = plan(hull, repeated(matrix, need.runs), NOISE, laboratory=LAB, reference=programme.noise.reference)
    reached = enlarged.standard_errors[enlarged.position(name)]
    assert reached == pytest.approx(need.reached, rel=1e-6)
    assert reached <= need.target
    # chosen runs are worth more than the programme as a whole
    assert sum(need.runs.values()) <= (need.whole_programme - 1) * len(matrix)
    assert list(need.runs.values()) == sorted(need.runs.values(), reverse=True)


def test_a_programme_that_is_good_enough_needs_no_repeats(programme):
    need = repeats_for(programme, "Yv", 0.5)
    assert (need.whole_programme, need.runs) == (1, {})
    assert "no repeats" in need.describe()
    assert "times, or repeat" in repeats_for(programme, "Yv", 0.005).describe()


def test_shared_gain_counts_and_can_make_the_target_impossible(hull, matrix, programme):
    biased = plan(hull, matrix, replace(NOISE, gain_bias=0.005), laboratory=LAB)
    need = repeats_for(biased, "Nv", 0.02)
    assert need.shared == pytest.approx(0.005 * abs(hull["Nv"]), rel=1e-6)
    assert need.whole_programme > repeats_for(programme, "Nv", 0.02).whole_programme
    assert need.reached <= need.target
    with pytest.raises(FitError, match="shared by all runs"):
        repeats_for(biased, "Nv", 0.005)


def test_what_is_not_known_or_not_determined_has_no_repeats(hull, programme):
    drift = [run for run in programme.runs if run.kind == "static_drift"]
    with pytest.raises(FitError, match="does not determine Yr"):
        repeats_for(plan(hull, drift, NOISE, laboratory=LAB), "Yr")
    terms = plan(["Yv", "Yvvv"], drift, {"Y": 1e-3}, ship=hull.ship, laboratory=LAB)
    with pytest.raises(FitError, match="size of Yv"):
        repeats_for(terms, "Yv")
    with pytest.raises(TermError, match="Yphi"):
        repeats_for(programme, "Yphi")


def test_a_term_is_planned_beside_terms_that_cannot_be_found(hull, programme):
    drift = [run for run in programme.runs if run.kind == "static_drift"]
    need = repeats_for(plan(hull, drift, NOISE, laboratory=LAB), "Nv", 0.02)
    alone = plan(hull.subset(["Nv", "Nvvv"]), drift, NOISE, laboratory=LAB)
    assert need.whole_programme == repeats_for(alone, "Nv", 0.02).whole_programme
    assert need.reached <= need.target


@pytest.mark.parametrize("criterion", ["D", "A"])
def test_the_best_next_run_is_the_one_that_a_new_plan_prefers(hull, programme, criterion):
    candidates = [
        Run("more drift", "static_drift", 1.5, drift_angle=math.radians(18)),
        Run("straight", "static_drift", 1.5),
        Run("fast sway", "pure_sway", 1.5, frequency=1.5, sway_amplitude=0.3),
        Run("gentle yaw", "pure_yaw", 1.5, frequency=0.6, sway_amplitude=0.1),
        Run("strong yaw", "yaw_drift", 1.5, frequency=1.0, sway_amplitude=0.6, drift_angle=math.radians(12)),
    ]
    table = best_next_run(programme, candidates, criterion)
    merit = {}
    for candidate in candidates:
        enlarged = plan(
            hull, [*programme.runs, candidate], NOISE, laboratory=LAB, reference=programme.noise.reference
        )
        if criterion == "D":
            merit[candidate.name] = np.linalg.slogdet(enlarged.covariance)[1]
        else:
            merit[candidate.name] = float(np.mean((enlarged.standard_errors / hull.values) ** 2))
    assert list(table["run"]) == sorted(merit, key=merit.get)
    assert table["score"].is_monotonic_increasing
    assert (table["gain"] > 0).all()


def test_the_best_run_for_one_term_and_the_error_it_leaves(hull, programme):
    table = best_next_run(programme, programme.runs, target="Yrrr")
    assert table.loc[0, "run"] == "yaw r 0.375 rad/s"
    best = next(run for run in programme.runs if run.name == table.loc[0, "run"])
    enlarged = plan(
        hull,
        [*programme.runs, replace(best, name="again")],
        NOISE,
        laboratory=LAB,
        reference=programme.noise.reference,
    )
    assert table.loc[0, "std"] == pytest.approx(enlarged.standard_errors[enlarged.position("Yrrr")], rel=1e-9)


def test_runs_that_determine_new_terms_come_first(hull, programme):
    drift = [run for run in programme.runs if run.kind == "static_drift"]
    candidates = [drift[0], *(run for run in programme.runs if run.harmonic)]
    table = best_next_run(plan(hull, drift, NOISE, laboratory=LAB), candidates)
    assert math.isinf(table.loc[0, "gain"])
    assert table.loc[0, "type"] == "yaw_drift"
    assert table.iloc[-1]["run"] == drift[0].name
    assert math.isfinite(table.iloc[-1]["gain"])


def test_no_candidate_is_refused(programme):
    with pytest.raises(CampaignError, match="no candidate"):
        best_next_run(programme, [])
