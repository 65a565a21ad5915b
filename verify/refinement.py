"""Refinement of a series of grids or time steps: spacings, ratios, and the ratio that a study says it has.

Cell counts give the refinement that was really made: grids coarsened by sqrt(2) in their base size, but not in
their wall layers, differ by less than sqrt(2). An order computed with the wrong ratio is a wrong order.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError
from ..core.findings import Finding

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

RATIO_TOLERANCE = 0.05
"""Share by which a ratio may differ from the assumed one before it is reported."""

SMALL_RATIO = 1.3
"""Celik et al. (2008) ask for more than this: smaller ratios drown the discretisation error in the others."""

SAME_SPACING = 1e-9
"""Share up to which two spacings are the same."""


def spacings_from_cells(cells: ArrayLike, dimension: int = 3) -> np.ndarray:
    """Spacings of similar grids from their numbers of cells, that of the finest being 1.

    Parameters
    ----------
    cells : array_like, shape (n,)
        Numbers of cells, in any order.
    dimension : {1, 2, 3}
        Directions that are refined: ``h = (N_max / N)^(1/dimension)``.

    Returns
    -------
    ndarray, shape (n,)
        In the order of `cells`.

    Raises
    ------
    TowtankError
        When a count is not positive, or the dimension is not 1, 2 or 3.
    """
    counts = np.atleast_1d(np.asarray(cells, dtype=float))
    if dimension not in (1, 2, 3):
        raise TowtankError(f"a grid of {dimension} dimensions cannot be refined", cure="give 1, 2 or 3")
    if not (np.isfinite(counts) & (counts > 0.0)).all():
        bad = counts[~(np.isfinite(counts) & (counts > 0.0))][0]
        raise TowtankError(f"a grid cannot have {bad:g} cells", cure="give the number of cells of every grid")
    return np.asarray((counts.max() / counts) ** (1.0 / dimension))


def spacings_from_ratio(count: int, ratio: float) -> np.ndarray:
    """Spacings of `count` grids that differ by one constant ratio, finest first.

    Raises
    ------
    TowtankError
        When the ratio does not exceed 1.
    """
    if not (np.isfinite(ratio) and ratio > 1.0):
        raise TowtankError(f"the refinement ratio {ratio:g} does not exceed 1", cure="give coarse over fine")
    return np.asarray(float(ratio) ** np.arange(count))


def finest_first(spacings: ArrayLike) -> np.ndarray:
    """Order of the grids from the finest to the coarsest.

    Parameters
    ----------
    spacings : array_like, shape (n,)
        Positive spacings in any unit and order.

    Returns
    -------
    ndarray of int, shape (n,)

    Raises
    ------
    TowtankError
        When a spacing is not positive, or two are the same: two results on one grid are repeats, no refinement.
    """
    h = np.atleast_1d(np.asarray(spacings, dtype=float))
    if not (np.isfinite(h) & (h > 0.0)).all():
        bad = h[~(np.isfinite(h) & (h > 0.0))][0]
        raise TowtankError(
            f"a grid cannot have the spacing {bad:g}", cure="give a positive spacing for every grid"
        )
    order = np.argsort(h, kind="stable")
    steps = h[order][1:] / h[order][:-1]
    if (steps < 1.0 + SAME_SPACING).any():
        again = h[order][1:][steps < 1.0 + SAME_SPACING][0]
        raise TowtankError(
            f"two grids have the same spacing {again:g}", cure="keep one of them, or give the one that was refined"
        )
    return np.asarray(order)


def refinement_ratios(spacings: ArrayLike) -> np.ndarray:
    """Ratios of neighbouring spacings, coarse over fine, finest pair first.

    Parameters
    ----------
    spacings : array_like, shape (n,)
        In any order.

    Returns
    -------
    ndarray, shape (n - 1,)
        r21, r32, ...

    Raises
    ------
    TowtankError
        See :func:`finest_first`.
    """
    h = np.sort(np.asarray(spacings, dtype=float)[finest_first(spacings)])
    return np.asarray(h[1:] / h[:-1])


def refinement_findings(
    spacings: ArrayLike, assumed: float | None = None, *, tolerance: float = RATIO_TOLERANCE
) -> tuple[Finding, ...]:
    """What is to be said of the ratios: other than assumed, too small.

    Parameters
    ----------
    spacings : array_like, shape (n,)
        In any order; from cell counts by :func:`spacings_from_cells`.
    assumed : float, optional
        The ratio that the study says it has.
    tolerance : float
        Share by which a ratio may differ from `assumed`.

    Returns
    -------
    tuple of Finding
        Warnings ``refinement-ratio`` and remarks ``small-refinement``; empty when all is well.
    """
    found = []
    for number, ratio in enumerate(refinement_ratios(spacings)):
        pair = f"r{number + 2}{number + 1}"
        if assumed is not None and abs(ratio / assumed - 1.0) > tolerance:
            found.append(
                Finding(
                    "refinement-ratio",
                    "warning",
                    f"{pair} is {ratio:.4g}, not the assumed {assumed:.4g}",
                    place=pair,
                    cure="use the ratio of the cell counts; orders and uncertainties of the assumed one are wrong",
                )
            )
        if ratio < SMALL_RATIO:
            found.append(
                Finding(
                    "small-refinement",
                    "info",
                    f"{pair} is {ratio:.4g}, below {SMALL_RATIO:g}: iterative and rounding errors weigh heavily",
                    place=pair,
                    cure="refine by more",
                )
            )
    return tuple(found)
