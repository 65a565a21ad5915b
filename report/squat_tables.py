"""Tables of the squat report: means, repeats, waves, fits, formulas, clearance."""

from __future__ import annotations

import math

import numpy as np

from ..core.errors import TowtankError
from ..squat.formula_comparison import FormulaComparison
from ..squat.scaling_error import clearance_with_allowance
from ..squat.squat_analysis import SquatAnalysis
from ..squat.squat_curve import SquatCurve
from ..squat.squat_group import SquatGroup
from ..squat.squat_in_waves import SquatInWaves
from ..squat.steady_squat import SteadySquat
from ..squat.wave_response import WaveResponses
from .page_table import Column, Table, make_table
from .squat_units import (
    harmonics_of,
    place_title,
    quantity_title,
    short_title,
    shown_length,
    shown_quantity,
    value_and_error,
)
from .typography import fixed, signed, significant

_SEEN = 3.0
"""Standard errors above which an amplitude is there and has a phase."""
_MODELS = {"depth-froude": "c Fh²/√(1 − Fh²)", "power": "c V^p"}


def _one(value: float, error: float) -> str:
    """Value and standard error in one cell."""
    shown, error_shown = value_and_error(value, error)
    return f"{shown} ± {error_shown}" if error_shown else shown


_MAIN = ("sinkage_bow", "sinkage_stern", "sinkage_midship", "sinkage_cog", "trim")


def means_table(analysis: SquatAnalysis) -> Table:
    """Sinkage and trim of every run over its window."""
    names = [name for name in _MAIN if any(name in one.means for one in analysis.steady)]
    columns = [Column("run"), *(_mean_column(analysis, name) for name in names), Column("speed [m/s]", "number")]
    rows = [[one.run, *(_mean(analysis, one, name) for name in (*names, "speed"))] for one in analysis.steady]
    return make_table(columns, rows, "Shaded: the window still drifts.", _drifting(analysis))


def windows_table(analysis: SquatAnalysis) -> Table:
    """Window of every run, the samples that count in it, and what else was averaged over it."""
    names = dict.fromkeys(name for one in analysis.steady for name in one.means if name not in (*_MAIN, "speed"))
    columns = [Column("run"), Column("window [s]", "number")]
    columns += [Column("n eff", "number", "independent samples in the trim")]
    columns += [_mean_column(analysis, name) for name in names]
    rows = []
    for one in analysis.steady:
        window = f"{fixed(one.window.start_time, 1)} … {fixed(one.window.stop_time, 1)}"
        row = [one.run, window, f"{float(one.means['trim'].n_eff):.0f}"]
        rows.append(row + [_mean(analysis, one, name) for name in names])
    return make_table(columns, rows, marks=_drifting(analysis))


def _mean_column(analysis: SquatAnalysis, name: str) -> Column:
    unit = next(one.units[name] for one in analysis.steady if name in one.units)
    return Column(short_title(name, unit, analysis.campaign.length), "number", "± standard error")


def _mean(analysis: SquatAnalysis, one: SteadySquat, name: str) -> str:
    of = one.means.get(name)
    if of is None:
        return "–"
    if name == "speed":
        return significant(float(of.mean), 4)
    factor = shown_quantity(one.units[name], analysis.campaign.length)[0]
    return _one(factor * float(of.mean), factor * float(of.se))


def _drifting(analysis: SquatAnalysis) -> list[str]:
    return ["" if one.window.is_stationary or _in_waves(analysis, one.run) else "weak" for one in analysis.steady]


def _in_waves(analysis: SquatAnalysis, run: str) -> bool:
    return any(one.waves is not None and one.name == run for one in analysis.runs)


def repeats_table(analysis: SquatAnalysis) -> Table:
    """Pooled repeats with their Student-t intervals."""
    length = analysis.campaign.length
    columns = [
        Column("condition", "short"),
        Column("quantity", "short"),
        Column("n", "number"),
        Column("mean", "number"),
    ]
    columns += [Column("± 95 %", "number", "half the Student-t interval of the mean")]
    columns += [
        Column("sd", "number", "between the runs"),
        Column("one further run ±", "number", "95 %"),
        Column("unit", "short"),
    ]
    rows = []
    for one in analysis.repeats:
        for name, of in one.pooled.items():
            if name == "speed":
                continue
            factor, unit = shown_quantity(one.runs[0].units[name], length)
            mean, half = value_and_error(factor * of.mean, factor * of.half_width)
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


def waves_table(analysis: SquatAnalysis, waves: SquatInWaves) -> Table:
    """Mean, amplitudes and phases of one run in waves."""
    length = analysis.campaign.length
    frame = waves.frame
    orders = harmonics_of(frame)
    columns = [Column("quantity", "short"), Column("mean", "number", "± standard error")]
    for order in orders:
        columns += [Column(f"A{order}", "number", "± standard error"), Column(f"phase {order} [°]", "number")]
    rows = []
    for of in frame.to_dict("records"):
        factor = shown_quantity(str(of["unit"]), length)[0]
        row = [short_title(str(of["quantity"]), str(of["unit"]), length)]
        row.append(_one(factor * of["mean"], factor * of["se"]))
        for order in orders:
            size, error = of[f"amplitude_{order}"], of[f"amplitude_{order}_se"]
            row.append(_one(factor * size, factor * error))
            row.append(fixed(math.degrees(of[f"phase_{order}"]), 1) if size > _SEEN * error else "–")
        rows.append(row)
    frequency = _one(waves.omega, waves.omega_se)
    caption = f"ωₑ = {frequency} rad/s, {waves.start:.1f} to {waves.stop:.1f} s."
    return make_table(columns, rows, f"{caption} A dash: the amplitude is below three standard errors.")


def responses_table(analysis: SquatAnalysis, responses: WaveResponses) -> Table:
    """Motions of one run over the wave at its gauge."""
    columns = [Column("quantity", "short"), Column("per m of wave", "number", "± standard error")]
    columns += [Column("unit", "short"), Column("over wave slope", "number", "trim over k ζ")]
    columns += [Column("phase [°]", "number", "lead over the wave crest at the CoG, ± standard error")]
    rows = []
    for of in responses.frame.to_dict("records"):
        rows.append(
            (
                quantity_title(str(of["quantity"])),
                _one(of["ratio"], of["ratio_se"]),
                str(of["unit"]),
                significant(of["over_slope"]) if math.isfinite(of["over_slope"]) else "–",
                _one(math.degrees(of["phase"]), math.degrees(of["phase_se"])),
            )
        )
    factor, unit = shown_length(analysis.campaign.length)
    wave, height = responses.wave, float(responses.frame["wave_amplitude"].iloc[0])
    caption = (
        f"Head waves of {significant(factor * height)} {unit} amplitude and {significant(wave.length, 4)} m length, "
        f"ω = {significant(wave.omega, 4)} rad/s. Sinkage is positive down and the elevation up."
    )
    return make_table(columns, rows, caption)


def fits_table(analysis: SquatAnalysis, group: SquatGroup) -> Table:
    """Parameters of the curves, with the truth of virtual records."""
    length = analysis.campaign.length
    columns = [Column("quantity"), Column("curve", "short"), Column("c", "number", "± standard error")]
    columns += [Column("unit of c", "short"), Column("p", "number", "± standard error")]
    columns += [Column("scatter", "number"), Column("points", "number")]
    columns += [Column("true c", "number")] if analysis.truth else []
    rows = []
    for quantity, models in group.fits.items():
        factor, unit = shown_quantity("m/m" if quantity == "trim" else "m", length)
        for model, fit in models.items():
            errors = np.sqrt(np.diagonal(fit.cov))
            power = model == "power"
            row = [quantity_title(quantity), _MODELS[model]]
            row.append(_one(factor * float(fit.params[0]), factor * float(errors[0])))
            row.append(f"{unit} (s/m)^p" if power else unit)
            row.append(_one(float(fit.params[1]), float(errors[1])) if power else "–")
            row.append(significant(factor * fit.residual_sd, 2))
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
        columns += [Column(f"{place_title(name)} [{unit}]", "number"), Column(f"corrected [{unit}]", "number")]
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
        value, error = value_and_error(factor * float(of.mean), factor * float(of.se))
        at = f" at {float(one.means['speed'].mean):.3g} m/s" if "speed" in one.means else ""
        facts.append(
            ("largest sinkage", f"{value} {unit}", f"± {error} {unit}, {place_title(name)}{at}, {one.run}")
        )
    for group in analysis.groups:
        fit = group.fits.get("sinkage_bow", {}).get("depth-froude")
        if fit is not None:
            value, error = value_and_error(factor * float(fit.params[0]), factor * float(fit.cov[0, 0]) ** 0.5)
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
