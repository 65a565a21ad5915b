from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear
from towtank.identify.shared_bias import (
    bias_contributions,
    estimator_matrix,
    monte_carlo_bias,
    propagate_bias,
)

NAMES = ("Y0", "Yv")


def campaign(runs: int, seed: int = 0, weighted: bool = False):
    rng = np.random.default_rng(seed)
    v = np.linspace(-0.3, 0.3, runs)
    design = np.column_stack([np.ones(runs), v])
    weights = rng.uniform(0.5, 2.0, runs) if weighted else None
    response = design @ [0.01, -0.3] + 0.01 * rng.standard_normal(runs)
    return fit_linear(design, response, NAMES, weights=weights)


@pytest.mark.parametrize("weighted", [False, True])
def test_fit_and_matrix_agree_with_refitting(weighted: bool) -> None:
    fit = campaign(25, weighted=weighted)
    np.testing.assert_allclose(estimator_matrix(fit) @ fit.response, fit.params, rtol=1e-11)
    effects = np.column_stack([np.ones(25), fit.response])
    u = np.array([0.004, 0.02])
    moved = bias_contributions(fit, effects, u)
    for j in range(2):
        shifted = fit_linear(fit.design, fit.response + effects[:, j] * u[j], NAMES, weights=fit.weights)
        np.testing.assert_allclose(moved[:, j], shifted.params - fit.params, atol=1e-13)
    by_matrix = propagate_bias(estimator_matrix(fit), effects, u)
    np.testing.assert_allclose(propagate_bias(fit, effects, u), by_matrix, rtol=1e-10, atol=1e-18)


def test_shared_bias_is_not_averaged_away() -> None:
    # A zero offset and a calibration factor, the same in all runs.
    scatter, shared = [], []
    for runs in (10, 100, 1000, 10000):
        fit = campaign(runs)
        effects = np.column_stack([np.ones(runs), fit.fitted])
        scatter.append(fit.bse)
        shared.append(np.sqrt(np.diagonal(propagate_bias(fit, effects, [0.005, 0.01]))))
    assert scatter[-1][1] < 0.1 * scatter[0][1]
    np.testing.assert_allclose([s[0] for s in shared], 0.005, rtol=0.01)
    np.testing.assert_allclose([s[1] for s in shared], 0.01 * 0.3, rtol=0.1)


@pytest.mark.parametrize("distribution", ["normal", "uniform", "triangular"])
def test_monte_carlo_agrees_with_first_order(distribution) -> None:
    fit = campaign(40)
    effects = np.column_stack([np.ones(40), fit.design[:, 1]])
    u = np.array([0.004, 0.03])
    sample = monte_carlo_bias(fit, effects, u, n=20000, seed=1, distribution=distribution)
    expected = fit.cov + propagate_bias(fit, effects, u)
    np.testing.assert_allclose(sample.bse, np.sqrt(np.diagonal(expected)), rtol=0.02)
    np.testing.assert_allclose(sample.params.mean(axis=0), fit.params, atol=0.03 * sample.bse.max())
    if distribution == "normal":
        half = 1.96 * sample.bse
        np.testing.assert_allclose(sample.interval()[:, 1] - fit.params, half, rtol=0.05)


def test_errors_in_the_motion_are_drawn_by_refitting() -> None:
    fit = campaign(40)
    angle = fit.design[:, 1]

    def misaligned(error: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return np.column_stack([np.ones(40), angle + error[0]]), fit.response

    sample = monte_carlo_bias(fit, misaligned, [0.01], n=3000, seed=2)
    # An angle error d shifts the intercept by -Yv d and leaves the slope alone.
    expected = np.hypot(fit.bse[0], 0.01 * abs(fit["Yv"]))
    assert sample.bse[0] == pytest.approx(expected, rel=0.06)
    assert sample.bse[1] == pytest.approx(fit.bse[1], rel=0.06)


def test_bad_requests_are_refused() -> None:
    fit = campaign(20)
    with pytest.raises(FitError, match="effects of shape"):
        propagate_bias(fit, np.ones((19, 1)), [0.1])
    with pytest.raises(FitError, match="negative"):
        propagate_bias(fit, np.ones((20, 1)), [-0.1])
    with pytest.raises(FitError, match="no distribution"):
        monte_carlo_bias(fit, np.ones((20, 1)), [0.1], distribution="cauchy")
    with pytest.raises(FitError, match="cannot separate"):
        monte_carlo_bias(fit, lambda e: (np.ones((20, 2)), fit.response), [0.1], n=2)
