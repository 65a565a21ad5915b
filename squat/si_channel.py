"""A channel of a file in SI, refused when its unit is not that of the quantity it is to be."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from ..formats.units import conversion

if TYPE_CHECKING:
    from ..formats.raw_table import RawTable


def require_channels(table: RawTable, names: tuple[str, ...]) -> None:
    """Raise :class:`ReadError` for the first name that the file does not have."""
    for name in names:
        if name not in table.columns:
            raise ReadError(
                f"there is no channel '{name}'",
                cure=f"the file has {', '.join(table.columns)}",
                file=table.path or None,
            )


def si_channel(table: RawTable, name: str, dimensions: tuple[str, ...] = ()) -> np.ndarray:
    """Values of a channel in SI, shape (n,); as they are where the file gives no unit.

    Parameters
    ----------
    table : RawTable
    name : str
    dimensions : tuple of str
        What the quantity may be, e.g. ``("length",)``; anything when empty.

    Raises
    ------
    ReadError
        When the unit is of another dimension.
    """
    unit = table.units.get(name, "")
    if not unit:
        return np.asarray(table.columns[name])
    known = conversion(unit)
    if dimensions and known.dimension not in dimensions:
        raise ReadError(
            f"is in {unit}, a {known.dimension}, and should be a {' or '.join(dimensions)}",
            cure="name another channel or declare its unit",
            file=table.path or None,
            place=f"channel {name}",
        )
    return np.asarray(table.columns[name] * known.factor)
