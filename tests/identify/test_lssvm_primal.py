from __future__ import annotations

import numpy as np
import pytest

from towtank.identify.lssvm_dual import solve_dual
from towtank.identify.lssvm_kernels import GaussianKernel, PolynomialKernel
from towtank.identify.lssvm_primal import LinearFeatures, PrimalSystem, landmark_features

RNG = np.random.default_rng(0)
X = RNG.uniform(-1.0, 1.0, (60, 2))
Y = RNG.standard_normal(60)
W = RNG.uniform(0.5, 2.0, 60)


def test_features_times_their_transpose_are_the_nystroem_kernel() -> None:
    kernel = GaussianKernel(1.5)
    features, matrix = landmark_features(kernel, X, 15)
    cross = kernel.matrix(X, features.landmarks)
    expected = cross @ np.linalg.solve(kernel.matrix(features.landmarks, features.landmarks), cross.T)
    np.testing.assert_allclose(matrix @ matrix.T, expected, atol=1e-8)
    np.testing.assert_allclose(features.matrix(X), matrix, atol=1e-8)
    assert len({tuple(row) for row in features.landmarks}) == 15
    left_over = features.left_over(X, matrix)
    np.testing.assert_allclose(left_over, np.maximum(1.0 - np.diagonal(expected), 0.0), atol=1e-8)


def test_landmarks_stop_when_they_span_the_kernel() -> None:
    features, matrix = landmark_features(PolynomialKernel(2, 1.0), X, 60)
    # Polynomials of degree 2 in two variables have six coefficients.
    assert matrix.shape == (60, 6)
    np.testing.assert_allclose(matrix @ matrix.T, PolynomialKernel(2, 1.0).matrix(X, X), atol=1e-9)
    assert features.landmarks.shape == (6, 2)


@pytest.mark.parametrize("gamma", [0.1, 100.0])
def test_posterior_and_scatter(gamma: float) -> None:
    fit = PrimalSystem(LinearFeatures(2), X, W).solve(Y, gamma)
    centred = X - W @ X / W.sum()
    gram = centred.T @ (W[:, None] * centred)
    inverse = np.linalg.inv(gram + np.eye(2) / gamma)
    np.testing.assert_allclose(fit.posterior, inverse, rtol=1e-10)
    np.testing.assert_allclose(fit.scatter, inverse @ gram @ inverse, rtol=1e-10)
    np.testing.assert_allclose(fit.function.gradient(X[:3]), np.tile(fit.coef, (3, 1)))
    assert np.all(fit.function.hessian(X[:3]) == 0.0)


def test_more_features_than_samples_leave_the_prior_where_nothing_was_seen() -> None:
    wide = RNG.standard_normal((5, 9))
    fit = PrimalSystem(LinearFeatures(9), wide, np.ones(5)).solve(Y[:5], 4.0)
    dense = solve_dual(PolynomialKernel(1, 0.0), wide, Y[:5], np.ones(5), 4.0)
    at = RNG.standard_normal((6, 9))
    np.testing.assert_allclose(fit.function.value(at), dense.function.value(at), rtol=1e-9)
    np.testing.assert_allclose(fit.unit_variance(at), dense.unit_variance(at), rtol=1e-9)
    np.testing.assert_allclose(fit.open, dense.open, atol=1e-11)
