"""Largest sinkage along the ship, across it, and at its corners.

A hull that sinks, trims and heels touches ground where the three add up. Along the ship the largest sinkage is that
of the bow or the stern on the centre line; across it that of the bilge at midship; the corners bound both, because no
hull is as broad at its ends as at midship. Source: full-scale measurements of container ships, 5th MASHCON 2019.
"""

from __future__ import annotations

import numpy as np

from ..core.errors import TowtankError


def longitudinal_sinkage(midship: np.ndarray, trim: np.ndarray, length: float) -> np.ndarray:
    """Larger sinkage of bow and stern in m, shape (n,).

    Parameters
    ----------
    midship : ndarray, shape (n,)
        Sinkage at midship on the centre line in m, positive down.
    trim : ndarray, shape (n,)
        Slope, positive by the bow.
    length : float
        Between perpendiculars in m.
    """
    return np.asarray(midship + 0.5 * _extent(length, "length") * np.abs(trim))


def lateral_sinkage(midship: np.ndarray, heel: np.ndarray, breadth: float) -> np.ndarray:
    """Larger sinkage of the two bilges at midship in m, shape (n,).

    Parameters
    ----------
    midship : ndarray, shape (n,)
        As in :func:`longitudinal_sinkage`.
    heel : ndarray, shape (n,)
        Slope, positive to starboard.
    breadth : float
        Of the flat bottom, or moulded to be on the safe side, in m.
    """
    return np.asarray(midship + 0.5 * _extent(breadth, "breadth") * np.abs(heel))


def corner_sinkage(
    midship: np.ndarray, trim: np.ndarray, heel: np.ndarray, length: float, breadth: float
) -> np.ndarray:
    """Largest sinkage of the four corners in m, shape (n,); arguments as in the two functions before."""
    return lateral_sinkage(longitudinal_sinkage(midship, trim, length), heel, breadth)


def _extent(size: float, what: str) -> float:
    if not size > 0.0:
        raise TowtankError(f"a {what} of {size:g} m is impossible", cure="give it in m, positive")
    return size
