"""Least squares over many runs without keeping their rows.

Each run updates the triangular factor of the stacked [design | response], which is as accurate as a
factorisation of all rows together; memory does not grow with the rows. Clustered errors need one small matrix
a run beside it.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np

from ..core.errors import FitError
from .coefficient_table import CoefficientTable
from .collinearity import ScaledSvd, inseparable_terms, scaled_svd, variance_inflation
from .regression_input import checked_regression, require_full_rank
from .sandwich import cluster_covariance, geometry_of_blocks


@dataclass(frozen=True, eq=False)
class StackedFit(CoefficientTable):
    """Least-squares fit of which the rows were not kept.

    Attributes
    ----------
    covariance : {"model", "cluster"}
        Kind of `cov`.
    n, dof : int
        Rows and residual degrees of freedom.
    ssr, tss : float
        Weighted sum of squared residuals, and of the response about its mean (about zero without a constant
        column).
    vif : ndarray, shape (p,)
        Variance inflation factors.
    svd : ScaledSvd
        Singular values of the design with unit columns.
    flagged : tuple of str
        Terms whose split is arbitrary in a fit with ``allow_singular``.
    n_groups : int
        Runs that were added.
    """

    covariance: str
    n: int
    dof: int
    ssr: float
    tss: float
    vif: np.ndarray
    svd: ScaledSvd
    flagged: tuple[str, ...]
    n_groups: int

    @property
    def scale(self) -> float:
        """Residual variance."""
        return self.ssr / self.dof if self.dof > 0 else math.nan

    @cached_property
    def r2(self) -> float:
        """Coefficient of determination."""
        return 1.0 - self.ssr / self.tss if self.tss > 0.0 else math.nan

    @property
    def condition_number(self) -> float:
        """Condition number of the weighted design with columns scaled to unit length."""
        return self.svd.condition_number

    def inseparable(self) -> list[set[str]]:
        """Sets of terms that the data cannot separate."""
        return inseparable_terms(self.svd, self.names)


class NormalEquations:
    """Accumulator of a stacked least-squares problem.

    Parameters
    ----------
    p : int
        Number of terms.
    names : sequence of p str, optional
        Names of the terms; ``x0, x1, ...`` when omitted.
    keep_groups : bool
        Keep one matrix of (p + 1)^2 numbers a run, which clustered errors need.

    Attributes
    ----------
    triangle : ndarray, shape (p + 1, p + 1)
        Triangular factor of the weighted [design | response] of all rows so far.
    n : int
        Rows so far.
    """

    def __init__(self, p: int, names: Sequence[str] | None = None, *, keep_groups: bool = True) -> None:
        self.names = tuple(names) if names is not None else tuple(f"x{j}" for j in range(p))
        if len(self.names) != p:
            raise FitError(f"{len(self.names)} names for {p} terms", cure="give one name a term")
        self.p, self.keep_groups, self.n = p, keep_groups, 0
        self.triangle = np.zeros((p + 1, p + 1))
        self._moments = np.zeros(p + 2)
        # Value of each column that has been constant so far, nan for the others.
        self._constant: np.ndarray | None = None
        self._grams: dict[Hashable, np.ndarray] = {}
        self._rows: dict[Hashable, int] = {}

    def add(
        self,
        design: np.ndarray,
        response: np.ndarray,
        weights: np.ndarray | None = None,
        *,
        group: Hashable | None = None,
    ) -> NormalEquations:
        """Add the rows of a run; rows of later calls with the same `group` join it.

        Parameters
        ----------
        design : ndarray, shape (n, p)
        response : ndarray, shape (n,)
        weights : ndarray, shape (n,), optional
            Inverse variances up to a common factor.
        group : hashable, optional
            Label of the run; each call is a run of its own when omitted.

        Raises
        ------
        FitError
            As :func:`.regression.fit_linear`.
        """
        x, y, w = checked_regression(design, response, self.names, weights)
        # Columns contiguous, as the factorisation wants them.
        block = np.empty((y.size, self.p + 1), order="F")
        block[:, :-1], block[:, -1] = x, y
        mass = np.ones(y.size) if w is None else w
        self._moments += np.concatenate([[mass.sum()], mass @ block])
        if w is not None:
            block *= np.sqrt(w)[:, None]
        self._note_constant_columns(x)
        triangle = _triangle(block)
        if self.keep_groups:
            label = ("run", len(self._grams)) if group is None else group
            gram = triangle.T @ triangle
            self._grams[label] = self._grams[label] + gram if label in self._grams else gram
            self._rows[label] = self._rows.get(label, 0) + y.size
        self.triangle = _triangle(np.vstack([self.triangle, triangle]))
        self.n += y.size
        return self

    def _note_constant_columns(self, x: np.ndarray) -> None:
        if self._constant is None:
            self._constant = x[0].copy()
        same = (x[0] == self._constant) & (x[-1] == self._constant)
        for j in np.flatnonzero(same):
            same[j] = bool((x[:, j] == self._constant[j]).all())
        self._constant = np.where(same, self._constant, np.nan)

    def merge(self, other: NormalEquations) -> NormalEquations:
        """Add what another accumulator of the same terms holds, as when runs were read in parallel.

        Raises
        ------
        FitError
            If the terms differ.
        """
        if other.names != self.names:
            raise FitError("the accumulators hold different terms", cure="use one list of terms")
        self.triangle = _triangle(np.vstack([self.triangle, other.triangle]))
        self._moments += other._moments
        if self._constant is None:
            self._constant = None if other._constant is None else other._constant.copy()
        elif other._constant is not None:
            self._constant = np.where(self._constant == other._constant, self._constant, np.nan)
        self.n += other.n
        for label, gram in other._grams.items():
            key = ("run", len(self._grams)) if isinstance(label, tuple) and label[:1] == ("run",) else label
            self._grams[key] = self._grams[key] + gram if key in self._grams else gram
            self._rows[key] = self._rows.get(key, 0) + other._rows[label]
        return self

    def solve(
        self,
        *,
        covariance: Literal["model", "cluster"] = "model",
        cluster_correction: Literal["cr1", "cr2", "cr3"] = "cr2",
        confidence: float = 0.95,
        allow_singular: bool = False,
    ) -> StackedFit:
        """Solve for the coefficients.

        Parameters
        ----------
        covariance : {"model", "cluster"}
            Independent alike errors, or errors correlated within runs.
        cluster_correction : {"cr2", "cr3", "cr1"}
            See :func:`.sandwich.cluster_covariance`.
        confidence : float
            Level of the intervals in tables.
        allow_singular : bool
            Minimum-norm solution when terms are exactly dependent.

        Raises
        ------
        FitError
            If there are no rows, a term was never excited, terms are exactly dependent, or runs were not kept
            for clustered errors.
        """
        if self.n == 0:
            raise FitError("there is nothing to fit", cure="add at least one run")
        p = self.p
        svd, left = scaled_svd(self.triangle[:p, :p], self.n, self.names)
        flagged = require_full_rank(svd, self.names, allow_singular=allow_singular)
        r = svd.rank
        back = svd.right[:, :r] / svd.singular[:r] / svd.scale[:, None]
        if flagged:
            null = svd.null_directions()
            back = back - null @ (null.T @ back)
        target = self.triangle[:p, p]
        params = back @ (left[:, :r].T @ target)
        missed = target - self.triangle[:p, :p] @ params
        ssr = float(missed @ missed) + float(self.triangle[p, p]) ** 2
        dof = self.n - r
        scale = ssr / dof if dof > 0 else math.nan
        t_dof = np.full(p, float(dof) if dof > 0 else math.nan)
        if covariance == "model":
            cov = scale * (back @ back.T)
        elif covariance == "cluster":
            cov, t_dof = self._clustered(params, back, scale, dof, cluster_correction)
        else:
            raise FitError(f"there is no covariance '{covariance}'", cure="use model or cluster")

        weight, sums = float(self._moments[0]), self._moments[1:]
        intercept = self._constant is not None and bool(np.isfinite(self._constant).any())
        total = float(self.triangle[:, p] @ self.triangle[:, p])
        unit = np.einsum("ij,ij->i", back, back)
        vif = variance_inflation(unit, svd.scale**2, sums[:p], weight, intercept)
        return StackedFit(
            names=self.names,
            params=params,
            cov=cov,
            t_dof=t_dof,
            confidence=confidence,
            covariance=covariance,
            n=self.n,
            dof=dof,
            ssr=ssr,
            tss=total - float(sums[p]) ** 2 / weight if intercept else total,
            vif=np.where(np.isin(self.names, flagged), math.inf, vif),
            svd=svd,
            flagged=flagged,
            n_groups=len(self._grams),
        )

    def _clustered(
        self, params: np.ndarray, back: np.ndarray, scale: float, dof: int, correction: str
    ) -> tuple[np.ndarray, np.ndarray]:
        if not self.keep_groups:
            raise FitError("the runs were not kept apart", cure="use keep_groups=True")
        p = self.p
        stack = np.stack(list(self._grams.values()))
        scores = stack[:, :p, p] - stack[:, :p, :p] @ params
        grams = np.einsum("ki,gkl,lj->gij", back, stack[:, :p, :p], back, optimize=True)
        sizes = np.array(list(self._rows.values()))
        indices = np.arange(sizes.size)
        geometry = geometry_of_blocks(indices, np.repeat(indices, sizes), sizes, grams, scores @ back)
        return cluster_covariance(geometry, back, scale, dof, correction)


def _triangle(block: np.ndarray) -> np.ndarray:
    r = np.asarray(np.linalg.qr(block, mode="r"))
    if r.shape[0] == r.shape[1]:
        return r
    full = np.zeros((block.shape[1], block.shape[1]))
    full[: r.shape[0]] = r
    return full


def fit_stacked(
    blocks: Iterable[tuple[np.ndarray, ...]],
    names: Sequence[str],
    *,
    covariance: Literal["model", "cluster"] = "cluster",
    **options: Any,
) -> StackedFit:
    """Fit all runs together, taking them one by one.

    Parameters
    ----------
    blocks : iterable of tuple
        ``(design, response)`` or ``(design, response, weights)`` of each run; may be a generator.
    names : sequence of p str
        Names of the terms.
    covariance : {"cluster", "model"}
        Errors correlated within runs, or independent.
    **options
        As :meth:`NormalEquations.solve`.

    Raises
    ------
    FitError
        As :meth:`NormalEquations.solve`.
    """
    equations = NormalEquations(len(names), names, keep_groups=covariance == "cluster")
    for block in blocks:
        equations.add(*block)
    return equations.solve(covariance=covariance, **options)
