"""Linear least squares of forces on term columns, with honest covariance and diagnostics.

The weighted design is factorised once (QR, then the singular values of R with columns scaled to unit length);
coefficients, covariances, leverages and collinearity all come from that factorisation.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from typing import Literal, get_args

import numpy as np

from ..core.errors import FitError
from .collinearity import scaled_svd
from .linear_fit import LinearFit
from .normal_equations import NormalEquations, StackedFit, fit_stacked
from .regression_input import checked_regression, require_full_rank
from .sandwich import cluster_covariance, group_geometry, hac_covariance, hc3_covariance

__all__ = ["LinearFit", "NormalEquations", "StackedFit", "fit_linear", "fit_stacked"]

Covariance = Literal["model", "hac", "cluster", "hc3"]


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
