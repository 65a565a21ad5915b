"""Linear least squares of forces on term columns, with honest covariance and diagnostics.

The weighted design is factorised once (QR, then the singular values of R with columns scaled to unit length);
coefficients, covariances, leverages and collinearity all come from that factorisation.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .collinearity import ScaledSvd, inseparable_terms, scaled_svd, variance_inflation
from .normal_equations import NormalEquations, StackedFit, fit_stacked
from .regression_input import checked_regression, require_full_rank
from .sandwich import GroupGeometry, cluster_covariance, group_geometry, hac_covariance, hc3_covariance

if TYPE_CHECKING:
    import pandas as pd

__all__ = ["LinearFit", "NormalEquations", "StackedFit", "fit_linear", "fit_stacked"]

Covariance = Literal["model", "hac", "cluster", "hc3"]


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
        """Leverage of the groups; each row is a group of its own when none were given."""
        groups = np.arange(self.n) if self.groups is None else self.groups
        return group_geometry(self.q, self.weighted_resid, groups)

    @cached_property
    def deleted_residuals(self) -> np.ndarray:
        """Weighted residual of each row by the fit without the row's group, shape (n,)."""
        return self.geometry.deleted_residuals(self.q, self.weighted_resid)

    def influence(self) -> pd.DataFrame:
        """One row a group: rows, leverage (trace), rms residual, rms deleted residual, Cook's distance."""
        import pandas as pd

        geometry = self.geometry
        count = geometry.sizes.size

        def rms(values: np.ndarray) -> np.ndarray:
            return np.sqrt(np.bincount(geometry.codes, values**2, count) / geometry.sizes)

        shift = geometry.adjusted_scores(-1.0)
        cook = np.einsum("gi,gi->g", shift, shift) / (max(self.rank, 1) * self.scale)
        columns = {
            "rows": geometry.sizes,
            "leverage": geometry.leverage.sum(axis=1),
            "rms": rms(self.weighted_resid),
            "deleted_rms": rms(self.deleted_residuals),
            "cooks_distance": cook,
        }
        return pd.DataFrame(columns, index=pd.Index(geometry.labels, name="group"))

    def outlying(self, threshold: float = 3.5) -> list[Hashable]:
        """Rows, or groups, that the fit of the others does not explain.

        Without groups: positions of rows whose studentised residual exceeds `threshold`. With groups: labels
        whose rms deleted residual lies more than `threshold` robust deviations above the groups' median.
        """
        if self.groups is None:
            return [int(i) for i in np.flatnonzero(np.abs(self.studentized_residuals) > threshold)]
        geometry = self.geometry
        totals = np.bincount(geometry.codes, self.deleted_residuals**2, geometry.sizes.size)
        size = np.sqrt(totals / geometry.sizes)
        middle = float(np.median(size))
        spread = 1.4826 * float(np.median(np.abs(size - middle)))
        rounding = 1e-12 * float(np.sqrt(np.mean(self.response**2)))
        return list(geometry.labels[size > middle + threshold * spread + rounding])

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


def fit_linear(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    covariance: Covariance = "model",
    hac_lags: int | None = None,
    cluster_correction: Literal["cr1", "cr2", "cr3"] = "cr2",
    confidence: float = 0.95,
    allow_singular: bool = False,
) -> LinearFit:
    """Fit response = design @ params by (weighted) least squares.

    Parameters
    ----------
    design : ndarray, shape (n, p)
        One column a term. There is no hidden intercept: give a column of ones where one is wanted.
    response : ndarray, shape (n,)
        Measured force or moment.
    names : sequence of p str
        Names of the columns.
    weights : ndarray, shape (n,), optional
        Inverse variances up to a factor.
    groups : sequence of n labels, optional
        Run of each row; needed by ``cluster``, respected by ``hac`` and by :meth:`LinearFit.outlying`.
    covariance : {"model", "hac", "cluster", "hc3"}
        Independent alike errors; errors correlated along time (Newey-West); errors correlated within runs;
        independent errors of unequal size.
    hac_lags : int, optional
        Lags of ``hac``; by Andrews' rule when omitted.
    cluster_correction : {"cr2", "cr3", "cr1"}
        Small-sample correction of ``cluster`` (see :func:`.sandwich.cluster_covariance`).
    confidence : float
        Level of the intervals in tables.
    allow_singular : bool
        Return the minimum-norm solution when terms are exactly dependent, and flag them.

    Returns
    -------
    LinearFit

    Raises
    ------
    FitError
        If shapes disagree, a value is not finite, a weight is not positive, a column is zero, or terms are
        exactly dependent (named in the message) and `allow_singular` is false.
    """
    x, y, w = checked_regression(design, response, names, weights)
    labels = None if groups is None else np.asarray(groups)
    if labels is not None and labels.shape != y.shape:
        raise FitError(f"{labels.size} group labels for {y.size} rows", cure="give one label a row")
    if covariance not in get_args(Covariance):
        raise FitError(
            f"there is no covariance '{covariance}'", cure=f"use one of {', '.join(get_args(Covariance))}"
        )
    root = None if w is None else np.sqrt(w)
    rows = x if root is None else x * root[:, None]
    target = y if root is None else y * root
    q, triangle = np.linalg.qr(np.asfortranarray(rows))
    svd, left = scaled_svd(triangle, y.size, names)
    flagged = require_full_rank(svd, names, allow_singular=allow_singular)
    r = svd.rank
    q = q @ left[:, :r]
    back = svd.right[:, :r] / svd.singular[:r] / svd.scale[:, None]
    if flagged:
        null = svd.null_directions()
        back = back - null @ (null.T @ back)
    params = back @ (q.T @ target)
    residual = y - x @ params
    if root is not None:
        residual = residual * root
    dof = y.size - r
    scale = float(residual @ residual) / dof if dof > 0 else math.nan

    t_dof = np.full(x.shape[1], float(dof) if dof > 0 else math.nan)
    note = ""
    if covariance == "model":
        cov = scale * (back @ back.T)
    elif covariance == "hc3":
        cov = hc3_covariance(q, residual, back)
    elif covariance == "hac":
        cov, lags = hac_covariance(q, residual, back, hac_lags, labels)
        note = f"{lags} lags"
    else:
        if labels is None:
            raise FitError("clustered errors need the run of each row", cure="give groups")
        geometry = group_geometry(q, residual, labels)
        cov, t_dof = cluster_covariance(geometry, back, scale, dof, cluster_correction)
        note = f"{geometry.labels.size} groups, {cluster_correction.upper()}"
    return LinearFit(
        names=tuple(names),
        params=params,
        cov=cov,
        t_dof=t_dof,
        confidence=confidence,
        design=x,
        response=y,
        weights=w,
        groups=labels,
        covariance=covariance,
        covariance_note=note,
        scale=scale,
        dof=dof,
        svd=svd,
        flagged=flagged,
        q=q,
        back=back,
    )
