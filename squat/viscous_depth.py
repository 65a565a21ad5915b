"""Viscous resistance in shallow water: form factor against depth, and the step from model to ship.

Source: Raven, 5th MASHCON 2019, equations 5, 6 and 8.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import TowtankError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

DRAUGHT_OVER_DEPTH_LIMIT = 0.5
"""Raven's law holds for T/h below this."""


def friction_line(reynolds: ArrayLike) -> np.ndarray:
    """Frictional coefficient of the ITTC 1957 line at a Reynolds number."""
    return np.asarray(0.075 / (np.log10(np.asarray(reynolds, dtype=float)) - 2.0) ** 2)


def viscous_ratio(draught: float, depth: float) -> float:
    """Viscous resistance over that in deep water, ``1 + 0.57 (T/h)**1.79``.

    Parameters
    ----------
    draught, depth : float
        In m.

    Raises
    ------
    TowtankError
        For T/h of 0.5 and more, where the law does not hold.
    """
    if not 0.0 < draught < depth:
        raise TowtankError(f"draught {draught} m and depth {depth} m leave no water under the keel")
    ratio = draught / depth
    if ratio >= DRAUGHT_OVER_DEPTH_LIMIT:
        raise TowtankError(
            f"T/h = {ratio:.3f}: the depth-dependent form factor holds below {DRAUGHT_OVER_DEPTH_LIMIT}",
            cure="measure the form factor at this depth",
        )
    return 1.0 + 0.57 * ratio**1.79


def form_factor_in_depth(deep_form_factor: float, draught: float, depth: float) -> float:
    """1+k in water of finite depth from 1+k in deep water; lengths in m. Raises as :func:`viscous_ratio`."""
    return deep_form_factor * viscous_ratio(draught, depth)


def ship_resistance_coefficient(
    model_coefficient: ArrayLike, model_reynolds: ArrayLike, ship_reynolds: ArrayLike, form_factor: float = 1.0
) -> np.ndarray:
    """Total coefficient of the smooth ship from that of the model at the same Froude number.

    Parameters
    ----------
    model_coefficient, model_reynolds, ship_reynolds : array_like, shape (n,)
    form_factor : float
        1+k at the depth of the test; 1 is Froude's way.
    """
    drop = friction_line(model_reynolds) - friction_line(ship_reynolds)
    return np.asarray(np.asarray(model_coefficient, dtype=float) - form_factor * drop)
