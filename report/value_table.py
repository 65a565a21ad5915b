"""Tables of results as they come to be compared: quantities, manoeuvring indices, numerical uncertainties, curves.

=====================  ===========================================================================================
columns                what it is
=====================  ===========================================================================================
quantity, value        results of CFD or of an experiment; optional: ``uncertainty`` (expanded) or ``std`` (one standard
                       uncertainty), ``unit``, ``input_uncertainty`` (expanded), ``covariance`` (of S and D)
manoeuvre, index, ...  ``indices.csv`` of ``towtank simulate``, or measured indices with the same columns
quantity, uncertainty  ``uncertainty.csv`` of ``towtank gci``: numerical uncertainties by method
anything else          curves: one column to compare over (speed, angle), one column a quantity
=====================  ===========================================================================================
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from ..core.errors import ReadError
from ..core.provenance import file_hash
from .numbered_rows import NumberedRows, cell_number, numbered_rows

if TYPE_CHECKING:
    import pandas as pd

Kind = Literal["values", "indices", "curves", "derivatives"]

WANTED = "quantity,value,uncertainty,unit"


@dataclass(frozen=True, eq=False)
class ValueTable:
    """Results read from a file.

    Attributes
    ----------
    file, sha256 : str
    kind : {"values", "indices", "curves", "derivatives"}
    frame : DataFrame
        Values and indices: quantity, value, uncertainty (expanded; NaN unknown), input_uncertainty, covariance, unit.
        Curves: the columns of the file. Derivatives: empty.
    """

    file: str
    sha256: str
    kind: Kind
    frame: pd.DataFrame


def read_values(path: str | Path, *, coverage: float = 2.0) -> ValueTable:
    """Read a table of results; the module says which.

    Parameters
    ----------
    path : str or Path
    coverage : float
        Coverage factor that turns standard uncertainties of the file into expanded ones.

    Returns
    -------
    ValueTable
        ``kind`` is ``derivatives`` and the frame empty for a table with ``name,value``: read it with
        :func:`towtank.report.read_set`.

    Raises
    ------
    ReadError
        Naming file, line, cause and cure.
    """
    import pandas as pd

    path = Path(path)
    table = numbered_rows(path, WANTED)
    kind = _kind(table.names)
    if kind == "derivatives":
        frame = pd.DataFrame()
    elif kind == "curves":
        frame = _curves(table, path)
    else:
        frame = _results(table, path, kind, coverage)
    return ValueTable(path.name, file_hash(path), kind, frame)


def numerical_uncertainties(
    path: str | Path, method: str = "", units: Mapping[str, str] | None = None
) -> dict[str, float]:
    """Expanded numerical uncertainty of each quantity from a table such as ``uncertainty.csv`` of ``towtank gci``.

    Parameters
    ----------
    path : str or Path
        Columns quantity, uncertainty and, with several methods, method.
    method : str
        Which method; needed when the table has several of a quantity.
    units : mapping of str to str, optional
        Units that the quantities must have, where both name one.

    Raises
    ------
    ReadError
        Naming file, line, cause and cure.
    """
    path = Path(path)
    table = numbered_rows(path, "quantity,method,uncertainty")
    for name in ("quantity", "uncertainty"):
        if name not in table.names:
            raise ReadError(
                f"the table has no column '{name}'", cure=f"it has {', '.join(table.names)}", file=path
            )
    methods = list(dict.fromkeys(row.get("method", "") for _, row in table.rows))
    if method and method not in methods:
        raise ReadError(
            f"the table has no method '{method}'", cure=f"it has {', '.join(filter(None, methods))}", file=path
        )
    found: dict[str, float] = {}
    for number, row in table.rows:
        if method and row.get("method", "") != method:
            continue
        name, place = row["quantity"], f"line {number}"
        if name in found:
            raise ReadError(
                f"the table has several uncertainties of '{name}'",
                cure=f"choose with --method: {', '.join(methods)}",
                file=path,
                place=place,
            )
        unit, wanted = row.get("unit", ""), (units or {}).get(name, "")
        if unit and wanted and unit != wanted:
            raise ReadError(
                f"the uncertainty of '{name}' is in '{unit}', its value in '{wanted}'",
                cure="give both in one unit",
                file=path,
                place=place,
            )
        found[name] = _uncertainty(row["uncertainty"], "uncertainty", path, place)
    return found


def _kind(names: tuple[str, ...]) -> Kind:
    if {"quantity", "value"} <= set(names):
        return "values"
    if {"manoeuvre", "index", "value"} <= set(names):
        return "indices"
    return "derivatives" if {"name", "value"} <= set(names) else "curves"


def _results(table: NumberedRows, path: Path, kind: Kind, coverage: float) -> pd.DataFrame:
    import pandas as pd

    spread = [name for name in ("uncertainty", "std", "sd") if name in table.names]
    if len(spread) > 1:
        raise ReadError(
            f"the table has the columns {' and '.join(spread)}",
            cure="keep one: uncertainty is expanded, std is one standard uncertainty",
            file=path,
        )
    factor = coverage if spread and spread[0] != "uncertainty" else 1.0
    rows, seen = [], set()
    for number, row in table.rows:
        place = f"line {number}"
        name = row["quantity"] if kind == "values" else f"{row['manoeuvre']}: {row['index']}"
        if name in seen:
            raise ReadError(f"'{name}' is given twice", cure="keep one row", file=path, place=place)
        seen.add(name)
        value = cell_number(row["value"] or "nan", "value", path, place)
        if not math.isfinite(value):
            raise ReadError(
                f"the value of '{name}' is missing", cure="fill or drop the row", file=path, place=place
            )
        rows.append(
            {
                "quantity": name,
                "value": value,
                "uncertainty": factor * _uncertainty(row[spread[0]], spread[0], path, place)
                if spread
                else math.nan,
                "input_uncertainty": _uncertainty(row["input_uncertainty"], "input_uncertainty", path, place)
                if "input_uncertainty" in row
                else 0.0,
                "covariance": cell_number(row.get("covariance") or "0", "covariance", path, place),
                "unit": row.get("unit", ""),
            }
        )
    if not rows:
        raise ReadError("the table has no rows", cure=f"give rows of {WANTED}", file=path)
    return pd.DataFrame(rows)


def _uncertainty(cell: str, what: str, path: Path, place: str) -> float:
    """Uncertainty in a cell; NaN when it is empty."""
    value = cell_number(cell or "nan", what, path, place)
    if value < 0.0:
        raise ReadError(
            f"{what} = {cell} is negative", cure="give the half width of the interval", file=path, place=place
        )
    return value


def _curves(table: NumberedRows, path: Path) -> pd.DataFrame:
    import pandas as pd

    if len(table.names) < 2 or not table.rows:
        raise ReadError(
            f"the table has the columns {', '.join(table.names)} and {len(table.rows)} rows",
            cure=f"give {WANTED}, or a column to compare over and one for each quantity",
            file=path,
        )
    rows = [
        {name: cell_number(cell or "nan", name, path, f"line {number}") for name, cell in row.items()}
        for number, row in table.rows
    ]
    return pd.DataFrame(rows)
