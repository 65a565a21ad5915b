"""The page of scored computations: curves, errors, scores, ranking."""

from __future__ import annotations

import math
from datetime import datetime
from pathlib import Path

import pandas as pd

from ..squat.code_scores import SIGNS, CodeScores
from .figure_style import PANEL, new_axes
from .page_table import Column, Table, make_table
from .score_figures import mean_error_figure, quality_figure, score_curve_figure, score_error_figure, shown_units
from .squat_page import Part, Section, drawn, findings_section, provenance_section, render_squat_page
from .squat_units import place_title, quantity_title
from .typography import fixed, signed, significant


def render_scores(scores: CodeScores, *, created: datetime | None = None) -> str:
    """The page of some scores as HTML that needs nothing beside itself.

    Parameters
    ----------
    scores : CodeScores
    created : datetime, optional
        Time that the page carries; the present one when not given.
    """
    name = Path(scores.measured.path).stem
    title = f"{', '.join(one.name for one in scores.codes)} against {name}"
    return render_squat_page(
        title,
        "scores of computations",
        [
            Section("scores", "Scores", score_parts(scores)),
            Section("curves", "Curves", _curves(scores)),
            Section("errors", "Residuals", _errors(scores)),
            *([Section("ranking", "Ranking", _ranking(scores))] if len(scores.codes) > 1 else []),
            findings_section(scores.findings),
            provenance_section({one.path: one.sha256 for one in (scores.measured, *scores.codes)}),
        ],
        source=f"{SIGNS}.",
        created=created,
    )


def score_parts(scores: CodeScores) -> tuple[Part, ...]:
    """Bars and tables of Q, BS and errors."""
    shown = shown_units(scores)
    units = dict.fromkeys(shown[str(name)][1] for name in scores.points["quantity"])
    drawings = [
        drawn(quality_figure(scores), "quality", "Quality Q over all cases: 10 % is a typical deviation of 10 %.")
    ]
    drawings += [
        drawn(
            mean_error_figure(scores, unit),
            f"mean-error-{number}",
            "Mean of S − D over all points; whiskers: standard deviation of the errors about it.",
        )
        for number, unit in enumerate(units)
    ]
    parts = [Part(drawings=tuple(drawings)), Part("By case and quantity", tables=(case_table(scores),))]
    if scores.scale != 1.0:
        parts.append(Part("At full scale", tables=(full_scale_table(scores),)))
    if len(scores.totals) > len(scores.codes):
        parts.append(
            Part(
                "Totals", ("Q is weighted by the number of points, BS is added.",), tables=(totals_table(scores),)
            )
        )
    if not scores.motions.empty:
        note = (
            "Length of the difference of the phasors over that of the measured ones: 0 agrees, 1 says no motion."
        )
        parts.append(Part("Motions, amplitude and phase together", notes=(note,), tables=(motions_table(scores),)))
    return tuple(parts)


def motions_table(scores: CodeScores) -> Table:
    """Complex errors of motions in waves."""
    columns = [
        Column("computation", "short"),
        Column("case", "short"),
        Column("motion", "short"),
        Column("n", "number"),
    ]
    columns += [Column("complex error", "number"), Column("amplitude [%]", "number", "mean of (|S| - |D|)/|D|")]
    columns.append(Column("phase [°]", "number", "root mean square of the phase of S ahead of D"))
    rows = [
        (
            str(of["code"]),
            str(of["case"]) or "–",
            quantity_title(str(of["motion"])),
            str(of["n"]),
            _known(of["complex_error"]),
            "–" if math.isnan(of["amplitude_error [%]"]) else signed(of["amplitude_error [%]"], 1),
            "–" if math.isnan(of["phase_difference [deg]"]) else fixed(of["phase_difference [deg]"], 1),
        )
        for of in scores.motions.to_dict("records")
    ]
    return make_table(columns, rows)


def case_table(scores: CodeScores) -> Table:
    """Scores by case and quantity, in the units of the measurement."""
    shown = shown_units(scores)
    noted = scores.details["note"].astype(bool).any()
    columns = [
        Column("case", "short"),
        Column("quantity", "short"),
        Column("n", "number"),
        Column("Q [%]", "number"),
    ]
    columns += [Column("BS", "number", "sum of the signs of D - S"), Column("bias", "number", "mean of S - D")]
    columns += [Column("rms", "number"), Column("max", "number", "largest |S - D|"), Column("unit", "short")]
    columns += [Column("note")] if noted else []
    rows, marks = [], []
    for of, more in zip(scores.scores.to_dict("records"), scores.details.to_dict("records"), strict=True):
        row = [str(of["case"]), quantity_title(str(of["quantity"])), str(of["n"]), fixed(100.0 * of["Q"], 1)]
        factor, unit = shown[str(of["quantity"])]
        row += [f"{of['BS']}/{of['n']}".replace("-", "−"), significant(factor * of["bias"])]
        row += [significant(factor * of["rms"]), significant(factor * of["max_abs"]), unit]
        rows.append([*row, *([str(more["note"]) or "–"] if noted else [])])
        marks.append("weak" if more["note"] else "")
    return make_table(columns, rows, marks=marks)


def full_scale_table(scores: CodeScores) -> Table:
    """Deviations by case and quantity at full scale."""
    columns = [Column("case", "short"), Column("quantity", "short"), Column("bias", "number", "mean of S - D")]
    columns += [Column("rms", "number"), Column("max", "number", "largest |S - D|"), Column("unit", "short")]
    rows = [
        (
            str(of["case"]),
            quantity_title(str(of["quantity"])),
            *(_known(more[f"{name}_full_scale"]) for name in ("bias", "rms", "max_abs")),
            str(more["unit_full_scale"]) or "–",
        )
        for of, more in zip(scores.scores.to_dict("records"), scores.details.to_dict("records"), strict=True)
    ]
    return make_table(columns, rows, f"Lengths times {scores.scale:g}; angles as they are.")


def _known(value: float) -> str:
    return "–" if math.isnan(value) else significant(value)


def totals_table(scores: CodeScores) -> Table:
    """Pooled totals."""
    rows = [
        (
            str(of["code"]),
            quantity_title(str(of["quantity"])),
            str(of["n"]),
            fixed(100.0 * of["Q"], 1),
            fixed(of["BS"], 0),
        )
        for of in scores.totals.to_dict("records")
    ]
    columns = [Column("computation"), Column("quantity"), Column("n", "number"), Column("Q [%]", "number")]
    return make_table([*columns, Column("BS", "number")], rows)


def _curves(scores: CodeScores) -> tuple[Part, ...]:
    parts = []
    for case in scores.measured.cases:
        used = scores.points[scores.points["case"] == case]["quantity"]
        drawings = tuple(
            drawn(
                score_curve_figure(scores, name, case, ax=new_axes(PANEL)),
                f"curve-{case}-{name}",
                f"{quantity_title(name).capitalize()}. Points: measured, with two standard uncertainties where known.",
            )
            for name in dict.fromkeys(str(name) for name in used)
        )
        parts.append(Part(case, drawings=drawings, size="panel"))
    return tuple(parts)


def _errors(scores: CodeScores) -> tuple[Part, ...]:
    quantities = dict.fromkeys(str(name) for name in scores.points["quantity"])
    drawings = tuple(
        drawn(
            score_error_figure(scores, name, ax=new_axes(PANEL)),
            f"error-{name}",
            "Above zero: computed larger.",
        )
        for name in quantities
    )
    return (Part(drawings=drawings, size="panel"), Part("Point by point", tables=(_points_table(scores),)))


def _points_table(scores: CodeScores) -> Table:
    by = scores.measured.by
    has_cases = scores.measured.cases != [""]
    shown = shown_units(scores)
    has_z = scores.points["z"].notna().any()
    columns = [Column("computation"), *([Column("case")] if has_cases else []), Column("quantity", "short")]
    columns += [Column(by, "number"), Column("D", "number"), Column("S", "number"), Column("S − D", "number")]
    columns += [Column("(S − D)/D [%]", "number"), Column("(D − S)/D [%]", "number")]
    columns += [Column("z", "number", "S - D over its combined standard uncertainty")] if has_z else []
    rows, marks = [], []
    for of in scores.points.to_dict("records"):
        factor, unit = shown[str(of["quantity"])]
        named = f"{place_title(str(of['quantity']))} [{unit or '-'}]"
        row = [str(of["code"]), *([str(of["case"])] if has_cases else []), named]
        row += [significant(of[by], 4), *(_known(factor * of[name]) for name in ("D", "S", "S - D"))]
        row += [signed(of["(S - D)/D [%]"], 1), signed(of["(D - S)/D [%]"], 1)]
        rows.append([*row, *([signed(of["z"], 1)] if has_z else [])])
        marks.append("weak" if math.isnan(of["S - D"]) else "")
    return make_table(columns, rows, "Shaded: outside the computation; nothing is extrapolated.", marks)


def _ranking(scores: CodeScores) -> tuple[Part, ...]:
    parts = []
    shown = shown_units(scores)
    for scope, of in scores.ranking.groupby("quantity", sort=False):
        # a scope over several quantities has the unit of the files
        factor, unit = shown.get(str(scope), (1.0, ""))
        parts.append(Part(quantity_title(str(scope)), tables=(_ranking_table(of, factor, unit),)))
    note = (
        "Smallest root mean square of S − D first; a computation of fewer points is ranked with them and says so."
    )
    return (Part(notes=(note,)), *parts)


def _ranking_table(of: pd.DataFrame, factor: float, unit: str) -> Table:
    tail = f" [{unit}]" if unit else ""
    columns = [Column("rank", "number"), Column("computation"), Column("n", "number")]
    columns += [Column(f"{name}{tail}", "number") for name in ("rms", "bias", "max")]
    columns += [Column("Q [%]", "number"), Column("BS", "number")]
    rows = [
        [
            str(row["rank"]),
            str(row["code"]),
            str(row["n"]),
            significant(factor * row["rms"]),
            significant(factor * row["bias"]),
            significant(factor * row["max_abs"]),
            fixed(100.0 * row["Q"], 1),
            f"{row['BS']}/{row['n']}".replace("-", "−"),
            str(row["note"]) or "–",
        ]
        for row in of.to_dict("records")
    ]
    return make_table([*columns, Column("note")], rows)
