from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.lssvm_dual import dual_spectrum
from towtank.identify.lssvm_kernels import GaussianKernel, PolynomialKernel
from towtank.identify.lssvm_primal import LinearFeatures, PrimalSystem
from towtank.identify.lssvm_spectrum import groups_of_several

RNG = np.random.default_rng(0)
X = RNG.uniform(-1.0, 1.0, (40, 2))
Y = X[:, 0] ** 2 + 0.1 * RNG.standard_normal(40)
W = RNG.uniform(0.5, 2.0, 40)
GAMMAS = np.array([1e-3, 1.0, 1e3, 1e6])


def hat_matrix(kernel, gamma: float) -> np.ndarray:
    """From the dual: fitted = hat @ y."""
    h = np.linalg.inv(kernel.matrix(X, X) + np.diag(1.0 / (gamma * W)))
    u = h.sum(axis=1)
    return np.eye(40) - (h - np.outer(u, u) / u.sum()) / (gamma * W)[:, None]


@pytest.mark.parametrize("criterion", ["loo", "gcv"])
def test_scores_follow_the_hat_matrix(criterion) -> None:
    scores = dual_spectrum(GaussianKernel(1.0), X, W).scores(Y * np.sqrt(W), GAMMAS, criterion)
    for gamma, score in zip(GAMMAS[:3], scores):
        hat = hat_matrix(GaussianKernel(1.0), gamma)
        open_ = 1.0 - (np.diagonal(hat) if criterion == "loo" else np.trace(hat) / 40)
        assert score == pytest.approx(np.sqrt(np.average(((Y - hat @ Y) / open_) ** 2, weights=W)), rel=1e-8)


def test_runs_are_left_out_whole() -> None:
    runs = np.repeat(np.arange(8), 5)
    members = groups_of_several(runs, 40)
    score = dual_spectrum(GaussianKernel(1.0), X, W).scores(Y * np.sqrt(W), GAMMAS[:3], "loo", members)
    for gamma, found in zip(GAMMAS, score):
        hat = hat_matrix(GaussianKernel(1.0), gamma)
        missed = Y - hat @ Y
        for rows in members:
            missed[rows] = np.linalg.solve(np.eye(5) - hat[np.ix_(rows, rows)], missed[rows])
        assert found == pytest.approx(np.sqrt(np.average(missed**2, weights=W)), rel=1e-8)


@pytest.mark.parametrize("criterion", ["loo", "gcv"])
def test_features_and_kernel_matrix_agree(criterion) -> None:
    members = groups_of_several(np.arange(40) // 3, 40) if criterion == "loo" else []
    dual = dual_spectrum(PolynomialKernel(1, 0.0), X, W).scores(Y * np.sqrt(W), GAMMAS, criterion, members)
    system = PrimalSystem(LinearFeatures(2), X, W)
    primal = system.spectrum.scores(Y * np.sqrt(W), GAMMAS, criterion, members)
    np.testing.assert_allclose(dual, primal, rtol=1e-9)
    assert dual_spectrum(PolynomialKernel(1, 0.0), X, W).complete
    assert not system.spectrum.complete


def test_left_out_errors_of_an_interpolation_stay_exact() -> None:
    """Where 1 - leverage is 1e-9, the error has a limit that refits show."""
    scores = dual_spectrum(GaussianKernel(0.02), X, np.ones(40)).scores(Y, np.array([1e7, 1e8]), "loo")
    assert scores[0] == pytest.approx(scores[1], rel=1e-5)
    h = np.linalg.inv(GaussianKernel(0.02).matrix(X, X))
    u = h.sum(axis=1)
    missed = (h @ Y - u * (u @ Y) / u.sum()) / (np.diagonal(h) - u**2 / u.sum())
    assert scores[1] == pytest.approx(np.sqrt(np.mean(missed**2)), rel=1e-5)


def test_rows_that_determine_their_own_fit_cannot_be_judged() -> None:
    alone = np.vstack([np.zeros((6, 2)), [[1.0, 0.0]], [[0.0, 1.0]]])
    system = PrimalSystem(LinearFeatures(2), alone, np.ones(8))
    assert math.isinf(system.spectrum.scores(np.arange(8.0), np.array([1e14]), "loo")[0])
    far = PrimalSystem(LinearFeatures(2), alone[[0, 6, 7]], np.ones(3))
    assert math.isinf(far.spectrum.scores(np.arange(3.0), np.array([1e14]), "gcv")[0])
    runs = groups_of_several(np.array([0, 0, 0, 0, 1, 1, 2, 2]), 8)
    assert math.isinf(system.spectrum.scores(np.arange(8.0), np.array([1e14]), "loo", runs)[0])


def test_groups() -> None:
    members = groups_of_several(["b", "a", "b", "c", "a"], 5)
    assert [rows.tolist() for rows in members] == [[1, 4], [0, 2]]
    with pytest.raises(FitError, match="2 group labels for 3 rows"):
        groups_of_several([0, 1], 3)
    with pytest.raises(FitError, match="at least two"):
        groups_of_several([7, 7, 7], 3)
