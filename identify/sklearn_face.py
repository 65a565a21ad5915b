"""The estimators of this room as one scikit-learn regressor."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal

import numpy as np
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_is_fitted, validate_data

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .constrained import fit_constrained
from .regression import fit_linear
from .ridge import fit_ridge, fit_truncated_svd
from .robust import fit_huber

Kind = Literal["ols", "huber", "ridge", "tsvd", "constrained"]
INTERCEPT = "intercept"


class TermRegressor(RegressorMixin, BaseEstimator):
    """Linear regression on term columns.

    Parameters
    ----------
    estimator : {"ols", "huber", "ridge", "tsvd", "constrained"}
        Least squares; Huber's loss; ridge or truncated singular values with the strength chosen by
        left-out rows or runs; least squares under constraints.
    fit_intercept : bool
        Add a constant, which is never penalised.
    penalty : float, optional
        Fixed ridge penalty.
    kept : int, optional
        Fixed number of singular values.
    signs, bounds, equalities, prior : optional
        As :func:`.constrained.fit_constrained`; names are those of the columns (``x0, x1, ...`` for arrays).
    allow_singular : bool
        Accept exactly dependent columns (``ols`` only).

    Attributes
    ----------
    coef_ : ndarray, shape (n_features,)
        Coefficients.
    intercept_ : float
        Constant, 0 without one.
    result_ : CoefficientTable
        The fit with its covariance and diagnostics.
    n_features_in_ : int
    feature_names_in_ : ndarray
        Only when X has column names.
    """

    def __init__(
        self,
        estimator: Kind = "ols",
        *,
        fit_intercept: bool = True,
        penalty: float | None = None,
        kept: int | None = None,
        signs: Mapping[str, Literal["+", "-"]] | None = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        equalities: Sequence[tuple[Mapping[str, float], float]] = (),
        prior: Mapping[str, tuple[float, float]] | None = None,
        allow_singular: bool = False,
    ) -> None:
        self.estimator = estimator
        self.fit_intercept = fit_intercept
        self.penalty = penalty
        self.kept = kept
        self.signs = signs
        self.bounds = bounds
        self.equalities = equalities
        self.prior = prior
        self.allow_singular = allow_singular

    def fit(self, X: Any, y: Any, groups: Any = None) -> TermRegressor:
        """Fit to X (n, p) and y (n,); `groups` (n,) names the run of each row.

        Raises
        ------
        FitError
            As the chosen estimator.
        """
        X, y = validate_data(self, X, y, dtype=np.float64, y_numeric=True, ensure_min_samples=2)
        design, names = np.asarray(X), self._names()
        if self.fit_intercept:
            design = np.column_stack([design, np.ones(len(y))])
            names = (*names, INTERCEPT)
        self.result_ = self._estimate(design, np.asarray(y, dtype=float), names, groups)
        params = self.result_.params
        self.coef_ = params[: self.n_features_in_].copy()
        self.intercept_ = float(params[-1]) if self.fit_intercept else 0.0
        return self

    def predict(self, X: Any) -> np.ndarray:
        """Response for X (m, p), shape (m,)."""
        check_is_fitted(self)
        X = validate_data(self, X, dtype=np.float64, reset=False)
        return np.asarray(X) @ self.coef_ + self.intercept_

    def _names(self) -> tuple[str, ...]:
        named = getattr(self, "feature_names_in_", None)
        return tuple(f"x{j}" for j in range(self.n_features_in_)) if named is None else tuple(map(str, named))

    def _estimate(
        self, design: np.ndarray, y: np.ndarray, names: tuple[str, ...], groups: Any
    ) -> CoefficientTable:
        free = (INTERCEPT,) if self.fit_intercept else ()
        if self.estimator == "ols":
            kind: Literal["model", "cluster"] = "model" if groups is None else "cluster"
            return fit_linear(design, y, names, groups=groups, covariance=kind, allow_singular=self.allow_singular)
        if self.estimator == "huber":
            return fit_huber(design, y, names)
        if self.estimator == "ridge":
            return fit_ridge(design, y, names, penalty=self.penalty, free=free, groups=groups)
        if self.estimator == "tsvd":
            return fit_truncated_svd(design, y, names, kept=self.kept, free=free, groups=groups)
        if self.estimator == "constrained":
            return fit_constrained(
                design,
                y,
                names,
                signs=self.signs,
                bounds=self.bounds,
                equalities=self.equalities,
                prior=self.prior,
            )
        raise FitError(
            f"there is no estimator '{self.estimator}'", cure="use ols, huber, ridge, tsvd or constrained"
        )
