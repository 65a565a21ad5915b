"""Rows of the regression: which are kept, how their noise is pooled, the scatter between runs."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.terms import parse_terms
from towtank.pmm.force_rows import ForceRows, between_run_scatter, force_rows, moderated_variances
from towtank.pmm.run_types import Run


def drift_sway_yaw(length: float) -> list[Run]:
    return [
        Run("drift", "static_drift", speed=1.2, drift_angle=0.1),
        Run("sway", "pure_sway", speed=1.2, frequency=0.9, sway_amplitude=0.15),
        Run("yaw", "pure_yaw", speed=1.2, frequency=0.9, sway_amplitude=0.25),
    ]


def test_rows_are_the_runs_own_harmonics(reduced, hull) -> None:
    runs = reduced(hull, drift_sway_yaw(hull.ship.L))
    rows = force_rows(runs, hull.terms, "Y")
    assert rows.names == [name for name in hull.names if name.startswith("Y")]
    for row in range(len(rows.response)):
        run = runs[rows.run[row]]
        assert rows.response[row] == run.scaled["Y"][rows.harmonic[row]]
        np.testing.assert_array_equal(rows.design[row], run.design(rows.terms)[rows.harmonic[row]])
    values = np.array([hull[name] for name in rows.names])
    np.testing.assert_allclose(rows.design @ values, rows.response, atol=1e-14)


def test_rows_that_no_term_explains_are_left_out(reduced, hull) -> None:
    runs = reduced(hull, drift_sway_yaw(hull.ship.L))
    rows = force_rows(runs, hull.terms, "Y")
    sway = set(rows.harmonic[rows.run == 1].tolist())
    # mean and second harmonics of Y vanish for a symmetric hull
    assert sway == {1, 2, 5, 6}
    assert set(rows.harmonic[rows.run == 0].tolist()) == {0}
    surge = force_rows(runs, hull.terms, "X")
    assert {0, 3} <= set(surge.harmonic[surge.run == 1].tolist())
    assert not {1, 2} & set(surge.harmonic[surge.run == 1].tolist())


def test_terms_of_other_components_and_missing_channels(reduced, hull) -> None:
    runs = reduced(hull, drift_sway_yaw(hull.ship.L))
    without = replace(runs[0], scaled={"Y": runs[0].scaled["Y"]})
    rows = force_rows([without, *runs[1:]], hull.terms, "N")
    assert 0 not in rows.run
    assert all(name.startswith("N") for name in rows.names)
    empty = force_rows(runs, hull.terms, "K")
    assert empty.design.shape == (0, 0)


def test_rounding_of_the_kinematics_excites_nothing(reduced, hull) -> None:
    """The sway velocity of pure yaw is 1e-17, not zero, and carries no information about Yv."""
    runs = reduced(hull, [drift_sway_yaw(hull.ship.L)[2]])
    rows = force_rows(runs, parse_terms(["Yv", "Yr", "Yrdot", "Yvdot"]), "Y")
    assert rows.excited.tolist() == [False, True, True, False]


def test_selection_of_rows_and_columns(reduced, hull) -> None:
    rows = force_rows(reduced(hull, drift_sway_yaw(hull.ship.L)), hull.terms, "Y")
    part = rows.only(rows.run == 1, [2, 0])
    assert part.names == [rows.names[2], rows.names[0]]
    np.testing.assert_array_equal(part.design, rows.design[rows.run == 1][:, [2, 0]])
    assert set(part.run.tolist()) == {1}


def test_unknown_noise_of_one_run_makes_all_unknown(reduced, hull) -> None:
    runs = reduced(hull, drift_sway_yaw(hull.ship.L), noise=0.01)
    silent = replace(runs[0], scaled_sd={"Y": np.array([math.nan])}, scaled={"Y": runs[0].scaled["Y"]})
    assert np.isfinite(force_rows(runs, hull.terms, "Y").sd).all()
    assert np.isnan(force_rows([silent, *runs[1:]], hull.terms, "Y").sd).all()


def test_noise_of_equal_runs_is_pooled(reduced, hull) -> None:
    """Forty runs in the same noise get nearly the same standard error, where their own estimates scatter."""
    tests = [Run(f"{i}", "pure_sway", speed=1.2, frequency=0.9, sway_amplitude=0.1 + 0.002 * i) for i in range(40)]
    runs = reduced(hull, tests, noise=0.02, seed=6, cycles=2, samples=60)
    rows = force_rows(runs, hull.terms, "Y")
    own = np.array([run.scaled_sd["Y"][1] for run in runs])
    pooled = rows.sd[rows.harmonic == 1]
    assert pooled.std() / pooled.mean() < 0.6 * own.std() / own.mean()
    assert pooled.mean() == pytest.approx(np.sqrt(np.mean(own**2)), rel=0.1)


def test_moderation_is_nearer_to_the_truth() -> None:
    random = np.random.default_rng(0)
    prior, level, dof = 12.0, 2.0, 6.0
    truth = level * prior / random.chisquare(prior, 3000)
    measured = truth * random.chisquare(dof, 3000) / dof
    moderated = moderated_variances(measured, np.full(3000, dof))
    raw_error = np.mean((np.log(measured) - np.log(truth)) ** 2)
    assert np.mean((np.log(moderated) - np.log(truth)) ** 2) < 0.5 * raw_error
    # Smyth (2004), equation 11: (d0 s0^2 + d s^2)/(d0 + d) is a straight line of the measured variance
    slope, intercept = np.polyfit(measured, moderated, 1)
    assert slope == pytest.approx(dof / (prior + dof), rel=0.15)
    assert intercept / (1 - slope) == pytest.approx(level, rel=0.1)


def test_moderation_of_alike_variances_is_their_common_level() -> None:
    random = np.random.default_rng(1)
    measured = 3.0 * random.chisquare(40, 500) / 40
    moderated = moderated_variances(measured, np.full(500, 40.0))
    assert moderated.std() < 0.3 * measured.std()
    assert moderated.mean() == pytest.approx(3.0, rel=0.02)
    same = moderated_variances(np.full(5, 3.0), np.full(5, 1e6))
    np.testing.assert_allclose(same, 3.0, rtol=1e-5)


def test_few_or_exact_variances_stay() -> None:
    two = np.array([1.0, 5.0])
    np.testing.assert_array_equal(moderated_variances(two, np.full(2, 4.0)), two)
    known = np.array([1.0, 5.0, 2.0])
    np.testing.assert_array_equal(moderated_variances(known, np.array([4.0, 4.0, math.inf])), known)


def _rows(design: np.ndarray, response: np.ndarray, sd: float) -> ForceRows:
    n = len(response)
    index = np.arange(n)
    return ForceRows("Y", parse_terms(["Yv", "Yvvv"]), design, response, np.full(n, sd), index, 0 * index)


def test_scatter_between_runs_solves_paule_and_mandel() -> None:
    random = np.random.default_rng(4)
    v = np.linspace(-0.3, 0.3, 40)
    design = np.column_stack([v, v**3])
    rows = _rows(design, design @ [-0.3, -1.5] + 3e-3 * random.standard_normal(40), 1e-3)
    tau = between_run_scatter(rows)
    weight = 1 / np.hypot(rows.sd, tau)
    solution = np.linalg.lstsq(design * weight[:, None], rows.response * weight, rcond=None)[0]
    residual = (rows.response - design @ solution) * weight
    assert residual @ residual == pytest.approx(38, rel=1e-3)
    assert tau == pytest.approx(math.sqrt(9e-6 - 1e-6), rel=0.3)


def test_noise_that_explains_the_residuals_leaves_no_scatter() -> None:
    random = np.random.default_rng(5)
    v = np.linspace(-0.3, 0.3, 40)
    design = np.column_stack([v, v**3])
    response = design @ [-0.3, -1.5] + 1e-3 * random.standard_normal(40)
    assert between_run_scatter(_rows(design, response, 2e-3)) == 0.0
    assert between_run_scatter(_rows(design, response, math.nan)) == 0.0
    assert between_run_scatter(_rows(design[:2], response[:2], 1e-6)) == 0.0
