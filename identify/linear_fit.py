"""Result of a linear least-squares fit: statistics, influence of rows and runs, prediction."""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .collinearity import ScaledSvd, inseparable_terms, variance_inflation
from .sandwich import FULL_LEVERAGE, GroupGeometry, group_geometry

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class LinearFit(CoefficientTable):
    """Least-squares fit; attributes are named as in statsmodels where it has them.

    Attributes
    ----------
    design : ndarray, shape (n, p)
    response : ndarray, shape (n,)
    weights : ndarray, shape (n,), or None
    groups : ndarray, shape (n,), or None
        Run of each row.
    covariance : str
        Kind of `cov`: ``model``, ``hac``, ``cluster`` or ``hc3``, with its detail in `covariance_note`.
    covariance_note : str
    scale : float
        s^2 = weighted residual sum of squares over `dof`; nan when nothing is left.
    dof : int
        Residual degrees of freedom, n minus rank.
    svd : ScaledSvd
        Singular values of the design with unit columns.
    flagged : tuple of str
        Terms whose split is arbitrary in a fit with ``allow_singular``; empty otherwise.
    q, back : ndarray, shapes (n, r) and (p, r)
        Orthonormal coordinates of the weighted design, and the map from them to coefficients.
    """

    design: np.ndarray
    response: np.ndarray
    weights: np.ndarray | None
    groups: np.ndarray | None
    covariance: str
    covariance_note: str
    scale: float
    dof: int
    svd: ScaledSvd
    flagged: tuple[str, ...]
    q: np.ndarray
    back: np.ndarray

    @property
    def n(self) -> int:
        """Number of rows."""
        return self.response.size

    @property
    def nobs(self) -> int:
        """Number of rows, under statsmodels' name."""
        return self.n

    @cached_property
    def fitted(self) -> np.ndarray:
        """Fitted response, shape (n,)."""
        return self.design @ self.params

    @cached_property
    def resid(self) -> np.ndarray:
        """Response minus fitted, shape (n,)."""
        return self.response - self.fitted

    @cached_property
    def weighted_resid(self) -> np.ndarray:
        """Residuals times the root of their weights, shape (n,)."""
        return self.resid if self.weights is None else self.resid * np.sqrt(self.weights)

    @cached_property
    def ssr(self) -> float:
        """Weighted sum of squared residuals."""
        return float(self.weighted_resid @ self.weighted_resid)

    @cached_property
    def has_intercept(self) -> bool:
        """True when a combination of the columns is constant."""
        ones = np.ones(self.n) if self.weights is None else np.sqrt(self.weights)
        left = ones - self.q @ (self.q.T @ ones)
        return bool(left @ left <= 1e-20 * (ones @ ones))

    @cached_property
    def r2(self) -> float:
        """Coefficient of determination, about the mean if there is an intercept, else about zero."""
        w = np.ones(self.n) if self.weights is None else self.weights
        centre = float(w @ self.response) / float(w.sum()) if self.has_intercept else 0.0
        total = float(w @ (self.response - centre) ** 2)
        return 1.0 - self.ssr / total if total > 0.0 else math.nan

    @property
    def r2_adj(self) -> float:
        """`r2` adjusted for the number of terms."""
        if self.dof <= 0:
            return math.nan
        return 1.0 - (self.n - int(self.has_intercept)) / self.dof * (1.0 - self.r2)

    @property
    def rank(self) -> int:
        """Number of independent columns."""
        return self.svd.rank

    @cached_property
    def loglik(self) -> float:
        """Gaussian log-likelihood at its maximum."""
        if self.ssr <= 0.0:
            return math.inf
        half = 0.5 * self.n
        weights = 0.0 if self.weights is None else 0.5 * float(np.log(self.weights).sum())
        return -half * (math.log(2.0 * math.pi * self.ssr / self.n) + 1.0) + weights

    @property
    def aic(self) -> float:
        """Akaike's criterion, counting the coefficients as statsmodels does."""
        return -2.0 * self.loglik + 2.0 * self.rank

    @property
    def bic(self) -> float:
        """Schwarz's criterion, counting the coefficients as statsmodels does."""
        return -2.0 * self.loglik + math.log(self.n) * self.rank

    @property
    def aicc(self) -> float:
        """Akaike's criterion for small samples; the residual variance counts as a parameter."""
        k = self.rank + 1
        if self.n - k - 1 <= 0:
            return math.inf
        return -2.0 * self.loglik + 2.0 * k * self.n / (self.n - k - 1.0)

    @cached_property
    def vif(self) -> np.ndarray:
        """Variance inflation factors, shape (p,); centred when a column is constant, inf where flagged."""
        w = np.ones(self.n) if self.weights is None else self.weights
        intercept = bool(np.any(np.ptp(self.design, axis=0) == 0.0))
        unit = np.einsum("ij,ij->i", self.back, self.back)
        squares, sums = w @ self.design**2, w @ self.design
        factors = variance_inflation(unit, squares, sums, float(w.sum()), intercept)
        return np.where(np.isin(self.names, self.flagged), math.inf, factors)

    @property
    def condition_number(self) -> float:
        """Condition number of the weighted design with columns scaled to unit length."""
        return self.svd.condition_number

    def inseparable(self) -> list[set[str]]:
        """Sets of terms that the data cannot separate (see :func:`.collinearity.inseparable_terms`)."""
        return inseparable_terms(self.svd, self.names)

    @cached_property
    def leverage(self) -> np.ndarray:
        """Diagonal of the hat matrix, shape (n,)."""
        return np.einsum("ij,ij->i", self.q, self.q)

    @cached_property
    def standardised_residuals(self) -> np.ndarray:
        """Internally studentised residuals, shape (n,)."""
        left = np.maximum(self.scale * (1.0 - self.leverage), 0.0)
        return np.divide(self.weighted_resid, np.sqrt(left), out=np.full(self.n, np.nan), where=left > 0.0)

    @cached_property
    def studentized_residuals(self) -> np.ndarray:
        """Residuals over the scatter of a fit without the row, shape (n,); t with dof - 1."""
        inner = self.standardised_residuals
        left = np.maximum(self.dof - inner**2, 0.0)
        return inner * np.sqrt(np.divide(self.dof - 1.0, left, out=np.full(self.n, np.inf), where=left > 0.0))

    @cached_property
    def cooks_distance(self) -> np.ndarray:
        """Cook's distance of each row, shape (n,)."""
        ratio = self.leverage / np.maximum(1.0 - self.leverage, 1e-300)
        return self.standardised_residuals**2 * ratio / max(self.rank, 1)

    @cached_property
    def geometry(self) -> GroupGeometry:
        """Leverage and scores of the groups.

        Raises
        ------
        FitError
            If the fit has no groups.
        """
        if self.groups is None:
            raise FitError("the fit does not know the run of each row", cure="give groups")
        return group_geometry(self.q, self.weighted_resid, self.groups)

    @cached_property
    def deleted_residuals(self) -> np.ndarray:
        """Weighted residual of each row by the fit without its group (without the row itself if there are none).

        Unchanged where the row or group alone determines a combination of terms; see `determined_alone`.
        """
        if self.groups is not None:
            return self.geometry.deleted_residuals(self.q, self.weighted_resid)
        open_ = np.where(self.leverage < FULL_LEVERAGE, 1.0 - self.leverage, 1.0)
        return self.weighted_resid / open_

    @cached_property
    def determined_alone(self) -> np.ndarray:
        """True for each group (or row) without which the terms cannot be separated."""
        if self.groups is not None:
            return np.asarray((self.geometry.leverage >= FULL_LEVERAGE).any(axis=1))
        return self.leverage >= FULL_LEVERAGE

    def influence(self) -> pd.DataFrame:
        """One row a group (or row): rows, leverage (trace), rms and rms deleted residual, Cook's distance."""
        import pandas as pd

        if self.groups is None:
            labels, sizes, leverage = np.arange(self.n), np.ones(self.n, dtype=int), self.leverage
            cook = self.cooks_distance
        else:
            geometry = self.geometry
            labels, sizes, leverage = geometry.labels, geometry.sizes, geometry.leverage.sum(axis=1)
            shift = geometry.adjusted_scores(-1.0)
            cook = np.einsum("gi,gi->g", shift, shift) / (max(self.rank, 1) * self.scale)
        columns = {
            "rows": sizes,
            "leverage": leverage,
            "rms": self.group_rms(self.weighted_resid),
            "deleted_rms": self.group_rms(self.deleted_residuals),
            "cooks_distance": cook,
        }
        return pd.DataFrame(columns, index=pd.Index(labels, name="group"))

    def group_rms(self, values: np.ndarray) -> np.ndarray:
        """Root mean square of row values (n,) within each group (or row), shape (g,)."""
        if self.groups is None:
            return np.abs(values)
        sizes = self.geometry.sizes
        return np.sqrt(np.bincount(self.geometry.codes, values**2, sizes.size) / sizes)

    def outlying(self, threshold: float = 3.5) -> list[Hashable]:
        """Rows, or groups, that the fit of the others does not explain.

        Without groups: positions of rows whose studentised residual exceeds `threshold`. With groups: labels
        whose rms deleted residual lies more than `threshold` robust deviations above the groups' median.
        """
        if self.groups is None:
            return [int(i) for i in np.flatnonzero(np.abs(self.studentized_residuals) > threshold)]
        size = self.group_rms(self.deleted_residuals)
        middle = float(np.median(size))
        spread = 1.4826 * float(np.median(np.abs(size - middle)))
        rounding = 1e-12 * float(np.sqrt(np.mean(self.response**2)))
        return list(self.geometry.labels[size > middle + threshold * spread + rounding])

    def predict(self, design: np.ndarray) -> np.ndarray:
        """Response for new rows (m, p), shape (m,)."""
        return np.asarray(design, dtype=float) @ self.params

    def predict_se(self, design: np.ndarray) -> np.ndarray:
        """Standard error of the fitted mean for new rows (m, p), shape (m,)."""
        rows = np.asarray(design, dtype=float)
        return np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", rows, self.cov, rows), 0.0))

    def to_frame(self) -> pd.DataFrame:
        """One row a coefficient: value, std, t, p, lower, upper, dof, vif."""
        return super().to_frame().assign(vif=self.vif)

    def summary(self) -> str:
        """The fit as a text table."""
        from .regression_summary import summary_text

        return summary_text(self)

    def as_statsmodels(self) -> Any:
        """The same fit as a statsmodels result; its cluster covariance is the simpler CR1."""
        from statsmodels.regression.linear_model import OLS, WLS

        if self.weights is None:
            model = OLS(self.response, self.design)
        else:
            model = WLS(self.response, self.design, weights=self.weights)
        model.data.xnames = list(self.names)
        if self.covariance == "model":
            return model.fit()
        if self.covariance == "hc3":
            return model.fit(cov_type="HC3", use_t=True)
        if self.covariance == "cluster":
            return model.fit(cov_type="cluster", cov_kwds={"groups": self.geometry.codes}, use_t=True)
        lags = int(self.covariance_note.split()[0])
        options: dict[str, Any] = {"maxlags": lags, "use_correction": True}
        if self.groups is None:
            return model.fit(cov_type="HAC", cov_kwds=options, use_t=True)
        options = {"maxlags": lags, "use_correction": "hac", "groups": self.geometry.codes}
        return model.fit(cov_type="hac-panel", cov_kwds=options, use_t=True)
