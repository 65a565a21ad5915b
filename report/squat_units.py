"""How squat is shown: millimetres for models, metres for ships, trim in mm/m; errors with the decimals they support."""

from __future__ import annotations

import math

MODEL_LENGTH = 30.0
"""A hull shorter than this, in m, is a model and squats by millimetres."""


def shown_length(length: float) -> tuple[float, str]:
    """Factor from m to the unit of sinkage on pages and terminals for a hull of `length` m, and that unit."""
    return (1000.0, "mm") if length < MODEL_LENGTH else (1.0, "m")


def shown_quantity(unit: str, length: float) -> tuple[float, str]:
    """Factor from SI to what is shown of a quantity, and that unit."""
    if unit == "m":
        return shown_length(length)
    if unit == "m/m":
        return 1000.0, "mm/m"
    return 1.0, unit or "-"


def quantity_title(name: str) -> str:
    """A quantity in words: ``sinkage_bow`` is the sinkage at the bow."""
    place = name.removeprefix("sinkage_")
    if place == name:
        return name
    return {"cog": "sinkage at CoG"}.get(place, f"sinkage at {place}")


def with_error(value: float, error: float) -> str:
    """Value and its error with the decimals that the error supports."""
    if not (math.isfinite(error) and error > 0.0):
        return f"{value:.4g}"
    places = max(1 - math.floor(math.log10(error)), 0)
    return f"{value:.{places}f} ± {error:.{places}f}"
