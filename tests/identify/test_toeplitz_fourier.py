from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.toeplitz_fourier import FourierSmoother, fourier_cost, fourier_size

COUNT = 300
I = np.arange(COUNT)
Y = np.cos(0.1 * I) + 0.1 * np.random.default_rng(0).standard_normal(COUNT)
WEIGHTS = np.random.default_rng(1).uniform(0.3, 2.0, COUNT)


@pytest.mark.parametrize("width", [10.0, 40.0, 400.0])
def test_the_series_is_the_kernel(width: float) -> None:
    """Features times their transpose are the Gaussian, up to the constant mode that the bias takes."""
    smoother = FourierSmoother(COUNT, width)
    turn = np.outer(I - smoother.middle, smoother.angle)
    features = np.hstack([np.cos(turn), np.sin(turn)]) * smoother.root
    constant = math.sqrt(math.pi) * width / smoother.period
    kernel = np.exp(-(((I[:, None] - I) / width) ** 2))
    np.testing.assert_allclose(features @ features.T + constant, kernel, atol=5e-15)


@pytest.mark.parametrize("weights", [None, WEIGHTS], ids=["plain", "weighted"])
@pytest.mark.parametrize("width", [10.0, 60.0])
def test_small_systems_are_those_of_the_features(weights, width: float) -> None:
    smoother = FourierSmoother(COUNT, width, weights)
    v = np.ones(COUNT) if weights is None else weights
    turn = np.outer(I - smoother.middle, smoother.angle)
    features = np.hstack([np.cos(turn), np.sin(turn)])
    centred = (features - v @ features / v.sum()) * smoother.root
    gram = centred.T @ (v[:, None] * centred)
    fit = smoother.solve(Y, 20.0)
    inner = np.zeros_like(gram)
    for part, block in fit.blocks:
        inner[part, part] = block
    expected = np.linalg.inv(gram + np.eye(len(gram)) / 20.0) * np.outer(smoother.root, smoother.root)
    np.testing.assert_allclose(inner, expected, atol=1e-10)
    hat = (centred / smoother.root) @ inner @ (centred / smoother.root).T + 1.0 / v.sum()
    np.testing.assert_allclose(fit.open, 1.0 - v * np.diagonal(hat), atol=1e-11)
    np.testing.assert_allclose(fit.fitted, hat @ (v * Y), atol=1e-10)


@pytest.mark.parametrize("width", [20.0, 60.0])
def test_residuals_on_the_record_restore_what_normal_equations_lose(width: float) -> None:
    """At a condition number of 1e11, ten digits are those of a singular value decomposition of the features."""
    smooth = np.cos(0.1 * I)
    smoother = FourierSmoother(COUNT, width)
    turn = np.outer(I - smoother.middle, smoother.angle)
    features = np.hstack([np.cos(turn), np.sin(turn)]) * smoother.root
    left, singular, _ = np.linalg.svd(features - features.mean(axis=0), full_matrices=False)
    shrunk = singular**2 / (singular**2 + 1e-9) * (left.T @ (smooth - smooth.mean()))
    fit = smoother.solve(smooth, 1e9)
    np.testing.assert_allclose(fit.fitted, smooth.mean() + left @ shrunk, atol=1e-9)


def test_work_grows_with_the_narrowness_and_not_with_the_samples() -> None:
    assert fourier_cost(8000, 400.0) < 0.2 * fourier_cost(8000, 200.0)
    assert fourier_cost(200_000, 10_000.0) == pytest.approx(fourier_cost(20_000, 1000.0), rel=0.05)
    modes, period = fourier_size(8000, 100.0)
    assert period >= 8000 + 600
    assert modes < 200
    # A kernel of a few steps has as many modes as samples.
    assert math.isinf(fourier_cost(8000, 5.0))
    assert math.isinf(fourier_cost(2_000_000, 200.0))


def test_too_large_gamma_is_named() -> None:
    with pytest.raises(FitError, match="gamma 1e\\+300 leaves no ridge"):
        FourierSmoother(COUNT, 40.0).solve(Y, 1e300)
