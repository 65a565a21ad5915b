"""The exponential with random height and decay."""

import numpy as np
import pytest

from towtank.reproduce.random_exponential import (
    GRID,
    INPUTS,
    error_levels,
    exact_mean_and_sd,
    random_exponential,
)
from towtank.verify import project_chaos, quadrature


def test_closed_forms_are_the_integrals():
    nodes, weights = quadrature(INPUTS, 20)
    values = random_exponential(nodes, GRID)
    mean, sd = exact_mean_and_sd(GRID)
    np.testing.assert_allclose(weights @ values, mean, rtol=1e-13)
    np.testing.assert_allclose(np.sqrt(weights @ (values - mean) ** 2), sd, rtol=1e-12)
    assert (mean[0], sd[0]) == pytest.approx((1.5, np.sqrt(1.0 / 12.0)))


def test_legendre_projection_of_order_two_has_the_mean_and_most_of_the_sd():
    fit = project_chaos(INPUTS, 2, lambda samples: random_exponential(samples, GRID), level=6)
    mean, sd = exact_mean_and_sd(GRID)
    np.testing.assert_allclose(fit.mean, mean, rtol=1e-12)
    assert np.max(np.abs(fit.sd / sd - 1.0)) < 2.5e-4


def test_errors_fall_with_the_samples_and_below_those_of_the_samples_themselves():
    few, many = error_levels(12, hypercubes=30), error_levels(72, hypercubes=30)
    assert many[0] < few[0] < 0.01
    assert many[1] < few[1] < 0.05
    assert many[1] < 0.2 * many[2]
