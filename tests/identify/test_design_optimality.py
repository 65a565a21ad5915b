from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.design_optimality import (
    augment_greedily,
    expected_covariance,
    expected_standard_errors,
    rank_candidates,
    repeats_for_target,
    run_information,
)
from towtank.identify.regression import fit_linear

ANGLES = np.array([0.02, 0.1, 0.2, 0.35])
CANDIDATES = np.array([run_information(np.array([[v, v**3]]), 0.01) for v in ANGLES])
BASE = 2.0 * CANDIDATES[1] + CANDIDATES[2]


def test_expected_errors_are_those_of_the_fit() -> None:
    rng = np.random.default_rng(0)
    design, sd = rng.standard_normal((30, 3)), rng.uniform(0.5, 2.0, 30)
    fit = fit_linear(design, rng.standard_normal(30), list("abc"), weights=1.0 / sd**2)
    information = sum(run_information(d, s) for d, s in zip(np.split(design, 5), np.split(sd, 5)))
    np.testing.assert_allclose(expected_covariance(information), fit.cov / fit.scale, rtol=1e-10)
    np.testing.assert_allclose(expected_standard_errors(information), fit.bse / np.sqrt(fit.scale), rtol=1e-10)
    np.testing.assert_allclose(
        expected_standard_errors(information, np.eye(3)) ** 2,
        expected_standard_errors(information) ** 2 + 1.0,
    )


@pytest.mark.parametrize("criterion", ["D", "A", "target"])
def test_scores_are_the_criteria_of_the_enlarged_programme(criterion: str) -> None:
    scales = np.array([0.3, 2.0])
    target = 1 if criterion == "target" else None
    name = "D" if criterion == "target" else criterion
    ranking = rank_candidates(BASE, CANDIDATES, name, target, scales=scales)
    covariances = [np.linalg.inv(BASE + c) for c in CANDIDATES]
    expected = {
        "D": [np.log(np.linalg.det(c)) for c in covariances],
        "A": [np.mean(np.diagonal(c) / scales**2) for c in covariances],
        "target": [c[1, 1] for c in covariances],
    }[criterion]
    difference = ranking.score - expected
    # D is compared up to the constant of the scaling.
    np.testing.assert_allclose(difference, difference[0] if criterion == "D" else 0.0, atol=1e-6)
    np.testing.assert_array_equal(ranking.order, np.argsort(expected))
    np.testing.assert_allclose(ranking.standard_errors, [np.sqrt(np.diagonal(c)) for c in covariances], rtol=1e-8)


def test_cubic_term_asks_for_the_largest_angle() -> None:
    assert rank_candidates(BASE, CANDIDATES, target=1).order[0] == 3
    direction = np.array([1.0, 3.0 * 0.2**2])
    score = rank_candidates(BASE, CANDIDATES, target=direction).score
    assert score[0] == pytest.approx(direction @ np.linalg.inv(BASE + CANDIDATES[0]) @ direction, rel=1e-9)


def test_singular_programme_is_completed_first() -> None:
    one = CANDIDATES[1]
    ranking = rank_candidates(one, CANDIDATES)
    assert ranking.order[-1] == 1
    assert np.all(np.isinf(ranking.standard_errors[1]))
    assert np.all(np.isfinite(ranking.standard_errors[3]))
    idle = np.diag([4.0, 0.0])
    assert np.isinf(rank_candidates(idle, idle[None]).standard_errors[0, 1])
    assert rank_candidates(idle, idle[None]).standard_errors[0, 0] == pytest.approx(1 / np.sqrt(8.0))


def test_greedy_programme_beats_the_even_one() -> None:
    chosen, information = augment_greedily(BASE, CANDIDATES, 6)
    assert len(chosen) == 6
    np.testing.assert_allclose(information, BASE + CANDIDATES[chosen].sum(axis=0))
    even = BASE + CANDIDATES.sum(axis=0) * 1.5
    assert np.linalg.det(information) > np.linalg.det(even)
    once, _ = augment_greedily(BASE, CANDIDATES, 4, repeats=False)
    assert sorted(once) == [0, 1, 2, 3]


def test_repeats_for_a_target_error() -> None:
    error = expected_standard_errors(BASE)[0]
    assert repeats_for_target(BASE, 0, error) == 1
    assert repeats_for_target(BASE, 0, 0.5 * error) == 4
    count = repeats_for_target(BASE, 0, 0.3 * error)
    assert expected_standard_errors(count * BASE)[0] <= 0.3 * error
    assert expected_standard_errors((count - 1) * BASE)[0] > 0.3 * error
    bias = np.diag([(0.4 * error) ** 2, 0.0])
    assert repeats_for_target(BASE, 0, 0.5 * error, bias=bias) == 12
    with pytest.raises(FitError, match="repeats do not help"):
        repeats_for_target(BASE, 0, 0.3 * error, bias=bias)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: run_information(np.ones((2, 2)), [1.0, 0.0]), "not positive"),
        (lambda: expected_covariance(CANDIDATES[0]), "cannot separate terms"),
        (lambda: expected_covariance(np.diag([1.0, 0.0])), "no run excites term.s. .1."),
        (lambda: rank_candidates(BASE, np.eye(2)), "do not fit"),
        (lambda: rank_candidates(BASE, CANDIDATES, "E"), "no criterion"),
        (lambda: augment_greedily(BASE, CANDIDATES, 5, repeats=False), "cannot be taken"),
        (lambda: repeats_for_target(BASE, 0, 0.0), "not positive"),
    ],
)
def test_impossible_requests_are_refused(call, message: str) -> None:
    with pytest.raises(FitError, match=message):
        call()
