"""Burg's recursion: the autoregression of one series, its order by AICc."""

from __future__ import annotations

import math
import sys

import numpy as np

PATIENCE = 4
"""Orders tried in a row without a better AICc before the recursion stops."""


def burg_recursion(row: np.ndarray, max_order: int) -> tuple[np.ndarray, float]:
    """Burg's autoregression of one centred series, order by AICc.

    Parameters
    ----------
    row : ndarray, shape (m,)
        Centred series.
    max_order : int
        Highest order tried; the recursion stops earlier after four orders without a gain.

    Returns
    -------
    coefficients : ndarray, shape (p + 1,)
        Prediction-error filter of the chosen order p, first element 1.
    innovation : float
        Innovation variance.
    """
    # Compiling pays only where the compiler has been loaded for other work.
    if "numba" in sys.modules:
        from .burg_compiled import compiled_recursion

        return compiled_recursion(np.ascontiguousarray(row), max_order)
    reflections, innovation = reflections_of(row, max_order)
    coefficients = np.ones(1)
    for reflection in reflections:
        longer = np.append(coefficients, 0.0)
        coefficients = longer + reflection * longer[::-1]
    return coefficients, innovation


def reflections_of(row: np.ndarray, max_order: int) -> tuple[np.ndarray, float]:
    """Reflection coefficients up to the chosen order, and the innovation variance."""
    m = row.size
    energy = float(row @ row)
    power = energy / m
    reflections: list[float] = []
    order, innovation = 0, power
    if power > 0.0 and max_order > 0:
        criterion = m * math.log(power) + 2.0 * m / (m - 2)
        # Forward errors in the first row, backward errors in the second; dropping both ends of the flat
        # array advances the first and delays the second by one sample.
        errors, denominator = np.concatenate([row, row]), 2.0 * energy
        for p in range(1, max_order + 1):
            denominator -= float(errors[0]) ** 2 + float(errors[-1]) ** 2
            if denominator <= 1e-14 * energy:
                break
            pair = errors[1:-1].reshape(2, -1)
            reflection = -2.0 * float(pair[0] @ pair[1]) / denominator
            if not abs(reflection) < 1.0:
                break
            reflections.append(reflection)
            errors = (pair + reflection * pair[::-1]).ravel()
            denominator *= 1.0 - reflection**2
            power *= 1.0 - reflection**2
            trial = m * math.log(power) + 2.0 * m * (p + 1) / (m - p - 2)
            if trial < criterion:
                criterion, order, innovation = trial, p, power
            elif p - order >= PATIENCE:
                break
    return np.array(reflections[:order]), innovation
