"""Roll equation from a record by the discrete search of the at-sea paper, which calls it reinforcement learning.

From a rough guess every coefficient may take one step up or down, or stay; of all combinations the one with the
smallest error is the next guess, until no combination is better. There is no gradient, no reduction of the step and
no statement of how sure the result is: it stops in the first hollow of its own grid. It is kept here as it is
published, to be compared with :mod:`.at_sea`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

import numpy as np

from ..core.errors import FitError

SHIP = ("b1", "b3", "c1", "c3", "c5")
EXCITATION = ("f", "we", "phase", "f0")

# Candidates times samples in one block of the evaluation.
_BLOCK = 4_000_000


@dataclass(frozen=True, eq=False)
class DiscreteSearch:
    """Where the search stopped.

    Attributes
    ----------
    values : dict of str to float
        Coefficients, SI.
    error : float
        Mean absolute misfit of the equation of motion, rad/s2.
    moves : int
        Steps taken.
    local_minimum : bool
        True when no neighbour on the grid was better; False when the moves ran out.
    """

    values: dict[str, float]
    error: float
    moves: int
    local_minimum: bool


def search_on_grid(
    time: np.ndarray,
    angle: np.ndarray,
    rate: np.ndarray,
    acceleration: np.ndarray,
    *,
    start: Mapping[str, float],
    steps: Mapping[str, float],
    unchanged: bool = True,
    most_moves: int = 2000,
) -> DiscreteSearch:
    """Greedy search over the coefficients of ``phi'' + b1 phi' + b3 phi'^3 + c1 phi + c3 phi^3 + c5 phi^5 = F(t)``.

    Parameters
    ----------
    time, angle, rate, acceleration : ndarray, shape (n,)
        Record of one oscillation, or of a free decay: s, rad, rad/s, rad/s2.
    start : mapping of str to float
        First guess of b1, b3, c1, c3, c5 and, with an excitation ``f sin(we t + phase) + f0``, of its four numbers.
    steps : mapping of str to float
        Step of each of them.
    unchanged : bool
        Whether a coefficient may stay (3^n candidates a move) or must move (2^n).
    most_moves : int

    Raises
    ------
    FitError
        For a missing guess or step, columns that do not pair, or a step that is not positive.
    """
    names = [*SHIP, *EXCITATION] if "f" in start else list(SHIP)
    missing = [name for name in names if name not in start or name not in steps]
    if missing:
        raise FitError(f"the search has no guess or step of {missing[0]}", cure=f"give {', '.join(names)}")
    width = np.array([steps[name] for name in names], dtype=float)
    if not (width > 0.0).all():
        raise FitError("a step of the search is not positive", cure="give a size for each coefficient")
    t, x, v, a = (np.asarray(column, dtype=float) for column in (time, angle, rate, acceleration))
    if not t.shape == x.shape == v.shape == a.shape:
        raise FitError("the columns of the record differ in length", cure="give time, angle, rate, acceleration")
    turns = (-1.0, 0.0, 1.0) if unchanged else (-1.0, 1.0)
    moves = np.array(list(product(turns, repeat=len(names)))) * width
    terms = np.column_stack([v, v**3, x, x**3, x**5])

    def errors(candidates: np.ndarray) -> np.ndarray:
        found = np.empty(len(candidates))
        rows = max(1, _BLOCK // t.size)
        for first in range(0, len(candidates), rows):
            block = candidates[first : first + rows]
            misfit = block[:, :5] @ terms.T + a
            if block.shape[1] > 5:
                f, we, phase, bias = block[:, 5:].T[:, :, None]
                misfit -= f * np.sin(we * t + phase) + bias
            found[first : first + rows] = np.abs(misfit).mean(axis=1)
        return found

    here = np.array([start[name] for name in names], dtype=float)
    error = float(errors(here[None, :])[0])
    taken, stuck = 0, False
    while taken < most_moves:
        candidates = here + moves
        tried = errors(candidates)
        best = int(np.argmin(tried))
        if not tried[best] < error:
            stuck = True
            break
        here, error = candidates[best], float(tried[best])
        taken += 1
    return DiscreteSearch(dict(zip(names, here.tolist())), error, taken, stuck)
