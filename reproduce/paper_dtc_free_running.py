"""DTC free-running tests (SINTEF Ocean, MASHCON 2019): repeatability of zig-zags in waves, model scale."""

from __future__ import annotations

from collections.abc import Iterator

from ..simulate.repeatability import Repeatability, mean_uncertainty
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_rows, ship_of
from .rounding import spread_of

KEY = "dtc-free-running"

SCALE = 63.65

_MODEL_DIGITS = {"length": 3, "breadth": 3, "draught": 3, "roll inertia": 1, "yaw inertia": 0}
"""Decimals to which the printed value of the ship determines that of the model."""

_MEASURED = {"displacement", "pitch inertia"}
"""Values of the model that were measured, and kept to those of the ship within 0.2 %."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _repeatability()
    yield from _model()
    yield from _speed()


def _repeatability() -> Iterator[Case]:
    """Table 3 from its means and standard deviations, which are rounded to one decimal."""
    for row in printed_rows("dtc-free-running-repeatability"):
        count = int(row["count"])

        def found(mean: float, sd: float, count: int = count) -> Repeatability:
            return mean_uncertainty(count, mean, sd)

        for name in ("sd_of_mean", "uncertainty", "relative"):
            spread = spread_of(
                lambda m, s, n=name: float(getattr(found(m, s), n)), (row["mean"], 1), (row["sd"], 1)
            )
            yield Case(
                KEY,
                "Table 3, 20/20 zig-zag in head waves",
                f"{name.replace('_', ' ')} of the {row['quantity']}, {'%' if name == 'relative' else row['unit']}",
                row[name],
                float(getattr(found(row["mean"], row["sd"]), name)),
                spread + half_digit(1),
            )


def _model() -> Iterator[Case]:
    """Table 1 at model scale by Froude's law."""
    for row in printed_rows("dtc-free-running-particulars"):
        measured = row["item"] in _MEASURED
        yield Case(
            KEY,
            "Table 1, scale 1:63.65",
            f"{row['item']}, SI",
            row["model"],
            row["ship"] / SCALE ** row["power"],
            2e-3 * row["model"] if measured else half_digit(_MODEL_DIGITS[row["item"]]),
            note="measured on the model" if measured else "",
        )


def _speed() -> Iterator[Case]:
    ship = ship_of("dtc-free-running-particulars")
    yield Case(
        KEY,
        "text, approach speed",
        "Froude number at 16 knots",
        0.14,
        ship.froude_number(16.0 * KNOT),
        half_digit(2),
    )


PAPER = Paper(
    KEY,
    "DTC free-running manoeuvring tests in calm water and regular waves (SINTEF Ocean, 2019), 5th MASHCON, Ostend, "
    "pp. 261-271",
    cases,
)
