"""The folder of results of squat records: means, repeats, waves, curves, provenance, report; complete or not at all."""

from __future__ import annotations

import math
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.provenance import program_versions
from ..squat.squat_analysis import CONVENTIONS, SquatAnalysis
from .aligned_text import aligned_text
from .provenance_tables import setting_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json
from .squat_units import harmonics_of, shown_quantity, with_error

if TYPE_CHECKING:
    import pandas as pd

SQUAT_FORMAT = "towtank squat provenance 1"


def require_squat_folder(out: str | Path) -> None:
    """Refuse a place that cannot take the results of squat records, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), SQUAT_FORMAT)


def write_squat(
    analysis: SquatAnalysis, out: str | Path, *, report: bool | None = None, progress: Progress | None = None
) -> list[Path]:
    """Write everything that a squat campaign yields.

    Files are ``squat.csv`` (run, quantity, mean, se, n_eff, window_start, window_end, unit), ``squat.json``,
    ``report.html`` and ``provenance.json``; where there is something to say also ``squat_repeats.csv``,
    ``squat_waves.csv``, ``squat_rao.csv``, ``squat_curve.csv``, ``squat_fits.csv``, ``squat_formulas.csv`` and, for
    models, ``squat_full_scale.csv``; with a correction ``squat_corrected.csv``. All in SI with all digits.

    Parameters
    ----------
    analysis : SquatAnalysis
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool, optional
        Write ``report.html``; as the campaign says when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files that were written.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    wanted = analysis.campaign.output.report if report is None else report
    writers: list[tuple[str, Writer]] = [
        ("squat.csv", csv_writer(analysis.squat_frame)),
        ("squat_repeats.csv", _when_rows(analysis.repeats_frame)),
        ("squat_waves.csv", _when_rows(analysis.waves_frame)),
        ("squat_rao.csv", _when_rows(analysis.responses_frame)),
        ("squat_curve.csv", _when_rows(analysis.curve_frame)),
        ("squat_fits.csv", _when_rows(analysis.fits_frame)),
        ("squat_full_scale.csv", _when_rows(analysis.full_scale_frame)),
        ("squat_corrected.csv", _when_rows(analysis.corrected_frame)),
        ("squat_formulas.csv", _when_rows(analysis.formulas_frame)),
        ("squat.json", lambda path: write_json(analysis.to_dict(), path)),
    ]
    if wanted:

        def write_page(path: Path) -> None:
            # drawing needs matplotlib, which the command line must not load at its start
            from .squat_report import render_squat_report

            path.write_text(render_squat_report(analysis, progress=progress), encoding="utf-8")

        writers.append(("report.html", write_page))
    return write_folder(Path(out), writers, squat_provenance(analysis), progress)


def _when_rows(frame: Callable[[], pd.DataFrame]) -> Writer:
    """Write a table unless it is empty."""

    def write(path: Path) -> None:
        table = frame()
        if not table.empty:
            table.to_csv(path, index=False)

    return write


def squat_provenance(analysis: SquatAnalysis, created: datetime | None = None) -> dict[str, Any]:
    """Where the squat comes from, as plain data: campaign, files, windows, findings, versions."""
    return {
        "format": SQUAT_FORMAT,
        "created": timestamp(created),
        "conventions": CONVENTIONS,
        "campaign": analysis.campaign.model_dump(),
        "campaign_file": "" if analysis.path is None else analysis.path.name,
        "versions": program_versions(),
        "inputs": {run.record.name: run.record.sha256 for run in analysis.runs},
        "records": {run.name: list(run.steps) for run in analysis.runs},
        "findings": [vars(item) for item in analysis.findings],
    }


def squat_text(analysis: SquatAnalysis) -> str:
    """What a terminal shows: the means of every run, repeats, waves, curves."""
    parts = [_runs_text(analysis)]
    more = (_repeats_text, _waves_text, _responses_text, _curves_text)
    parts += [text for text in (say(analysis) for say in more) if text]
    return "\n\n".join(parts)


def _runs_text(analysis: SquatAnalysis) -> str:
    import pandas as pd

    length = analysis.campaign.length
    rows: list[dict[str, str]] = []
    for one in analysis.steady:
        row = {"run": one.run}
        for name, of in one.means.items():
            head, times = _heading(name, one.units[name], length)
            row[head] = with_error(times * float(of.mean), times * float(of.se))
        row["window [s]"] = f"{one.window.start_time:.4g} to {one.window.stop_time:.4g}"
        row["n_eff"] = f"{float(one.means['trim'].n_eff):.0f}"
        rows.append(row)
    frame = pd.DataFrame(rows).fillna("")
    columns = [*(name for name in frame.columns if name not in ("window [s]", "n_eff")), "window [s]", "n_eff"]
    heading = f"{analysis.campaign.squat.name}: {len(analysis.runs)} record(s), {CONVENTIONS.split(';')[0]}"
    notes = dict.fromkeys(one.window.note for one in analysis.steady)
    channels = analysis.campaign.channels.model_dump(exclude_defaults=True, exclude={"units", "places"})
    lines = [
        heading,
        f"channels: {setting_text(channels)}",
        "",
        aligned_text(frame, columns),
        "",
        "± standard error; n_eff: independent samples in the trim",
    ]
    return "\n".join([*lines, *(f"window: {note}" for note in list(notes)[:3])])


def _heading(name: str, unit: str, length: float) -> tuple[str, float]:
    """Heading of a quantity on the terminal, and its factor from SI."""
    factor, shown = shown_quantity(unit, length)
    return f"{name.removeprefix('sinkage_')} [{shown}]", factor


def _repeats_text(analysis: SquatAnalysis) -> str:
    import pandas as pd

    if not analysis.repeats:
        return ""
    length = analysis.campaign.length
    rows = []
    for one in analysis.repeats:
        row = {"repeats": f"{one.condition} (n = {len(one.runs)})"}
        for name, of in one.pooled.items():
            head, times = _heading(name, one.runs[0].units[name], length)
            row[head] = with_error(times * of.mean, times * of.half_width)
        rows.append(row)
    frame = pd.DataFrame(rows).fillna("")
    return aligned_text(frame, list(frame.columns)) + "\n\n± half the 95 % Student-t interval between runs"


def _waves_text(analysis: SquatAnalysis) -> str:
    import pandas as pd

    frame = analysis.waves_frame()
    if frame.empty:
        return ""
    length = analysis.campaign.length
    orders = harmonics_of(frame)
    rows = []
    for of in frame.to_dict("records"):
        head, times = _heading(str(of["quantity"]), str(of["unit"]), length)
        row: dict[str, Any] = {
            "run in waves": of["run"],
            "quantity": head,
            "mean": with_error(times * of["mean"], times * of["se"]),
        }
        for order in orders:
            row[f"A{order}"] = with_error(times * of[f"amplitude_{order}"], times * of[f"amplitude_{order}_se"])
            row[f"phase{order} [deg]"] = f"{math.degrees(float(of[f'phase_{order}'])):.1f}"
        row["omega [rad/s]"] = float(of["omega"])
        rows.append(row)
    table = pd.DataFrame(rows)
    return aligned_text(table, list(table.columns))


def _responses_text(analysis: SquatAnalysis) -> str:
    import pandas as pd

    frame = analysis.responses_frame()
    if frame.empty:
        return ""
    rows = [
        {
            "response in waves": of["run"],
            "quantity": str(of["quantity"]).removeprefix("sinkage_"),
            "per m of wave": with_error(of["ratio"], of["ratio_se"]),
            "unit": of["unit"],
            "phase [deg]": with_error(math.degrees(of["phase"]), math.degrees(of["phase_se"])),
            "wave amplitude [m]": f"{of['wave_amplitude']:.4g}",
            "wave length [m]": f"{of['wave_length']:.4g}",
        }
        for of in frame.to_dict("records")
    ]
    place = float(frame["reference_x"].iloc[0])
    note = f"phase: lead over the wave crest at x = {place:.4g} m (CoG); sinkage down, elevation up"
    return f"{aligned_text(pd.DataFrame(rows), list(rows[0]))}\n\n{note}"


def _curves_text(analysis: SquatAnalysis) -> str:
    import pandas as pd

    parts = []
    length = analysis.campaign.length
    for group in analysis.groups:
        rows = []
        for quantity, models in group.fits.items():
            head, times = _heading(quantity, "m/m" if quantity == "trim" else "m", length)
            row = {group.label: head}
            if analysis.truth:
                row["true c"] = f"{times * analysis.truth[quantity]:.4g}" if quantity in analysis.truth else ""
            for model, fit in models.items():
                errors = fit.cov.diagonal() ** 0.5
                if model == "depth-froude":
                    row["c of c Fh²/√(1-Fh²)"] = with_error(times * fit.params[0], times * errors[0])
                    row["scatter"] = f"{times * fit.residual_sd:.3g}"
                else:
                    row["p of c V^p"] = with_error(fit.params[1], errors[1])
            rows.append(row)
        if rows:
            frame = pd.DataFrame(rows).fillna("")
            parts.append(aligned_text(frame, list(frame.columns)))
        if group.failures:
            parts.append("\n".join(f"no curve: {what}: {reason}" for what, reason in group.failure_lines))
    return "\n\n".join(parts)
