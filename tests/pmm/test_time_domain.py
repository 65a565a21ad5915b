"""Fits in the time domain: every sample counts, condensed without loss."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import FitError
from towtank.core.terms import Term, parse_terms
from towtank.pmm.campaign_file import Fit, Reduction, SharedBias
from towtank.pmm.force_rows import force_rows
from towtank.pmm.hull_fit import fit_hull
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.noise import SILENT, Noise
from towtank.pmm.reduced_run import term_columns
from towtank.pmm.reduction import ReductionPlan, reduce_run
from towtank.pmm.standard_matrices import pure_sway, pure_yaw, static_drift
from towtank.pmm.time_rows import TimeRows
from towtank.pmm.virtual_records import virtual_campaign

SPEED = 1.5
MATRIX = [
    *static_drift((-12, -8, -4, 0, 4, 8, 12), SPEED),
    *pure_sway((0.1, 0.3), 0.9, SPEED),
    *pure_yaw((0.1, 0.2, 0.3), 0.9, SPEED),
    *pure_yaw((0.15, 0.3), 0.9, SPEED, (-8.0, 6.0)),
]
QUICK = Laboratory(sampling_rate=10.0, duration=20.0, cycles=3)


@pytest.fixture(scope="module")
def campaign(hull):
    return virtual_campaign(hull, MATRIX, QUICK)


def reduced(campaign, hull, noise=SILENT, *, time_domain=True, **reduction):
    settings = Reduction(skip_cycles=0, **reduction)
    plan = ReductionPlan(settings, hull.ship, HOME, terms=hull.terms, time_domain=time_domain)
    return [reduce_run(record, run, plan) for run, record in campaign.records(noise)]


def fitted(runs, hull, **settings):
    return fit_hull(runs, Fit(domain="time", **settings), hull.ship, name="twin", terms=hull.terms).derivatives


def test_condensed_rows_give_the_normal_equations_of_all_samples(campaign, hull):
    noise = Noise(white=0.02, seed=3)
    run, record = campaign.records(noise)[-1]
    plan = ReductionPlan(Reduction(skip_cycles=0), hull.ship, HOME, terms=hull.terms, time_domain=True)
    one = reduce_run(record, run, plan)
    terms = [term for term in hull.terms if term.component == "Y"]
    design, response = one.samples.rows("Y", terms)
    at = one.motion.at(one.window.times)
    columns = term_columns(at, terms, hull.ship, "instantaneous", one.motion.speed)
    full = np.column_stack([columns[term.factors] for term in terms])
    speed = np.hypot(at["surge"], at["v"])
    ship = hull.ship
    force = record["Y"][: one.window.count] / (0.5 * ship.rho * ship.L * ship.T * speed**2)
    assert len(design) < len(full) / 5
    np.testing.assert_allclose(design.T @ design, full.T @ full, rtol=1e-5, atol=1e-9)
    np.testing.assert_allclose(design.T @ response, full.T @ force, rtol=1e-3, atol=1e-6)
    # The noise that no term can follow is left out.
    assert float(response @ response) < float(force @ force)


def test_a_term_with_a_sign_keeps_it():
    v = np.linspace(0.1, 1.0, 20)
    columns = {Term.parse("Yv").factors: v}
    rows = TimeRows.condensed(columns, {"X": -0.02 * np.ones(20), "Y": 3.0 * v}, {"X": np.array([0.04])})
    assert rows.sd["X"].tolist() == [0.2, 0.2]
    design, response = rows.rows("X", parse_terms(["R0"]))
    assert np.linalg.lstsq(design, response, rcond=None)[0] == pytest.approx([0.02])
    design, response = rows.rows("Y", parse_terms(["Yv"]))
    assert np.linalg.lstsq(design, response, rcond=None)[0] == pytest.approx([3.0])
    assert float(rows.constant @ rows.constant) == pytest.approx(20.0)


def test_a_term_that_was_not_made_when_the_runs_were_read_is_named(campaign, hull):
    runs = reduced(campaign, hull)
    with pytest.raises(FitError, match=r"no column for Yvvvvv -> name the term in \[fit\] or its candidates"):
        force_rows(runs, parse_terms(["Yv", "Yvvvvv"]), "Y")


def test_noise_free_samples_give_the_truth(campaign, hull):
    found = fitted(reduced(campaign, hull), hull)
    assert max(abs(found[name] - hull[name]) for name in hull.names) < 1e-10


@pytest.mark.parametrize("covariance", ["model", "cluster"])
def test_the_two_domains_agree_within_their_errors(campaign, hull, covariance):
    """More harmonics carry nearly all that the samples carry: values and errors are alike."""
    noise = Noise(ar1=0.02, rho=0.9, seed=8)
    time = fitted(reduced(campaign, hull, noise), hull, covariance=covariance)
    harmonic = fit_hull(
        reduced(campaign, hull, noise, time_domain=False, harmonics=5),
        Fit(covariance=covariance),
        hull.ship,
        name="twin",
        terms=hull.terms,
    ).derivatives
    difference = np.array([time[name] - harmonic[name] for name in hull.names])
    error = np.array([harmonic.bse[name] for name in hull.names])
    assert np.abs(difference / error).max() < 4.0
    ratio = time.bse[list(hull.names)].to_numpy() / error
    assert 0.5 < np.exp(np.log(ratio).mean()) < 2.0


def test_standard_errors_are_those_of_the_scatter_over_campaigns(campaign, hull):
    found = [fitted(reduced(campaign, hull, Noise(ar1=0.02, rho=0.9, seed=seed)), hull) for seed in range(40)]
    names = ["R0", "Yv", "Yr", "Nv", "Nr", "Yvdot", "Nrdot"]
    scatter = np.std([[one[name] for name in names] for one in found], axis=0, ddof=1)
    said = np.sqrt(np.mean([[one.bse[name] ** 2 for name in names] for one in found], axis=0))
    assert 0.75 < np.exp(np.log(said / scatter).mean()) < 1.35


def test_a_shared_offset_moves_the_coefficients_as_predicted(campaign, hull):
    """A zero error of the balance, added to every sample, against the effect that the linear map predicts."""
    from towtank.pmm.shared_bias import bias_effects

    size = 0.5
    settings = Fit(domain="time", estimator="ols", shared_bias=SharedBias(offset={"Y": size}))
    clean = fit_hull(reduced(campaign, hull), settings, hull.ship, name="twin", terms=hull.terms)
    ((_, effect),) = bias_effects(clean.runs, clean.components, settings.shared_bias).values()
    plan = ReductionPlan(Reduction(skip_cycles=0), hull.ship, HOME, terms=hull.terms, time_domain=True)
    wrong = [
        reduce_run(record.with_channels("offset", Y=record["Y"] + size), run, plan)
        for run, record in campaign.records(SILENT)
    ]
    moved = fit_hull(wrong, settings, hull.ship, name="twin", terms=hull.terms).derivatives
    change = np.array([moved[name] - clean.derivatives[name] for name in moved.names])
    # Scaled with the mean speed of each run, which varies by a few per cent within a cycle.
    np.testing.assert_allclose(change, size * effect, atol=0.05 * np.abs(change).max())
    assert np.abs(change).max() > 1e-4


def test_diagnostics_count_the_runs(campaign, hull):
    table = fitted(reduced(campaign, hull, Noise(white=0.02)), hull).diagnostics["Y"]
    # Straight towing says nothing about Y.
    assert table["runs"] == len(MATRIX) - 1
    assert math.isfinite(table["condition number"])
    assert table["outlying runs"] == []
