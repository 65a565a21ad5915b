"""Tables of the decay report: coefficients of all methods, verdicts, records, Ikeda, steps."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from ..decay.compare import METHODS
from ..decay.damping_models import TERMS
from ..decay.decay_results import DecayAnalysis, DecayGroup, is_dimensional
from ..decay.ikeda_comparison import IkedaComparison
from ..decay.model_verdict import term_verdicts
from .damping_figures import shown_unit
from .page_table import Column, Table, make_table
from .typography import fixed, significant

_SHOWN_AMPLITUDES = 6


def _with_error(value: float, error: float) -> tuple[str, str]:
    """Value and standard error with the decimals that the error supports."""
    if not (math.isfinite(error) and error > 0.0):
        return significant(value, 4), "–"
    places = max(1 - math.floor(math.log10(error)), 0)
    return fixed(value, places), fixed(error, places)


def method_table(group: DecayGroup, truth: Mapping[str, float]) -> Table:
    """Coefficients of every method, one row a fit; those to be doubted are shaded."""
    names = [
        name for name in (*TERMS, *group.preferred.model.speed) if any(name in one.names for one in group.results)
    ]
    units = {name: unit for one in group.results for name, unit in one.units.items()}
    columns = [Column("method"), Column("model", "code")]
    for name in names:
        columns += [Column(f"{name} [{units[name]}]", "number"), Column("±", "number", "standard error")]
    columns += [Column("R²", "number"), Column("to be trusted")]
    rows, marks = [], []
    if truth:
        cells = [cell for name in names for cell in (significant(truth.get(name, 0.0), 4), "")]
        rows.append(("truth", "", *cells, "", ""))
        marks.append("first")
    for fit in group.results:
        cells = []
        for name in names:
            if name in fit.names:
                place = fit.position(name)
                cells += _with_error(float(fit.params[place]), float(fit.bse[place]))
            else:
                cells += ["–", ""]
        doubts = group.doubts(fit)
        rows.append(
            (
                fit.method,
                fit.model.label,
                *cells,
                fixed(fit.diagnostics.r2, 5),
                "no: " + ", ".join(doubts) if doubts else "yes",
            )
        )
        marks.append("weak" if doubts else "")
    return make_table(columns, rows, marks=marks)


def failures_table(group: DecayGroup) -> Table:
    """Methods that gave no result, and why."""
    return make_table([Column("method"), Column("why it gave no result")], list(group.failures.items()))


def equivalent_table(group: DecayGroup) -> Table:
    """Equivalent damping of the preferred fit at a few amplitudes, in the forms of the field."""
    fit = group.preferred
    speed = group.records[0].speed
    low, high = fit.diagnostics.amplitudes
    at = np.linspace(low, high, _SHOWN_AMPLITUDES)
    one = fit.equivalent(at, speed=speed)
    factor, unit = shown_unit(fit.motion)
    columns = [Column(f"amplitude [{unit}]", "number"), Column("ω [rad/s]", "number")]
    columns += [
        Column("αₑ [1/s]", "number"),
        Column("95 % interval", "number"),
        Column("Bₑ = 2αₑ [1/s]", "number"),
    ]
    columns += [Column("ζ [-]", "number")]
    if fit.motion != "heave":
        columns.append(Column("Bertin N [1/deg]", "number"))
    dimensional = fit.dimensional(at, speed=speed) if is_dimensional(fit) else None
    if dimensional is not None:
        columns += [Column("B44 [N m s]", "number"), Column("B44-hat [-]", "number")]
    rows = []
    for k in range(at.size):
        row = [fixed(factor * at[k], 2), fixed(one.omega[k], 4), fixed(one.alpha[k], 5)]
        row += [f"{fixed(one.alpha_lower[k], 5)} … {fixed(one.alpha_upper[k], 5)}", fixed(one.B[k], 5)]
        row.append(fixed(one.zeta[k], 5))
        if fit.motion != "heave":
            row.append(fixed(float(one.bertin[k]), 5))
        if dimensional is not None:
            row += [significant(float(dimensional["B44 [N m s]"].iloc[k]), 4)]
            row += [fixed(float(dimensional["B44-hat [-]"].iloc[k]), 6)]
        rows.append(row)
    return make_table(columns, rows)


def models_table(group: DecayGroup) -> Table | None:
    """What the records say of each damping model; None when none was judged."""
    if group.verdict is None:
        return None
    rows, marks = [], []
    for words, statistic, p in group.verdict.models:
        supported = not group.verdict.contradicts(words)
        said = "supported" if supported else "contradicted"
        if words == group.verdict.supported:
            said += ", with the fewest terms"
        rows.append((words, group.verdict.restoring, fixed(statistic, 2), _p_text(p), said))
        marks.append("" if supported else "weak")
    columns = [
        Column("damping"),
        Column("restoring"),
        Column("F", "number"),
        Column("p", "number"),
        Column("verdict"),
    ]
    largest = group.verdict.largest.model.label
    return make_table(
        columns, rows, f"F test of the terms that a model leaves out of the largest one ({largest}).", marks
    )


def _p_text(p: float) -> str:
    return "< 0.0001" if p < 1e-4 else fixed(p, 4)


def terms_table(group: DecayGroup) -> Table:
    """Which terms of the preferred fit are identifiable."""
    fit = group.preferred
    rows, marks = [], []
    for name, said in term_verdicts(fit):
        place = fit.position(name)
        rows.append((name, *_with_error(float(fit.params[place]), float(fit.bse[place])), fit.units[name], said))
        marks.append("weak" if said.startswith(("not", "weakly")) else "")
    columns = [Column("term", "code"), Column("value", "number"), Column("±", "number"), Column("unit", "short")]
    return make_table([*columns, Column("verdict")], rows, marks=marks)


def ikeda_table(comparison: IkedaComparison) -> Table:
    """Measured and predicted B44-hat at a few amplitudes, all times 1000."""
    table = comparison.table
    picked = np.unique(np.linspace(0, len(table) - 1, _SHOWN_AMPLITUDES).round().astype(int))
    names = ["measured", "friction", "wave", "eddy", "bilge_keel", "lift", "predicted"]
    columns = [Column("amplitude [deg]", "number")]
    columns += [Column(name.replace("_", " "), "number") for name in names]
    columns.append(Column("predicted / measured", "number"))
    rows = [
        [fixed(table["amplitude_deg"].iloc[k], 2)]
        + [fixed(1000.0 * float(table[name].iloc[k]), 4) for name in names]
        + [fixed(float(table["ratio"].iloc[k]), 2)]
        for k in picked
    ]
    return make_table(columns, rows, "1000 · B44-hat, non-dimensional.")


def records_table(analysis: DecayAnalysis) -> Table:
    """The records: file, speed, free part, half cycles."""
    columns = [Column("record"), Column("group"), Column("samples", "number"), Column("free part [s]", "number")]
    columns += [Column("half cycles", "number"), Column("period [s]", "number"), Column("amplitudes", "number")]
    rows = []
    for group in analysis.groups:
        for record in group.records:
            factor, unit = shown_unit(record.motion)
            swings = factor * record.extremes.half_swing
            rows.append(
                (
                    record.name,
                    group.label,
                    str(len(record)),
                    f"{fixed(record.time[0], 2)} … {fixed(record.time[-1], 2)}",
                    str(swings.size),
                    fixed(record.period, 4),
                    f"{fixed(swings.max(), 2)} … {fixed(swings.min(), 2)} {unit}",
                )
            )
    return make_table(columns, rows)


def ratio_facts(group: DecayGroup) -> list[tuple[str, str, str]]:
    """What a group amounts to, as (what, number, detail)."""
    fit = group.preferred
    middle = math.sqrt(fit.diagnostics.amplitudes[0] * fit.diagnostics.amplitudes[1])
    at = fit.equivalent([middle], speed=group.records[0].speed)
    factor, unit = shown_unit(fit.motion)
    percent = 100.0 * float(at.alpha_sd[0] / abs(at.alpha[0]))
    rows = [
        (
            "natural period",
            f"{fixed(2.0 * math.pi / fit.omega_n, 3)} s",
            f"ωₙ = {fixed(fit.omega_n, 4)} rad/s at vanishing amplitude",
        ),
        (
            "damping ratio",
            f"ζ {fixed(float(at.zeta[0]), 5)}",
            f"at {fixed(factor * middle, 2)} {unit}, standard error {percent:.1f} %, {fit.method}",
        ),
        ("R²", fixed(fit.diagnostics.r2, 5), "of the re-simulated motion"),
    ]
    if group.verdict is not None:
        rows.append(("damping supported", group.verdict.supported, f"restoring: {group.verdict.restoring}"))
    return rows


def ratio_sentence(group: DecayGroup) -> str:
    """Damping ratio and frequency for a simulator in six degrees of freedom; empty when there are none."""
    ratio = group.ratio
    if ratio is None:
        return ""
    return (
        f"For a simulator with one ratio: ζ = {fixed(ratio.zeta, 5)} "
        f"(light-damping form {fixed(ratio.zeta_light, 5)}), ωₙ = {fixed(ratio.omega_n, 4)} rad/s, "
        f"from peaks of one side of {group.records[0].name}."
    )


def method_notes() -> str:
    """Which methods are exact for a noise-free decay."""
    exact = [name for name, method in METHODS.items() if method.exact]
    return f"Exact for a noise-free decay: {', '.join(exact)}. The others hold to first order in the damping."
