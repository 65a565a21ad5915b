"""Refinement studies from a table: a row a grid and a column a quantity, or a row a value.

Columns that describe the grid are ``cells`` (number of cells), ``h`` or ``spacing`` (cell size, or its ratio to
another) and ``time_step`` or ``dt``; ``grid``, ``study`` and ``note`` are words for the reader. In a table with
``quantity`` and ``value`` each row is one value, and ``unit`` and ``iterative`` may stand beside it. In any other
table every further column is a quantity, with its unit behind its name, and ``<name>_iterative`` is the half-width of
its iterative uncertainty.
"""

from __future__ import annotations

import difflib
import math
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.errors import ReadError
from ..core.findings import Finding
from ..core.provenance import file_hash
from ..formats.units import split_name
from ..verify.refinement import SAME_SPACING, refinement_findings, spacings_from_cells
from ..verify.refinement_study import Refinement, RefinementStudy
from .numbered_rows import NumberedRows, cell_number, numbered_rows

WANTED = "cells (or h) and one column a quantity, or quantity,cells,value"

SPACINGS, TIME_STEPS, WORDS = ("h", "spacing"), ("time_step", "dt"), ("grid", "study", "note")
ITERATIVE = "_iterative"
_LONG = ("quantity", "value", "unit", "iterative")


@dataclass(frozen=True)
class GridTable:
    """Studies of one file.

    Attributes
    ----------
    file, sha256 : str
    studies : tuple of RefinementStudy
    findings : tuple of Finding
        Refinement ratios that are small or not those assumed; rows that no study uses.
    """

    file: str
    sha256: str
    studies: tuple[RefinementStudy, ...]
    findings: tuple[Finding, ...]


@dataclass(frozen=True)
class _Rows:
    """Values of one quantity with what describes their grids; NaN where a table has no such column."""

    quantity: str
    unit: str
    value: list[float]
    spacing: list[float]
    time_step: list[float]
    point: list[float]
    iterative: list[float]


def read_grid_table(
    path: str | Path,
    *,
    dimension: int = 3,
    over: str = "",
    quantities: Sequence[str] = (),
    assumed_ratio: float | None = None,
) -> GridTable:
    """Read the studies of a table.

    Parameters
    ----------
    path : str or Path
        Text table parted by commas, semicolons or tabulators.
    dimension : {1, 2, 3}
        Directions in which the grids are refined, for cell counts.
    over : str
        Column that a curve runs over; each quantity is then a curve.
    quantities : sequence of str
        The quantities wanted; all when empty.
    assumed_ratio : float, optional
        Refinement ratio that the study says it has.

    Raises
    ------
    ReadError
        Naming file, line, cause and cure.
    """
    path = Path(path)
    table = numbered_rows(path, WANTED)
    heads = [split_name(name) for name in table.names]
    names = [name for name, _ in heads]
    if over and over not in names:
        raise ReadError(f"there is no column '{over}'", cure=_close(over, names), file=path)
    sizes = _sizes(table, names, path, dimension)
    long = {"quantity", "value"} <= set(names)
    found = _long(table, names, sizes, over, path) if long else _wide(table, heads, sizes, over, path)
    if quantities:
        for name in quantities:
            if name not in found:
                raise ReadError(f"there is no quantity '{name}'", cure=_close(name, list(found)), file=path)
        found = {name: found[name] for name in quantities}
    findings: list[Finding] = []
    studies = tuple(_study(rows, bool(over), path, findings) for rows in found.values())
    findings += _ratio_findings(studies, assumed_ratio, path.name)
    return GridTable(path.name, file_hash(path), studies, tuple(dict.fromkeys(findings)))


def _close(wanted: str, names: Sequence[str]) -> str:
    near = difflib.get_close_matches(wanted, names, n=1)
    return f"did you mean '{near[0]}'" if near else f"the table has {', '.join(names)}"


def _sizes(table: NumberedRows, names: list[str], path: Path, dimension: int) -> dict[str, np.ndarray]:
    """Relative cell size and time step of each row; NaN where the table has none."""
    spacing = _one_of(("cells", *SPACINGS), names, path)
    step = _one_of(TIME_STEPS, names, path)
    if not (spacing or step):
        raise ReadError("no column says how fine a grid is", cure=f"give {WANTED}", file=path)
    sizes = {key: np.full(len(table.rows), math.nan) for key in ("spacing", "time_step")}
    for key, name in (("spacing", spacing), ("time_step", step)):
        if not name:
            continue
        head = table.names[names.index(name)]
        column = np.array([_number(row[head], name, path, number) for number, row in table.rows])
        for (number, _), value in zip(table.rows, column, strict=True):
            if not (math.isfinite(value) and value > 0.0):
                raise ReadError(
                    f"{name} is {value:g}", cure="give a positive number", file=path, place=f"line {number}"
                )
        sizes[key] = spacings_from_cells(column, dimension) if name == "cells" and column.size else column
    return sizes


def _one_of(wanted: Sequence[str], names: Sequence[str], path: Path) -> str:
    there = [name for name in wanted if name in names]
    if len(there) > 1:
        raise ReadError(f"{' and '.join(there)} both say how fine a grid is", cure="keep one of them", file=path)
    return there[0] if there else ""


def _number(text: str, what: str, path: Path, line: int) -> float:
    """A number, NaN for an empty cell."""
    return math.nan if not text else cell_number(text, what, path, f"line {line}")


def _wide(
    table: NumberedRows, heads: list[tuple[str, str]], sizes: Mapping[str, np.ndarray], over: str, path: Path
) -> dict[str, _Rows]:
    names = [name for name, _ in heads]
    aside = {"cells", *SPACINGS, *TIME_STEPS, *WORDS, over}
    iterative = {name for name in names if name.endswith(ITERATIVE) and name.removesuffix(ITERATIVE) in names}
    found = {}
    for head, (name, unit) in zip(table.names, heads, strict=True):
        if name in aside or name in iterative:
            continue

        def column(of: str) -> list[float]:
            place = table.names[names.index(of)]
            return [_number(row[place], of, path, number) for number, row in table.rows]

        value = [_number(row[head], name, path, number) for number, row in table.rows]
        lacks = [math.nan] * len(value)
        found[name] = _Rows(
            name,
            unit,
            value,
            sizes["spacing"].tolist(),
            sizes["time_step"].tolist(),
            column(over) if over else lacks,
            column(name + ITERATIVE) if name + ITERATIVE in iterative else lacks,
        )
    if not found:
        raise ReadError("the table has no quantity", cure=f"give {WANTED}", file=path)
    return found


def _long(
    table: NumberedRows, names: list[str], sizes: Mapping[str, np.ndarray], over: str, path: Path
) -> dict[str, _Rows]:
    known = {"cells", *SPACINGS, *TIME_STEPS, *WORDS, *_LONG, over}
    for name in names:
        if name not in known:
            raise ReadError(
                f"unknown column '{name}'",
                cure=f"use {', '.join(sorted(known - {''}))}; name the column of a curve with --over",
                file=path,
            )
    found: dict[str, _Rows] = {}
    for place, (number, cells) in enumerate(table.rows):
        row = {name: cells[head] for name, head in zip(names, table.names, strict=True)}
        name = row["quantity"]
        if not name:
            raise ReadError("the quantity has no name", cure="complete the row", file=path, place=f"line {number}")
        rows = found.setdefault(name, _Rows(name, row.get("unit", ""), [], [], [], [], []))
        if row.get("unit", "") != rows.unit:
            raise ReadError(
                f"{name} is in '{row['unit']}' here and in '{rows.unit}' before",
                cure="give one unit a quantity",
                file=path,
                place=f"line {number}",
            )
        rows.value.append(_number(row["value"], "value", path, number))
        rows.spacing.append(float(sizes["spacing"][place]))
        rows.time_step.append(float(sizes["time_step"][place]))
        rows.point.append(_number(row[over], over, path, number) if over else math.nan)
        rows.iterative.append(_number(row.get("iterative", ""), "iterative", path, number))
    return found


def _study(rows: _Rows, curve: bool, path: Path, findings: list[Finding]) -> RefinementStudy:
    value, spacing, step = (np.array(one) for one in (rows.value, rows.spacing, rows.time_step))
    point = np.array(rows.point) if curve else None
    place = f"column {rows.quantity}"
    if not curve and not np.isfinite(value).all():
        bad = int(np.flatnonzero(~np.isfinite(value))[0]) + 1
        raise ReadError(
            f"{rows.quantity} has no value in data row {bad}",
            cure="leave the row of a failed run out, or run it again",
            file=path,
            place=place,
        )
    if rows.quantity.lower().endswith("phase") and rows.unit not in ("deg", "rad"):
        raise ReadError(
            f"'{rows.quantity}' is a phase without a unit",
            cure=f"write {rows.quantity} [deg] or [rad]: phases are unwrapped",
            file=path,
            place=place,
        )
    with_h, with_dt = np.isfinite(spacing).all(), np.isfinite(step).all()
    if not (with_h and with_dt):
        single = Refinement(value, spacing if with_h else step, point)
        parts: tuple[Refinement | None, Refinement | None] = (single, None) if with_h else (None, single)
        finest = spacing if with_h else step
    else:
        of_grid, of_time = _mode(step), _mode(spacing)
        parts = (
            _part(value, spacing, point, np.isclose(step, of_grid, rtol=SAME_SPACING)),
            _part(value, step, point, np.isclose(spacing, of_time, rtol=SAME_SPACING)),
        )
        finest = spacing
        unused = ~(np.isclose(step, of_grid) | np.isclose(spacing, of_time))
        if unused.any():
            findings.append(
                Finding(
                    "unused-rows",
                    "warning",
                    f"{int(unused.sum())} row(s) belong neither to the grids at one time step nor to the time steps "
                    "on one grid",
                    file=path.name,
                    cure="refine space and time one after the other",
                )
            )
    iterative = rows.iterative[int(np.argmin(finest))]
    if parts == (None, None):
        raise ReadError(f"{rows.quantity} is on one grid", cure="give three grids or more", file=path, place=place)
    if math.isfinite(iterative) and iterative < 0.0:
        raise ReadError("an iterative uncertainty is negative", cure="give half-widths", file=path, place=place)
    return RefinementStudy(rows.quantity, rows.unit, parts[0], parts[1], iterative)


def _mode(values: np.ndarray) -> float:
    """The most frequent value, the smallest of several."""
    counts = Counter(values.tolist())
    return min(counts, key=lambda value: (-counts[value], value))


def _part(value: np.ndarray, size: np.ndarray, point: np.ndarray | None, kept: np.ndarray) -> Refinement | None:
    if np.unique(size[kept]).size < 2:
        return None
    return Refinement(value[kept], size[kept], None if point is None else point[kept])


def _ratio_findings(studies: Sequence[RefinementStudy], assumed: float | None, file: str) -> list[Finding]:
    found: list[Finding] = []
    for study in studies:
        for part in (study.grid, study.time_step):
            sizes = None if part is None else np.unique(part.spacings)
            if sizes is not None and sizes.size > 1:
                found += refinement_findings(sizes, assumed)
    return [Finding(one.rule, one.severity, one.message, file, one.place, one.cure) for one in found]
