"""Regression that a few bad rows cannot bend: Huber's M-estimator through statsmodels."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .regression import fit_linear


@dataclass(frozen=True, eq=False)
class RobustFit(CoefficientTable):
    """Huber fit.

    Attributes
    ----------
    scale : float
        Robust standard deviation of the (weighted) residuals.
    resid : ndarray, shape (n,)
        Response minus fitted.
    row_weights : ndarray, shape (n,)
        Weight that the estimator gave to each row, 1 for a row within the bulk.
    iterations : int
        Reweighting steps.
    """

    scale: float
    resid: np.ndarray
    row_weights: np.ndarray
    iterations: int

    def outlying(self, weight: float = 0.5) -> list[int]:
        """Positions of the rows that were given less than `weight`."""
        return [int(i) for i in np.flatnonzero(self.row_weights < weight)]


def fit_huber(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    *,
    weights: np.ndarray | None = None,
    tuning: float = 1.345,
    confidence: float = 0.95,
    max_iterations: int = 200,
) -> RobustFit:
    """Fit by Huber's loss, scale by the median absolute deviation.

    Parameters
    ----------
    design, response, names :
        As :func:`.regression.fit_linear`.
    weights : ndarray, shape (n,), optional
        Inverse variances up to a factor, known before the fit.
    tuning : float
        Residuals beyond `tuning` scales count linearly; 1.345 has 95 % efficiency for normal errors.
    confidence : float
        Level of the intervals in tables.
    max_iterations : int
        Reweighting steps allowed.

    Returns
    -------
    RobustFit
        With Huber's (1981) covariance.

    Raises
    ------
    FitError
        As :func:`.regression.fit_linear`; if no degree of freedom is left; or if the steps do not converge.
    """
    from statsmodels.robust.norms import HuberT
    from statsmodels.robust.robust_linear_model import RLM

    start = fit_linear(design, response, names, weights=weights, confidence=confidence)
    if start.dof < 1:
        raise FitError(f"{start.n} rows for {len(start.names)} terms leave no scatter", cure="add rows")
    root = np.ones(start.n) if start.weights is None else np.sqrt(start.weights)
    exact = 1e-13 * float(np.max(np.abs(start.response * root)))
    if np.median(np.abs(start.weighted_resid)) <= exact:
        # Without scatter there is no bulk to compare with, and least squares is already exact.
        return RobustFit(
            start.names, start.params, start.cov, start.t_dof, confidence, 0.0, start.resid, np.ones(start.n), 0
        )
    # Columns and response of unit length, so that the convergence limit means the same for every force.
    size = float(np.linalg.norm(start.response * root))
    lengths = start.svd.scale / size
    model = RLM(start.response * root / size, start.design * root[:, None] / start.svd.scale, M=HuberT(tuning))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = model.fit(maxiter=max_iterations, tol=1e-12, conv="coefs", cov="H1")
    iterations = int(result.fit_history["iteration"])
    if iterations >= max_iterations:
        raise FitError(
            f"the Huber fit did not settle in {max_iterations} steps", cure="raise max_iterations or tuning"
        )
    params = np.asarray(result.params) / lengths
    return RobustFit(
        names=start.names,
        params=params,
        cov=np.asarray(result.cov_params()) / np.outer(lengths, lengths),
        t_dof=start.t_dof,
        confidence=confidence,
        scale=float(result.scale) * size,
        resid=start.response - start.design @ params,
        row_weights=np.asarray(result.weights),
        iterations=iterations,
    )
