"""Speed through the water from the speed over ground and the current: squat knows the water only."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

FASTEST_CURRENT = 6.0
"""Current in m/s above which a table is more likely in knots, or in cm/s."""


def current_along(course: ArrayLike, current_speed: ArrayLike, current_direction: ArrayLike) -> np.ndarray:
    """Part of a current along the course of the ship in m/s, positive with the ship.

    Parameters
    ----------
    course, current_direction : array_like, shape (n,)
        In rad from north; of the current where it flows to, not where it comes from.
    current_speed : array_like, shape (n,)
        In m/s, not negative.

    Raises
    ------
    TowtankError
        For a negative speed of the current: its direction is turned then.
    """
    speed = np.asarray(current_speed, dtype=float)
    if np.any(speed < 0.0):
        raise TowtankError("a current is negative", cure="give its size, and where it flows to")
    return np.atleast_1d(speed * np.cos(np.subtract(current_direction, course)))


def speed_through_water(speed_over_ground: ArrayLike, current: ArrayLike) -> np.ndarray:
    """Speed through the water in m/s, shape (n,).

    Parameters
    ----------
    speed_over_ground : array_like, shape (n,)
        In m/s.
    current : array_like, shape (n,)
        Along the course in m/s, positive with the ship. Tables of the mean over the depth are lower than the
        current that the ship meets near the surface.

    Raises
    ------
    TowtankError
        For a negative speed over ground, or a current above 6 m/s.
    """
    over_ground, along = np.asarray(speed_over_ground, dtype=float), np.asarray(current, dtype=float)
    if np.any(over_ground < 0.0):
        raise TowtankError("a speed over ground is negative", cure="give its size in m/s")
    if np.any(np.abs(along) > FASTEST_CURRENT):
        raise TowtankError(f"a current of {np.nanmax(np.abs(along)):.3g} m/s is impossible", cure="check its unit")
    return np.atleast_1d(over_ground - along)
