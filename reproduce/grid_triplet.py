"""Results on three systematically refined grids: ratio, order, grid convergence index."""

from __future__ import annotations

import math
from typing import NamedTuple


class GridTriplet(NamedTuple):
    """One result on three grids.

    Attributes
    ----------
    fine, medium, coarse : float
    """

    fine: float
    medium: float
    coarse: float

    @property
    def fine_change(self) -> float:
        """eps21: medium less fine."""
        return self.medium - self.fine

    @property
    def coarse_change(self) -> float:
        """eps32: coarse less medium."""
        return self.coarse - self.medium

    @property
    def ratio(self) -> float:
        """Convergence ratio R: 0 to 1 is monotonic, below 0 oscillatory, beyond 1 in size divergent."""
        return self.fine_change / self.coarse_change

    @property
    def behaviour(self) -> str:
        """Monotonic, oscillatory or divergent, from :attr:`ratio` (Stern 2001)."""
        if abs(self.ratio) >= 1:
            return "divergent"
        return "monotonic" if self.ratio > 0 else "oscillatory"

    def order(self, refinement: float) -> float:
        """Observed order p for a constant refinement ratio, of a monotonic triplet."""
        return math.log(self.coarse_change / self.fine_change) / math.log(refinement)

    def convergence_index(self, refinement: float, factor: float = 1.25) -> float:
        """Grid convergence index of the fine grid as an absolute value, ``factor |eps21| / (r^p - 1)``."""
        return factor * abs(self.fine_change) / (refinement ** self.order(refinement) - 1.0)
