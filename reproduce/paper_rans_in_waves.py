"""DTC in shallow-water head waves by RANS (MASHCON 2019): measured values that the printed errors imply, and the waves.

The paper prints computed values and errors (D - S)/D, but no measurement. A sister paper prints two of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..core.variables import GRAVITY
from .case import Case, Paper, half_digit
from .dtc_head_waves import SPEEDS, WAVE_LENGTH, added_resistance_unit, depth_of, encounter_frequency
from .printed_numbers import printed_by, printed_rows, ship_of
from .rounding import spread_of

KEY = "dtc-rans-measured"


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _implied_measurements()
    yield from _tanks()
    yield from _waves()
    yield from _amplitude()


def _implied_measurements() -> Iterator[Case]:
    """Measured values from a computed one and its printed error, and against the sister paper."""
    fine = {
        str(row["quantity"]): float(row["S2"])
        for row in printed_rows("dtc-waves-convergence")
        if row["study"] == "grid waves"
    }
    errors = {(row["condition"], row["quantity"]): row for row in printed_rows("dtc-rans-errors")}
    for row in printed_rows("dtc-rans-measured"):
        condition, quantity, decimals = str(row["condition"]), str(row["quantity"]), int(row["decimals"])
        printed = errors[condition, quantity]
        # Table 2 has one digit more than Table 7
        computed = (
            fine.get(quantity, float(printed["narrow"])) if condition == "waves" else float(printed["narrow"])
        )
        implied = computed / (1.0 - float(printed["error"]) / 100.0)
        yield Case(
            KEY,
            condition,
            f"measured {quantity} that the error implies (recomputed reference)",
            row["measured"],
            implied,
            half_digit(decimals),
        )
    sister = printed_by("dtc-chaos-samples", "case")["EFD"]
    for quantity, apart in (("heave", 0.2), ("pitch", 0.5)):
        implied = fine[quantity] / (1.0 - float(errors["waves", quantity]["error"]) / 100.0)
        yield Case(
            KEY,
            "head waves",
            f"measured {quantity} against the sister paper's sine fit, % (recomputed reference)",
            apart,
            abs(100.0 * (implied / float(sister[quantity]) - 1.0)),
            half_digit(1),
        )


def _tanks() -> Iterator[Case]:
    """Computed values of the narrow tank against those of the wide one."""
    errors = {(row["condition"], row["quantity"]): row for row in printed_rows("dtc-rans-errors")}
    narrow, wide = (float(errors["calm", "z0/L"][tank]) for tank in ("narrow", "wide"))
    yield Case(
        KEY, "calm water", "mean sinkage of the narrow tank over the wide one, %", 23.0, 100.0 * (narrow / wide - 1.0),
        half_digit(0) + spread_of(lambda a, b: 100.0 * (a / b - 1.0), (narrow, 4), (wide, 4)),
    )  # fmt: skip
    narrow, wide = (float(errors["calm", "Ct"][tank]) for tank in ("narrow", "wide"))
    yield Case(
        KEY, "calm water", "Ct of the narrow tank over the wide one, %", 2.4, 100.0 * (narrow / wide - 1.0),
        half_digit(1),
    )  # fmt: skip


def _waves() -> Iterator[Case]:
    """Length, period and encounter of the waves."""
    ship = ship_of("dtc-waves-convergence")
    depth = depth_of(ship, 1.0)
    periods = {0.55: 1.3839, 0.70: 1.6895, 0.85: 2.0032, 1.00: 2.3223}
    for length, period in periods.items():
        own = 2.0 * math.pi / encounter_frequency(length * ship.L, depth, 0.0)
        yield Case(KEY, "head waves", f"period in s of {length:g} L (recomputed reference)", period, own, 5e-4)
    met = encounter_frequency(WAVE_LENGTH * ship.L, depth, SPEEDS["CW3"]) / (2.0 * math.pi)
    yield Case(KEY, "head waves", "encounter frequency in Hz (recomputed reference)", 1.1206, met, 5e-4)
    yield Case(
        KEY,
        "head waves",
        "Froude number of the depth",
        0.488,
        SPEEDS["CW3"] / math.sqrt(GRAVITY * depth),
        half_digit(3),
    )


def _amplitude() -> Iterator[Case]:
    """The wave amplitude is half of the 62.35 mm that one table heads amplitude."""
    ship = ship_of("dtc-waves-convergence")
    # total resistance in waves of the sister paper and calm resistance give the coefficient of half the height
    sister = printed_by("dtc-chaos-samples", "case")["EFD"]
    calm = float(printed_by("dtc-calm-resistance", "test")["C2"]["measured"])
    added = -float(sister["X"]) - calm
    height = float(printed_by("dtc-added-resistance-cases", "test")["CW3"]["wave_height"])
    for part, printed in ((0.5, 2.25), (1.0, 0.56)):
        what = "half the height" if part == 0.5 else "the whole height"
        yield Case(
            KEY,
            "head waves",
            f"measured Caw with {what} as amplitude (recomputed reference)",
            printed,
            added / added_resistance_unit(ship, 1e-3 * part * height),
            half_digit(2) + 0.05 / added_resistance_unit(ship, 1e-3 * part * height),
        )


PAPER = Paper(
    KEY,
    "RANS simulation of DTC in shallow calm water and head waves (2019), 5th MASHCON, Ostend, pp. 395-409: what the "
    "printed errors say of the measurements",
    cases,
)
