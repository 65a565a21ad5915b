"""Ridge and truncated singular values: coefficients for data that cannot separate all terms.

The penalty, or the number of singular values, is chosen by the exact prediction error of left-out rows or
runs, in closed form from one factorisation. Ridge with an unpenalised intercept and unscaled columns is the
linear-kernel LS-SVM with gamma = 1/penalty (Suykens et al. 2002).
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .regression_input import checked_regression
from .sandwich import FULL_LEVERAGE

if TYPE_CHECKING:
    import pandas as pd

# Penalties tried, relative to the number of rows (columns have unit mean square): six a decade.
RELATIVE_PENALTIES = np.logspace(-10.0, 2.0, 73)


@dataclass(frozen=True, eq=False)
class RidgeFit(CoefficientTable):
    """Regularised fit; its covariance shows scatter only, not the pull towards zero.

    Attributes
    ----------
    penalty : float
        Ridge penalty on the (scaled) columns; 0 for truncated singular values.
    kept : int
        Singular values kept; all of them for ridge.
    effective_dof : float
        Trace of the hat matrix, free columns included.
    scale : float
        Residual variance, sum of squares over n - effective_dof.
    loo_rmse : float
        Root mean square (weighted) prediction error of left-out rows or runs.
    curve : DataFrame
        Columns ``penalty`` or ``kept``, ``loo_rmse``, ``effective_dof`` of all that were tried.
    resid : ndarray, shape (n,)
        Response minus fitted.
    """

    penalty: float
    kept: int
    effective_dof: float
    scale: float
    loo_rmse: float
    curve: pd.DataFrame
    resid: np.ndarray


def fit_ridge(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    penalty: float | None = None,
    penalties: Sequence[float] | None = None,
    free: Sequence[str] = (),
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    standardise: bool = True,
    confidence: float = 0.95,
) -> RidgeFit:
    """Minimise |y - X b|^2 + penalty |b|^2 over the penalised columns.

    Parameters
    ----------
    design, response, names, weights :
        As :func:`.regression.fit_linear`.
    penalty : float, optional
        Fixed penalty; chosen among `penalties` by left-out error when omitted.
    penalties : sequence of float, optional
        Candidates; 73 from 1e-10 to 1e2 times the number of rows when omitted.
    free : sequence of str
        Columns that are not penalised, for example the intercept.
    groups : sequence of n labels, optional
        Leave out whole runs; single rows when omitted.
    standardise : bool
        Penalise columns scaled to unit mean square (after the free columns are projected out).
    confidence : float
        Level of the intervals in tables.

    Raises
    ------
    FitError
        As :func:`.regression.fit_linear`; if a penalty is negative; if no candidate can be judged.
    """
    split = _Split(design, response, names, free, weights, groups, standardise)
    if penalty is not None:
        tried = np.array([float(penalty)])
    elif penalties is not None:
        tried = np.asarray(penalties, dtype=float)
    else:
        tried = RELATIVE_PENALTIES * split.y.size * (1.0 if standardise else split.mean_square)
    if tried.size == 0 or not (tried >= 0.0).all():
        raise FitError("a ridge penalty is negative or missing", cure="use penalties of 0 or more")
    square = split.singular**2
    floor = split.rounding**2
    shrink = square / np.maximum(square + tried[:, None], floor)
    inverse = split.singular / np.maximum(square + tried[:, None], floor)
    return split.choose("penalty", tried, shrink, inverse, confidence)


def fit_truncated_svd(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    kept: int | None = None,
    free: Sequence[str] = (),
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    standardise: bool = True,
    confidence: float = 0.95,
) -> RidgeFit:
    """Least squares in the space of the largest singular values.

    Parameters
    ----------
    design, response, names, weights, free, groups, standardise, confidence :
        As :func:`fit_ridge`.
    kept : int, optional
        Singular values kept; chosen by left-out error, with the singular vectors held, when omitted.

    Raises
    ------
    FitError
        As :func:`fit_ridge`; if `kept` is not between 1 and the number of independent columns.
    """
    split = _Split(design, response, names, free, weights, groups, standardise)
    usable = int(np.count_nonzero(split.singular > split.rounding))
    if kept is not None and not 1 <= kept <= usable:
        raise FitError(f"{kept} singular values of {usable} cannot be kept", cure=f"use 1 to {usable}")
    tried = np.arange(1, usable + 1) if kept is None else np.array([kept])
    shrink = (np.arange(split.singular.size) < tried[:, None]).astype(float)
    inverse = shrink / np.maximum(split.singular, split.rounding)
    return split.choose("kept", tried, shrink, inverse, confidence)


class _Split:
    """Penalised and free columns taken apart, and the penalised ones decomposed."""

    def __init__(
        self,
        design: np.ndarray,
        response: np.ndarray,
        names: Sequence[str],
        free: Sequence[str],
        weights: np.ndarray | None,
        groups: np.ndarray | Sequence[Hashable] | None,
        standardise: bool,
    ) -> None:
        self.design, self.response, w = checked_regression(design, response, names, weights)
        unknown = [name for name in free if name not in names]
        if unknown:
            raise FitError(f"there is no column '{unknown[0]}' to leave free", cure=f"use {', '.join(names)}")
        self.names = tuple(names)
        self.is_free = np.array([name in free for name in names])
        if self.is_free.all():
            raise FitError("all columns are free: there is nothing to penalise", cure="use fit_linear")
        root = np.ones(self.response.size) if w is None else np.sqrt(w)
        rows = self.design * root[:, None]
        self.y = self.response * root
        self.free_q, self.free_r = np.linalg.qr(rows[:, self.is_free])
        if self.is_free.any() and np.linalg.cond(self.free_r) > 1e12:
            raise FitError("the free columns are dependent", cure="leave fewer columns free")
        self.overlap = self.free_q.T @ rows[:, ~self.is_free]
        apart = rows[:, ~self.is_free] - self.free_q @ self.overlap
        size = np.sqrt(np.mean(apart**2, axis=0))
        self.mean_square = float(np.mean(size**2))
        self.scale = np.where(size > 0.0, size, 1.0) if standardise else np.ones(size.size)
        self.left, self.singular, right = np.linalg.svd(apart / self.scale, full_matrices=False)
        self.right = right.T
        self.rounding = max(float(self.singular[0]) * max(rows.shape) * np.finfo(float).eps, 1e-300)
        self.rest = self.y - self.free_q @ (self.free_q.T @ self.y)
        self.along = self.left.T @ self.rest
        self.codes: np.ndarray | None = None
        if groups is not None:
            labels = np.asarray(groups)
            if labels.shape != self.y.shape:
                raise FitError(f"{labels.size} group labels for {self.y.size} rows", cure="give one a row")
            self.codes = np.unique(labels, return_inverse=True)[1].reshape(-1)
            basis = np.hstack([self.free_q, self.left])
            self.sizes = np.bincount(self.codes)
            if self.sizes.size < 2:
                raise FitError("leaving out runs needs at least two of them", cure="leave groups out")
            self.grams = np.stack(
                [basis[self.codes == g].T @ basis[self.codes == g] for g in range(self.sizes.size)]
            )
            self.projected = np.stack(
                [basis[self.codes == g].T @ self.rest[self.codes == g] for g in range(self.sizes.size)]
            )

    def choose(
        self, kind: str, tried: np.ndarray, shrink: np.ndarray, inverse: np.ndarray, confidence: float
    ) -> RidgeFit:
        """Best of the candidates: rows of `shrink` (filter factors) and `inverse` (their part of 1/s)."""
        import pandas as pd

        errors = np.array([self._left_out_error(factors) for factors in shrink])
        dof = self.is_free.sum() + shrink.sum(axis=1)
        best = int(np.argmin(errors))
        if not math.isfinite(errors[best]) and tried.size > 1:
            raise FitError(
                "every candidate is determined by a single row or run", cure="fix the penalty or add runs"
            )
        curve = pd.DataFrame({kind: tried, "loo_rmse": errors, "effective_dof": dof})

        p, pen, loose = len(self.names), ~self.is_free, self.is_free
        params = np.empty(p)
        params[pen] = (self.right @ (inverse[best] * self.along)) / self.scale
        free_inverse = np.linalg.inv(self.free_r)
        params[loose] = free_inverse @ (self.free_q.T @ self.y - self.overlap @ params[pen])
        turned = (self.right * inverse[best]) / self.scale[:, None]
        inner = turned @ turned.T
        through = -free_inverse @ self.overlap
        unit = np.empty((p, p))
        unit[np.ix_(pen, pen)] = inner
        unit[np.ix_(loose, pen)] = through @ inner
        unit[np.ix_(pen, loose)] = (through @ inner).T
        unit[np.ix_(loose, loose)] = free_inverse @ free_inverse.T + through @ inner @ through.T

        missed = self.rest - self.left @ (shrink[best] * self.along)
        left_dof = self.y.size - float(dof[best])
        variance = float(missed @ missed) / left_dof if left_dof > 0.0 else math.nan
        return RidgeFit(
            names=self.names,
            params=params,
            cov=variance * unit,
            t_dof=np.full(p, left_dof if left_dof > 0.0 else math.nan),
            confidence=confidence,
            penalty=float(tried[best]) if kind == "penalty" else 0.0,
            kept=self.singular.size if kind == "penalty" else int(tried[best]),
            effective_dof=float(dof[best]),
            scale=variance,
            loo_rmse=float(errors[best]),
            curve=curve,
            resid=self.response - self.design @ params,
        )

    def _left_out_error(self, shrink: np.ndarray) -> float:
        missed = self.rest - self.left @ (shrink * self.along)
        if self.codes is None:
            leverage = (self.free_q**2).sum(axis=1) + self.left**2 @ shrink
            if np.any(leverage >= FULL_LEVERAGE):
                return math.inf
            return float(np.sqrt(np.mean((missed / (1.0 - leverage)) ** 2)))
        # (I - Z Z')^-1 e = e + Z (I - Z'Z)^-1 Z'e with Z = basis times the root of the filter factors.
        q = self.free_q.shape[1]
        root = np.sqrt(np.concatenate([np.ones(q), shrink]))
        fitted = np.concatenate([np.zeros(q), shrink * self.along])
        scores = (self.projected - self.grams @ fitted) * root
        grams = self.grams * root[:, None] * root
        open_ = np.eye(root.size) - grams
        try:
            pivots = np.diagonal(np.linalg.cholesky(open_), axis1=1, axis2=2)
        except np.linalg.LinAlgError:
            return math.inf
        if pivots.min() ** 2 <= 1.0 - FULL_LEVERAGE:
            return math.inf
        shift = np.linalg.solve(open_, scores[:, :, None])[:, :, 0]
        extra = 2.0 * np.einsum("gi,gi->", shift, scores) + np.einsum("gi,gij,gj->", shift, grams, shift)
        return math.sqrt(max(float(missed @ missed) + float(extra), 0.0) / self.y.size)
