from __future__ import annotations

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.collinearity import scaled_svd
from towtank.identify.regression_input import checked_regression, require_full_rank

X = np.arange(12.0).reshape(6, 2) ** 1.5
Y = np.arange(6.0)


def test_good_input_becomes_floats() -> None:
    x, y, w = checked_regression(X.astype(int), Y.astype(int), ["a", "b"], None)
    assert x.dtype == y.dtype == float
    assert w is None


@pytest.mark.parametrize(
    ("x", "y", "names", "weights", "message"),
    [
        (X, Y, ["a"], None, "does not fit 1 names"),
        (X, Y, ["a", "a"], None, "same name"),
        (X, Y[:5], ["a", "b"], None, "6 rows of terms"),
        (X[:0], Y[:0], ["a", "b"], None, "nothing to fit"),
        (np.where(np.arange(12).reshape(6, 2) == 5, np.nan, X), Y, ["a", "b"], None, "terms b hold"),
        (X, np.where(Y == 3, np.inf, Y), ["a", "b"], None, "the response hold"),
        (X, Y, ["a", "b"], np.ones(5), "5 weights"),
        (X, Y, ["a", "b"], np.array([1, 1, 0, 1, 1, 1.0]), "not positive"),
    ],
)
def test_bad_input_is_named(x, y, names, weights, message: str) -> None:
    with pytest.raises(FitError, match=message):
        checked_regression(x, y, names, weights)


def test_dependent_terms_are_refused_or_flagged() -> None:
    design = np.column_stack([X, X[:, 0] + X[:, 1]])
    svd, _ = scaled_svd(design, 6, ["Yv", "Yr", "Yd"])
    with pytest.raises(FitError, match="cannot separate these terms at all: Yv, Yr, Yd"):
        require_full_rank(svd, ["Yv", "Yr", "Yd"], allow_singular=False)
    assert require_full_rank(svd, ["Yv", "Yr", "Yd"], allow_singular=True) == ("Yv", "Yr", "Yd")
