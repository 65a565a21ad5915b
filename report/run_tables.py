"""Tables of the report about runs: the runs themselves, their harmonics, and the diagnostics of the fit."""

from __future__ import annotations

import math

from ..pmm.campaign_result import CampaignResult
from ..pmm.hull_fit import HullFit
from .page_table import Column, Table, make_table
from .typography import MINUS, fixed, significant

MOST_ROWS = 400
"""Rows of a table in the page; all of them are in the CSV file."""

_PARAMETERS = (
    ("drift angle [deg]", "β [deg]"),
    ("yaw rate [rad/s]", "r [rad/s]"),
    ("frequency [rad/s]", "ω [rad/s]"),
    ("sway amplitude [m]", "y amplitude [m]"),
    ("yaw amplitude [deg]", "ψ amplitude [deg]"),
    ("rudder angle [deg]", "δ [deg]"),
    ("heel [deg]", "φ [deg]"),
)
_MARKS = {"outlying": "bad", "accepted with errors": "bad", "with warnings": "weak"}


def runs_table(result: CampaignResult) -> Table:
    """One row a run: type, what varies, window, largest residual, quality, findings."""
    frame = result.runs_frame()
    total = len(frame)
    frame = frame.head(MOST_ROWS)
    used = [(name, title) for name, title in _PARAMETERS if (frame[name] != 0.0).any()]
    depths = frame["h/T"].nunique() > 1
    columns = [Column("№", "number"), Column("run", "name"), Column("type", "short"), Column("U [m/s]", "number")]
    columns += [Column(title, "number") for _, title in used]
    if depths:
        columns.append(Column("h/T", "number"))
    columns += [
        Column("window [s]", "short"),
        Column("samples", "number"),
        Column("largest residual", "number", "standard deviations"),
        Column("quality", "short"),
    ]
    if frame["findings"].any():
        columns.append(Column("findings"))
    rows, marks = [], []
    for number, row in enumerate(frame.to_dict("records"), start=1):
        window = "–"
        if row["samples"] > 1:
            window = f"{row['window start [s]']:.1f}–{row['window stop [s]']:.1f}"
        cells = [str(number), row["run"], row["type"].replace("_", " "), _short(row["speed [m/s]"])]
        cells += [_short(row[name]) for name, _ in used]
        if depths:
            cells.append(_short(row["h/T"]))
        cells += [
            window,
            str(row["samples"]),
            fixed(row["largest residual [sd]"], 1),
            row["quality"],
            row["findings"] or "–",
        ][: len(columns) - len(cells)]
        rows.append(cells)
        marks.append(_MARKS.get(row["quality"], ""))
    caption = f"The first {len(frame)} of {total} runs; all are in runs.csv." if total > len(frame) else ""
    return make_table(columns, rows, caption, marks)


def _short(value: float) -> str:
    """At most four significant digits, without zeros at the end."""
    text = f"{value + 0.0:.4g}"
    return text.replace("-", MINUS) if math.isfinite(value) and "e" not in text else significant(value)


def harmonics_table(fit: HullFit) -> Table:
    """Mean and harmonics of the oscillating runs of a group: measured with standard error, and fitted."""
    columns = [
        Column("run"),
        Column("force"),
        Column("harmonic", "number"),
        Column("cos measured", "number"),
        Column("std", "number"),
        Column("cos fitted", "number"),
        Column("sin measured", "number"),
        Column("std", "number"),
        Column("sin fitted", "number"),
    ]
    rows: list[tuple[str, ...]] = []
    total = 0
    for run in fit.runs:
        if not run.order:
            continue
        for component, result in fit.components.items():
            if component not in run.scaled:
                continue
            total += run.order + 1
            if len(rows) + run.order >= MOST_ROWS:
                continue
            measured, sd = run.scaled[component], run.scaled_sd[component]
            fitted = run.design(result.rows.terms) @ result.params
            for k in range(run.order + 1):
                c = 0 if k == 0 else 2 * k - 1
                sine = (measured[c + 1], sd[c + 1], fitted[c + 1]) if k else (math.nan,) * 3
                cells = (measured[c], sd[c], fitted[c], *sine)
                rows.append((run.name, component, str(k), *(fixed(value, 6) for value in cells)))
    caption = "Scaled forces; harmonic 0 is the mean."
    if total > len(rows):
        caption += f" The first {len(rows)} of {total} rows; all measured values are in harmonics.csv."
    return make_table(columns, rows, caption)


def diagnostics_table(fit: HullFit) -> Table:
    """Numbers that judge the fit of each component, one column a component."""
    found = [component for component in fit.components if component in fit.derivatives.diagnostics]
    columns = [Column("diagnostic"), *(Column(component, "number") for component in found)]
    kinds = (
        ("data", "n", lambda x: fixed(x, 0)),
        ("runs", "runs", lambda x: fixed(x, 0)),
        ("degrees of freedom", "dof", lambda x: fixed(x, 0)),
        ("R²", "R2", lambda x: fixed(x, 5)),
        ("s, residual scatter over its expectation", "s", significant),
        ("residual rms, scaled force", "residual rms", significant),
        ("scatter between runs beyond their noise", "scatter between runs", significant),
        ("condition number of the scaled design", "condition number", significant),
        ("largest VIF", "VIF", lambda x: fixed(max(x.values(), default=math.nan), 1)),
        ("AICc", "AICc", lambda x: fixed(x, 1)),
    )
    rows = []
    for title, key, text in kinds:
        rows.append((title, *(text(fit.derivatives.diagnostics[component][key]) for component in found)))
    return make_table(columns, rows)


def remarks(fit: HullFit) -> list[tuple[str, str, str]]:
    """What the diagnostics say in words: (mark, subject, sentence), ``weak`` marking what needs attention."""
    found: list[tuple[str, str, str]] = []
    for component in fit.components:
        facts = fit.derivatives.diagnostics.get(component)
        if facts is None:
            continue
        for group in facts["inseparable"]:
            found.append(("weak", component, f"the runs cannot tell {', '.join(group)} apart"))
        if facts["outlying runs"]:
            found.append(("weak", component, f"outlying runs: {', '.join(facts['outlying runs'])}"))
        heavy = ", ".join(f"{name} ({value:.2f})" for name, value in facts["highest leverage"].items())
        found.append(("", component, f"highest leverage: {heavy}"))
        found += [("", component, note) for note in facts["notes"]]
    shares = fit.derivatives.diagnostics.get("shared_bias") or {}
    if shares:
        text = ", ".join(f"{source} {significant(share)}" for source, share in shares.items())
        found.append(("", "shared bias", f"root sum of squares over the derivatives by source: {text}"))
    return found
