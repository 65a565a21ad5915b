"""Which terms the data cannot tell apart: condition number, variance inflation, variance decomposition.

After Belsley, Kuh and Welsch (1980): columns are scaled to unit length, a condition index above 30 marks a
near dependency, and a term belongs to it when it gets more than half of its variance from there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError

CONDITION_LIMIT = 30.0
PROPORTION_LIMIT = 0.5
# A coefficient takes part in an exact dependency when its share of the null vector exceeds this.
NULL_SHARE = 1e-6


@dataclass(frozen=True, eq=False)
class ScaledSvd:
    """Singular values of a design whose columns were scaled to unit length.

    Attributes
    ----------
    scale : ndarray, shape (p,)
        Lengths of the columns.
    singular : ndarray, shape (p,)
        Singular values of the scaled design, falling.
    right : ndarray, shape (p, p)
        Right singular vectors in columns.
    rank : int
        Singular values above rounding.
    """

    scale: np.ndarray
    singular: np.ndarray
    right: np.ndarray
    rank: int

    @property
    def condition_number(self) -> float:
        """Largest over smallest singular value; inf without full rank."""
        if self.rank < self.singular.size:
            return float("inf")
        return float(self.singular[0] / self.singular[-1])

    def null_directions(self) -> np.ndarray:
        """Orthonormal directions in coefficient space that leave the fit unchanged, shape (p, p - rank)."""
        raw = self.right[:, self.rank :] / self.scale[:, None]
        return np.linalg.qr(raw)[0] if raw.shape[1] else raw


def scaled_svd(triangle: np.ndarray, rows: int, names: Sequence[str]) -> tuple[ScaledSvd, np.ndarray]:
    """Singular value decomposition of a design from its triangular factor, columns scaled.

    Parameters
    ----------
    triangle : ndarray, shape (q, p)
        R of the (weighted) design, or the design itself.
    rows : int
        Rows of the design, for the rounding limit of the rank.
    names : sequence of str
        Names of the columns.

    Returns
    -------
    svd : ScaledSvd
    left : ndarray, shape (q, p)
        Left singular vectors in columns.

    Raises
    ------
    FitError
        If a column is zero everywhere: the term was never excited.
    """
    scale = np.sqrt(np.einsum("ij,ij->j", triangle, triangle))
    empty = [name for name, length in zip(names, scale) if length == 0.0]
    if empty:
        raise FitError(
            f"no run excites {', '.join(empty)}: the column is zero everywhere",
            cure="drop the term or add runs that excite it",
        )
    left, singular, right = np.linalg.svd(triangle / scale, full_matrices=False)
    limit = singular[0] * max(rows, len(names)) * np.finfo(float).eps
    return ScaledSvd(scale, singular, right.T, int(np.count_nonzero(singular > limit))), left


def exact_dependencies(svd: ScaledSvd, names: Sequence[str]) -> list[set[str]]:
    """Sets of terms that are linearly dependent; terms of separate dependencies come in separate sets."""
    null = svd.right[:, svd.rank :]
    if null.shape[1] == 0:
        return []
    linked = np.abs(null @ null.T) > NULL_SHARE
    remaining = {j for j in range(len(names)) if linked[j, j]}
    sets = []
    while remaining:
        group, fresh = set(), {min(remaining)}
        while fresh:
            group |= fresh
            fresh = {int(j) for i in fresh for j in np.flatnonzero(linked[i])} - group
        sets.append({names[j] for j in sorted(group)})
        remaining -= group
    return sets


def variance_proportions(svd: ScaledSvd) -> np.ndarray:
    """Share of each coefficient's variance that comes from each singular value, shape (p, p).

    Rows follow the singular values, columns the coefficients; columns sum to 1.
    """
    shares = (svd.right / svd.singular).T ** 2
    return shares / shares.sum(axis=0)


def inseparable_terms(svd: ScaledSvd, names: Sequence[str]) -> list[set[str]]:
    """Sets of terms that the data cannot separate, worst first.

    With full rank these are the terms that share more than half of their variance at a condition index
    above 30; when several near dependencies compete and none of them reaches half, they are pooled. Without
    full rank they are the exactly dependent terms.
    """
    if svd.rank < svd.singular.size:
        return exact_dependencies(svd, names)
    index = svd.singular[0] / svd.singular
    weak = np.flatnonzero(index > CONDITION_LIMIT)
    if weak.size == 0:
        return []
    proportions = variance_proportions(svd)
    sets: list[set[str]] = []
    for row in proportions[weak[::-1]]:
        members = {name for name, share in zip(names, row) if share > PROPORTION_LIMIT}
        if len(members) > 1 and members not in sets:
            sets.append(members)
    pooled = {name for name, share in zip(names, proportions[weak].sum(axis=0)) if share > PROPORTION_LIMIT}
    if not sets and len(pooled) > 1:
        sets.append(pooled)
    return sets


def variance_inflation(
    unit_variance: np.ndarray, squares: np.ndarray, sums: np.ndarray, weight: float, intercept: bool
) -> np.ndarray:
    """Variance inflation factors.

    Parameters
    ----------
    unit_variance : ndarray, shape (p,)
        Diagonal of (X' W X)^-1.
    squares, sums : ndarray, shape (p,)
        Weighted sums of squares and sums of the columns.
    weight : float
        Sum of the weights.
    intercept : bool
        True when a column is constant: the other columns are then centred; the constant column itself is
        not.

    Returns
    -------
    ndarray, shape (p,)
        1 for a column orthogonal to all others.
    """
    if not intercept:
        return squares * unit_variance
    centred = squares - sums**2 / weight
    constant = centred <= 1e-12 * squares
    return np.where(constant, squares, centred) * unit_variance
