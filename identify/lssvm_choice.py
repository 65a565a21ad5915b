"""Choice of gamma and sigma: every point of a grid, then a compass search from the best one."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import FitError

if TYPE_CHECKING:
    import pandas as pd

Criterion = Literal["loo", "gcv"]
Score = Callable[[float, np.ndarray], np.ndarray]
_FINEST = 1.02
# Scores this close, relatively, are equal; then the smaller gamma and the wider kernel are better.
_EQUAL = 1e-6


@dataclass(frozen=True, eq=False)
class LSSVMChoice:
    """Chosen gamma and sigma.

    Attributes
    ----------
    gamma, sigma : float
        sigma is nan for a kernel without width.
    score : float
        Root of the criterion there, in the unit of the response.
    edges : tuple of str
        ``gamma`` or ``sigma`` where the best value lies on the edge of its candidates, so that a wider range
        might have a better one.
    tried : DataFrame
        Columns ``sigma, gamma, score`` of all that were tried, in order.
    """

    gamma: float
    sigma: float
    score: float
    edges: tuple[str, ...]
    tried: pd.DataFrame


def checked_gammas(gammas: Sequence[float] | np.ndarray) -> np.ndarray:
    """Candidates in ascending order.

    Raises
    ------
    FitError
        If there is none, or one is not a positive number.
    """
    values = np.unique(np.asarray(gammas, dtype=float).reshape(-1))
    if values.size == 0 or not (np.isfinite(values).all() and (values > 0.0).all()):
        shown = ", ".join(f"{value:g}" for value in values if not value > 0.0 or math.isinf(value)) or "none"
        raise FitError(f"gamma is not positive: {shown}", cure="use a gamma above 0")
    return values


def choose_gamma_sigma(
    score: Score,
    gammas: Sequence[float] | np.ndarray,
    sigmas: Sequence[float] | np.ndarray,
    *,
    refine: bool = True,
) -> LSSVMChoice:
    """Best of a grid, refined by a compass search with halving steps within the range of the grid.

    Parameters
    ----------
    score : callable
        ``score(sigma, gammas)``: criterion of each gamma (g,), inf where it cannot be judged.
    gammas, sigmas : sequences of float
        Candidates; a single one is held fixed.
    refine : bool
        Search between the points of the grid, to 2 %. Scores that differ by less than 1e-6 of their size count as
        equal, and the smoother function (smaller gamma, wider kernel) is taken.

    Raises
    ------
    FitError
        If a candidate is not positive, or none can be judged.
    """
    import pandas as pd

    gamma_grid = checked_gammas(gammas)
    sigma_grid = np.unique(np.asarray(sigmas, dtype=float).reshape(-1))
    if sigma_grid.size == 0 or (sigma_grid <= 0.0).any() or np.isinf(sigma_grid).any():
        raise FitError("a sigma is not positive", cure="use a sigma above 0")
    tried: list[tuple[float, float, float]] = []

    def best_of(candidates: np.ndarray, sigma: float) -> tuple[float, float, float]:
        values = score(sigma, candidates)
        tried.extend((sigma, float(g), float(s)) for g, s in zip(candidates, values))
        k = int(np.argmax(values <= values.min() * (1.0 + _EQUAL)))
        return float(values[k]), float(candidates[k]), sigma

    best = _widest([best_of(gamma_grid, float(sigma)) for sigma in sigma_grid])
    if not math.isfinite(best[0]):
        raise FitError(
            "no gamma and sigma can be judged: every one lets rows or runs determine their own fit",
            cure="use smaller gammas or wider kernels, or add data",
        )
    if refine and gamma_grid.size * sigma_grid.size > 1:
        best = _compass(best_of, best, gamma_grid, sigma_grid)
    edges = tuple(
        name
        for name, value, grid in (("gamma", best[1], gamma_grid), ("sigma", best[2], sigma_grid))
        if grid.size > 1 and (value <= grid[0] * _FINEST or value >= grid[-1] / _FINEST)
    )
    frame = pd.DataFrame(tried, columns=["sigma", "gamma", "score"])
    return LSSVMChoice(best[1], best[2], best[0], edges, frame)


def _widest(found: list[tuple[float, float, float]]) -> tuple[float, float, float]:
    """Best of (score, gamma, sigma) in order of sigma; the last of equals."""
    limit = min(found)[0] * (1.0 + _EQUAL)
    return [item for item in found if item[0] <= limit][-1]


def _compass(
    best_of: Callable[[np.ndarray, float], tuple[float, float, float]],
    best: tuple[float, float, float],
    gamma_grid: np.ndarray,
    sigma_grid: np.ndarray,
) -> tuple[float, float, float]:
    def spacing(grid: np.ndarray) -> float:
        return float((grid[-1] / grid[0]) ** (0.5 / (grid.size - 1))) if grid.size > 1 else 1.0

    gamma_step, sigma_step = spacing(gamma_grid), spacing(sigma_grid)
    while max(gamma_step, sigma_step) > _FINEST:
        around = best[1] * np.array([1.0 / gamma_step, 1.0, gamma_step])
        around = np.unique(np.clip(around, gamma_grid[0], gamma_grid[-1]))
        neighbours = {best[2]}
        if sigma_grid.size > 1:
            neighbours |= {max(best[2] / sigma_step, sigma_grid[0]), min(best[2] * sigma_step, sigma_grid[-1])}
        found = _widest([best_of(around, sigma) for sigma in sorted(neighbours)])
        if found[0] < best[0] * (1.0 - _EQUAL):
            best = found
        else:
            gamma_step, sigma_step = math.sqrt(gamma_step), math.sqrt(sigma_step)
    return best
