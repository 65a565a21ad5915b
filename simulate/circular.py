"""Sine and cosine together, as a compiled function that costs a quarter of the library's two."""

from __future__ import annotations

import math

from .compilation import compiled

_LARGEST = 1e5
"""Angle in rad up to which three parts of pi/2 reduce the argument to rounding."""


@compiled
def sine_and_cosine(angle: float) -> tuple[float, float]:
    """Sine and cosine of an angle in rad, to rounding (Moshier, Cephes library, ``sin`` and ``cos``)."""
    if not abs(angle) < _LARGEST:
        return math.sin(angle), math.cos(angle)
    quarter = math.floor(angle * 0.6366197723675814 + 0.5)
    x = angle - quarter * 1.57079625129699707031
    x -= quarter * 7.54978941586159635335e-8
    x -= quarter * 5.39030252995776476554e-15
    z = x * x
    odd = 1.58962301576546568060e-10
    odd = odd * z - 2.50507477628578072866e-8
    odd = odd * z + 2.75573136213857245213e-6
    odd = odd * z - 1.98412698295895385996e-4
    odd = odd * z + 8.33333333332211858878e-3
    odd = odd * z - 1.66666666666666307295e-1
    sine = x + x * z * odd
    even = -1.13585365213876817300e-11
    even = even * z + 2.08757008419747316778e-9
    even = even * z - 2.75573141792967388112e-7
    even = even * z + 2.48015872888517045348e-5
    even = even * z - 1.38888888888730564116e-3
    even = even * z + 4.16666666666665929218e-2
    cosine = 1.0 - 0.5 * z + z * z * even
    quadrant = quarter - 4.0 * math.floor(0.25 * quarter)
    if quadrant == 0.0:
        return sine, cosine
    if quadrant == 1.0:
        return cosine, -sine
    if quadrant == 2.0:
        return -sine, -cosine
    return -cosine, sine
