"""Simplified Ikeda roll damping (Kawahara, Maekawa and Ikeda 2009): a sample hull, component by component."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..datasets import load_table
from ..decay.ikeda import IkedaHull, ikeda_damping
from .case import Case, Paper
from .printed_numbers import ship_of

KEY = "ikeda"

_TABLE = "ikeda-sample"
_DECIMALS = 5
"""Decimals of the mantissa in the table."""


def sample_hull() -> IkedaHull:
    """Hull of the sample table; the published program takes g = 9.81."""
    ship = ship_of(_TABLE)
    return IkedaHull(
        L=ship.L,
        B=ship.B,
        d=ship.T,
        CB=0.65,
        CM=0.98,
        OG=-0.2 * ship.T,
        keel_breadth=0.025 * ship.B,
        keel_length=0.2 * ship.L,
        gravity=9.81,
    )


def cases() -> Iterator[Case]:
    """Every number of the sample table."""
    hull = sample_hull()
    printed = load_table(_TABLE, corrected=False).frame
    corrected = load_table(_TABLE).frame
    for as_printed, mended in zip(printed.to_dict("records"), corrected.to_dict("records"), strict=True):
        amplitude, reduced = float(mended["amplitude"]), float(mended["omega_hat"])
        damping = ikeda_damping(hull, math.radians(amplitude), reduced * hull.frequency_unit)
        for name in ("friction", "wave", "eddy", "bilge_keel", "total"):
            value = float(as_printed[name])
            misprint = value != mended[name]
            yield Case(
                KEY,
                f"sample hull at {amplitude:g} deg, omega_hat {reduced:g}",
                name.replace("_", " "),
                value,
                float(getattr(damping, name)[0]),
                0.5 * 10.0 ** (math.floor(math.log10(value)) - _DECIMALS),
                expected=float(mended[name]) if misprint else None,
                note="bilge keel damping is proportional to the frequency: the row at 0.6 needs 5.62218e-3"
                if misprint
                else "",
            )


PAPER = Paper(
    KEY,
    "Kawahara, Maekawa and Ikeda (2009), simplified prediction formula of roll damping by Ikeda's method",
    cases,
)
