"""Tables of a grid study for a page and for a terminal."""

from __future__ import annotations

import math

from ..cfd.grid_study import GridStudy
from .aligned_text import aligned_text
from .page_table import Column, Table, make_table
from .typography import derivative_name, fixed, significant


def grid_derivatives_table(study: GridStudy) -> Table:
    """Each derivative: value, truth where known, both uncertainties, class, observed order and limit."""
    frame = study.table()
    terms = {term.name: term for term in study.derivatives.terms}
    known = study.truth is not None
    columns = [Column("derivative", "short"), Column("value", "number", "of the finest grid")]
    if known:
        columns += [Column("truth", "number"), Column("inside", "short", "truth within value ± U95")]
    columns += [
        Column("U95", "number", "numerical and fit together, expanded"),
        Column("U_num", "number", "numerical uncertainty, expanded (95 %)"),
        Column("u_fit", "number", "standard error of the fit on the finest grid"),
        Column("class"),
        Column("order", "number", "observed order of convergence"),
        Column("limit", "number", "extrapolated to spacing zero"),
    ]
    rows, marks = [], []
    for row in frame.to_dict("records"):
        places = _places(row["U95"])
        cells = [derivative_name(terms[row["name"]]), fixed(row["value"], places)]
        if known:
            cells += [fixed(row["truth"], places), "yes" if row["truth inside"] else "no"]
        cells += [significant(row[name], 2) for name in ("U95", "U_num", "u_fit")]
        cells += [row["class"], fixed(row["order"], 2), fixed(row["extrapolated"], places)]
        rows.append(cells)
        marks.append("weak" if "divergent" in row["class"] or (known and not row["truth inside"]) else "")
    return make_table(columns, rows, marks=marks)


def grids_table(study: GridStudy) -> Table:
    """Each grid: cells, relative spacing, ratio to the next finer one, cases."""
    columns = [
        Column("grid"),
        Column("cells", "number"),
        Column("spacing", "number"),
        Column("ratio", "number"),
        Column("cases", "number"),
    ]
    rows = []
    for place, grid in enumerate(study.grids):
        mine = [item for item in study.settled if item.case.grid == grid]
        ratio = study.spacings[place] / study.spacings[place - 1] if place else math.nan
        rows.append(
            [
                grid,
                fixed(mine[0].case.cells, 0),
                fixed(float(study.spacings[place]), 3),
                fixed(float(ratio), 3),
                str(len(mine)),
            ]
        )
    return make_table(columns, rows)


def grid_study_text(study: GridStudy) -> str:
    """What a terminal shows: the derivatives with their uncertainty, and the verdict of the comparison."""
    frame = study.table()
    columns = ["name", "value", "class", "order", "U_num", "u_fit", "U95"]
    lines = [f"{study.name}: grids {', '.join(study.grids)}, spacings {_spacings(study)}", ""]
    if study.truth is not None:
        columns += ["truth", "truth inside"]
        frame["truth inside"] = ["yes" if inside else "no" for inside in frame["truth inside"]]
    lines.append(aligned_text(frame, columns))
    lines += ["", "U: expanded uncertainties (95 %); u_fit: standard error of the fit"]
    if study.validation is not None and study.reference is not None:
        verdicts = study.validation["verdict"].value_counts()
        counts = ", ".join(f"{count} {verdict}" for verdict, count in verdicts.items())
        lines.append(f"against {study.reference.name}: {counts}")
    return "\n".join(lines)


def _spacings(study: GridStudy) -> str:
    return ", ".join(f"{value:.3g}" for value in study.spacings)


def _places(half: float) -> int:
    if not (math.isfinite(half) and half > 0.0):
        return 5
    return min(max(1 - math.floor(math.log10(half)), 0), 8)
