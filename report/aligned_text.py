"""Tables for a terminal: columns aligned, numbers with the digits that can be read."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd


def aligned_text(frame: pd.DataFrame, columns: Sequence[str], digits: int = 4) -> str:
    """Some columns of a table as lines of text.

    Numbers are set flush right with `digits` significant digits, nothing for NaN; a column without any entry is left
    out.
    """
    heads, cells, right = [], [], []
    for name in columns:
        values = frame[name].tolist()
        numbers = [value for value in values if isinstance(value, float | int)]
        if numbers and all(isinstance(value, float) and math.isnan(value) for value in numbers):
            continue
        heads.append(name)
        right.append(bool(numbers))
        cells.append([_cell(value, digits) for value in values])
    widths = [max(map(len, [head, *column])) for head, column in zip(heads, cells, strict=True)]
    rows = [heads, *zip(*cells, strict=True)]
    return "\n".join(
        "  ".join(
            cell.rjust(width) if flush else cell.ljust(width)
            for cell, width, flush in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in rows
    )


def _cell(value: object, digits: int) -> str:
    if not isinstance(value, float):
        return str(value)
    if math.isnan(value):
        return ""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    places = max(digits - 1 - math.floor(math.log10(abs(value))), 0)
    return f"{value:.{places}f}" if abs(value) >= 1e-4 else f"{value:.{digits - 1}e}"
