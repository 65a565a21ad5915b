"""Linear-kernel LS-SVM of term columns: physical coefficients with covariance.

The linear kernel makes the LS-SVM ridge regression with penalty 1/gamma and a bias that is not penalised
(:mod:`.ridge`); it is solved in the primal, where the coefficients are.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .lssvm_choice import checked_gammas
from .lssvm_weights import suykens_weights
from .regression_input import checked_regression
from .ridge import RidgeFit, fit_ridge

if TYPE_CHECKING:
    import pandas as pd

BIAS = "bias"


@dataclass(frozen=True, eq=False)
class LSSVMFit(CoefficientTable):
    """Coefficients of the terms; their covariance shows scatter only, not the pull towards zero.

    Attributes
    ----------
    gamma : float
    bias, bias_std : float
        The constant b and its standard deviation; 0 without one.
    effective_dof : float
        Trace of the hat matrix, bias and free columns included.
    scale : float
        Residual variance of a row of weight 1, sum of squares over n - effective_dof.
    loo_rmse : float
        Root mean square (weighted) prediction error of left-out rows or runs.
    curve : DataFrame
        Columns ``gamma``, ``loo_rmse``, ``effective_dof`` of all that were tried, gamma ascending.
    edges : tuple of str
        ``gamma`` if the best value is the smallest or largest that was tried.
    resid : ndarray, shape (n,)
        Response minus fitted.
    row_weights : ndarray, shape (n,)
        Weights of the robust reweighting, 1 without it.
    influence : ndarray, shape (p, n)
        ``params = influence @ response``, gamma and weights held.
    """

    gamma: float
    bias: float
    bias_std: float
    effective_dof: float
    scale: float
    loo_rmse: float
    curve: pd.DataFrame
    edges: tuple[str, ...]
    resid: np.ndarray
    row_weights: np.ndarray
    influence: np.ndarray


def fit_lssvm(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    gamma: float | None = None,
    gammas: Sequence[float] | None = None,
    bias: bool | np.ndarray = True,
    free: Sequence[str] = (),
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    reweightings: int = 0,
    standardise: bool = True,
    confidence: float = 0.95,
) -> LSSVMFit:
    """Minimise |w|^2 / 2 + gamma/2 sum v_i e_i^2 with y = X w + b + e.

    Parameters
    ----------
    design, response, names, weights :
        As :func:`.regression.fit_linear`.
    gamma : float, optional
        Fixed; chosen among `gammas` by the exact error of left-out rows or runs when omitted.
    gammas : sequence of float, optional
        Candidates; 73, six a decade, when omitted.
    bias : bool or ndarray, shape (n,)
        Add the constant b. An array is its column: 1 where a row has the constant, 0 where it has not (the
        harmonics of a run have none, its mean has).
    free : sequence of str
        Columns that are not penalised, such as a constant term of the model that takes the place of the bias.
    groups : sequence of n labels, optional
        Leave out whole runs; single rows when omitted.
    reweightings : int
        Robust reweightings by :func:`.lssvm_weights.suykens_weights`, gamma chosen anew after each.
    standardise : bool
        Penalise columns scaled to unit mean square (after bias and free columns are projected out).
    confidence : float
        Level of the intervals in tables.

    Raises
    ------
    FitError
        As :func:`.ridge.fit_ridge`; if gamma is not positive; if the bias cannot be told from a column.
    """
    x, y, given = checked_regression(design, response, names, weights)
    if reweightings < 0:
        raise FitError(f"{reweightings} reweightings cannot be done", cure="use 0 or more")
    columns, all_names, loose = x, tuple(names), tuple(free)
    constant = _bias_column(bias, y.size)
    if constant is not None:
        _refuse_constants(x, constant, names)
        columns, all_names, loose = np.column_stack([x, constant]), (*all_names, BIAS), (*loose, BIAS)
    penalties = None
    if gamma is not None or gammas is not None:
        penalties = list(1.0 / checked_gammas([gamma] if gamma is not None else list(gammas or ())))

    own, settled = np.ones(y.size), given
    for left in range(reweightings, -1, -1):
        fit = fit_ridge(
            columns,
            y,
            all_names,
            penalties=penalties,
            free=loose,
            weights=settled,
            groups=groups,
            standardise=standardise,
            confidence=confidence,
        )
        if left:
            own = suykens_weights(fit.resid * (1.0 if given is None else np.sqrt(given)))
            settled = own if given is None else own * given
    influence = _influence(columns, settled, np.array([name in loose for name in all_names]), fit, standardise)
    p = len(names)
    curve = fit.curve.assign(gamma=1.0 / fit.curve["penalty"])[["gamma", "loo_rmse", "effective_dof"]]
    curve = curve.sort_values("gamma", ignore_index=True)
    chosen = 1.0 / fit.penalty if gamma is None else float(gamma)
    at_edge = len(curve) > 1 and chosen in (curve["gamma"].iloc[0], curve["gamma"].iloc[-1])
    return LSSVMFit(
        names=tuple(names),
        params=fit.params[:p],
        cov=fit.cov[:p, :p],
        t_dof=fit.t_dof[:p],
        confidence=confidence,
        gamma=chosen,
        bias=float(fit.params[p]) if constant is not None else 0.0,
        bias_std=float(np.sqrt(fit.cov[p, p])) if constant is not None else 0.0,
        effective_dof=fit.effective_dof,
        scale=fit.scale,
        loo_rmse=fit.loo_rmse,
        curve=curve,
        edges=("gamma",) if at_edge else (),
        resid=fit.resid,
        row_weights=own,
        influence=influence[:p],
    )


def _bias_column(bias: bool | np.ndarray, count: int) -> np.ndarray | None:
    if isinstance(bias, np.ndarray):
        column = bias.astype(float)
        if column.shape != (count,):
            raise FitError(f"a bias column of shape {column.shape} for {count} rows", cure="give one a row")
        if not (np.isfinite(column).all() and column.any()):
            raise FitError("the bias column is zero or not finite", cure="use bias=False for none")
        return column
    return np.ones(count) if bias else None


def _refuse_constants(x: np.ndarray, constant: np.ndarray, names: Sequence[str]) -> None:
    unit = constant / np.linalg.norm(constant)
    left = np.linalg.norm(x - np.outer(unit, unit @ x), axis=0)
    for name, rest, size in zip(names, left, np.linalg.norm(x, axis=0)):
        if rest <= 1e-10 * size:
            raise FitError(
                f"column '{name}' does not vary: it cannot be told from the bias",
                cure=f"use bias=False and free=['{name}'], or drop the column",
            )


def _influence(
    columns: np.ndarray, weights: np.ndarray | None, is_free: np.ndarray, fit: RidgeFit, standardise: bool
) -> np.ndarray:
    """Ridge as least squares on rows that are followed by one row a penalty."""
    root = np.ones(len(columns)) if weights is None else np.sqrt(weights)
    rows = columns * root[:, None]
    size = np.ones(columns.shape[1])
    if standardise:
        basis = np.linalg.qr(rows[:, is_free])[0]
        size = np.sqrt(np.mean((rows - basis @ (basis.T @ rows)) ** 2, axis=0))
    pulls = np.diag(np.sqrt(fit.penalty) * size)[~is_free]
    # Columns of unit length first, so that the cut-off of small singular values means the same for each.
    stacked = np.vstack([rows, pulls])
    lengths = np.linalg.norm(stacked, axis=0)
    return (np.linalg.pinv(stacked / lengths) / lengths[:, None])[:, : len(columns)] * root
