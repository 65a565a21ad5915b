"""Repeated measurements of one quantity: mean, scatter and Student-t interval; how often intervals cover a value."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Repeats:
    """Repeated runs of one condition.

    Attributes
    ----------
    mean, sd, se : float
        Mean, standard deviation between runs (n - 1), and standard error of the mean, sd / sqrt(n).
    n : int
        Runs.
    half_width : float
        Half the Student-t interval of the mean at `level`, with n - 1 degrees of freedom.
    single_half_width : float
        Half the interval that one further run falls into, at `level`.
    level : float
    """

    mean: float
    sd: float
    se: float
    n: int
    half_width: float
    single_half_width: float
    level: float

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper limit of the mean."""
        return self.mean - self.half_width, self.mean + self.half_width


def pooled_repeats(values: ArrayLike, level: float = 0.95) -> Repeats:
    """Mean of repeated runs with its Student-t interval.

    The scatter is that between the runs, whatever the standard error inside each: a bias of a run (ballast,
    waiting time) shows between runs only.

    Parameters
    ----------
    values : array_like, shape (n,)
        One value a run.
    level : float
        Probability of the interval.

    Raises
    ------
    TowtankError
        With fewer than two runs, or a value that is not finite.
    """
    from scipy.special import stdtrit

    x = np.asarray(values, dtype=float).ravel()
    if x.size < 2:
        raise TowtankError(f"{x.size} run(s) have no repeatability", cure="give at least two repeats")
    if not np.isfinite(x).all():
        raise TowtankError(
            f"run {int(np.flatnonzero(~np.isfinite(x))[0]) + 1} has no value", cure="leave failed runs out"
        )
    if not 0.0 < level < 1.0:
        raise TowtankError(f"the level {level:g} is no probability", cure="give one between 0 and 1")
    factor = float(stdtrit(x.size - 1, 0.5 + 0.5 * level))
    sd = float(x.std(ddof=1))
    se = sd / float(np.sqrt(x.size))
    single = factor * sd * float(np.sqrt(1.0 + 1.0 / x.size))
    return Repeats(float(x.mean()), sd, se, int(x.size), factor * se, single, level)


def coverage(lower: ArrayLike, upper: ArrayLike, truth: ArrayLike) -> float:
    """Share of intervals that hold the value they are for.

    Parameters
    ----------
    lower, upper, truth : array_like, shape (n,)
        Limits and the true (or measured) values; a NaN leaves its row out. `truth` may be one value.

    Returns
    -------
    float
        NaN when no row is complete.

    Raises
    ------
    TowtankError
        When a lower limit exceeds its upper limit.
    """
    low, high, value = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (lower, upper, truth)))
    if np.any(low > high):
        raise TowtankError("a lower limit exceeds its upper limit", cure="swap the limits")
    known = np.isfinite(low) & np.isfinite(high) & np.isfinite(value)
    inside = (low[known] <= value[known]) & (value[known] <= high[known])
    return float(inside.mean()) if inside.size else float("nan")
