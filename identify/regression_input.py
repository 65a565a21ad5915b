"""Checks that every regression of this room makes on its input."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.errors import FitError
from .collinearity import ScaledSvd, exact_dependencies


def checked_regression(
    design: np.ndarray, response: np.ndarray, names: Sequence[str], weights: np.ndarray | None
) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    """Design (n, p), response (n,) and weights (n,) as floats.

    Raises
    ------
    FitError
        If shapes disagree, there is no row, a value is not finite, or a weight is not positive.
    """
    x, y = np.asarray(design, dtype=float), np.asarray(response, dtype=float)
    if x.ndim != 2 or x.shape[1] != len(names):
        raise FitError(
            f"a design of shape {x.shape} does not fit {len(names)} names", cure="give one name a column"
        )
    if len(set(names)) != len(names):
        raise FitError("two columns have the same name", cure="name each term once")
    if y.shape != (x.shape[0],):
        raise FitError(f"{x.shape[0]} rows of terms for a response of shape {y.shape}", cure="give one a row")
    if y.size == 0 or not names:
        raise FitError("there is nothing to fit", cure="give at least one row and one term")
    # A sum is finite only when all its parts are, and needs no array of booleans.
    if not (np.isfinite(y.sum()) and np.isfinite(x.sum())):
        columns = [name for name, column in zip(names, x.T) if not np.isfinite(column).all()]
        where = f"terms {', '.join(columns)}" if columns else "the response"
        raise FitError(f"{where} hold values that are not finite", cure="fill or cut the gaps first")
    if weights is None:
        return x, y, None
    w = np.asarray(weights, dtype=float)
    if w.shape != y.shape:
        raise FitError(f"{w.size} weights for {y.size} rows", cure="give one weight a row")
    if not (np.isfinite(w).all() and (w > 0.0).all()):
        raise FitError("a weight is not positive", cure="leave out the rows that should not count")
    return x, y, w


def require_full_rank(svd: ScaledSvd, names: Sequence[str], *, allow_singular: bool) -> tuple[str, ...]:
    """Names of exactly dependent terms; empty with full rank.

    Raises
    ------
    FitError
        If terms are dependent and that is not allowed.
    """
    dependent = exact_dependencies(svd, names)
    if dependent and not allow_singular:
        sets = "; ".join(", ".join(name for name in names if name in group) for group in dependent)
        raise FitError(
            f"the data cannot separate these terms at all: {sets}",
            cure="drop one of them, add runs that tell them apart, or allow_singular=True",
        )
    return tuple(name for name in names if any(name in group for group in dependent))
