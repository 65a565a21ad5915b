"""How far the rounding of printed numbers can move what is computed from them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np


def rounding_spread(
    function: Callable[[np.ndarray], np.ndarray | float],
    values: Sequence[float] | np.ndarray,
    half_steps: Sequence[float] | np.ndarray | float,
) -> np.ndarray:
    """Largest change of a result when every printed number may lie anywhere within its rounding.

    Parameters
    ----------
    function : callable
        Result, shape (m,) or a number, of the printed numbers, shape (n,).
    values : array_like, shape (n,)
        The numbers as printed.
    half_steps : array_like, shape (n,), or float
        Half a unit of the last printed digit of each; 0 for numbers that are exact.

    Returns
    -------
    ndarray, shape (m,)
        Sum over the numbers of the larger change that half a step up or down makes: the worst case to first
        order, which rounding alone cannot exceed by more than products of half steps.
    """
    x = np.asarray(values, dtype=float)
    steps = np.broadcast_to(np.asarray(half_steps, dtype=float), x.shape)
    base = np.atleast_1d(np.asarray(function(x), dtype=float))
    total = np.zeros_like(base)
    for place in np.flatnonzero(steps):
        change = np.zeros_like(base)
        for sign in (1.0, -1.0):
            moved = x.copy()
            moved[place] += sign * steps[place]
            change = np.maximum(change, np.abs(np.atleast_1d(np.asarray(function(moved), dtype=float)) - base))
        total += change
    return total


def spread_of(function: Callable[..., float], *numbers: tuple[float, int]) -> float:
    """:func:`rounding_spread` of a number that is computed from a few printed ones.

    Parameters
    ----------
    function : callable
        Takes the numbers one by one.
    *numbers : (float, int)
        Each number with the decimals that are printed of it.
    """
    values = [value for value, _ in numbers]
    steps = [0.5 * 10.0**-decimals for _, decimals in numbers]
    return float(rounding_spread(lambda x: function(*x), values, steps)[0])
