"""S-175 turning in deep and shallow water: the derivatives against Son and Nomoto, errors, depth corrections."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from ..datasets import load_set
from ..verify import relative_errors
from .case import Case, Paper, half_digit
from .printed_numbers import printed_rows
from .rounding import spread_of
from .s175_turning import turning_cases

KEY = "s175"

_SOURCE_DECIMALS = {
    "Xudot": 6, "Yvdot": 6, "Nrdot": 6, "Xuu": 7, "Xvv": 5, "Xvr": 5, "Xrr": 5,
    "Yv": 4, "Yr": 5, "Yvvv": 3, "Yvvr": 4, "Yvrr": 4, "Yrrr": 5,
    "Nv": 7, "Nr": 5, "Nvvv": 6, "Nvvr": 4, "Nvrr": 5, "Nrrr": 5,
}  # fmt: skip
"""Decimals that Son and Nomoto's set is printed with."""

_PRINTED_NAMES = {"Xudot": "mx'", "Yvdot": "my'", "Nrdot": "JN'", "Xuu": "a0"}
"""What the paper prints for these terms; the added masses with the opposite sign."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _scaling()
    yield from _turning_errors()
    yield from _added_masses_in_shallow_water()
    yield from _depth_multipliers()
    yield from turning_cases(KEY)


def _scaling() -> Iterator[Case]:
    """Son and Nomoto's set in L^2 scaling times L/d = 18.42 is Table 2, but for one misprint."""
    printed = load_set("s175", corrected=False)
    corrected = load_set("s175")
    # Their ship is described at a draught of 8.5 m; the paper scales with 9.5 m.
    source = replace(load_set("s175-son-nomoto"), ship=printed.ship).to("lt")
    factor = printed.ship.L / printed.ship.T
    for name, decimals in _SOURCE_DECIMALS.items():
        sign = -1.0 if name in ("Xudot", "Yvdot", "Nrdot") else 1.0
        misprint = corrected[name] != printed[name]
        yield Case(
            KEY,
            "Table 2 from Son and Nomoto (1981)",
            _PRINTED_NAMES.get(name, name),
            sign * printed[name],
            sign * source[name],
            factor * half_digit(decimals) + half_digit(4),
            expected=sign * corrected[name] if misprint else None,
            note="misprint: the decimal point has moved by one place" if misprint else "",
        )


def _turning_errors() -> Iterator[Case]:
    for row in printed_rows("s175-turning"):
        printed = row["error"]
        decimals = 2 if printed == -2.07 else 3
        spread = spread_of(
            lambda s, d: float(relative_errors([s], [d]).s_minus_d[0]),
            (row["simulated"], 3),
            (row["measured"], 3),
        )
        yield Case(
            KEY,
            f"Tables 3, 4, 6 and 7, {row['derivatives']}",
            f"error of the {row['quantity']}, {row['turn']}, %",
            printed,
            float(relative_errors([row["simulated"]], [row["measured"]]).s_minus_d[0]),
            spread + half_digit(decimals),
        )


def _added_masses_in_shallow_water() -> Iterator[Case]:
    """Table 5, h/d = 1.2, from the deep values by Li and Wu (1990)."""
    deep, shallow = load_set("s175-regression"), load_set("s175-regression-shallow")
    ship = shallow.ship
    clearance = ship.depth_ratio - 1.0
    breadth, length = ship.B / ship.T, ship.L / ship.T
    block = 0.572
    surge, lateral = clearance**1.3, clearance**0.82
    multipliers = {
        "Xudot": (surge + 3.77 + 1.14 * breadth - 0.233 * length - 3.43 * block) / surge,
        "Yvdot": (lateral + 0.413 + 0.032 * breadth + 0.0129 * breadth**2) / lateral,
        "Nrdot": (lateral + 0.413 + 0.0192 * breadth + 0.00554 * breadth**2) / lateral,
    }
    for name, multiplier in multipliers.items():
        yield Case(
            KEY,
            "Table 5, Li and Wu (1990)",
            f"{_PRINTED_NAMES[name]} at h/d = 1.2",
            -shallow[name],
            -multiplier * deep[name],
            (1.0 + multiplier) * half_digit(5),
        )


def _depth_multipliers() -> Iterator[Case]:
    """Relations between the multipliers of Table 5 (Ankudinov): fY = 3/2 fN - 1/2, quadratic 9/4 fN - 5/4."""
    deep, shallow = load_set("s175-regression", corrected=False), load_set("s175-regression-shallow")
    mended = load_set("s175-regression")
    numbers = (deep["Nv"], 5), (shallow["Nv"], 5)

    def sway(nv: float, nv_shallow: float) -> float:
        return deep["Yv"] * (1.5 * nv_shallow / nv - 0.5)

    def quadratic_sway(nv: float, nv_shallow: float) -> float:
        return mended["Yv|v|"] * (2.25 * nv_shallow / nv - 1.25)

    def quadratic_yaw(nv: float, nv_shallow: float) -> float:
        return shallow["Nv|v|"] / (2.25 * nv_shallow / nv - 1.25)

    yield Case(
        KEY,
        "Table 5, depth multipliers",
        "Yv at h/d = 1.2 from the multiplier of Nv",
        shallow["Yv"],
        sway(deep["Nv"], shallow["Nv"]),
        spread_of(sway, *numbers) + (1.0 + shallow["Yv"] / deep["Yv"]) * half_digit(5),
    )
    yield Case(
        KEY,
        "Table 5, depth multipliers",
        "Yv|v| at h/d = 1.2 from the multiplier of Nv",
        load_set("s175-regression-shallow", corrected=False)["Yv|v|"],
        quadratic_sway(deep["Nv"], shallow["Nv"]),
        spread_of(quadratic_sway, *numbers) + (1.0 + shallow["Yv|v|"] / mended["Yv|v|"]) * half_digit(5),
        expected=shallow["Yv|v|"],
        note="printed for the drift angle among terms in the sway velocity: there its sign turns",
    )
    yield Case(
        KEY,
        "Table 5, depth multipliers",
        "Nv|v| in deep water from the shallow value",
        deep["Nv|v|"],
        quadratic_yaw(deep["Nv"], shallow["Nv"]),
        spread_of(quadratic_yaw, *numbers) + half_digit(4),
        expected=mended["Nv|v|"],
        note="misprint: a zero too many",
    )


PAPER = Paper(
    KEY,
    "Manoeuvring of the S-175 container ship in deep and shallow water (ELIGMOS), against Son and Nomoto (1981)",
    cases,
)
