"""Left-out errors of an LS-SVM for many gammas from one factorisation.

With the bias projected out of the (weighted) kernel matrix or features, the hat matrix is
q q' + U diag(s / (s + 1/gamma)) U', q the unit vector of root weights and (U, s) the eigenvectors and eigenvalues
of the centred kernel matrix. Every gamma then costs a matrix-vector product.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .lssvm_choice import Criterion
from .sandwich import FULL_LEVERAGE


@dataclass(frozen=True, eq=False)
class CentredSpectrum:
    """Spectrum of the centred kernel matrix.

    Attributes
    ----------
    constant : ndarray, shape (n,)
        Root weights, scaled to unit length.
    vectors : ndarray, shape (n, r)
        Orthonormal, orthogonal to `constant`.
    squares : ndarray, shape (r,)
        Eigenvalues, not negative.
    total : float
        Sum of the weights.
    complete : bool
        The vectors span all that is orthogonal to `constant`. What the fit leaves open is then a sum of positive
        parts, exact even where next to nothing is left.
    """

    constant: np.ndarray
    vectors: np.ndarray
    squares: np.ndarray
    total: float
    complete: bool

    def scores(
        self, rooted: np.ndarray, gammas: np.ndarray, criterion: Criterion, members: Sequence[np.ndarray] = ()
    ) -> np.ndarray:
        """Root of the criterion for each gamma, shape (g,); inf where rows determine their own fit.

        Parameters
        ----------
        rooted : ndarray, shape (n,)
            Response times root weights.
        gammas : ndarray, shape (g,)
        criterion : {"loo", "gcv"}
        members : sequence of arrays of int
            Rows of each group of several rows that is left out as a whole (``loo``).
        """
        rest = rooted - self.constant * (self.constant @ rooted)
        along = self.vectors.T @ rest
        return np.array([self._score(rest, along, float(g), criterion, members) for g in gammas])

    def _score(
        self,
        rest: np.ndarray,
        along: np.ndarray,
        gamma: float,
        criterion: Criterion,
        members: Sequence[np.ndarray],
    ) -> float:
        kept = 1.0 / (1.0 + gamma * self.squares)
        shrink = 1.0 - kept
        missed = self.vectors @ (kept * along) if self.complete else rest - self.vectors @ (shrink * along)
        if criterion == "gcv":
            left = float(kept.sum()) if self.complete else rest.size - 1.0 - float(shrink.sum())
            open_share = left / rest.size
            if open_share <= 1.0 - FULL_LEVERAGE:
                return math.inf
            return math.sqrt(float(missed @ missed) / self.total) / open_share
        if criterion != "loo":
            raise FitError(f"there is no criterion '{criterion}'", cure="use loo or gcv")
        open_ = self.vectors**2 @ kept if self.complete else 1.0 - self.constant**2 - self.vectors**2 @ shrink
        grouped = np.concatenate(members) if members else np.zeros(0, dtype=int)
        open_[grouped] = 1.0
        if open_.min() <= 1.0 - FULL_LEVERAGE:
            return math.inf
        left_out = missed / open_
        for rows in members:
            q, u = self.constant[rows], self.vectors[rows]
            block = (u * kept) @ u.T if self.complete else np.eye(rows.size) - np.outer(q, q) - (u * shrink) @ u.T
            values, vectors = np.linalg.eigh(block)
            if values[0] <= 1.0 - FULL_LEVERAGE:
                return math.inf
            left_out[rows] = vectors @ ((vectors.T @ missed[rows]) / values)
        return math.sqrt(float(left_out @ left_out) / self.total)


def groups_of_several(labels: np.ndarray | Sequence[Hashable], count: int) -> list[np.ndarray]:
    """Rows of each label that several rows share.

    Raises
    ------
    FitError
        If there is not one label a row, or only one group.
    """
    codes = np.asarray(labels)
    if codes.shape != (count,):
        raise FitError(f"{codes.size} group labels for {count} rows", cure="give one a row")
    _, inverse, sizes = np.unique(codes, return_inverse=True, return_counts=True)
    if sizes.size < 2:
        raise FitError("leaving out runs needs at least two of them", cure="leave groups out")
    order = np.argsort(inverse, kind="stable")
    parts = np.split(order, np.cumsum(sizes)[:-1])
    return [rows for rows in parts if rows.size > 1]
