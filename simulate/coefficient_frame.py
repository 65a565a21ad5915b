"""Tables of force coefficients as users give them: named columns, angles in degrees."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError, TowtankError

if TYPE_CHECKING:
    import pandas as pd


@contextmanager
def read_from(path: str | Path) -> Iterator[pd.DataFrame]:
    """Table of a CSV file (:func:`coefficient_frame`); what is found wrong with it names the file."""
    try:
        yield coefficient_frame(path)
    except TowtankError as error:
        raise type(error)(error.cause, cure=error.cure, file=path, place=error.place) from error


def coefficient_frame(path: str | Path) -> pd.DataFrame:
    """Table of a CSV file; lines that begin with ``#`` are comments.

    Raises
    ------
    ReadError
        When the file is missing or is not a table.
    """
    import pandas as pd

    try:
        return pd.read_csv(path, comment="#", skipinitialspace=True)
    except (OSError, ValueError) as error:
        raise ReadError(f"not a table of coefficients: {error}", file=path) from error


def coefficient_columns(
    frame: pd.DataFrame, by: str, names: Sequence[str], optional: Sequence[str] = ()
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """Column `by` and the named columns of a table as numbers.

    Parameters
    ----------
    frame : DataFrame
    by : str
        Column of the angle.
    names, optional : sequence of str
        Columns that must be there, and columns that are 0 where they are not.

    Raises
    ------
    ReadError
        For a missing column, or one that is not of numbers.
    """
    missing = [name for name in (by, *names) if name not in frame.columns]
    if missing:
        raise ReadError(
            f"the table has no column '{missing[0]}'",
            cure=f"columns are {by}, {', '.join((*names, *optional))}; this one has {', '.join(map(str, frame))}",
        )
    found = {}
    for name in (by, *names, *optional):
        if name not in frame.columns:
            found[name] = np.zeros(len(frame))
            continue
        try:
            found[name] = frame[name].to_numpy(dtype=float)
        except ValueError as error:
            raise ReadError(f"column '{name}' is not of numbers: {error}", place=name) from error
    return found.pop(by), found
