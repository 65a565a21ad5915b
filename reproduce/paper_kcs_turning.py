"""KCS turning in regular waves (KRISO, MASHCON 2019): model scale, safety index, direction of the drift."""

from __future__ import annotations

import math
from collections.abc import Iterator

from ..datasets import load_table
from ..simulate.turning_drift import relative_drift_direction, safety_index
from .case import Case, Paper, half_digit
from .printed_numbers import KNOT, printed_by, printed_rows

KEY = "kcs-turning"

SCALE = 65.833

_DECIMALS = {
    "length": 3, "breadth": 3, "draught": 3, "volume": 3, "GM": 3, "rudder area": 4, "rudder rate": 2,
    "propeller diameter": 3,
}  # fmt: skip

_POWERS = {"m": -1.0, "m2": -2.0, "m3": -3.0, "deg/s": 0.5}

_ROUGHLY = 5.0
"""Half of the ten degrees to which "about 45 degrees" is taken."""


def cases() -> Iterator[Case]:
    """All cases of the paper."""
    yield from _model()
    yield from _safety_index()
    yield from _drift_direction()
    yield from _drift_distance()


def _model() -> Iterator[Case]:
    """Table 1 at model scale: lengths, and the rudder rate by Froude's law."""
    mended = printed_by("kcs-turning-particulars", "item")
    printed = load_table("kcs-turning-particulars", corrected=False).frame.set_index("item")["model"]
    for item, decimals in _DECIMALS.items():
        row = mended[item]
        misprint = printed[item] != row["model"]
        yield Case(
            KEY,
            "Table 1, scale 1:65.833",
            f"{item} in {row['unit']}",
            float(printed[item]),
            row["ship"] * SCALE ** _POWERS[row["unit"]],
            half_digit(decimals),
            expected=row["model"] if misprint else None,
            note="the other particulars keep to the scale" if misprint else "",
        )
    yield Case(
        KEY,
        "Table 2, 10.7 revolutions a second",
        "16 knots at model scale in m/s (recomputed reference)",
        1.0145,
        16.0 * KNOT / math.sqrt(SCALE),
        half_digit(4),
    )


def _safety_index() -> Iterator[Case]:
    """Table 3: all rows from the printed ratios."""
    for row in printed_rows("kcs-turning-waves"):
        yield Case(
            KEY,
            "Table 3",
            f"safety index, {_waves(row)}",
            row["safety_index"],
            float(safety_index(row["direction_ratio"], row["distance_ratio"])),
            2.0 * half_digit(2),
        )


def _waves(row: dict[str, float]) -> str:
    return f"waves {row['wave_direction']:g} deg, {row['wave_height']:g} L high, {row['wave_length']:g} L long"


def _drift_direction() -> Iterator[Case]:
    """Wave direction less drift direction: the text says about 0 for the shortest waves and about 45 for the others."""
    frame = load_table("kcs-turning-waves").frame
    relative = relative_drift_direction(frame["wave_direction"], frame["drift_direction"])
    for length, printed in ((0.5, 0.0), (0.7, 45.0), (1.0, 45.0)):
        mean = float(relative[(frame["wave_length"] == length).to_numpy()].mean())
        yield Case(
            KEY,
            "text, relative drift direction",
            f"mean in degrees, waves {length:g} L long",
            printed,
            mean,
            _ROUGHLY,
            note="41 to 70 degrees in Table 3: further than the text says" if length == 1.0 else "",
        )


def _drift_distance() -> Iterator[Case]:
    """The drift of a full turn grows with the wave height."""
    frame = load_table("kcs-turning-waves").frame
    grows = [
        bool(group.sort_values("wave_height")["drift_distance"].is_monotonic_increasing)
        for _, group in frame.groupby(["wave_direction", "wave_length"])
    ]
    yield Case(
        KEY,
        "text, drift distance",
        "grows with the wave height in every wave",
        "yes",
        "yes" if all(grows) else "no",
    )


PAPER = Paper(
    KEY,
    "Initial and steady turning characteristics of KCS in regular waves (KRISO, 2019), 5th MASHCON, Ostend, "
    "pp. 183-193",
    cases,
)
