"""Shallow-water effects in model tests and at full scale (Raven, MASHCON 2019): overspeed, form factor, speeds."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.variables import GRAVITY
from ..squat.restricted_flow import critical_depth_froude, kreitner
from ..squat.viscous_depth import form_factor_in_depth, viscous_ratio
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_rows

KEY = "shallow-water"

_FROUDE = {
    "g020": 0.2, "g030": 0.3, "g040": 0.4, "g050": 0.5, "g0559": 0.559, "g060": 0.6, "g065": 0.65, "g070": 0.7,
}  # fmt: skip
_FERRY_DRAUGHT = 6.0
_FERRY_BLOCKAGE = 0.0386
_FERRY_DEPTH = 13.1


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _series_60()
    yield from _overspeed()
    yield from _form_factor()
    yield from _speeds()


def _series_60() -> Iterator[Case]:
    # Series 60 with CB 0.60: L/B 7.5, B/T 2.5, midship coefficient 0.977; tank 1.31 L wide, h/T 1.54
    gamma = kreitner(0.977 / (1.31 * 7.5 * 1.54), 0.559).gamma[0]
    yield Case(KEY, "Figure 1, Series 60", "overspeed in %", 11.3, 100 * (gamma - 1), 0.1)
    length_over_depth = 7.5 * 2.5 / 1.54
    yield Case(
        KEY,
        "Figure 1, Series 60",
        "depth Froude number from the Froude number 0.160",
        0.559,
        0.160 * math.sqrt(length_over_depth),
        0.0005 * math.sqrt(length_over_depth),
    )


def _overspeed() -> Iterator[Case]:
    for row in printed_rows("kreitner-overspeed"):
        case = f"equation 1, blockage {row['blockage']:.4f}"
        found = kreitner(row["blockage"], list(_FROUDE.values()))
        yield Case(
            KEY, case, "critical depth Froude number", row["critical"], found.critical, half_digit(4) * 1.01
        )
        for (column, froude), gamma in zip(_FROUDE.items(), found.gamma, strict=True):
            printed: float | str = row[column]
            computed: float | str = float(gamma)
            if math.isnan(row[column]):
                printed, computed = "no root", "no root" if math.isnan(gamma) else f"{gamma:.4f}"
            yield Case(KEY, case, f"gamma at {froude:g}", printed, computed, half_digit(4) * 1.01)


def _form_factor() -> Iterator[Case]:
    for row in printed_rows("raven-form-factors"):
        case = f"equation 8, depth {row['depth']:g} m"
        computed = form_factor_in_depth(1.22, _FERRY_DRAUGHT, row["depth"])
        measured = math.isnan(row["increase"])
        # 1.27 is measured: the law comes within 1.5 % of it
        tolerance = 0.015 * row["form_factor"] if measured else half_digit(2)
        yield Case(KEY, case, "form factor", row["form_factor"], computed, tolerance)
        if not measured:
            increase = 100 * (viscous_ratio(_FERRY_DRAUGHT, row["depth"]) - 1)
            yield Case(KEY, case, "viscous increase in %", row["increase"], increase, half_digit(0))


def _speeds() -> Iterator[Case]:
    for row in printed_rows("raven-ferry-speeds"):
        speed = row["depth_froude"] * math.sqrt(GRAVITY * row["depth"]) / KNOT
        name = f"speed in kn at depth Froude {row['depth_froude']:g}"
        yield Case(
            KEY, f"ferry, depth {row['depth']:g} m", name, row["speed"], speed, half_digit(int(row["decimals"]))
        )
    critical = critical_depth_froude(_FERRY_BLOCKAGE)[0]
    wave = math.sqrt(GRAVITY * _FERRY_DEPTH) / KNOT
    case = f"ferry, depth {_FERRY_DEPTH:g} m"
    name = "critical speed in the tank in kn (recomputed reference)"
    yield Case(KEY, case, name, 16.81, critical * wave, half_digit(2))
    root = "no root" if not kreitner(_FERRY_BLOCKAGE, 17.0 / wave).subcritical[0] else "root"
    yield Case(KEY, case, "Kreitner at 17 kn", "no root", root)


PAPER = Paper(KEY, "Raven (2019), shallow-water effects in ship model testing and at full scale", cases)
