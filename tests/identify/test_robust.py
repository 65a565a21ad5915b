from __future__ import annotations

import numpy as np
import pytest
import statsmodels.api as sm

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear
from towtank.identify.robust import fit_huber

RNG = np.random.default_rng(0)
V = RNG.uniform(-0.3, 0.3, 80)
X = np.column_stack([np.ones(80), V, 1e3 * V**3])
TRUTH = np.array([0.02, -0.315, -1.6e-3])
Y = X @ TRUTH + 0.005 * RNG.standard_normal(80)
NAMES = ("Y0", "Yv", "Yvvv")


@pytest.mark.parametrize("weights", [None, RNG.uniform(0.5, 2.0, 80)], ids=["plain", "weighted"])
def test_agrees_with_statsmodels(weights) -> None:
    fit = fit_huber(X, Y, NAMES, weights=weights)
    root = np.ones(80) if weights is None else np.sqrt(weights)
    expected = sm.RLM(Y * root, X * root[:, None], M=sm.robust.norms.HuberT()).fit(tol=1e-12, maxiter=200)
    np.testing.assert_allclose(fit.params, expected.params, rtol=1e-6)
    np.testing.assert_allclose(fit.cov, expected.cov_params(), rtol=1e-5)
    assert fit.scale == pytest.approx(expected.scale, rel=1e-6)


def test_bad_rows_do_not_bend_the_fit() -> None:
    spoiled = Y.copy()
    spoiled[[3, 40, 77]] += [0.5, -0.8, 0.6]
    fit = fit_huber(X, spoiled, NAMES)
    clean = fit_linear(X, Y, NAMES)
    assert np.all(np.abs(fit.params - clean.params) < 2.0 * clean.bse)
    assert np.any(np.abs(fit_linear(X, spoiled, NAMES).params - clean.params) > 2.0 * clean.bse)
    assert fit.outlying(0.2) == [3, 40, 77]


def test_noise_free_rows_give_the_exact_coefficients() -> None:
    fit = fit_huber(X, X @ TRUTH, NAMES)
    np.testing.assert_allclose(fit.params, TRUTH, rtol=1e-12)
    assert fit.outlying() == []


def test_failures_are_told() -> None:
    with pytest.raises(FitError, match="did not settle"):
        fit_huber(X, Y, NAMES, max_iterations=1)
    with pytest.raises(FitError, match="leave no scatter"):
        fit_huber(X[:3], Y[:3], NAMES)
