"""Tables of the report about derivatives: values, conventions, validity, other ways, models and ranges."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.derivative_table import digits_for, unit_line
from ..core.variables import VARIABLES
from ..pmm.campaign_file import SharedBias
from ..pmm.hull_fit import HullFit
from ..pmm.shared_bias import bias_covariance
from .page_table import Column, Table, make_table
from .typography import derivative_name, fixed, printed_formula, signed, significant, symbol

if TYPE_CHECKING:
    import pandas as pd

VIF_LIMIT = 10.0
"""Variance inflation from which a derivative is marked as poorly separated."""


def units_text(derivatives: DerivativeSet) -> str:
    """The line that says how a set is scaled, in print."""
    return printed_formula(unit_line(derivatives))


def derivative_table(fit: HullFit, written: DerivativeSet, bias: SharedBias) -> Table:
    """Derivatives of one group with everything that says how sure they are.

    Parameters
    ----------
    fit : HullFit
    written : DerivativeSet
        The set of the fit in the conventions of the output.
    bias : SharedBias
        Its share of the uncertainty gets a column of its own where there is one.
    """
    inflation = _inflation(fit)
    shared = _shared_part(fit, written, bias)
    columns = [
        Column("derivative"),
        Column("value", "number"),
        Column("std", "number", "standard uncertainty"),
        Column("lower 95 %", "number"),
        Column("upper 95 %", "number"),
        Column("± 95 % [%]", "number", "half width of the interval over the magnitude of the value"),
        Column("VIF", "number", "variance inflation factor"),
    ]
    if shared:
        columns.insert(3, Column("of it shared", "number", "part of std that all runs share (type B)"))
    rows, marks = [], []
    for term, row in zip(written.terms, written.to_frame().to_dict("records"), strict=True):
        places = digits_for(row["value"], row["std"])
        half = 0.5 * (row["upper95"] - row["lower95"])
        factor = inflation.get(term.name, math.nan)
        cells = [
            derivative_name(term),
            fixed(row["value"], places),
            fixed(row["std"], places),
            fixed(row["lower95"], places),
            fixed(row["upper95"], places),
            _percent(half, row["value"]),
            fixed(factor, 1),
        ]
        if shared:
            cells.insert(3, fixed(shared.get(term.name, math.nan), places))
        rows.append(cells)
        holds_zero = row["lower95"] <= 0.0 <= row["upper95"]
        marks.append("weak" if holds_zero or factor > VIF_LIMIT else "")
    return make_table(columns, rows, units_text(written), marks)


def _percent(half: float, value: float) -> str:
    if not math.isfinite(half) or value == 0.0:
        return "–"
    percent = 100.0 * half / abs(value)
    return "> 999" if percent > 999 else fixed(percent, 1 if percent < 10 else 0)


def _inflation(fit: HullFit) -> dict[str, float]:
    factors: dict[str, float] = {}
    for component in fit.components:
        diagnostics = fit.derivatives.diagnostics.get(component, {})
        factors |= diagnostics.get("VIF", {})
    return factors


def _shared_part(fit: HullFit, written: DerivativeSet, bias: SharedBias) -> dict[str, float]:
    """Standard uncertainty from shared bias by derivative, in the conventions of the output; empty when none."""
    covariance, shares = bias_covariance(fit.runs, fit.components, bias)
    if not shares:
        return {}
    part = replace(fit.derivatives, covariance=covariance).to(written.conventions)
    return dict(zip(part.names, part.bse.tolist(), strict=True))


def conventions_table(derivatives: DerivativeSet) -> Table:
    """Conventions of a set in words."""
    rows = [
        (name.replace("coriolis", "Coriolis"), printed_formula(meaning), choice)
        for name, choice, meaning in derivatives.conventions.describe()
    ]
    return make_table([Column("convention"), Column("meaning"), Column("choice", "code")], rows)


def validity_table(derivatives: DerivativeSet) -> Table:
    """Range of each variable that the runs covered."""
    rows = []
    for name, (low, high) in derivatives.validity.items():
        if name == "Fn":
            meaning, unit, factor = "Froude number U/√(g L)", "–", 1.0
        else:
            kind = VARIABLES[name]
            meaning = kind.meaning
            unit, factor = ("deg", 180.0 / math.pi) if kind.angle else ("–", 1.0)
        prime = "" if name == "Fn" or unit == "deg" else "′"
        rows.append((symbol(name) + prime, significant(factor * low), significant(factor * high), unit, meaning))
    columns = [
        Column("variable"),
        Column("from", "number"),
        Column("to", "number"),
        Column("unit"),
        Column("meaning"),
    ]
    return make_table(columns, rows)


def estimators_table(estimates: pd.DataFrame, derivatives: DerivativeSet) -> Table:
    """Estimates of the chosen estimator beside those of least squares."""
    columns = [
        Column("derivative"),
        Column("fit", "number"),
        Column("std", "number"),
        Column("least squares", "number"),
        Column("std", "number"),
        Column("Δ / std", "number", "difference in standard errors of least squares"),
    ]
    terms = {term.name: term for term in derivatives.terms}
    rows = []
    for row in estimates.to_dict("records"):
        places = digits_for(row["fit"], row["fit_std"])
        rows.append(
            (
                derivative_name(terms[row["name"]]),
                fixed(row["fit"], places),
                fixed(row["fit_std"], places),
                *_value_and_std(row["least_squares"], row["least_squares_std"], places),
                _change(row["difference_in_std"]),
            )
        )
    return make_table(columns, rows)


def three_ways_table(ways: pd.DataFrame, derivatives: DerivativeSet) -> Table:
    """Fit, single-run and multiple-run estimates side by side."""
    columns = [
        Column("derivative"),
        Column("fit of all runs", "number"),
        Column("std", "number"),
        Column("single runs", "number", "mean over the runs that give an estimate"),
        Column("std", "number"),
        Column("runs", "number"),
        Column("Δ [%]", "number", "single runs less fit, in per cent of the fit"),
        Column("multiple runs", "number", "curve over the amplitudes of one kind of test"),
        Column("std", "number"),
        Column("Δ [%]", "number", "multiple runs less fit, in per cent of the fit"),
        Column("from"),
    ]
    terms = {term.name: term for term in derivatives.terms}
    rows = []
    for row in ways.to_dict("records"):
        places = digits_for(row["fit"], row["fit_std"])
        rows.append(
            (
                derivative_name(terms[row["name"]]),
                fixed(row["fit"], places),
                fixed(row["fit_std"], places),
                *_value_and_std(row["single_run"], row["single_run_std"], places),
                str(row["single_runs"]) if row["single_runs"] else "–",
                _change(row["single_minus_fit_percent"]),
                *_value_and_std(row["multiple_run"], row["multiple_run_std"], places),
                _change(row["multiple_minus_fit_percent"]),
                row["multiple_run_method"] or "–",
            )
        )
    return make_table(columns, rows)


def _value_and_std(value: float, std: float, places: int) -> tuple[str, str]:
    """Both with the digits that `std` supports, or with `places` where it is unknown."""
    if math.isfinite(std):
        places = digits_for(value, std)
    return fixed(value, places), fixed(std, places)


def _change(percent: float) -> str:
    if not math.isfinite(percent):
        return "–"
    if abs(percent) > 999:
        return "> 999" if percent > 0 else "< −999"
    return signed(percent, 1)


def candidates_table(candidates: pd.DataFrame) -> Table:
    """Hull models that were compared, best first for each component."""
    columns = [
        Column("force"),
        Column("model"),
        Column("terms", "number"),
        Column("data", "number"),
        Column("ΔAICc", "number", "AICc less that of the best model"),
        Column("weight", "number", "Akaike weight"),
        Column("R²", "number"),
        Column("residual rms", "number", "weighted, scaled force"),
        Column("left-out rms", "number", "of each run predicted by the fit without it"),
        Column("condition", "number"),
    ]
    noted = bool((candidates["note"] != "").any())
    if noted:
        columns.append(Column("note"))
    rows, marks = [], []
    last = ""
    for row in candidates.to_dict("records"):
        marks.append("first" if row["component"] != last else "")
        last = str(row["component"])
        rows.append(
            (
                str(row["component"]),
                str(row["model"]),
                fixed(row["terms"], 0),
                fixed(row["n"], 0),
                fixed(row["delta_AICc"], 1),
                fixed(row["weight"], 3),
                fixed(row["R2"], 5),
                significant(row["residual_rms"]),
                significant(row["cv_rms"]),
                significant(row["condition_number"]),
                *((str(row["note"]),) if noted else ()),
            )
        )
    return make_table(columns, rows, marks=marks)


def range_table(sensitivity: pd.DataFrame, derivatives: DerivativeSet) -> Table:
    """Derivatives refitted on runs within limits: value, and change in standard errors of the full fit."""
    terms = {term.name: term for term in derivatives.terms}
    limits = list(
        dict.fromkeys(zip(sensitivity["variable"], sensitivity["limit"], sensitivity["runs"], strict=True))
    )
    columns = [Column("derivative")]
    for variable, limit, _ in limits:
        columns.append(Column(_within(variable, limit), "number"))
        if variable:
            columns.append(Column("Δ/std", "number", "change over the standard error of the fit of all runs"))
    table: Mapping[tuple[str, str, float], tuple[float, float, float]] = {
        (row["name"], row["variable"], row["limit"]): (row["value"], row["std"], row["change_in_std"])
        for row in sensitivity.to_dict("records")
    }
    rows, marks = [], []
    for name in dict.fromkeys(sensitivity["name"]):
        cells: list[str] = [derivative_name(terms[name])]
        moved = 0.0
        for variable, limit, _ in limits:
            value, std, change = table[name, variable, limit]
            cells.append(fixed(value, digits_for(value, std)))
            if variable:
                cells.append(signed(change, 1))
                moved = max(moved, abs(change) if np.isfinite(change) else 0.0)
        rows.append(cells)
        marks.append("weak" if moved > 2.0 else "")
    caption = "Runs: " + "; ".join(f"{_within(variable, limit)}: {runs}" for variable, limit, runs in limits)
    return make_table(columns, rows, caption, marks)


def _within(variable: str, limit: float) -> str:
    return f"|{symbol(variable)}{'′' if variable in ('v', 'r') else ''}| ≤ {limit:g}" if variable else "all"
