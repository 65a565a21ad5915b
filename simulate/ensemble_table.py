"""Indices of an ensemble as a table: value, mean, spread and quantiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from .events import FloatArray
from .index_definitions import definition_of

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = ("manoeuvre", "index", "value", "unit", "sd", "p05", "p95", "mean", "p50", "draws")
"""Columns of the table; the first seven are those of ``indices.csv``."""


def index_statistics(
    values: Mapping[str, Mapping[str, FloatArray]], unperturbed: Mapping[str, Mapping[str, float]]
) -> pd.DataFrame:
    """One row an index; indices that neither the unperturbed vessel nor a draw has are left out.

    Parameters
    ----------
    values : mapping of str to mapping of str to ndarray, shape (draws,)
        Manoeuvre -> index -> values; NaN where a draw has none.
    unperturbed : mapping of str to mapping of str to float

    Returns
    -------
    DataFrame
        `COLUMNS`; sd with n - 1 degrees of freedom, NaN below two draws.
    """
    import pandas as pd

    rows = []
    for manoeuvre, indices in values.items():
        for index, drawn in indices.items():
            value = unperturbed[manoeuvre].get(index, np.nan)
            known = drawn[np.isfinite(drawn)]
            if np.isnan(value) and not len(known):
                continue
            low, middle, high = np.quantile(known, (0.05, 0.5, 0.95)) if len(known) else (np.nan,) * 3
            rows.append(
                (
                    manoeuvre,
                    index,
                    value,
                    definition_of(index).unit,
                    float(np.std(known, ddof=1)) if len(known) > 1 else np.nan,
                    float(low),
                    float(high),
                    float(np.mean(known)) if len(known) else np.nan,
                    float(middle),
                    len(known),
                )
            )
    return pd.DataFrame(rows, columns=list(COLUMNS))
