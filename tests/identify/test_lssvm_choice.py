from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_choice import choose_gamma_sigma

GAMMAS, SIGMAS = np.logspace(-1.0, 8.0, 10), np.geomspace(0.1, 50.0, 10)


def bowl(gamma: float, sigma: float):
    """Criterion with its only minimum at (gamma, sigma)."""

    def score(s: float, candidates: np.ndarray) -> np.ndarray:
        a, b = np.log10(candidates / gamma), math.log10(s / sigma)
        return np.sqrt(1.0 + a**2 + b**2 + 0.9 * a * b)

    return score


@pytest.mark.parametrize(("gamma", "sigma"), [(37.0, 2.2), (4.1e6, 0.31), (1e3, 8.0)])
def test_finds_the_minimum_between_the_points(gamma: float, sigma: float) -> None:
    choice = choose_gamma_sigma(bowl(gamma, sigma), GAMMAS, SIGMAS)
    assert choice.gamma == pytest.approx(gamma, rel=0.04)
    assert choice.sigma == pytest.approx(sigma, rel=0.04)
    assert choice.edges == ()
    assert choice.score == choice.tried["score"].min()
    assert 100 < len(choice.tried) < 400


def test_grid_alone_tries_every_pair_once() -> None:
    choice = choose_gamma_sigma(bowl(37.0, 2.2), GAMMAS, SIGMAS, refine=False)
    assert len(choice.tried) == 100
    assert not choice.tried.duplicated(["gamma", "sigma"]).any()
    best = choice.tried.loc[choice.tried["score"].idxmin()]
    assert (choice.gamma, choice.sigma) == (best["gamma"], best["sigma"])


def test_stays_within_the_range_and_tells_its_edges() -> None:
    choice = choose_gamma_sigma(bowl(1e12, 1e-3), GAMMAS, SIGMAS)
    assert (choice.gamma, choice.sigma, choice.edges) == (1e8, 0.1, ("gamma", "sigma"))
    fixed = choose_gamma_sigma(bowl(37.0, 2.2), [5.0], SIGMAS)
    assert (fixed.gamma, fixed.edges) == (5.0, ())


def test_of_equals_the_smoothest_is_taken() -> None:
    def flat(sigma: float, candidates: np.ndarray) -> np.ndarray:
        return 1.0 + 1e-9 * np.sin(1e3 * candidates * sigma)

    choice = choose_gamma_sigma(flat, GAMMAS, SIGMAS)
    assert (choice.gamma, choice.sigma) == (GAMMAS[0], SIGMAS[-1])


def test_what_cannot_be_judged_is_passed_over() -> None:
    def partly(sigma: float, candidates: np.ndarray) -> np.ndarray:
        return np.where(candidates > 100.0, math.inf, bowl(1e5, 2.2)(sigma, candidates))

    assert choose_gamma_sigma(partly, GAMMAS, SIGMAS).gamma == pytest.approx(100.0, rel=0.02)
    with pytest.raises(FitError, match="no gamma and sigma can be judged"):
        choose_gamma_sigma(lambda sigma, candidates: np.full(candidates.size, math.inf), GAMMAS, SIGMAS)


@pytest.mark.parametrize(
    ("gammas", "sigmas", "message"),
    [
        ([], SIGMAS, "gamma is not positive: none"),
        ([1.0, 0.0], SIGMAS, "gamma is not positive: 0"),
        ([math.nan], SIGMAS, "gamma is not positive: nan"),
        (GAMMAS, [], "a sigma is not positive"),
        (GAMMAS, [1.0, -2.0], "a sigma is not positive"),
    ],
)
def test_bad_candidates_are_named(gammas, sigmas, message: str) -> None:
    with pytest.raises(FitError, match=message):
        choose_gamma_sigma(bowl(1.0, 1.0), gammas, sigmas)
