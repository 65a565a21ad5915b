"""KCS planar motion at four water depths (MASHCON 2019): grid ratios, scaling, motion parameters, percentages."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ..core.ship import Ship
from ..datasets import load_table
from ..pmm.planar_motion import prescribed_motion
from ..pmm.run_types import Run
from ..pmm.standard_matrices import standard_matrix
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .grid_triplet import GridTriplet
from .rounding import spread_of

KEY = "kcs-depths"

_CUT_OFF = "the printed number is cut off, not rounded"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _grid_ratios()
    yield from _grid_changes()
    yield from _scaling()
    yield from _keel_clearances()
    yield from _motions()
    yield from _turning()
    yield from _steady_turn()


def _triplets() -> dict[str, GridTriplet]:
    grids = load_table("kcs-depth-grids").frame.set_index("grid")
    return {
        force: GridTriplet(*(float(grids.loc[name, force]) for name in ("fine", "medium", "coarse")))
        for force in ("X", "Y", "N")
    }


def _grid_ratios() -> Iterator[Case]:
    ratios = load_table("kcs-depth-grid-ratios").frame.set_index("quantity")["R_G"]
    for force, grids in _triplets().items():
        spread = spread_of(lambda *s: GridTriplet(*s).ratio, *((value, 6) for value in grids))
        note = ""
        if force == "X":
            note = (
                "the printed forces change by 1e-6 and 28e-6: no rounding of six decimals makes the ratio -0.28; "
                "it is oscillatory all the same"
            )
        yield Case(
            KEY,
            "Table 3, convergence",
            f"R_G of {force}'",
            float(ratios[force]),
            grids.ratio,
            spread + half_digit(4),
            note=note,
        )
        yield Case(KEY, "Table 3, convergence", f"behaviour of {force}'", "oscillatory", grids.behaviour)


def _grid_changes() -> Iterator[Case]:
    """The changes between grids that the text claims, over the finer grid of each pair."""
    triplets = _triplets().values()
    to_medium = [100 * abs(grids.coarse_change / grids.medium) for grids in triplets]
    to_fine = [100 * abs(grids.fine_change / grids.fine) for grids in triplets]
    # One unit of the sixth decimal is 0.06 % of N'.
    spread = max(100 * 2 * half_digit(6) / abs(grids.medium) for grids in triplets)
    for quantity, printed, computed, note in (
        ("smallest change, coarse to medium, %", 1.14, min(to_medium), ""),
        (
            "largest change, coarse to medium, %",
            3.15,
            max(to_medium),
            "N' changes by 3.5 % of the medium grid, 3.4 % of the coarse one",
        ),
        (
            "largest change, medium to fine, %",
            0.65,
            max(to_fine),
            "",
        ),
    ):
        yield Case(KEY, "text, grid changes", quantity, printed, computed, spread + half_digit(2), note=note)


def _scaling() -> Iterator[Case]:
    table = load_table("kcs-depth-particulars")
    printed = table.frame.set_index("item")
    scale = 75.5
    ship = load_ship()
    model = ship.at_scale(scale)
    exact = {"Lpp": model.L, "B": model.B, "T": model.T, "volume": model.volume}
    powers = {"Lpp": 1, "Lwl": 1, "B": 1, "D": 1, "T": 1, "volume": 3, "wetted surface": 2}
    full_decimals = {"Lpp": 0, "Lwl": 1, "B": 1, "D": 0, "T": 1, "volume": 0, "wetted surface": 0}
    for item, power in powers.items():
        full = float(printed.loc[item, "ship"])
        computed = exact.get(item) or full / scale**power
        # Dimensions of a ship are exact; the length of the waterline is the one that is given to a decimal only.
        spread = half_digit(full_decimals[item]) / scale**power if item == "Lwl" else 0.0
        yield Case(
            KEY,
            "Table 1, scale 1:75.5",
            item,
            float(printed.loc[item, "model"]),
            float(computed),
            spread + half_digit(4),
        )
    block = ship.block_coefficient
    assert block is not None
    yield Case(
        KEY, "Table 1, scale 1:75.5", "block coefficient", float(printed.loc["Cb", "ship"]), block, half_digit(3)
    )


def load_ship() -> Ship:
    """KCS at full scale with the particulars of Table 1."""
    ship = load_table("kcs-depth-particulars").ship
    assert ship is not None
    full = load_table("kcs-depth-particulars").frame.set_index("item")["ship"]
    return replace(
        ship,
        L=float(full["Lpp"]),
        B=float(full["B"]),
        T=float(full["T"]),
        volume=float(full["volume"]),
        scale=1.0,
    )
