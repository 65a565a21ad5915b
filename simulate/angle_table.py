"""Force coefficients over an angle from 0 to 180 degrees, mirrored to the other side of a symmetric ship."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

_SAME = 1e-9
"""Angles in rad, and shares of a column's size, below which two numbers are the same."""


@dataclass(frozen=True, eq=False)
class AngleTable:
    """Columns over an angle, periodic, each even or odd in the angle.

    Between the angles a column is the monotone cubic through its values (Fritsch and Carlson 1980): continuous in
    its first derivative and never outside the two values beside it.

    Attributes
    ----------
    angles : ndarray, shape (n,)
        Ascending from 0 to pi, rad.
    values : ndarray, shape (n, columns)
    odd : tuple of bool
        Columns that change sign between port and starboard; they vanish at 0 and pi.
    names : tuple of str
        Of the columns, for messages.
    """

    angles: np.ndarray
    values: np.ndarray
    odd: tuple[bool, ...]
    names: tuple[str, ...]

    def __post_init__(self) -> None:
        angles, values = np.array(self.angles, dtype=float), np.array(self.values, dtype=float)
        if angles.ndim != 1 or values.shape != (len(angles), len(self.odd)):
            raise ReadError(f"{len(self.odd)} columns over {angles.shape} angles have values {values.shape}")
        if not (np.isfinite(angles).all() and np.isfinite(values).all()):
            raise ReadError("a table over the angle has empty cells", cure="fill each row or take it out")
        if len(angles) < 3 or np.any(np.diff(angles) <= 0):
            raise ReadError("the angles of a table do not ascend", cure="sort the rows, name each angle once")
        if abs(angles[0]) > _SAME or abs(angles[-1] - math.pi) > _SAME:
            raise ReadError(
                f"the angles run from {math.degrees(angles[0]):g} to {math.degrees(angles[-1]):g} deg",
                cure="give one side of the ship, from 0 to 180 deg; the other side is its mirror image",
            )
        angles[0], angles[-1] = 0.0, math.pi
        for column in np.flatnonzero(self.odd):
            ends = values[[0, -1], column]
            if np.abs(ends).max() > 1e-3 * np.abs(values[:, column]).max(initial=0.0):
                raise ReadError(
                    f"{self.names[column]} is {ends[0]:g} at 0 deg and {ends[1]:g} at 180 deg",
                    cure="a ship with port-starboard symmetry has 0 there; check the columns",
                )
            values[[0, -1], column] = 0.0
        angles.setflags(write=False)
        values.setflags(write=False)
        object.__setattr__(self, "angles", angles)
        object.__setattr__(self, "values", values)

    @cached_property
    def _mirror(self) -> np.ndarray:
        return np.where(self.odd, -1.0, 1.0)

    @cached_property
    def _curve(self) -> PchipInterpolator:
        """Monotone cubic through the table and its mirror images on both sides."""
        from scipy.interpolate import PchipInterpolator

        mirror = self._mirror
        before, after = -self.angles[:0:-1], 2.0 * math.pi - self.angles[-2::-1]
        angles = np.concatenate([before, self.angles, after])
        values = np.concatenate([mirror * self.values[:0:-1], self.values, mirror * self.values[-2::-1]])
        return PchipInterpolator(angles, values)

    def at(self, angle: np.ndarray | float) -> np.ndarray:
        """Columns at any angle in rad.

        Returns
        -------
        ndarray, shape (..., columns)
        """
        wrapped = np.remainder(np.asarray(angle, dtype=float) + math.pi, 2.0 * math.pi) - math.pi
        # Only between 0 and pi has the curve neighbours on both sides.
        side = np.where(wrapped[..., None] < 0.0, self._mirror, 1.0)
        return np.asarray(side * self._curve(np.abs(wrapped)))

    def packed(self, units: np.ndarray | float = 1.0) -> np.ndarray:
        """Flat array for the compiled functions, each column times its unit (layout: ``environment_layout``)."""
        slopes = self._curve.derivative()(self.angles) * units
        values = self.values * units
        columns = [part for value, slope in zip(values.T, slopes.T, strict=True) for part in (value, slope)]
        return np.concatenate([[float(len(self.angles))], self.angles, *columns])
