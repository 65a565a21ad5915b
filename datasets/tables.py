"""Published tables: captive test points, harmonics, grid studies, test programmes, comparisons.

A table in a paper's file::

    [[table]]
    key = "dtc-drift-points"           # title, place, units and data are required
    ship = "dtc-100"
    conventions = {}                   # beside those of the paper; absent when the table has no forces
    units = { beta = "deg", X = "-" }  # of each column, in order; "text" for words, "list of deg" for 0;2;4
    computed = true                    # when the paper does not print it
    notes = ["..."]
    data = '''...'''                   # CSV with a header line, as printed
    [[table.correction]]               # where = {column = value}, column, corrected, reason: the loader uses it
    [[table.suspect]]                  # where, column, likely, reason: the loader says it
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..core.conventions import Conventions
from ..core.errors import DatasetError
from ..core.ship import Ship
from .catalogue import Paper, check_keys, correction_sentence, doubt_sentence, find, index

if TYPE_CHECKING:
    import pandas as pd

_TABLE_KEYS = {
    "key", "title", "place", "ship", "conventions", "units", "computed", "notes", "data", "correction", "suspect",
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class PublishedTable:
    """A table of a paper.

    Attributes
    ----------
    key, title : str
    frame : DataFrame
        The numbers; a cell that the paper leaves empty is NaN.
    units : dict of str to str
        Unit of each column: ``"-"`` when it has none, ``"text"`` for words, ``"L"`` for ship lengths,
        ``"list of deg"`` for several values parted by semicolons.
    source : str
        Paper and table.
    notes : tuple of str
    ship : Ship or None
    conventions : Conventions or None
        Those of its forces; None when it has none.
    misprints : tuple of str
        Known errors and what was done about them.
    computed : bool
        True when the numbers follow from the paper but are not printed in it.
    """

    key: str
    title: str
    frame: pd.DataFrame
    units: dict[str, str]
    source: str
    notes: tuple[str, ...] = ()
    ship: Ship | None = None
    conventions: Conventions | None = None
    misprints: tuple[str, ...] = ()
    computed: bool = False


def load_table(key: str, corrected: bool = True) -> PublishedTable:
    """A published table.

    Parameters
    ----------
    key : str
        See :func:`list_tables`.
    corrected : bool
        Correct the known misprints; False gives the numbers as they are printed.

    Raises
    ------
    DatasetError
        For an unknown key, with those nearest to it.
    """
    paper = find("table", key)
    block = paper.block("table", key)
    check_keys(block, _TABLE_KEYS, {"title", "place", "units", "data"}, paper.file, key)
    frame = _read_frame(paper, block)
    misprints = _mend(frame, paper, block, corrected)
    conventions = paper.conventions(block["conventions"]) if "conventions" in block else None
    return PublishedTable(
        key=key,
        title=block["title"],
        frame=frame,
        units=dict(block["units"]),
        source=f"{paper.reference}, {block['place']}",
        notes=tuple(block.get("notes", ())),
        ship=paper.ship(block["ship"]) if "ship" in block else None,
        conventions=conventions,
        misprints=tuple(misprints),
        computed=bool(block.get("computed", False)),
    )


def list_tables() -> pd.DataFrame:
    """All published tables: key, title, ship, source, rows, columns, whether computed instead of printed."""
    import pandas as pd

    rows = []
    for key in index("table"):
        table = load_table(key)
        rows.append(
            {
                "key": key,
                "title": table.title,
                "ship": table.ship.name if table.ship else "",
                "source": table.source,
                "rows": len(table.frame),
                "columns": ", ".join(table.units),
                "computed": table.computed,
            }
        )
    return pd.DataFrame(rows)


def _read_frame(paper: Paper, block: Mapping[str, Any]) -> pd.DataFrame:
    import pandas as pd

    units = block["units"]
    words = {name: str for name, unit in units.items() if unit == "text" or unit.startswith("list of ")}
    frame = pd.read_csv(io.StringIO(block["data"]), dtype=words, skip_blank_lines=True)
    if list(frame.columns) != list(units):
        raise DatasetError(
            f"columns {', '.join(frame.columns)} but units of {', '.join(units)}",
            file=paper.file,
            place=block["key"],
        )
    for name in units:
        if name not in words and not pd.api.types.is_numeric_dtype(frame[name]):
            raise DatasetError(f"column '{name}' is not of numbers", file=paper.file, place=block["key"])
    frame.attrs["units"] = dict(units)
    return frame


def _mend(frame: pd.DataFrame, paper: Paper, block: Mapping[str, Any], corrected: bool) -> list[str]:
    """Correct the frame in place and return a sentence for each misprint and each doubt."""
    sentences = []
    for item in block.get("correction", []):
        row, where = _row(frame, item["where"], paper, block["key"])
        column = item["column"]
        sentences.append(correction_sentence(f"{column} of {where}", frame.loc[row, column], item, corrected))
        if corrected:
            frame.loc[row, column] = item["corrected"]
    for item in block.get("suspect", []):
        row, where = _row(frame, item["where"], paper, block["key"])
        column = item["column"]
        sentences.append(doubt_sentence(f"{column} of {where}", frame.loc[row, column], item))
    return sentences


def _row(frame: pd.DataFrame, where: Mapping[str, Any], paper: Paper, key: str) -> tuple[Any, str]:
    """Label and description of the one row that `where` names."""
    chosen = frame
    for column, value in where.items():
        chosen = chosen[chosen[column] == value]
    text = ", ".join(f"{column} {value}" for column, value in where.items())
    if len(chosen) != 1:
        raise DatasetError(f"{len(chosen)} rows have {text}", file=paper.file, place=key)
    return chosen.index[0], text
