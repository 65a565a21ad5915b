"""Routh-Hurwitz: whether all roots of a polynomial lie left of the imaginary axis, without finding them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..core.errors import TowtankError


def routh_column(coefficients: Sequence[float] | np.ndarray) -> np.ndarray:
    """First column of the Routh array.

    Parameters
    ----------
    coefficients : array_like, shape (n + 1,)
        Of a polynomial of degree n, highest power first; the first is not 0.

    Returns
    -------
    ndarray, shape (n + 1,)
        The number of its sign changes is the number of roots in the right half plane. From the first zero on,
        where the array cannot be continued, it holds zeros.

    Raises
    ------
    TowtankError
        When there is no polynomial.
    """
    polynomial = np.asarray(coefficients, dtype=float)
    if polynomial.ndim != 1 or len(polynomial) < 2 or polynomial[0] == 0.0 or not np.isfinite(polynomial).all():
        raise TowtankError(
            f"no polynomial in {polynomial.tolist()}",
            cure="give its coefficients from the highest power, which is not 0, down",
        )
    degree = len(polynomial) - 1
    width = degree // 2 + 2
    above, row = np.zeros(width), np.zeros(width)
    above[: len(polynomial[::2])] = polynomial[::2]
    row[: len(polynomial[1::2])] = polynomial[1::2]
    column = np.zeros(degree + 1)
    column[:2] = above[0], row[0]
    for place in range(2, degree + 1):
        if row[0] == 0.0:
            break
        below = np.zeros(width)
        below[:-1] = above[1:] - above[0] / row[0] * row[1:]
        above, row = row, below
        column[place] = row[0]
    return column


def is_hurwitz(coefficients: Sequence[float] | np.ndarray) -> bool:
    """True when every root has a negative real part (Routh 1877, Hurwitz 1895).

    Parameters
    ----------
    coefficients : array_like, shape (n + 1,)
        Highest power first.
    """
    column = routh_column(coefficients)
    return bool(np.all(column > 0.0) or np.all(column < 0.0))
