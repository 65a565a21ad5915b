"""The folder of results of rolls at sea: terms, excitations, equivalent damping, provenance, report."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

from ..decay.at_sea_results import AtSeaAnalysis, AtSeaRecord
from .aligned_text import aligned_text
from .damping_outputs import campaign_provenance, with_error, write_with_page
from .result_folder import Progress, Writer, csv_writer, write_json


def write_at_sea(
    analysis: AtSeaAnalysis, out: str | Path, *, report: bool | None = None, progress: Progress | None = None
) -> list[Path]:
    """Write everything that a campaign at sea yields.

    Files are ``at_sea.csv`` (method, model, name, value, std, lower95, upper95, unit; with several records also
    record), ``excitations.csv`` (one row an oscillation of the joint fit), ``equivalent_damping.csv``,
    ``damping.json``, ``report.html`` and ``provenance.json``, with all digits. A new folder appears at once; in an
    existing one the old files stay until all new ones are made.

    Parameters
    ----------
    analysis : AtSeaAnalysis
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
        ("at_sea.csv", csv_writer(analysis.terms_frame)),
        ("excitations.csv", csv_writer(analysis.excitations_frame)),
        ("equivalent_damping.csv", csv_writer(analysis.equivalent_frame)),
        ("damping.json", lambda path: write_json(analysis.to_dict(), path)),
    ]
    records = [one.record for one in analysis.records]
    findings = [item for one in analysis.records for item in one.all_findings]
    return write_with_page(
        out,
        writers,
        campaign_provenance(analysis.campaign, analysis.path, records, findings),
        ("damping_at_sea_report", "render_at_sea_report") if wanted else None,
        analysis,
        progress,
    )


def at_sea_text(analysis: AtSeaAnalysis) -> str:
    """What a terminal shows: for each record the terms of all methods, and what gave no result."""
    return "\n\n".join(_record_text(analysis, one) for one in analysis.records)


def _record_text(analysis: AtSeaAnalysis, one: AtSeaRecord) -> str:
    import pandas as pd

    rows: list[dict[str, Any]] = []
    for row in one.terms().to_dict("records"):
        known = not math.isnan(row["std"])
        rows.append(
            {
                "method": row["method"],
                "model": row["model"],
                "term": f"{row['name']} [{row['unit']}]",
                "value": with_error(row["value"], row["std"]),
                "95 %": f"{row['lower95']:.5g} ... {row['upper95']:.5g}" if known else "",
            }
        )
    columns = ["method", "model", "term", "value", "95 %"]
    span = one.record.time[-1] - one.record.time[0]
    lines = [
        f"{analysis.campaign.decay.name}: {one.record.name}, {span:.6g} s of roll at sea; "
        f"first guess c1 = {one.guess['c1']:.4g} 1/s2 ({one.guessed_from})",
        "",
        aligned_text(pd.DataFrame(rows, columns=columns), columns),
        "",
        "± standard error; a discrete search states none",
    ]
    if one.joint is not None:
        shares = ", ".join(f"{name} {share:.1e}" for name, share in one.joint.own_share.items())
        lines.append(
            f"joint fit of {len(one.joint.excitations)} oscillations, R2 {one.joint.r2:.5f}; "
            f"what no excitation can imitate of each term: {shares}"
        )
    if one.searched is not None:
        lines.append(
            f"the search asks nine numbers of the one oscillation at {one.searched.start:.4g} s, which determines "
            f"{one.searched.determines}, and states no error: shown as published, not to be used"
        )
    lines += [f"no result: {method}: {reason}" for method, reason in one.failures.items()]
    return "\n".join(lines)
