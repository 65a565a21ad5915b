"""Covariance of least-squares coefficients when the errors are not independent or not alike.

All functions work in the orthonormal coordinates of the (weighted) design: q is n x r with q'q = I, the
coefficients are T c with c = q'y, and a covariance of c is turned into one of the coefficients by T . T'. In
these coordinates the leverage block of a run is q_g q_g', and everything that the cluster corrections need is
the r x r matrix q_g' q_g, whatever the number of samples in the run.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..core.errors import FitError

# A leverage this close to one is one: the run alone determines some combination of terms.
FULL_LEVERAGE = 1.0 - 1e-9


@dataclass(frozen=True, eq=False)
class GroupGeometry:
    """Leverage of each group of rows, in orthonormal coordinates.

    Attributes
    ----------
    labels : ndarray, shape (g,)
        Group labels in sorted order.
    codes : ndarray of int, shape (n,)
        Group of each row.
    sizes : ndarray of int, shape (g,)
        Rows in each group.
    leverage : ndarray, shape (g, r)
        Eigenvalues of q_g' q_g.
    vectors : ndarray, shape (g, r, r)
        Its eigenvectors, in columns.
    scores : ndarray, shape (g, r)
        q_g' e_g in the coordinates of `vectors`.
    """

    labels: np.ndarray
    codes: np.ndarray
    sizes: np.ndarray
    leverage: np.ndarray
    vectors: np.ndarray
    scores: np.ndarray

    def power(self, exponent: float) -> np.ndarray:
        """(1 - leverage)^exponent, shape (g, r); zero where a group has full leverage."""
        open_ = self.leverage < FULL_LEVERAGE
        return np.where(open_, (1.0 - np.where(open_, self.leverage, 0.0)) ** exponent, 0.0)

    def adjusted_scores(self, exponent: float) -> np.ndarray:
        """Scores with the residuals of each group multiplied by (I - H_gg)^exponent, shape (g, r)."""
        return np.einsum("gij,gj->gi", self.vectors, self.power(exponent) * self.scores)

    def deleted_residuals(self, q: np.ndarray, residual: np.ndarray) -> np.ndarray:
        """Residual of each row by a fit that leaves out the row's group, shape (n,)."""
        shift = self.adjusted_scores(-1.0)
        return residual + np.einsum("ij,ij->i", q, shift[self.codes])


def group_geometry(q: np.ndarray, residual: np.ndarray, groups: np.ndarray) -> GroupGeometry:
    """Leverage and scores of each group.

    Parameters
    ----------
    q : ndarray, shape (n, r)
        Orthonormal coordinates of the weighted design.
    residual : ndarray, shape (n,)
        Weighted residuals.
    groups : ndarray, shape (n,)
        Labels: rows of one run share one.
    """
    labels, codes = np.unique(groups, return_inverse=True)
    codes = codes.reshape(-1)
    order = np.argsort(codes, kind="stable")
    bounds = np.searchsorted(codes[order], np.arange(labels.size + 1))
    grams = np.empty((labels.size, q.shape[1], q.shape[1]))
    scores = np.empty((labels.size, q.shape[1]))
    consecutive = bool(np.all(order[1:] > order[:-1]))
    for g in range(labels.size):
        rows = slice(bounds[g], bounds[g + 1]) if consecutive else order[bounds[g] : bounds[g + 1]]
        block = q[rows]
        grams[g] = block.T @ block
        scores[g] = block.T @ residual[rows]
    return geometry_of_blocks(labels, codes, np.diff(bounds), grams, scores)


def geometry_of_blocks(
    labels: np.ndarray, codes: np.ndarray, sizes: np.ndarray, grams: np.ndarray, scores: np.ndarray
) -> GroupGeometry:
    """:class:`GroupGeometry` from q_g' q_g (g, r, r) and q_g' e_g (g, r) of each group."""
    leverage, vectors = np.linalg.eigh(grams)
    turned = np.einsum("gji,gj->gi", vectors, scores)
    return GroupGeometry(labels, codes, sizes, np.clip(leverage, 0.0, 1.0), vectors, turned)


def cluster_covariance(
    geometry: GroupGeometry, back: np.ndarray, scale: float, dof: int, correction: str
) -> tuple[np.ndarray, np.ndarray]:
    """Covariance of coefficients whose errors are correlated within groups, and its degrees of freedom.

    Parameters
    ----------
    geometry : GroupGeometry
    back : ndarray, shape (p, r)
        T: coefficients from orthonormal coordinates.
    scale : float
        Residual variance; used only where one group alone determines a combination of terms, because
        between-group scatter says nothing there.
    dof : int
        Residual degrees of freedom.
    correction : {"cr1", "cr2", "cr3"}
        ``cr2``: Bell and McCaffrey (2002), unbiased for alike errors, with Satterthwaite degrees of freedom
        of each coefficient. ``cr3``: close to the leave-one-group-out jackknife, same degrees of freedom
        formula. ``cr1``: Stata's and statsmodels' factor, with g - 1 degrees of freedom.

    Returns
    -------
    cov : ndarray, shape (p, p)
    t_dof : ndarray, shape (p,)

    Raises
    ------
    FitError
        If there is only one group or the correction is unknown.
    """
    g, r = geometry.leverage.shape
    if g < 2:
        raise FitError("clustered errors need at least two groups", cure="use covariance='hac'")
    exponents = {"cr1": 0.0, "cr2": -0.5, "cr3": -1.0}
    if correction not in exponents:
        raise FitError(f"there is no cluster correction '{correction}'", cure="use cr1, cr2 or cr3")
    scores = geometry.adjusted_scores(exponents[correction])
    meat = scores.T @ scores
    n = int(geometry.sizes.sum())
    if correction == "cr1":
        meat *= g / (g - 1.0) * (n - 1.0) / max(n - r, 1)
        return back @ meat @ back.T, np.full(back.shape[0], g - 1.0)
    alone = geometry.leverage >= FULL_LEVERAGE
    for group in np.flatnonzero(alone.any(axis=1)):
        directions = geometry.vectors[group][:, alone[group]]
        meat += scale * directions @ directions.T
    cov = back @ meat @ back.T

    # Variance of the estimator under alike errors: P = diag(a_g'a_g) - b_g'b_h, see Bell and McCaffrey.
    factor = geometry.power(exponents[correction])
    turned = geometry.vectors.transpose(0, 2, 1) @ back.T
    squares = np.einsum("gi,gip->gp", geometry.leverage * factor**2, turned**2)
    shadows = geometry.vectors @ ((geometry.leverage * factor)[:, :, None] * turned)
    lengths = (shadows**2).sum(axis=1)
    of_term = np.ascontiguousarray(shadows.transpose(2, 0, 1))
    overlap = of_term.transpose(0, 2, 1) @ of_term
    trace = (squares - lengths).sum(axis=0)
    trace_of_square = (squares**2 - 2.0 * squares * lengths).sum(axis=0) + (overlap**2).sum(axis=(1, 2))
    t_dof = trace**2 / np.maximum(trace_of_square, 1e-300)
    return cov, np.clip(t_dof, 1.0, max(float(dof), 1.0))


def hac_covariance(
    q: np.ndarray, residual: np.ndarray, back: np.ndarray, lags: int | None, groups: np.ndarray | None
) -> tuple[np.ndarray, int]:
    """Newey-West covariance: errors correlated along time, and of unequal size.

    Parameters
    ----------
    q, residual, back :
        As above.
    lags : int, optional
        Lags with falling (Bartlett) weights; by Andrews' (1991) first-order rule when omitted.
    groups : ndarray, shape (n,), optional
        Runs, each in consecutive rows: products never reach across two of them.

    Returns
    -------
    cov : ndarray, shape (p, p)
        With the small-sample factor n/(n - r).
    lags : int
        Lags used.

    Raises
    ------
    FitError
        If the lags are negative.
    """
    n, r = q.shape
    scores = q * residual[:, None]
    if groups is None:
        bounds = np.array([0, n])
    else:
        bounds = np.concatenate([[0], np.flatnonzero(groups[1:] != groups[:-1]) + 1, [n]])
    runs = [scores[a:b] for a, b in pairwise(bounds)]
    chosen = _andrews_lags(runs) if lags is None else int(lags)
    if chosen < 0:
        raise FitError(f"the number of lags {chosen} is negative", cure="use 0 or more")
    meat = scores.T @ scores
    for lag in range(1, chosen + 1):
        weight = 1.0 - lag / (chosen + 1.0)
        for run in runs:
            if len(run) > lag:
                product = run[lag:].T @ run[:-lag]
                meat += weight * (product + product.T)
    return back @ meat @ back.T * (n / max(n - r, 1)), chosen


def _andrews_lags(runs: list[np.ndarray]) -> int:
    products = sum((run[1:] * run[:-1]).sum(axis=0) for run in runs)
    squares = sum((run[:-1] ** 2).sum(axis=0) for run in runs)
    rho = np.clip(products / np.maximum(squares, 1e-300), -0.97, 0.97)
    weight = (np.asarray(squares) * (1.0 - rho**2)) ** 2
    if not np.any(weight > 0.0):
        return 0
    above = np.sum(weight * 4.0 * rho**2 / ((1.0 - rho) ** 6 * (1.0 + rho) ** 2))
    alpha = above / np.sum(weight / (1.0 - rho) ** 4)
    longest = max(len(run) for run in runs)
    bandwidth = 1.1447 * (alpha * sum(len(run) for run in runs)) ** (1.0 / 3.0)
    return int(min(bandwidth, longest - 1))


def hc3_covariance(q: np.ndarray, residual: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Covariance for independent errors of unequal size (MacKinnon and White 1985, HC3).

    Raises
    ------
    FitError
        If a row alone determines a combination of terms: its error cannot be seen.
    """
    leverage = np.einsum("ij,ij->i", q, q)
    if np.any(leverage >= FULL_LEVERAGE):
        row = int(np.argmax(leverage))
        raise FitError(
            f"row {row} alone determines a term, so that HC3 is undefined", cure="use covariance='model'"
        )
    scores = q * (residual / (1.0 - leverage))[:, None]
    return back @ (scores.T @ scores) @ back.T
