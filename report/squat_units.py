"""How squat is shown: millimetres for models, metres for ships, trim in mm/m; errors with the decimals they support."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from .typography import fixed, significant

if TYPE_CHECKING:
    import pandas as pd

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


def place_title(name: str) -> str:
    """A quantity in a word: the place of a sinkage."""
    place = name.removeprefix("sinkage_")
    return {"cog": "CoG"}.get(place, place)


def short_title(name: str, unit: str, length: float) -> str:
    """A quantity in a word, with the unit that it is shown in."""
    return f"{place_title(name)} [{shown_quantity(unit, length)[1]}]"


def value_and_error(value: float, error: float) -> tuple[str, str]:
    """Value and error with the decimals that the error supports; no error: four digits, and nothing."""
    if not (math.isfinite(error) and error > 0.0):
        return significant(value, 4), ""
    places = max(1 - math.floor(math.log10(error)), 0)
    return fixed(value, places), fixed(error, places)


def with_error(value: float, error: float) -> str:
    """Value and its error with the decimals that the error supports."""
    if not (math.isfinite(error) and error > 0.0):
        return f"{value:.4g}"
    places = max(1 - math.floor(math.log10(error)), 0)
    return f"{value:.{places}f} ± {error:.{places}f}"


def harmonics_of(frame: pd.DataFrame) -> list[int]:
    """Numbers of the harmonics that a table of runs in waves has."""
    return [int(found[1]) for name in frame if (found := re.fullmatch(r"amplitude_(\d+)", str(name)))]
