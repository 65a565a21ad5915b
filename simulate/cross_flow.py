"""Cross-flow drag: a sectional drag coefficient integrated over the length of the hull."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import TowtankError


@dataclass(frozen=True, eq=False)
class CrossFlow:
    """Drag of each section in the cross flow ``v + x r``.

    ``Y = -0.5 rho integral of C_D(x) T(x) |v + x r| (v + x r) dx``; N with the lever x. The integral is a
    trapezoidal sum over the given stations (Hooft 1994).

    Attributes
    ----------
    stations : ndarray, shape (n,)
        x/L of the sections, ascending, positive forward of midship.
    drag : ndarray, shape (n,)
        Sectional drag coefficient C_D.
    draught : ndarray, shape (n,)
        Sectional draught over the ship's draught.
    """

    stations: np.ndarray
    drag: np.ndarray
    draught: np.ndarray

    def __post_init__(self) -> None:
        for item in ("stations", "drag", "draught"):
            object.__setattr__(self, item, np.array(getattr(self, item), dtype=float))
        count = len(self.stations)
        if count < 2 or len(self.drag) != count or len(self.draught) != count:
            raise TowtankError(
                "cross-flow drag needs a drag coefficient and a draught at each of two or more stations"
            )
        if np.any(np.diff(self.stations) <= 0.0):
            raise TowtankError("the stations of the cross-flow drag do not ascend", cure="sort them from aft")

    @classmethod
    def uniform(cls, drag: float, stations: int = 21) -> CrossFlow:
        """One drag coefficient along a hull of constant draught."""
        x = np.linspace(-0.5, 0.5, stations)
        return cls(x, np.full(stations, drag), np.ones(stations))

    def packed(self, L: float, T: float, rho: float) -> np.ndarray:
        """Flat array of x in m and 0.5 rho C_D T dx in kg/m, station by station."""
        gaps = np.diff(self.stations)
        width = np.zeros(len(self.stations))
        width[:-1] += 0.5 * gaps
        width[1:] += 0.5 * gaps
        weight = 0.5 * rho * self.drag * self.draught * T * width * L
        return np.column_stack([self.stations * L, weight]).ravel()
