"""The folder of results of free decays: damping, equivalent damping, provenance, report; complete or not at all."""

from __future__ import annotations

import math
from collections.abc import Sequence
from datetime import datetime
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from ..core.findings import Finding
from ..core.provenance import program_versions
from ..decay.against_speed import against_speed, speed_series
from ..decay.decay_campaign import DecayCampaign
from ..decay.decay_record import DecayRecord
from ..decay.decay_results import DecayAnalysis
from ..decay.equivalent_damping import equivalent_linear
from ..decay.term_values import term_values
from .aligned_text import aligned_text
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json

DAMPING_FORMAT = "towtank damping provenance 1"

_LARGE = 1e6
"""Values above this, inertias, are printed with a power of ten."""


def require_damping_folder(out: str | Path) -> None:
    """Refuse a place that cannot take the results of decays, before anything is computed.

    Raises
    ------
    TowtankError
        When `out` is a file, or holds results of another kind.
    """
    require_folder(Path(out), DAMPING_FORMAT)


def write_damping(
    analysis: DecayAnalysis, out: str | Path, *, report: bool | None = None, progress: Progress | None = None
) -> list[Path]:
    """Write everything that a decay campaign yields.

    Files are ``damping.csv`` (method, model, name, value, std, lower95, upper95, unit; with several groups also
    group), ``equivalent_damping.csv`` (method, model, amplitude, omega, alpha_e, B_e, zeta, N, and B44 where the ship
    is known; units in the names), ``damping.json``, ``report.html`` and ``provenance.json``, with all digits; with
    several speeds ``against_speed.csv``, with a table of radiation ``radiation.csv`` and ``retardation.csv`` (SI).
    A new folder appears at once; in an existing one the old files stay until all new ones are made.

    Parameters
    ----------
    analysis : DecayAnalysis
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool, optional
        Write ``report.html``; as the campaign says when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files, in the order above.

    Raises
    ------
    TowtankError
        When `out` is a file, cannot be written to, or holds results of another kind.
    """
    wanted = analysis.campaign.output.report if report is None else report
    writers: list[tuple[str, Writer]] = [
        ("damping.csv", csv_writer(analysis.damping_frame)),
        ("equivalent_damping.csv", csv_writer(analysis.equivalent_frame)),
        *_optional(analysis),
        ("damping.json", lambda path: write_json(analysis.to_dict(), path)),
    ]
    return write_with_page(
        out,
        writers,
        damping_provenance(analysis),
        ("damping_report", "render_damping_report") if wanted else None,
        analysis,
        progress,
    )


def write_with_page(
    out: str | Path,
    writers: Sequence[tuple[str, Writer]],
    provenance: dict[str, Any],
    page: tuple[str, str] | None,
    analysis: object,
    progress: Progress | None,
) -> list[Path]:
    """Write files and, behind them, ``report.html`` by the function `page` (module of this room, name), if any.

    Drawing needs matplotlib, which the command line must not load at its start: the module is imported when it draws.
    """
    files = list(writers)
    if page is not None:
        module, name = page

        def write_page(path: Path) -> None:
            render = getattr(import_module(f".{module}", __package__), name)
            path.write_text(render(analysis, progress=progress), encoding="utf-8")

        files.append(("report.html", write_page))
    return write_folder(Path(out), files, provenance, progress)


def _optional(analysis: DecayAnalysis) -> list[tuple[str, Writer]]:
    """Files that only some campaigns have: damping against speed, and the memory of a table of radiation."""
    found: list[tuple[str, Writer]] = []
    if speed_series(analysis.groups):
        found.append(("against_speed.csv", csv_writer(lambda: against_speed(analysis.groups))))
    first = next((group.memory for group in analysis.groups if group.memory is not None), None)
    if first is not None:
        found.append(("radiation.csv", csv_writer(first.to_frame)))
        found.append(("retardation.csv", csv_writer(first.retardation)))
    return found


def damping_provenance(analysis: DecayAnalysis, created: datetime | None = None) -> dict[str, Any]:
    """Where the damping comes from, as plain data: campaign, files, steps, findings, versions."""
    records = [record for group in analysis.groups for record in group.records]
    findings = [item for group in analysis.groups for item in group.all_findings]
    data = campaign_provenance(analysis.campaign, analysis.path, records, findings, created)
    tables = [group.memory.table for group in analysis.groups if group.memory is not None]
    data["inputs"] |= {table.source: table.sha256 for table in tables}
    return data


def campaign_provenance(
    campaign: DecayCampaign,
    path: Path | None,
    records: Sequence[DecayRecord],
    findings: Sequence[Finding],
    created: datetime | None = None,
) -> dict[str, Any]:
    """Provenance of any campaign of this kind, as plain data."""
    return {
        "format": DAMPING_FORMAT,
        "created": timestamp(created),
        "campaign": campaign.model_dump(),
        "campaign_file": "" if path is None else path.name,
        "versions": program_versions(),
        "inputs": {record.source: record.sha256 for record in records},
        "records": {record.name: list(record.steps) for record in records},
        "findings": [vars(item) for item in findings],
    }


def damping_text(analysis: DecayAnalysis) -> str:
    """What a terminal shows: for each group the methods beside each other, the verdict, and what gave no result."""
    return "\n\n".join(_group_text(analysis, number) for number in range(len(analysis.groups)))


def _group_text(analysis: DecayAnalysis, number: int) -> str:
    import pandas as pd

    group = analysis.groups[number]
    names = list(dict.fromkeys(name for one in group.results for name in one.names))
    units = {name: unit for one in group.results for name, unit in one.units.items()}
    titles = {name: f"{name} [{units[name]}]" for name in names}
    rows: list[dict[str, Any]] = []
    if analysis.truth:
        true = {titles[name]: f"{analysis.truth.get(name, 0.0):g}" for name in names}
        middle = np.array([math.sqrt(math.prod(group.preferred.diagnostics.amplitudes))])
        alpha = equivalent_linear(term_values(analysis.truth), middle)[0][0]
        rows.append({"method": "truth", **true, "alpha_e [1/s]": f"{alpha:.6f}"})
    for one in group.results:
        low, high = one.diagnostics.amplitudes
        at = one.equivalent([(low * high) ** 0.5], speed=group.records[0].speed)
        row: dict[str, Any] = {"method": one.method, "model": one.model.label}
        for name, value, error in zip(one.names, one.params.tolist(), one.bse.tolist(), strict=True):
            row[titles[name]] = with_error(value, error)
        row["alpha_e [1/s]"] = with_error(float(at.alpha[0]), float(at.alpha_sd[0]))
        row["R2"] = f"{one.diagnostics.r2:.5f}"
        row["trusted"] = "no" if group.doubts(one) else "yes"
        rows.append(row)
    columns = ["method", "model", *titles.values(), "alpha_e [1/s]", "R2", "trusted"]
    frame = pd.DataFrame(rows, columns=columns).fillna("")
    fit = group.preferred
    lines = [
        f"{analysis.campaign.decay.name}: {group.label}, {len(group.records)} record(s), "
        f"{fit.diagnostics.half_cycles} half cycles",
        "",
        aligned_text(frame, columns),
        "",
        "± standard error; alpha_e: equivalent damping at the middle amplitude of each method",
        f"to quote: {fit.method}, {fit.model.label}: omega_n {fit.omega_n:.4f} rad/s, R2 {fit.diagnostics.r2:.5f}",
    ]
    if group.memory is not None:
        found = group.memory.identified
        amplitude = math.sqrt(math.prod(fit.diagnostics.amplitudes))
        share = float(group.memory.fit.radiation_share(amplitude, group.records[0].speed)[0])
        lines.append(
            f"radiation memory of order {found.order}, R2 {found.r2_damping:.4f} of the damping; {group.memory.known}; "
            f"waves make {100.0 * share:.0f} % of the damping at {_shown(amplitude, fit.motion)}"
        )
    if group.verdict is not None:
        lines.append(
            f"the records support: {group.verdict.supported} damping, {group.verdict.restoring} restoring"
        )
    lines += [f"no result: {method}: {reason}" for method, reason in group.failures.items()]
    return "\n".join(lines)


def _shown(amplitude: float, motion: str) -> str:
    """An amplitude with its unit."""
    return f"{1000.0 * amplitude:.3g} mm" if motion == "heave" else f"{math.degrees(amplitude):.3g} deg"


def with_error(value: float, error: float) -> str:
    """Value and standard error with the decimals that the error supports."""
    if not (math.isfinite(error) and error > 0.0):
        return f"{value:.4g}"
    if abs(value) >= _LARGE:
        return f"{value:.4g} ± {error:.2g}"
    places = max(1 - math.floor(math.log10(error)), 0)
    return f"{value:.{places}f} ± {error:.{places}f}"
