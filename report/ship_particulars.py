"""Particulars of a ship as rows of a page."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ..core.ship import Ship
from .typography import significant

Particular = tuple[str, float | None, str]
"""Name, value where it is known, unit."""


def particulars(ships: Sequence[Ship], more: Sequence[Particular] = ()) -> list[tuple[str, str, str]]:
    """Particulars of the ship of some runs as (name, value, unit); `ships` differ in water depth alone.

    `more` are particulars that not every page shows.
    """
    ship = ships[0]
    scale = "full scale" if ship.scale == 1 else f"1:{ship.scale:g}"
    rows = [("Ship", ship.name, ""), ("Scale", scale, "")]
    numbers: list[Particular] = [
        ("Length L", ship.L, "m"),
        ("Breadth B", ship.B, "m"),
        ("Draught T", ship.T, "m"),
        ("Mass", ship.displacement_mass, "kg"),
        ("Centre of gravity xG", ship.xG, "m"),
        ("Yaw inertia Izz", ship.yaw_inertia, "kg m²"),
        ("Water density ρ", ship.rho, "kg/m³"),
        *more,
    ]
    rows += [(name, significant(value, 4), unit) for name, value, unit in numbers if value is not None]
    ratios = sorted({ship.depth_ratio for ship in ships})
    depths = ", ".join("deep" if math.isinf(ratio) else f"{ratio:.3g}" for ratio in ratios)
    return [*rows, ("Depth over draught h/T", depths, "")]
