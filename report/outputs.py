"""The folder of results of a campaign: tables, sets, provenance, report; complete or not at all."""

from __future__ import annotations

import re
from datetime import datetime
from functools import partial
from importlib import import_module
from pathlib import Path
from threading import Thread
from typing import TYPE_CHECKING, Any

from ..core.provenance import program_versions
from ..pmm.campaign_result import CampaignResult
from .campaign_manoeuvres import SailedSet, sail_campaign, sailed_provenance
from .manoeuvre_outputs import manoeuvre_tables
from .result_folder import Progress, Writer, csv_writer, require_folder, timestamp, write_folder, write_json
from .set_table import SETS_FORMAT

if TYPE_CHECKING:
    import pandas as pd

PROVENANCE_FORMAT = "towtank provenance 1"

MANY_RUNS = 200
"""Runs from which on it pays to load libraries while they are read."""

COMPARISONS = {
    "three ways": "three-ways.csv",
    "estimators": "estimators.csv",
    "candidates": "candidates.csv",
    "range": "range.csv",
}
"""Kind of comparison and the file that its tables go to."""


def write_results(
    result: CampaignResult,
    out: str | Path,
    *,
    report: bool | None = None,
    sailed: list[SailedSet] | None = None,
    progress: Progress | None = None,
) -> list[Path]:
    """Write everything that a campaign yields.

    Files are ``derivatives.csv`` (name, value, std, lower95, upper95, scaling; with several groups also group),
    ``derivatives.json`` (the set; with several groups all of them by label, and ``derivatives-<group>.json`` for
    each), ``harmonics.csv``, ``runs.csv``, ``findings.csv``, the comparisons that were made (``three-ways.csv``,
    ``estimators.csv``, ``candidates.csv``, ``range.csv``), with ``[simulate]`` ``indices.csv``, ``imo.csv`` and
    ``trajectory_<manoeuvre>.csv`` (see :func:`~towtank.report.manoeuvre_outputs.write_manoeuvres`), ``report.html`` and
    ``provenance.json``. Numbers have all their digits.

    Everything is made in a folder beside `out` first. A new folder then appears at once; in an existing one file
    after file is replaced, and files that its provenance.json lists and this result does not have are removed.
    Until then the old result stays.

    Parameters
    ----------
    result : CampaignResult
    out : str or Path
        Folder of the results; made when it is missing.
    report : bool, optional
        Write ``report.html``; as the campaign file says when not given.
    sailed : list of SailedSet, optional
        Manoeuvres of its sets; sailed as the campaign file says when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    list of Path
        The files, in the order above.

    Raises
    ------
    TowtankError
        When `out` is a file or cannot be written to.
    """
    out = Path(out)
    require_folder(out, PROVENANCE_FORMAT)
    wanted = result.settings.output.report if report is None else report
    if sailed is None:
        sailed = sail_campaign(result, progress)
    source = provenance(result)
    if sailed:
        source["manoeuvres"] = sailed_provenance(sailed)
    return write_folder(out, _writers(result, sailed, wanted, progress), source, progress)


def loading_ahead(progress: Progress) -> Progress:
    """`progress` that also loads what drawing and fitting need, in the background of the reading of many runs.

    The runs of a large campaign are read by other processes while this one waits.
    """
    started: list[Thread] = []

    def load() -> None:
        for module in ("scipy.special", "towtank.report.report_figures"):
            import_module(module)

    def advance(what: str, done: int, total: int) -> None:
        # Not before the first run has arrived: processes must not be forked in the middle of an import.
        if not started and done and total >= MANY_RUNS:
            started.append(Thread(target=load, daemon=True))
            started[0].start()
        progress(what, done, total)

    return advance


def _writers(
    result: CampaignResult, sailed: list[SailedSet], report: bool, progress: Progress | None
) -> list[tuple[str, Writer]]:
    """Names of the files and what writes each; a comparison that was not made writes none."""
    page_writers: list[tuple[str, Writer]] = []
    if report:
        from .html_report import ReportPage

        # Its drawings, and the comparisons, may be under way in other processes: they are asked for last.
        page = ReportPage(result, sailed)

        def write_page(path: Path) -> None:
            path.write_text(page.render(progress=progress), encoding="utf-8")

        page_writers = [("report.html", write_page)]
    return [
        ("derivatives.csv", csv_writer(result.derivatives_frame)),
        *_sets(result),
        ("harmonics.csv", csv_writer(result.harmonics_frame)),
        ("runs.csv", csv_writer(result.runs_frame)),
        ("findings.csv", csv_writer(result.findings_frame)),
        *((name, partial(_write_comparison, result, kind)) for kind, name in COMPARISONS.items()),
        *_manoeuvres(sailed),
        *page_writers,
    ]


def _manoeuvres(sailed: list[SailedSet]) -> list[tuple[str, Writer]]:
    """Tables and tracks of the sets that were sailed; with several groups each has its own."""
    known = [one for one in sailed if one.results is not None]
    names = group_names([one.label for one in sailed])
    files: list[tuple[str, Writer]] = []
    for one in known:
        assert one.results is not None
        ending = f"-{names[one.label]}" if len(sailed) > 1 else ""
        files += manoeuvre_tables(one.results, ending)
    return files


def _write_comparison(result: CampaignResult, kind: str, path: Path) -> None:
    frame = comparison_frame(result, kind)
    if frame is not None:
        frame.to_csv(path, index=False)


def _sets(result: CampaignResult) -> list[tuple[str, Writer]]:
    sets = result.sets()
    if len(sets) == 1:
        (only,) = sets.values()
        return [("derivatives.json", only.to_json)]
    together = {"format": SETS_FORMAT, "sets": {label: one.to_dict() for label, one in sets.items()}}
    files: list[tuple[str, Writer]] = [("derivatives.json", lambda path: write_json(together, path))]
    names = group_names(list(sets))
    files += [(f"derivatives-{names[label]}.json", one.to_json) for label, one in sets.items()]
    return files


def group_names(labels: list[str]) -> dict[str, str]:
    """Labels of groups as parts of file names, no two alike."""
    names: dict[str, str] = {}
    for label in labels:
        name = re.sub(r"[^a-z0-9.]+", "-", label.lower().replace("/", "")).strip("-.") or "all"
        names[label] = name if name not in names.values() else f"{name}-{len(names) + 1}"
    return names


def comparison_frame(result: CampaignResult, kind: str) -> pd.DataFrame | None:
    """Table of one kind of comparison over all groups, or None; with a column group when there are several."""
    import pandas as pd

    frames = []
    for fit in result.fits:
        frame = result.comparison(kind, fit.label)
        if frame is not None:
            frames.append(frame.assign(group=fit.label) if len(result.fits) > 1 else frame.copy())
            frames[-1].attrs = {}  # pandas compares them when it joins tables
    return pd.concat(frames, ignore_index=True) if frames else None


def provenance(result: CampaignResult, created: datetime | None = None) -> dict[str, Any]:
    """Where the results come from, as plain data: campaign, files, choices, findings, versions."""
    return {
        "format": PROVENANCE_FORMAT,
        "created": timestamp(created),
        "campaign": result.campaign.model_dump(),
        "campaign_file": result.path.name,
        "versions": program_versions(),
        "rigid_body": result.rigid_body.describe() if result.rigid_body else None,
        "runs": len(result.runs),
        "groups": [
            {"label": label, "name": one.name, "provenance": one.to_dict()["provenance"]}
            for label, one in result.sets().items()
        ],
    }
