"""Fit of one force: each estimator, its covariance, and the linear map from data to coefficients."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.terms import parse_terms
from towtank.pmm.campaign_file import Fit
from towtank.pmm.component_fit import default_stages, fit_component, staged_influence
from towtank.pmm.force_rows import ForceRows

TRUTH = {"Yv": -0.30, "Yvvv": -1.60, "Yr": -0.05, "Yvvr": -1.10}
NOISE = 2e-3


def rows_of(names, v, r, response, run=None, sd=NOISE) -> ForceRows:
    terms = parse_terms(names)
    design = np.column_stack([term.column({"v": v, "r": r}) for term in terms])
    run = np.arange(len(v)) if run is None else run
    return ForceRows("Y", terms, design, response, np.full(len(v), sd), run, np.zeros(len(v), dtype=int))


@pytest.fixture
def rows() -> ForceRows:
    """Drift, yaw, and yaw with drift: 26 runs of two rows each, with white noise."""
    random = np.random.default_rng(7)
    drift = np.sin(np.radians([-16, -12, -8, -4, 0, 4, 8, 12, 16, 2]))
    turn = np.array([0.1, 0.2, 0.3, 0.4])
    v = np.concatenate([drift, np.zeros(4), np.repeat([-0.2, -0.1, 0.1], 4)])
    r = np.concatenate([np.zeros(10), turn, np.tile(turn, 3)])
    v, r, run = np.repeat(v, 2), np.repeat(r, 2), np.repeat(np.arange(len(v)), 2)
    clean = rows_of(list(TRUTH), v, r, np.zeros(len(v)), run)
    response = clean.design @ list(TRUTH.values()) + NOISE * random.standard_normal(len(v))
    return replace(clean, response=response)


def dependent() -> ForceRows:
    """Two terms that the runs cannot separate: v and v|v| at one size of drift."""
    v = np.array([-0.2, 0.2] * 6)
    return rows_of(["Yv", "Yv|v|"], v, 0 * v, -0.4 * v + NOISE * np.random.default_rng(3).standard_normal(12))


ESTIMATORS = ["wls", "ols", "huber", "ridge", "tsvd", "lssvm", "constrained"]


@pytest.mark.parametrize("estimator", ESTIMATORS)
def test_every_estimator_finds_the_truth_and_its_own_linear_map(rows, estimator):
    fit = fit_component(rows, Fit(estimator=estimator))
    np.testing.assert_allclose(fit.influence @ rows.response, fit.params, rtol=1e-9, atol=1e-12)
    z = (fit.params - list(TRUTH.values())) / np.sqrt(np.diag(fit.cov))
    assert np.abs(z).max() < 4.0
    np.testing.assert_allclose(fit.residual, rows.response - rows.design @ fit.params)
    assert fit.dof == len(rows.response) - 4
    assert np.linalg.eigvalsh(fit.cov).min() > 0


@pytest.mark.parametrize("estimator", ["wls", "ridge", "tsvd", "constrained"])
def test_noise_free_data_give_the_coefficients_exactly(rows, estimator):
    clean = replace(rows, response=rows.design @ list(TRUTH.values()), sd=np.full(len(rows.run), 1e-13))
    fit = fit_component(clean, Fit(estimator=estimator))
    np.testing.assert_allclose(fit.params, list(TRUTH.values()), rtol=1e-8)


def test_covariance_of_least_squares_is_that_of_its_linear_map(rows):
    fit = fit_component(rows, Fit())
    np.testing.assert_allclose(fit.cov, (fit.influence * fit.row_sd**2) @ fit.influence.T, rtol=1e-10)
    assert fit.row_sd.mean() == pytest.approx(NOISE, rel=0.3)


def test_rows_count_by_their_noise(rows):
    """A noisy run hardly moves a weighted fit, and moves an unweighted one."""
    noisy = np.where(rows.run == 0, 0.5, NOISE)
    spoiled = replace(rows, response=rows.response + np.where(rows.run == 0, 0.3, 0.0), sd=noisy)
    weighted, plain = fit_component(spoiled, Fit()), fit_component(spoiled, Fit(estimator="ols"))
    assert abs(weighted.params[0] - TRUTH["Yv"]) < 0.02 < abs(plain.params[0] - TRUTH["Yv"])


def test_without_noise_estimates_rows_count_equally_and_it_says_so(rows):
    unknown = fit_component(replace(rows, sd=np.full(len(rows.run), np.nan)), Fit())
    np.testing.assert_allclose(unknown.params, fit_component(rows, Fit(estimator="ols")).params)
    assert "no noise estimate for some runs: all rows count equally" in unknown.notes
    assert unknown.scatter == 0.0


def test_scatter_between_runs_is_found_and_said(rows):
    offsets = 0.02 * np.random.default_rng(1).standard_normal(rows.run.max() + 1)
    fit = fit_component(replace(rows, response=rows.response + offsets[rows.run]), Fit())
    assert fit.scatter == pytest.approx(0.02, rel=0.35)
    assert any(note.startswith("scatter between runs") for note in fit.notes)


def test_huber_resists_outliers_that_bend_least_squares(rows):
    bad = rows.response.copy()
    bad[[1, 33]] += [0.4, -0.4]
    spoiled = replace(rows, response=bad)
    huber, plain = fit_component(spoiled, Fit(estimator="huber")), fit_component(spoiled, Fit())
    wrong = np.abs(huber.params - list(TRUTH.values())) < 0.2 * np.abs(plain.params - list(TRUTH.values()))
    assert wrong.sum() >= 3
    assert any("Huber" in note for note in huber.notes)
    # The map holds the weights that the estimator settled on: outlying rows count less.
    assert np.abs(huber.influence[:, [1, 33]]).max() < 0.3 * np.abs(plain.influence[:, [1, 33]]).max()


@pytest.mark.parametrize("estimator", ["ridge", "tsvd", "lssvm"])
def test_shrinking_estimators_fit_terms_that_the_data_cannot_separate(estimator):
    rows = dependent()
    fit = fit_component(rows, Fit(estimator=estimator))
    np.testing.assert_allclose(fit.params[0] + 0.2 * fit.params[1], -0.4, atol=0.01)
    np.testing.assert_allclose(fit.influence @ rows.response, fit.params, rtol=1e-8)
    assert any("do not hold the bias of shrinking" in note for note in fit.notes)


def test_least_squares_names_terms_that_it_cannot_separate():
    with pytest.raises(FitError, match=r"cannot separate these terms at all: Yv, Yv\|v\|") as caught:
        fit_component(dependent(), Fit())
    assert "fit.estimator = 'ridge'" in caught.value.cure


# -- constraints ---------------------------------------------------------------------------------------------


def moved(rows: ForceRows, settings: Fit, prior=None) -> None:
    """The linear map is the derivative of the coefficients by the data, while the same constraints bind."""
    fit = fit_component(rows, settings, prior=prior)
    step = 1e-7 * np.random.default_rng(2).standard_normal(len(rows.response))
    # The weight of a prior follows the scatter; hold it by moving the data within the fitted space only.
    step = rows.design @ np.linalg.lstsq(rows.design, step, rcond=None)[0]
    other = fit_component(replace(rows, response=rows.response + step), settings, prior=prior)
    np.testing.assert_allclose(other.params - fit.params, fit.influence @ step, atol=1e-12)


def test_a_bound_that_binds_is_met_and_named(rows):
    settings = Fit(estimator="constrained", bounds={"Yv": (None, -0.35), "Yr": (-1.0, None)})
    fit = fit_component(rows, settings)
    assert fit.params[0] == -0.35
    assert fit.cov[0, 0] == 0.0
    assert fit.extra["active"] == ("Yv <= -0.35",)
    assert "constraints that bind: Yv <= -0.35" in fit.notes
    assert fit.params[2] == pytest.approx(TRUTH["Yr"], abs=0.05)
    moved(rows, settings)


def test_a_bound_that_does_not_bind_changes_nothing(rows):
    free = fit_component(rows, Fit())
    fit = fit_component(rows, Fit(estimator="constrained", bounds={"Yv": (-1.0, 0.0)}))
    np.testing.assert_allclose(fit.params, free.params, rtol=1e-9)
    np.testing.assert_allclose(fit.cov, free.cov, rtol=1e-8)
    assert fit.extra["active"] == ()


def test_an_equality_is_obeyed(rows):
    settings = Fit(estimator="constrained", equalities=[{"terms": {"Yv": 1.0, "Yr": -6.0}, "value": 0.02}])
    fit = fit_component(rows, settings)
    assert fit.params[0] - 6.0 * fit.params[2] == pytest.approx(0.02, abs=1e-12)
    along = np.array([1.0, 0.0, -6.0, 0.0])
    assert along @ fit.cov @ along == pytest.approx(0.0, abs=1e-18)
    moved(rows, settings)


def test_an_equality_settles_terms_that_the_data_cannot_separate():
    settings = Fit(estimator="constrained", equalities=[{"terms": {"Yv|v|": 1.0}, "value": 0.0}])
    fit = fit_component(dependent(), settings)
    assert fit.params == pytest.approx([-0.4, 0.0], abs=0.01)


def test_constraints_of_another_force_do_not_touch_this_one(rows):
    free = fit_component(rows, Fit(estimator="constrained"))
    fit = fit_component(rows, Fit(estimator="constrained", bounds={"Nv": (0.0, 1.0)}))
    np.testing.assert_allclose(fit.params, free.params, rtol=1e-12)


def test_a_prior_draws_by_its_weight(rows):
    wish = {"Yv": -0.60, "Yvvv": -3.0}
    plain = fit_component(rows, Fit())
    loose = Fit(estimator="constrained", prior="clarke", prior_relative_sd=10.0)
    tight = Fit(estimator="constrained", prior="clarke", prior_relative_sd=1e-3)
    few = rows.only(rows.run < 10, [0, 1])
    np.testing.assert_allclose(fit_component(rows, loose, prior=wish).params, plain.params, rtol=1e-3)
    drawn = fit_component(few, tight, prior=wish)
    assert drawn.params[0] == pytest.approx(-0.60, abs=0.05)
    assert any(note.startswith("prior: clarke") for note in drawn.notes)
    assert np.diag(drawn.cov)[0] < np.diag(fit_component(few, Fit()).cov)[0]
    moved(few, tight, wish)


def test_a_prior_settles_terms_that_the_data_cannot_separate():
    settings = Fit(estimator="constrained", prior="clarke", prior_relative_sd=0.1)
    fit = fit_component(dependent(), settings, prior={"Yv": -0.35})
    assert fit.params[0] == pytest.approx(-0.35, abs=0.01)
    assert fit.params[0] + 0.2 * fit.params[1] == pytest.approx(-0.4, abs=0.01)


# -- coefficients that are held ------------------------------------------------------------------------------


@pytest.mark.parametrize("estimator", ESTIMATORS)
def test_held_coefficients_stay_and_the_rest_is_fitted(rows, estimator):
    fit = fit_component(rows, Fit(estimator=estimator, fixed={"Yvvv": -1.60, "Nv": 3.0}))
    assert fit.params[1] == -1.60
    assert not fit.cov[1].any()
    assert not fit.influence[1].any()
    free = [0, 2, 3]
    rest = rows.response + 1.60 * rows.design[:, 1]
    np.testing.assert_allclose(fit.influence[free] @ rest, fit.params[free], rtol=1e-9)
    assert "held fixed: Yvvv = -1.6" in fit.notes
    unheld = fit_component(rows, Fit(estimator=estimator))
    assert fit.cov[0, 0] < unheld.cov[0, 0]


def test_all_coefficients_may_be_held(rows):
    fit = fit_component(rows, Fit(fixed=TRUTH))
    assert dict(zip(rows.names, fit.params, strict=True)) == TRUTH
    assert not fit.cov.any()
    assert fit.row_sd[0] == pytest.approx(NOISE, rel=0.3)


def test_a_held_coefficient_needs_no_run_that_excites_it(rows):
    with_rate = rows_of([*TRUTH, "Yrrr"], rows.design[:, 0], 0.0 * rows.run, rows.response, rows.run)
    with pytest.raises(FitError, match="no run excites Yr, Yvvr, Yrrr"):
        fit_component(with_rate, Fit())
    fit = fit_component(with_rate, Fit(estimator="ols", fixed={"Yr": -0.05, "Yvvr": -1.1, "Yrrr": 0.0}))
    assert fit.params[2:].tolist() == [-0.05, -1.1, 0.0]


# -- covariance ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("covariance", ["cluster", "bootstrap"])
def test_covariances_over_runs_see_what_rows_of_a_run_share(rows, covariance):
    offsets = 0.02 * np.random.default_rng(5).standard_normal(rows.run.max() + 1)
    spoiled = replace(rows, response=rows.response + offsets[rows.run], sd=np.full(len(rows.run), np.nan))
    model = fit_component(spoiled, Fit())
    fit = fit_component(spoiled, Fit(covariance=covariance, replicates=400))
    np.testing.assert_allclose(fit.params, model.params)
    # Two rows of a run that err together count as one: the variance doubles.
    ratio = np.diag(fit.cov) / np.diag(model.cov)
    assert 1.2 < np.exp(np.log(ratio).mean()) < 3.5


def test_bootstrap_is_seeded(rows):
    first, again, other = (
        fit_component(rows, Fit(covariance="bootstrap", replicates=200, seed=seed)).cov for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(first, again)
    assert not np.array_equal(first, other)


# -- stages --------------------------------------------------------------------------------------------------


def test_stages_by_default_are_drift_yaw_and_coupling():
    terms = parse_terms(["Yv", "Yr", "Yvvr", "Yvvv", "Yvdot", "Yrdot", "Yvrr", "Y0"])
    assert default_stages(terms) == [["Yv", "Yvvv", "Yvdot", "Y0"], ["Yr", "Yrdot"], ["Yvvr", "Yvrr"]]
    assert default_stages(parse_terms(["Yr"])) == [["Yr"]]


def test_a_staged_fit_takes_each_coefficient_from_its_own_runs(rows):
    stages = default_stages(rows.terms)
    fit = fit_component(rows, Fit(staged=True), stages)
    np.testing.assert_allclose(fit.influence @ rows.response, fit.params, rtol=1e-10)
    only_drift = rows.only(rows.run < 10, [0, 1])
    np.testing.assert_allclose(fit.params[:2], fit_component(only_drift, Fit()).params, rtol=1e-8)
    # The drift terms do not hear what the other runs say.
    assert not fit.influence[:2, rows.run >= 10].any()
    # The coupling term carries the uncertainty of the drift terms along.
    assert fit.influence[3, rows.run < 10].any()
    whole = fit_component(rows, Fit())
    assert (np.diag(fit.cov) >= np.diag(whole.cov) * (1 - 1e-9)).all()


def test_stages_of_noise_free_data_find_the_truth(rows):
    clean = replace(rows, response=rows.design @ list(TRUTH.values()))
    fit = fit_component(clean, Fit(staged=True, estimator="ols"), default_stages(rows.terms))
    np.testing.assert_allclose(fit.params, list(TRUTH.values()), rtol=1e-10)


def test_a_stage_without_runs_of_its_own_is_refused(rows):
    coupled_only = rows.only(rows.run >= 14)
    with pytest.raises(FitError, match=r"stage 1 \(Yv Yvvv\) has 0 data"):
        fit_component(coupled_only, Fit(staged=True), default_stages(rows.terms))
    with pytest.raises(FitError, match="no stage fits Yvvr"):
        staged_influence(rows, np.ones(len(rows.response)), [["Yv", "Yvvv"], ["Yr"]])


# -- too little data -----------------------------------------------------------------------------------------


def test_fewer_data_than_terms_are_refused(rows):
    with pytest.raises(FitError, match="3 data for 4 terms of Y"):
        fit_component(rows.only(np.array([0, 22, 30])), Fit())


def test_as_many_data_as_terms_have_the_noise_within_the_runs_as_uncertainty(rows):
    exact = rows.only(np.array([0, 6, 22, 40]))
    fit = fit_component(exact, Fit())
    np.testing.assert_allclose(fit.residual, 0.0, atol=1e-12)
    inverse = np.linalg.inv(exact.design)
    np.testing.assert_allclose(fit.cov, NOISE**2 * inverse @ inverse.T, rtol=1e-6, atol=1e-12)
    np.testing.assert_allclose(fit.row_sd, NOISE)
    assert any("as many data as terms" in note for note in fit.notes)
    with pytest.raises(FitError, match="leave no residual"):
        fit_component(replace(exact, sd=np.full(4, math.nan)), Fit())
