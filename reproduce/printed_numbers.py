"""Published tables row by row, as the cases of the gallery read them."""

from __future__ import annotations

from typing import Any

from ..core.errors import DatasetError
from ..core.ship import Ship
from ..datasets import load_table

KNOT = 1852.0 / 3600.0
"""Metres a second in one knot."""


def printed_rows(key: str) -> list[dict[str, Any]]:
    """Rows of a table, each a mapping of column to number or text; NaN where the paper leaves a cell empty."""
    records = load_table(key).frame.to_dict("records")
    return [{str(column): value for column, value in record.items()} for record in records]


def printed_by(key: str, column: str) -> dict[Any, dict[str, Any]]:
    """Rows of a table by the value in one of its columns.

    Raises
    ------
    DatasetError
        When two rows have the same value there.
    """
    rows = printed_rows(key)
    found = {row[column]: row for row in rows}
    if len(found) != len(rows):
        raise DatasetError(f"rows of table '{key}' share a value of {column}", cure="choose another column")
    return found


def ship_of(key: str) -> Ship:
    """Ship of a table.

    Raises
    ------
    DatasetError
        When the table belongs to no ship.
    """
    ship = load_table(key).ship
    if ship is None:
        raise DatasetError(f"table '{key}' has no ship", cure="name one in the file of the paper")
    return ship
