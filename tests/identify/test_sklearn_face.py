from __future__ import annotations

import numpy as np
import pandas as pd
import pytest
from sklearn.model_selection import GroupKFold, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures
from sklearn.utils.estimator_checks import parametrize_with_checks

from towtank.core.errors import FitError
from towtank.identify.regression import fit_linear
from towtank.identify.sklearn_face import TermRegressor

RNG = np.random.default_rng(0)
X = RNG.standard_normal((60, 3))
Y = X @ [1.0, -2.0, 0.5] + 3.0 + 0.1 * RNG.standard_normal(60)
KINDS = ("ols", "huber", "ridge", "tsvd", "constrained")


@parametrize_with_checks([TermRegressor(kind) for kind in KINDS])
def test_scikit_learn_contract(estimator, check) -> None:
    check(estimator)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("fit_intercept", [True, False])
def test_all_kinds_recover_a_clear_signal(kind, fit_intercept: bool) -> None:
    response = Y if fit_intercept else Y - 3.0
    model = TermRegressor(kind, fit_intercept=fit_intercept).fit(X, response)
    np.testing.assert_allclose(model.coef_, [1.0, -2.0, 0.5], atol=0.08)
    assert model.intercept_ == pytest.approx(3.0 if fit_intercept else 0.0, abs=0.08)
    assert model.score(X, response) > 0.99


def test_result_carries_the_diagnostics_and_column_names() -> None:
    frame = pd.DataFrame(X, columns=["v", "r", "vvr"])
    groups = np.repeat(np.arange(12), 5)
    model = TermRegressor().fit(frame, Y, groups=groups)
    expected = fit_linear(
        np.column_stack([X, np.ones(60)]),
        Y,
        ["v", "r", "vvr", "intercept"],
        groups=groups,
        covariance="cluster",
    )
    assert model.result_.names == expected.names
    np.testing.assert_allclose(model.result_.cov, expected.cov)


def test_constraints_reach_the_estimator() -> None:
    model = TermRegressor("constrained", signs={"x1": "+"}, bounds={"x0": (-1.0, 0.5)}).fit(X, Y)
    assert model.coef_[1] == 0.0
    assert model.coef_[0] == 0.5


def test_fixed_strength_reaches_the_estimator() -> None:
    assert TermRegressor("ridge", penalty=7.0).fit(X, Y).result_.penalty == 7.0
    assert TermRegressor("tsvd", kept=2).fit(X, Y).result_.kept == 2


def test_works_in_a_pipeline_and_in_cross_validation() -> None:
    v = RNG.uniform(-0.3, 0.3, (80, 1))
    response = -0.3 * v[:, 0] - 1.6 * v[:, 0] ** 3
    model = make_pipeline(PolynomialFeatures(3, include_bias=False), TermRegressor("ridge"))
    groups = np.repeat(np.arange(8), 10)
    scores = cross_val_score(model, v, response, groups=groups, cv=GroupKFold(4))
    assert scores.min() > 0.999


def test_unknown_kind_and_dependent_columns_are_refused() -> None:
    with pytest.raises(FitError, match="no estimator 'lasso'"):
        TermRegressor("lasso").fit(X, Y)
    doubled = np.column_stack([X, X[:, 0]])
    with pytest.raises(FitError, match="x0, x3"):
        TermRegressor().fit(doubled, Y)
    assert TermRegressor(allow_singular=True).fit(doubled, Y).score(doubled, Y) > 0.99
