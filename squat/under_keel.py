"""Water under the keel: of the ship at rest, and under way with its uncertainty."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def gross_clearance(depth: ArrayLike, draught: float) -> np.ndarray:
    """Static clearance over the draught, ``(h - T)/T``, shape (n,).

    Parameters
    ----------
    depth : array_like, shape (n,)
        Depth of the water in m, tide included.
    draught : float
        At rest in m.

    Raises
    ------
    TowtankError
        When a depth or the draught is not positive.
    """
    water = _depth(depth)
    _positive(draught)
    return np.asarray((water - draught) / draught)


@dataclass(frozen=True, eq=False)
class DynamicClearance:
    """Clearance under way.

    Attributes
    ----------
    clearance : ndarray, shape (n,)
        Depth less draught less sinkage in m; negative where the ship would touch.
    uncertainty : float
        Standard uncertainty in m, the parts independent.
    bound : float
        Sum of the parts in m: all of them to the wrong side.
    draught : float
        At rest in m.
    """

    clearance: np.ndarray
    uncertainty: float
    bound: float
    draught: float

    @property
    def percent_of_draught(self) -> np.ndarray:
        """Clearance in per cent of the draught at rest, shape (n,)."""
        return 100.0 * self.clearance / self.draught

    def touches(self, factor: float = 0.0) -> np.ndarray:
        """Whether the clearance less `factor` standard uncertainties is gone, shape (n,)."""
        return np.asarray(self.clearance - factor * self.uncertainty <= 0.0)


def dynamic_clearance(
    depth: ArrayLike,
    draught: float,
    sinkage: ArrayLike,
    *,
    u_depth: float = 0.0,
    u_draught: float = 0.0,
    u_sinkage: float = 0.0,
) -> DynamicClearance:
    """Clearance of a point of the hull under way.

    Parameters
    ----------
    depth : array_like, shape (n,)
        Depth of the water in m, tide included.
    draught : float
        Of that point at rest in m, in water of the density there.
    sinkage : array_like, shape (n,)
        Of that point in m, positive down.
    u_depth, u_draught, u_sinkage : float
        Standard uncertainties in m. The water level counts once: what it errs by at the time of the record is in
        the depth and in the sinkage with opposite signs.

    Raises
    ------
    TowtankError
        When a depth or the draught is not positive, or an uncertainty is negative.
    """
    water = _depth(depth)
    _positive(draught)
    parts = (u_depth, u_draught, u_sinkage)
    if not all(part >= 0.0 for part in parts):
        raise TowtankError(f"an uncertainty of {min(parts):g} m is impossible", cure="give its size in m")
    return DynamicClearance(
        np.asarray(water - draught - np.asarray(sinkage, dtype=float)),
        float(np.sqrt(sum(part**2 for part in parts))),
        float(sum(parts)),
        draught,
    )


def _depth(depth: ArrayLike) -> np.ndarray:
    water = np.atleast_1d(np.asarray(depth, dtype=float))
    if np.any(water <= 0.0):
        raise TowtankError(
            f"a water depth of {np.nanmin(water):g} m is impossible", cure="give the depth in m, positive"
        )
    return water


def _positive(draught: float) -> None:
    if not draught > 0.0:
        raise TowtankError(f"a draught of {draught:g} m is impossible", cure="give it in m, positive")
