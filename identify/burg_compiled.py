"""Burg's recursion in compiled code, the twin of :func:`.burg.burg_recursion` in plain Python."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .burg import PATIENCE


@njit(cache=True, nogil=True, error_model="numpy")
def compiled_recursion(row: np.ndarray, max_order: int) -> tuple[np.ndarray, float]:
    """Prediction-error filter of the chosen order and innovation variance; see :func:`.burg.burg_recursion`."""
    m = row.size
    energy = 0.0
    for value in row:
        energy += value * value
    power = energy / m
    reflections = np.empty(max(max_order, 0))
    order, innovation = 0, power
    if not (power > 0.0 and max_order > 0):
        return np.ones(1), innovation
    criterion = m * math.log(power) + 2.0 * m / (m - 2)
    forward, backward = row.copy(), row.copy()
    denominator = 2.0 * energy
    for p in range(1, max_order + 1):
        # Errors that belong together: forward of sample i, backward of the sample before it.
        denominator -= forward[p - 1] ** 2 + backward[m - p] ** 2
        if denominator <= 1e-14 * energy:
            break
        product = 0.0
        for i in range(p, m):
            product += forward[i] * backward[i - p]
        reflection = -2.0 * product / denominator
        if not abs(reflection) < 1.0:
            break
        reflections[p - 1] = reflection
        for i in range(p, m):
            ahead, back = forward[i], backward[i - p]
            forward[i] = ahead + reflection * back
            backward[i - p] = back + reflection * ahead
        denominator *= 1.0 - reflection**2
        power *= 1.0 - reflection**2
        trial = m * math.log(power) + 2.0 * m * (p + 1) / (m - p - 2)
        if trial < criterion:
            criterion, order, innovation = trial, p, power
        elif p - order >= PATIENCE:
            break
    coefficients = np.zeros(order + 1)
    coefficients[0] = 1.0
    for p in range(1, order + 1):
        # Levinson: both ends of the filter at once, then the middle.
        reflection = reflections[p - 1]
        for i in range(p // 2 + 1):
            ahead, back = coefficients[i], coefficients[p - i]
            coefficients[i] = ahead + reflection * back
            coefficients[p - i] = back + reflection * ahead
    return coefficients, innovation
