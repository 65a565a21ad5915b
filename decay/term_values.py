"""Coefficients of the equation of motion by name, as the packed array of the compiled kernels."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..core.errors import FitError
from .damping_models import TERMS


def term_values(coefficients: Mapping[str, float]) -> np.ndarray:
    """b1, b2, b3, c1, c3, c5, shape (6,); zero where none is given.

    Raises
    ------
    FitError
        For a name that is no term.
    """
    strangers = [name for name in coefficients if name not in TERMS]
    if strangers:
        raise FitError(f"there is no term '{strangers[0]}'", cure=f"terms are {', '.join(TERMS)}")
    return np.array([coefficients.get(name, 0.0) for name in TERMS], dtype=float)


def rising_times(time: np.ndarray) -> np.ndarray:
    """Times as a contiguous array of floats.

    Raises
    ------
    FitError
        For fewer than two, or when they do not rise.
    """
    instants = np.ascontiguousarray(time, dtype=float)
    if instants.ndim != 1 or instants.size < 2 or not (np.diff(instants) > 0.0).all():
        raise FitError("the times of the record do not rise", cure="give rising times in s")
    return instants
