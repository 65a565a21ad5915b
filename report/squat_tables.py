"""Tables of the squat report: means, repeats, waves, fits, formulas, clearance."""

from __future__ import annotations

import math

import numpy as np

from ..core.errors import TowtankError
from ..squat.formula_comparison import FormulaComparison
from ..squat.scaling_error import clearance_with_allowance
from ..squat.squat_analysis import SquatAnalysis, SquatGroup
from ..squat.squat_curve import SquatCurve
from .page_table import Column, Table, make_table
from .squat_units import quantity_title, shown_length, shown_quantity
from .typography import fixed, signed, significant

_MODELS = {"depth-froude": "c Fh²/√(1 − Fh²)", "power": "c V^p"}


def _with_error(value: float, error: float) -> tuple[str, str]:
    """Value and standard error with the decimals that the error supports."""
    if not (math.isfinite(error) and error > 0.0):
        return significant(value, 4), "–"
    places = max(1 - math.floor(math.log10(error)), 0)
    return fixed(value, places), fixed(error, places)


def means_table(analysis: SquatAnalysis) -> Table:
    """Means of every run over its window."""
    length = analysis.campaign.length
    names = list(dict.fromkeys(name for one in analysis.steady for name in one.means))
    units = {name: one.units[name] for one in analysis.steady for name in one.means}
    columns = [Column("run")]
    for name in names:
        columns += [Column(f"{_short(name)} [{shown_quantity(units[name], length)[1]}]", "number")]
        columns += [] if name == "speed" else [Column("±", "number", "standard error")]
    columns += [Column("window [s]", "number"), Column("n eff", "number", "independent samples in the trim")]
    rows, marks = [], []
    for one in analysis.steady:
        row = [one.run]
        for name in names:
            factor = shown_quantity(units[name], length)[0]
            of = one.means.get(name)
            cells = ("–", "–") if of is None else _with_error(factor * float(of.mean), factor * float(of.se))
            row += [significant(float(of.mean), 4) if of is not None else "–"] if name == "speed" else list(cells)
        row += [f"{fixed(one.window.start_time, 1)} … {fixed(one.window.stop_time, 1)}"]
        row.append(f"{float(one.means['trim'].n_eff):.0f}")
        rows.append(row)
        marks.append("" if one.window.is_stationary or _in_waves(analysis, one.run) else "weak")
    return make_table(columns, rows, "Shaded: the window still drifts.", marks)


def _in_waves(analysis: SquatAnalysis, run: str) -> bool:
    return any(one.waves is not None and one.name == run for one in analysis.runs)


def _short(name: str) -> str:
    place = name.removeprefix("sinkage_")
    return {"cog": "CoG"}.get(place, place)


def repeats_table(analysis: SquatAnalysis) -> Table:
    """Pooled repeats with their Student-t intervals."""
    length = analysis.campaign.length
    columns = [Column("condition"), Column("quantity"), Column("n", "number"), Column("mean", "number")]
    columns += [Column("± 95 %", "number", "half the Student-t interval of the mean")]
    columns += [
        Column("sd between runs", "number"),
        Column("one further run ±", "number", "95 %"),
        Column("unit", "short"),
    ]
    rows = []
    for one in analysis.repeats:
        for name, of in one.pooled.items():
            if name == "speed":
                continue
            factor, unit = shown_quantity(one.runs[0].units[name], length)
            mean, half = _with_error(factor * of.mean, factor * of.half_width)
            rows.append(
                (
                    one.condition,
                    quantity_title(name),
                    str(of.n),
                    mean,
                    half,
                    significant(factor * of.sd, 2),
                    significant(factor * of.single_half_width, 2),
                    unit,
                )
            )
    return make_table(columns, rows)


def waves_table(analysis: SquatAnalysis) -> Table:
    """Mean, amplitudes and phases of the runs in waves."""
    length = analysis.campaign.length
    frame = analysis.waves_frame()
    orders = [str(name).removeprefix("amplitude_") for name in frame if str(name).startswith("amplitude_")]
    columns = [
        Column("run"),
        Column("quantity"),
        Column("mean", "number"),
        Column("±", "number", "standard error"),
    ]
    for order in orders:
        columns += [Column(f"A{order}", "number"), Column(f"phase {order} [deg]", "number")]
    columns += [Column("unit", "short"), Column("ωₑ [rad/s]", "number"), Column("R²", "number")]
    rows = []
    for of in frame.to_dict("records"):
        factor, unit = shown_quantity(str(of["unit"]), length)
        row = [str(of["run"]), quantity_title(str(of["quantity"]))]
        row += _with_error(factor * of["mean"], factor * of["se"])
        for order in orders:
            row += [significant(factor * of[f"amplitude_{order}"])]
            row += [fixed(math.degrees(of[f"phase_{order}"]), 1)]
        rows.append([*row, unit, fixed(of["omega"], 4), fixed(of["r2"], 4)])
    return make_table(columns, rows)


def fits_table(analysis: SquatAnalysis, group: SquatGroup) -> Table:
    """Parameters of the curves, with the truth of virtual records."""
    length = analysis.campaign.length
    columns = [Column("quantity"), Column("curve"), Column("c", "number"), Column("±", "number", "standard error")]
    columns += [Column("p", "number"), Column("±", "number", "standard error"), Column("unit of c", "short")]
    columns += [Column("scatter", "number"), Column("points", "number")]
    columns += [Column("true c", "number")] if analysis.truth else []
    rows = []
    for quantity, models in group.fits.items():
        factor, unit = shown_quantity("m/m" if quantity == "trim" else "m", length)
        for model, fit in models.items():
            errors = np.sqrt(np.diagonal(fit.cov))
            power = model == "power"
            row = [quantity_title(quantity), _MODELS[model]]
            row += _with_error(factor * float(fit.params[0]), factor * float(errors[0]))
            row += _with_error(float(fit.params[1]), float(errors[1])) if power else ("–", "–")
            row += [f"{unit} (s/m)^p" if power else unit, significant(factor * fit.residual_sd, 2)]
            row.append(str(fit.dof + len(fit.params)))
            if analysis.truth:
                known = quantity in analysis.truth and not power
                row.append(significant(factor * analysis.truth[quantity], 4) if known else "–")
            rows.append(row)
    low, high = group.curve.points["speed"].min(), group.curve.points["speed"].max()
    return make_table(columns, rows, f"Valid from {low:.3g} to {high:.3g} m/s at {group.label}.")


def formula_scores_table(comparison: FormulaComparison, length: float) -> Table:
    """Scores of the formulas at each place; those that never apply are greyed."""
    factor, unit = shown_length(length)
    columns = [
        Column("formula", "short"),
        Column("place", "short"),
        Column("n", "number"),
        Column("Q [%]", "number"),
    ]
    columns += [Column("BS", "number", "sum of the signs of D - S"), Column(f"bias [{unit}]", "number")]
    columns += [Column(f"rms [{unit}]", "number"), Column(f"max [{unit}]", "number")]
    columns.append(Column("outside its limits"))
    rows, marks = [], []
    for of in comparison.scores.to_dict("records"):
        within = int(of["applicable"])
        rows.append(
            (
                str(of["formula"]),
                "largest" if of["place"] == "maximum" else str(of["place"]),
                str(of["n"]),
                fixed(100.0 * of["Q"], 1),
                f"{of['BS']}/{of['n']}".replace("-", "−"),
                signed(factor * of["bias"], 3 if unit == "mm" else 4),
                fixed(factor * of["rms"], 3 if unit == "mm" else 4),
                fixed(factor * of["max_abs"], 3 if unit == "mm" else 4),
                str(of["flag"]) or "–",
            )
        )
        marks.append("" if within else "grey")
    return make_table(columns, rows, "Grey: outside the limits of the formula at every speed.", marks)


def clearance_table(curve: SquatCurve, length: float) -> Table:
    """Water under the keel by speed, at the scale of the records and at full scale."""
    factor, unit = shown_length(length)
    full = curve.full_scale() if curve.scale != 1.0 else None
    allowed = _with_allowance(curve) if full is not None else None
    columns = [Column("speed [m/s]", "number"), Column("Fh", "number"), Column(f"clearance [{unit}]", "number")]
    columns.append(Column("of that at rest [%]", "number"))
    if full is not None:
        columns += [Column("full scale [kn]", "number"), Column("clearance, full scale [m]", "number")]
    if allowed is not None:
        columns.append(Column("with allowance [m]", "number", "less the largest scaling error that was computed"))
    still = curve.depth - curve.draught
    rows, marks = [], []
    clearances = curve.clearance()
    for k, speed in enumerate(curve.points["speed"].to_numpy(dtype=float)):
        row = [fixed(speed, 3), fixed(float(curve.depth_froude_number[k]), 3)]
        row += [fixed(factor * float(clearances[k]), 2 if unit == "mm" else 3)]
        row.append(fixed(100.0 * float(clearances[k]) / still, 1))
        if full is not None:
            row.append(fixed(float(full.points["speed"].iloc[k]) * 3600.0 / 1852.0, 2))
            row.append(fixed(float(full.clearance()[k]), 2))
        if allowed is not None:
            row.append(fixed(float(allowed[k]), 2))
        rows.append(row)
        marks.append("bad" if clearances[k] <= 0.0 else "")
    caption = f"At rest {fixed(factor * still, 2)} {unit}."
    if full is not None:
        caption += (
            " Allowance for what Froude's law leaves out: 10 or 15 % of the squat by h/T (ReSquat, MASHCON 2019)."
            if allowed is not None
            else " No allowance for the scaling error: it is not known at this h/T."
        )
    return make_table(columns, rows, caption, marks)


def _with_allowance(curve: SquatCurve) -> np.ndarray | None:
    """Least clearance at full scale in m with the scaling error; None in water too shallow for it."""
    try:
        return clearance_with_allowance(curve)["least"].to_numpy(dtype=float)
    except TowtankError:
        return None


def corrected_table(curve: SquatCurve, corrected: SquatCurve, length: float) -> Table:
    """Points before and after a correction."""
    factor, unit = shown_length(length)
    columns = [Column("speed [m/s]", "number"), Column("corrected [m/s]", "number")]
    names = ("sinkage_bow", "sinkage_stern")
    for name in names:
        columns += [Column(f"{_short(name)} [{unit}]", "number"), Column(f"corrected [{unit}]", "number")]
    rows = []
    for (_, before), (_, after) in zip(curve.points.iterrows(), corrected.points.iterrows(), strict=True):
        row = [fixed(float(before["speed"]), 4), fixed(float(after["speed"]), 4)]
        for name in names:
            row += [significant(factor * float(before[name]), 4), significant(factor * float(after[name]), 4)]
        rows.append(row)
    return make_table(columns, rows)


def squat_facts(analysis: SquatAnalysis) -> list[tuple[str, str, str]]:
    """What a campaign amounts to, as (what, number, detail)."""
    length = analysis.campaign.length
    factor, unit = shown_length(length)
    steady = analysis.steady
    deepest = None
    for one in steady:
        for name, of in one.means.items():
            if name.startswith("sinkage_") and (deepest is None or float(of.mean) > float(deepest[2].mean)):
                deepest = (one, name, of)
    facts = [("runs", str(len(analysis.runs)), f"{len(analysis.repeats)} condition(s) repeated")]
    if deepest is not None:
        one, name, of = deepest
        value, error = _with_error(factor * float(of.mean), factor * float(of.se))
        at = f" at {float(one.means['speed'].mean):.3g} m/s" if "speed" in one.means else ""
        facts.append(("largest sinkage", f"{value} {unit}", f"± {error} {unit}, {_short(name)}{at}, {one.run}"))
    for group in analysis.groups:
        fit = group.fits.get("sinkage_bow", {}).get("depth-froude")
        if fit is not None:
            value, error = _with_error(factor * float(fit.params[0]), factor * float(fit.cov[0, 0]) ** 0.5)
            facts.append(("bow curve", f"c {value} {unit}", f"± {error} {unit}, {group.label}"))
        left = group.curve.clearance()
        share = 100.0 * float(left.min()) / (group.curve.depth - group.curve.draught)
        facts.append(
            (
                "least water under keel",
                f"{significant(factor * float(left.min()))} {unit}",
                f"{share:.0f} % of that at rest, {group.label}",
            )
        )
    return facts
