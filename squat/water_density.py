"""Change of draught with the density of the water: a ship that leaves a river rises, and that is no squat."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

DENSITY_RANGE = (990.0, 1050.0)
"""Densities of river and sea water in kg/m3."""


def density_sinkage(volume: float, waterplane_area: float, rho_reference: float, rho: ArrayLike) -> np.ndarray:
    """Sinkage in m, positive down, that another density of the water brings: ``volume/Aw (rho0/rho - 1)``.

    Parameters
    ----------
    volume : float
        Displaced volume in m3 in water of `rho_reference`.
    waterplane_area : float
        In m2; taken as that of the whole change of draught.
    rho_reference : float
        Density in kg/m3 of the water that the draught was read in.
    rho : array_like, shape (n,)
        Density under way in kg/m3.

    Raises
    ------
    TowtankError
        For a volume or area that is not positive, or a density that water does not have.
    """
    if not (volume > 0.0 and waterplane_area > 0.0):
        raise TowtankError(
            f"a volume of {volume:g} m3 on a waterplane of {waterplane_area:g} m2 is impossible",
            cure="give both in SI",
        )
    here = np.atleast_1d(np.asarray(rho, dtype=float))
    low, high = DENSITY_RANGE
    for value in (rho_reference, *here[~((here >= low) & (here <= high))][:1]):
        if not low <= value <= high:
            raise TowtankError(
                f"{value:g} kg/m3 is no density of water", cure=f"give it in kg/m3, {low:g} to {high:g}"
            )
    return np.asarray(volume / waterplane_area * (rho_reference / here - 1.0))
