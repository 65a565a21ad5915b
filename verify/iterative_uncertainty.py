"""Uncertainty of a value that an iteration has not quite reached: ITTC 7.5-03-01-01, section 4.

The end of the history is read as one of four kinds: oscillating about a level, approaching it steadily, both, or
drifting without approach. The first has the uncertainty ``(S_U - S_L)/2`` of its limits, the second the
distance to the limit of the geometric series that the changes form, the last none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from ..core.errors import TowtankError
from .grid_triplet import EQUAL

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

IterativeBehaviour = Literal["constant", "oscillatory", "convergent", "mixed", "drifting"]

SHORTEST = 12
"""Iterations below which nothing can be said."""


@dataclass(frozen=True)
class IterativeUncertainty:
    """What the end of an iteration says.

    Attributes
    ----------
    value : float
        Mean of the limits when it oscillates, else the last value.
    uncertainty : float
        Half-width U_I in the unit of the value; NaN when the iteration drifts.
    behaviour : str
    lower, upper : float
        Limits S_L and S_U of the end of the history.
    note : str
    """

    value: float
    uncertainty: float
    behaviour: IterativeBehaviour
    lower: float
    upper: float
    note: str = ""


def iterative_limits(upper: float, lower: float) -> IterativeUncertainty:
    """From the limits that a paper prints: the mean ``(S_U + S_L)/2`` and the uncertainty ``(S_U - S_L)/2``.

    Raises
    ------
    TowtankError
        When the lower limit exceeds the upper one.
    """
    if lower > upper:
        raise TowtankError(f"the lower limit {lower:g} exceeds the upper one {upper:g}", cure="swap them")
    return IterativeUncertainty(0.5 * (upper + lower), 0.5 * (upper - lower), "oscillatory", lower, upper)


def iterative_uncertainty(history: ArrayLike, *, share: float = 0.5) -> IterativeUncertainty:
    """Uncertainty of the last value of an iteration.

    Parameters
    ----------
    history : array_like, shape (n,)
        Value after each iteration (or time step of a march to a steady state).
    share : float
        Share of the history, at its end, that counts.

    Raises
    ------
    TowtankError
        When fewer than 12 iterations count, or a value is missing (a diverged solver).
    """
    s = np.asarray(history, dtype=float).ravel()
    if not np.isfinite(s).all():
        bad = int(np.flatnonzero(~np.isfinite(s))[0]) + 1
        raise TowtankError(
            f"iteration {bad} has no value", cure="the solver diverged there; cut the history before it"
        )
    if not 0.0 < share <= 1.0:
        raise TowtankError(f"the share {share:g} is not between 0 and 1", cure="0.5 counts the second half")
    end = s[s.size - math.floor(share * s.size) :]
    if end.size < SHORTEST:
        raise TowtankError(
            f"{end.size} iterations say nothing of convergence", cure=f"give {SHORTEST} or more at the end"
        )
    low, high = float(end.min()), float(end.max())
    if high - low <= EQUAL * max(abs(low), abs(high)):
        return IterativeUncertainty(float(end[-1]), 0.0, "constant", low, high, "no change at the end")
    turns = _turns(end)
    if turns >= 4:
        return _oscillating(end)
    return _approaching(end, low, high, turns)


def _turns(end: np.ndarray) -> int:
    steps = np.sign(np.diff(end))
    steps = steps[steps != 0.0]
    return int(np.count_nonzero(steps[1:] != steps[:-1]))


def _oscillating(end: np.ndarray) -> IterativeUncertainty:
    """Limits of the second half; falling limits over a moving mean are a mixed approach."""
    half = end.size // 2
    first, last = end[:half], end[half:]
    low, high = float(last.min()), float(last.max())
    middle = 0.5 * (low + high)
    size = 0.5 * (high - low)
    moved = abs(0.5 * (float(first.min()) + float(first.max())) - middle)
    if moved > 0.25 * size:
        note = f"oscillates about a level that still moves: by {moved:.3g} between the halves of the end"
        return IterativeUncertainty(middle, size + moved, "mixed", low, high, note)
    return IterativeUncertainty(middle, size, "oscillatory", low, high, "half the distance of the limits")


def _approaching(end: np.ndarray, low: float, high: float, turns: int) -> IterativeUncertainty:
    """Limit of the geometric series of the changes over three equal stretches."""
    third = (end.size - 1) // 3
    a, b, c, d = end[[-1 - 3 * third, -1 - 2 * third, -1 - third, -1]].tolist()
    first, second, last = b - a, c - b, d - c
    if turns == 0 and second * last > 0.0 and first * second > 0.0:
        share = max(abs(last / second), abs(second / first))
        if share < 1.0:
            left = abs(last) * share / (1.0 - share)
            note = f"approaches steadily; changes fall by {share:.3g} from third to third of the end"
            return IterativeUncertainty(d, left, "convergent", low, high, note)
    if turns:
        return IterativeUncertainty(
            0.5 * (low + high),
            0.5 * (high - low),
            "mixed",
            low,
            high,
            "few oscillations: half the range of the end",
        )
    return IterativeUncertainty(
        d, math.nan, "drifting", low, high, "the changes do not become smaller: the iteration has not converged"
    )
