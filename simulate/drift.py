"""Drift angle, as a compiled function that is several times faster than the library's arc tangent."""

from __future__ import annotations

import math

from .compilation import compiled


@compiled
def drift_angle(u: float, v: float) -> float:
    """``atan2(-v, u)`` in rad, to rounding.

    Ahead and with less than 33 deg of drift it is a rational function of v/u (Moshier, Cephes library, ``atan``);
    elsewhere the library's function.
    """
    if not abs(v) < 0.66 * u:
        return math.atan2(-v, u)
    x = -v / u
    z = x * x
    above = -8.750608600031904122785e-1
    above = above * z - 1.615753718733365076637e1
    above = above * z - 7.500855792314704667340e1
    above = above * z - 1.228866684490136173410e2
    above = above * z - 6.485021904942025371773e1
    below = z + 2.485846490142306297962e1
    below = below * z + 1.650270098316988542046e2
    below = below * z + 4.328810604912902668951e2
    below = below * z + 4.853903996359136964868e2
    below = below * z + 1.945506571482613964425e2
    return x + x * z * above / below
