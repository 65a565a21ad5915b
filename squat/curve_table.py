"""A file of curves: a column to go by (the speed), one column a quantity, and what belongs to them."""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from ..formats.raw_table import RawTable
from ..formats.read import read_table
from ..formats.units import conversion, convertible

if TYPE_CHECKING:
    import pandas as pd

CASE = "case"
ERROR_ENDINGS = ("_se", "_std", "_u")
"""Endings of the columns that hold the standard uncertainty of a quantity."""
_NOT_SCORED = ("depth", "depth_froude", "clearance")
"""Columns that a table of squat has beside its quantities."""


@dataclass(frozen=True, eq=False)
class CurveTable:
    """Curves of one file.

    Attributes
    ----------
    name : str
        Stem of the file.
    by : str
        The column that the curves run over.
    frame : DataFrame
        `by`, the quantities, and ``case`` (text).
    errors : DataFrame
        Standard uncertainties of the quantities that have them.
    units : mapping of str to str
        As printed; empty where the file gives none.
    path, sha256 : str
    findings : tuple of Finding
    """

    name: str
    by: str
    frame: pd.DataFrame
    errors: pd.DataFrame
    units: Mapping[str, str]
    path: str = ""
    sha256: str = ""
    findings: tuple[Finding, ...] = field(default=())

    @property
    def quantities(self) -> list[str]:
        """Names of the quantities."""
        return [str(name) for name in self.frame.columns if name not in (self.by, CASE)]

    @property
    def cases(self) -> list[str]:
        """The cases in their order; one without a name where the file has no column ``case``."""
        return list(dict.fromkeys(self.frame[CASE].tolist()))

    def in_units_of(self, other: CurveTable) -> CurveTable:
        """The curves in the units of another table.

        Raises
        ------
        ReadError
            When a unit is of another dimension, or only one of the two tables has it.
        """
        frame, errors, units = self.frame.copy(), self.errors.copy(), dict(self.units)
        for name in [self.by, *self.quantities]:
            if name not in other.frame:
                continue
            own, wanted = self.units[name], other.units[name]
            if own == wanted:
                continue
            if not (own and wanted):
                knows, lacks = (self, other) if own else (other, self)
                raise ReadError(
                    f"'{name}' has no unit here and is in {own or wanted} in {Path(knows.path).name}",
                    cure=f"write the unit into the heading as {name} [{own or wanted}], or use --unit {name}=UNIT",
                    file=lacks.path,
                    place=f"column {name}",
                )
            target = conversion(wanted)
            factor = convertible(own, target.dimension)
            if factor is None and target.dimension == "slope" and conversion(own).dimension == "angle":
                factor = conversion(own).factor
            if factor is None:
                raise ReadError(
                    f"is in {own} and cannot be held against {wanted}",
                    cure="correct the unit, or name the column otherwise",
                    file=self.path,
                    place=f"column {name}",
                )
            frame[name] = frame[name] * (factor / target.factor)
            if name in errors:
                errors[name] = errors[name] * (factor / target.factor)
            units[name] = wanted
        return CurveTable(self.name, self.by, frame, errors, units, self.path, self.sha256, self.findings)


def read_curve_table(path: str | Path, by: str = "speed", *, units: Mapping[str, str] | None = None) -> CurveTable:
    """Read curves from a text table, a spreadsheet or another known format.

    Parameters
    ----------
    path : str or Path
    by : str
        The column that the curves run over.
    units : mapping of str to str, optional
        Units that the file does not give or gives wrongly.

    Raises
    ------
    ReadError
        When the file cannot be read, has no column `by` or no quantity, or a value of `by` is missing.
    """
    import pandas as pd

    table = read_table(path)
    if by not in table.columns:
        raise ReadError(
            f"there is no column '{by}'", cure=f"name one with --by: {', '.join(table.columns)}", file=path
        )
    known = {**table.units, **{name: unit for name, unit in (units or {}).items() if name in table.columns}}
    for name, unit in known.items():
        if unit:
            _require_unit(unit, name, path)
    over = table.columns[by]
    if not np.isfinite(over).all():
        row = int(np.flatnonzero(~np.isfinite(over))[0]) + 1
        raise ReadError(
            f"'{by}' is missing in data row {row}",
            cure="complete or remove the row",
            file=path,
            place=f"column {by}",
        )
    columns: dict[str, np.ndarray] = {by: over}
    errors: dict[str, np.ndarray] = {}
    for name, values in table.columns.items():
        ending = next((end for end in ERROR_ENDINGS if name.endswith(end)), "")
        if ending and name.removesuffix(ending) in table.columns:
            errors[name.removesuffix(ending)] = values * _to_unit(known, name, name.removesuffix(ending))
        elif name not in (by, CASE, *_NOT_SCORED):
            if not np.isfinite(values).any():
                raise ReadError(
                    "not one value is a number", cure="leave the column out", file=path, place=f"column {name}"
                )
            columns[name] = values
    if len(columns) == 1:
        raise ReadError(f"there is no quantity beside '{by}'", cure="give one column a quantity", file=path)
    frame = pd.DataFrame(columns)
    frame[CASE] = _cases(table, path)
    found = tuple(item for item in table.findings if item.rule != "text-column" or CASE not in item.message)
    return CurveTable(
        Path(path).stem, by, frame, pd.DataFrame(errors, index=frame.index), known, str(path), table.sha256, found
    )


def _require_unit(unit: str, name: str, path: str | Path) -> None:
    try:
        conversion(unit)
    except ReadError as error:
        raise ReadError(error.cause, cure=error.cure, file=path, place=f"column {name}") from None


def _to_unit(units: Mapping[str, str], name: str, of: str) -> float:
    """Factor from the unit of an uncertainty to that of its quantity; the same unit where it has none."""
    own, wanted = units[name], units[of]
    if not (own and wanted) or own == wanted:
        return 1.0
    return conversion(own).factor / conversion(wanted).factor


def _cases(table: RawTable, path: str | Path) -> list[str]:
    """Text of the column ``case`` in each row; empty where there is none."""
    rows = len(table)
    if CASE in table.columns:
        return [f"{value:g}" for value in table.columns[CASE]]
    if CASE not in table.file_columns or table.dialect is None:
        return [""] * rows
    form = table.dialect
    place = table.file_columns.index(CASE)
    lines = Path(path).read_bytes().decode(form.encoding).splitlines()[form.first_data_row :]
    kept = [line for line in lines if line.strip() and not (form.comment and line.startswith(form.comment))]
    cells = (
        [line.split() for line in kept]
        if form.delimiter == " "
        else list(csv.reader(kept, delimiter=form.delimiter))
    )
    if len(cells) != rows or any(len(row) <= place for row in cells):
        raise ReadError(
            "the rows of the column 'case' are not those of the numbers", cure="fill each cell", file=path
        )
    return [row[place].strip() for row in cells]
