"""Numerical uncertainty as text, as plain data and as tables of a page."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ..verify.derivative_uncertainty import DerivativeUncertainty
from ..verify.numerical_uncertainty import NumericalUncertainty, uncertainty_table
from ..verify.refinement_study import COMBINED, StudyUncertainty
from ..verify.triplet_uncertainty import UncertaintyEstimate
from .aligned_text import aligned_text
from .page_table import Column, Table, make_table
from .typography import derivative_name, fixed, significant


def percent(uncertainty: float, part: NumericalUncertainty) -> float:
    """Share of the fine value in per cent; NaN of zero and of phases, whose zero is arbitrary."""
    if part.fine == 0.0 or "phase" in part.quantity.lower():
        return math.nan
    return 100.0 * uncertainty / abs(part.fine)


def uncertainty_text(results: Sequence[StudyUncertainty]) -> str:
    """What a terminal shows: for each number its class and the methods beside each other."""
    blocks = []
    for result in results:
        blocks += [_block(part, result.method) for part in result.parts]
        for curve in result.curves:
            lines = [f"{one.method}: {_summary(one)}; {one.note}" for one in curve.pooled]
            blocks.append("\n".join([f"{result.study.quantity}, the whole curve", *lines, *curve.notes]))
        if result.chosen and result.chosen[0].method == COMBINED:
            one = result.chosen[0]
            blocks.append(
                f"{one.quantity}, all parts: U = {one.uncertainty:.4g} {one.unit}".rstrip() + f", {one.note}"
            )
    return "\n\n".join(blocks)


def _block(part: NumericalUncertainty, method: str) -> str:
    heading = f"{part.quantity or 'value'}{f' [{part.unit}]' if part.unit else ''}: {part.behaviour}"
    triplet = part.triplet
    if triplet is not None:
        ratios = ", ".join(f"{b / a:.4g}" for a, b in zip(part.spacings[:-1], part.spacings[1:], strict=True))
        r = "" if math.isnan(triplet.ratio) else f"R = {triplet.ratio:.4g}, "
        heading += f"; {r}refinement {ratios}"
        changes = (("e_a", triplet.relative_change), ("e_ext", triplet.relative_extrapolation))
        if math.isfinite(percent(1.0, part)):
            heading += "".join(f", {name} {100.0 * size:.4g} %" for name, size in changes if math.isfinite(size))
    frame = uncertainty_table(part.estimates)
    frame["% of fine"] = [percent(size, part) for size in frame["uncertainty"]]
    table = aligned_text(frame, ["method", "order", "extrapolated", "uncertainty", "% of fine", "note"], digits=5)
    chosen = part.by(method)
    share = percent(chosen.uncertainty, part)
    said = f", {share:.3g} % of" if math.isfinite(share) else " about"
    return f"{heading}\n{table}\n-> {chosen.method}: U = {chosen.uncertainty:.4g}{said} {part.fine:.6g}"


def _summary(one: UncertaintyEstimate) -> str:
    order = "no order" if math.isnan(one.order) else f"order {one.order:.4g}"
    return f"{one.behaviour}, {order}, U = {one.uncertainty:.4g} {one.unit}".rstrip()


def derivative_text(derivatives: DerivativeUncertainty) -> str:
    """What a terminal shows of derivatives: numerical uncertainty beside that of the fit."""
    columns = ["name", "value", "class", "method", "order", "extrapolated", "U_num", "u_fit", "U95"]
    return f"{aligned_text(derivatives.table, columns)}\nU_num and U95 (both parts): 95 %; u_fit: standard"


def derivative_records(derivatives: DerivativeUncertainty) -> list[dict[str, Any]]:
    """Rows of the table of derivatives as plain data."""
    return [
        {str(name): _known(value) if isinstance(value, float) else value for name, value in row.items()}
        for row in derivatives.table.to_dict("records")
    ]


def derivatives_table(derivatives: DerivativeUncertainty) -> Table:
    """One row a derivative: value, class, both uncertainties."""
    terms = {term.name: term for term in derivatives.combined.terms}
    columns = [
        Column("derivative", "short"),
        Column("value", "number", "of the finest grid"),
        Column("U95", "number", "numerical and fit together, 95 %"),
        Column("U_num", "number", "numerical, 95 %"),
        Column("u_fit", "number", "standard error of the fit on the finest grid"),
        Column("class"),
        Column("method"),
    ]
    rows, marks = [], []
    for row in derivatives.table.to_dict("records"):
        sizes = [significant(row[name], 3) for name in ("U95", "U_num", "u_fit")]
        rows.append(
            (
                derivative_name(terms[row["name"]]),
                significant(row["value"], 5),
                *sizes,
                row["class"],
                row["method"],
            )
        )
        marks.append("" if row["class"] == "monotone convergent" else "weak")
    return make_table(columns, rows, marks=marks)


def uncertainty_records(results: Sequence[StudyUncertainty]) -> list[dict[str, Any]]:
    """Everything as plain data; None for what does not exist."""
    records = []
    for result in results:
        for part in result.parts:
            records.append(_record(part, result.method))
        for curve in result.curves:
            records.append(
                {
                    "quantity": result.study.quantity,
                    "unit": result.study.unit,
                    "points": curve.points.tolist(),
                    "oscillating_percent": _known(100.0 * curve.oscillating),
                    "methods": [_estimate(one) for one in curve.pooled],
                    "notes": list(curve.notes),
                }
            )
        if result.chosen and result.chosen[0].method == COMBINED:
            one = result.chosen[0]
            records.append(
                {"quantity": one.quantity, "unit": one.unit, "class": one.behaviour, "chosen": _estimate(one)}
            )
    return records


def _record(part: NumericalUncertainty, method: str) -> dict[str, Any]:
    record: dict[str, Any] = {
        "quantity": part.quantity,
        "unit": part.unit,
        "class": part.behaviour,
        "values": part.values.tolist(),
        "relative_spacings": part.spacings.tolist(),
        "refinement_ratios": (part.spacings[1:] / part.spacings[:-1]).tolist(),
    }
    triplet = part.triplet
    if triplet is not None:
        celik = part["GCI Celik"]
        record |= {
            "convergence_ratio": _known(triplet.ratio),
            "order": _known(triplet.order),
            "extrapolated": _known(triplet.extrapolated),
            "relative_change_percent": _known(100.0 * triplet.relative_change),
            "relative_extrapolation_percent": _known(100.0 * triplet.relative_extrapolation),
            "gci_percent": _known(percent(celik.uncertainty, part)),
            "asymptotic_ratio": _known(triplet.asymptotic_ratio),
        }
    record["chosen"] = _estimate(part.by(method))
    record["methods"] = [_estimate(one) for one in part.estimates]
    return record


def _estimate(one: UncertaintyEstimate) -> dict[str, Any]:
    return {
        "method": one.method,
        "class": one.behaviour,
        "order": _known(one.order),
        "extrapolated": _known(one.extrapolated),
        "uncertainty": _known(one.uncertainty),
        "note": one.note,
    }


def _known(value: float) -> float | None:
    return value if math.isfinite(value) else None


def chosen_table(results: Sequence[StudyUncertainty]) -> Table:
    """One row a number: class, the method that counts, its uncertainty."""
    columns = [
        Column("quantity"),
        Column("unit", "short"),
        Column("class"),
        Column("fine value", "number"),
        Column("extrapolated", "number"),
        Column("order", "number"),
        Column("U (95 %)", "number"),
        Column("% of fine", "number"),
        Column("method"),
    ]
    rows, marks = [], []
    for result in results:
        parts = {part.quantity: part for part in result.parts}
        shown = [part.by(result.method) for part in result.parts]
        shown += [one for one in result.chosen if one.method == COMBINED]
        for one in shown:
            part = parts.get(one.quantity, result.parts[0])
            rows.append(
                (
                    one.quantity,
                    one.unit,
                    one.behaviour,
                    significant(part.fine, 5),
                    significant(one.extrapolated, 5),
                    fixed(one.order, 3),
                    significant(one.uncertainty, 3),
                    fixed(percent(one.uncertainty, part), 2),
                    one.method,
                )
            )
            marks.append("" if one.behaviour == "monotone convergent" else "weak")
    return make_table(columns, rows, marks=marks)


def methods_table(part: NumericalUncertainty, method: str) -> Table:
    """All methods for one number."""
    columns = [
        Column("method"),
        Column("order", "number"),
        Column("extrapolated", "number"),
        Column("U (95 %)", "number"),
        Column("% of fine", "number"),
        Column("note"),
    ]
    rows, marks = [], []
    for one in part.estimates:
        rows.append(
            (
                one.method,
                fixed(one.order, 3),
                significant(one.extrapolated, 5),
                significant(one.uncertainty, 3),
                fixed(percent(one.uncertainty, part), 2),
                one.note,
            )
        )
        marks.append("first" if one.method == part.by(method).method else "")
    return make_table(columns, rows, marks=marks)


def pooled_table(estimates: Sequence[UncertaintyEstimate]) -> Table:
    """A curve as a whole."""
    columns = [
        Column("method"),
        Column("class"),
        Column("order", "number"),
        Column("U (95 %)", "number"),
        Column("note"),
    ]
    return make_table(
        columns,
        [
            (one.method, one.behaviour, fixed(one.order, 3), significant(one.uncertainty, 3), one.note)
            for one in estimates
        ],
    )
