"""The report of a campaign: one self-contained HTML page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from ..core.provenance import program_versions
from ..formats.write import atomic_path
from ..pmm.campaign_result import CampaignResult
from ..pmm.hull_fit import HullFit
from .campaign_manoeuvres import SailedSet, sail_campaign
from .derivative_tables import (
    candidates_table,
    conventions_table,
    derivative_table,
    estimators_table,
    range_table,
    three_ways_table,
    units_text,
    validity_table,
)
from .manoeuvre_section import manoeuvre_section
from .page_table import Table
from .page_template import page_environment
from .provenance_tables import choices_tables, findings_table, inputs_table, setting_text, versions_text
from .run_tables import diagnostics_table, harmonics_table, remarks, runs_table
from .ship_particulars import particulars
from .typography import fixed

if TYPE_CHECKING:
    import pandas as pd

    from ..core.derivative_set import DerivativeSet
    from .report_figures import Sections

HERE = Path(__file__).parent

SECTIONS = {
    "derivatives": "Derivatives",
    "conventions": "Conventions",
    "fits": "Fitted forces",
    "residuals": "Residuals",
    "series": "Time series",
    "harmonics": "Harmonics",
    "ways": "Three ways",
    "models": "Models and ranges",
    "manoeuvres": "Manoeuvres",
    "diagnostics": "Diagnostics",
    "runs": "Runs",
    "findings": "Findings",
    "choices": "Choices",
    "provenance": "Provenance",
}
"""Anchor and heading of each section, in order."""


@dataclass(frozen=True)
class GroupPage:
    """What the page shows of one group of runs."""

    anchor: str
    label: str
    name: str
    units: str
    table: Table
    conventions: Table
    validity: Table
    harmonics: Table
    ways: Table | None
    left_out: tuple[str, ...]
    estimators: Table | None
    candidates: Table | None
    ranges: Table | None
    diagnostics: Table
    remarks: tuple[tuple[str, str, str], ...]
    drawn: Sections


class ReportPage:
    """The report of a campaign; its drawings are begun at once, for a large campaign in other processes.

    Parameters
    ----------
    result : CampaignResult
    sailed : sequence of SailedSet
        Manoeuvres of the fitted sets, where the campaign asks for them.
    """

    def __init__(self, result: CampaignResult, sailed: Sequence[SailedSet] = ()) -> None:
        # drawing needs matplotlib, which the command line must not load at its start
        from .report_figures import draw_sections

        self._result = result
        self._sailed = sailed
        self._written = [result.written(fit) for fit in result.fits]
        self._drawn = [
            draw_sections(fit, written, f"g{number}")
            for number, (fit, written) in enumerate(zip(result.fits, self._written, strict=True), start=1)
        ]

    def render(
        self, *, created: datetime | None = None, progress: Callable[[str, int, int], None] | None = None
    ) -> str:
        """The page as HTML; see :func:`render_report`."""
        groups, count = [], len(self._drawn)
        for number, fit in enumerate(self._result.fits):
            if progress:
                progress("drawing", number, count)
            page = _group(self._result, fit, self._written[number], f"g{number + 1}", self._drawn[number])
            groups.append(page)
        if progress:
            progress("drawing", count, count)
        return _render(self._result, groups, created, self._sailed)


def render_report(
    result: CampaignResult,
    *,
    created: datetime | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> str:
    """The report of a campaign as HTML.

    Parameters
    ----------
    result : CampaignResult
    created : datetime, optional
        Time that the page carries; now when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    str
        A page that needs nothing beside itself: style and drawings are inside.
    """
    return ReportPage(result, sail_campaign(result, progress)).render(created=created, progress=progress)


def _render(
    result: CampaignResult, groups: list[GroupPage], created: datetime | None, sailed: Sequence[SailedSet]
) -> str:
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    versions = program_versions()
    chosen, defaults = choices_tables(result.settings)
    provenance = result.fits[0].derivatives.provenance
    page: dict[str, Any] = {
        "campaign": result.campaign,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "particulars": particulars([run.ship for run in result.runs]),
        "facts": facts(result),
        "groups": groups,
        "manoeuvres": [
            (one, manoeuvre_section(one.results, f"m{number}") if one.results is not None else None)
            for number, one in enumerate(sailed, start=1)
        ],
        "runs": runs_table(result),
        "findings": findings_table(result.findings),
        "severities": _severities(result),
        "chosen": chosen,
        "defaults": defaults,
        "steps": list(provenance.choices.get("steps seen", [])),
        "body": result.rigid_body.describe() if result.rigid_body else "",
        "accepted": setting_text(provenance.choices.get("accepted rules", [])),
        "inputs": inputs_table(provenance.inputs),
        "versions": versions_text(versions),
        "citation": citation(result, versions["towtank"], moment),
        "file": result.path.name,
    }
    page["sections"] = _present(page)
    return page_environment().get_template("report.html.j2").render(page)


def write_report(
    result: CampaignResult,
    path: str | Path,
    *,
    created: datetime | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> Path:
    """Write the report of a campaign to `path`; see :func:`render_report`.

    The page appears when it is complete; an interrupted call leaves the old one or none.
    """
    target = Path(path)
    text = render_report(result, created=created, progress=progress)
    with atomic_path(target) as temporary:
        temporary.write_text(text, encoding="utf-8")
    return target


def _group(
    result: CampaignResult,
    fit: HullFit,
    written: DerivativeSet,
    anchor: str,
    drawn: Callable[[pd.DataFrame | None], Sections],
) -> GroupPage:
    # The tables first: the drawings may be under way in other processes.
    tables = {
        "table": derivative_table(fit, written, result.settings.fit.shared_bias),
        "conventions": conventions_table(written),
        "validity": validity_table(written),
        "harmonics": harmonics_table(fit),
        "diagnostics": diagnostics_table(fit),
    }
    ways = result.comparison("three ways", fit.label)
    candidates = result.comparison("candidates", fit.label)
    ranges = result.comparison("range", fit.label)
    estimates = result.comparison("estimators", fit.label)
    left_out: list[str] = []
    if ways is not None:
        left_out = [*ways.attrs.get("single_run_left_out", []), *ways.attrs.get("multiple_run_left_out", [])]
    return GroupPage(
        anchor=anchor,
        label=fit.label,
        name=written.name,
        units=units_text(written),
        ways=None if ways is None else three_ways_table(ways, fit.derivatives),
        left_out=tuple(left_out),
        estimators=None if estimates is None else estimators_table(estimates, fit.derivatives),
        candidates=None if candidates is None else candidates_table(candidates),
        ranges=None if ranges is None else range_table(ranges, fit.derivatives),
        remarks=tuple(remarks(fit)),
        drawn=drawn(ways),
        **tables,
    )


def _present(page: dict[str, Any]) -> dict[str, str]:
    """The sections that have something to show."""
    groups: list[GroupPage] = page["groups"]
    empty = {
        "series": not any(group.drawn.series for group in groups),
        "harmonics": not any(group.harmonics.rows for group in groups),
        "ways": not any(group.ways for group in groups),
        "manoeuvres": not page["manoeuvres"],
        "models": not any(group.candidates or group.ranges or group.estimators for group in groups),
    }
    return {anchor: title for anchor, title in SECTIONS.items() if not empty.get(anchor, False)}


def facts(result: CampaignResult) -> list[tuple[str, str, str]]:
    """What the campaign amounts to, as (what, number, detail)."""
    kinds = Counter(run.run.kind.replace("_", " ") for run in result.runs)
    detail = ", ".join(f"{count} {kind}" for kind, count in kinds.most_common())
    rows = [("runs", str(len(result.runs)), detail)]
    count = sum(len(fit.derivatives) for fit in result.fits)
    sets = f"in {len(result.fits)} sets" if len(result.fits) > 1 else "in one set"
    rows.append(("derivatives", str(count), sets))
    low: dict[str, float] = {}
    for fit in result.fits:
        for component in fit.components:
            value = fit.derivatives.diagnostics.get(component, {}).get("R2")
            if value is not None:
                low[component] = min(low.get(component, 1.0), value)
    if low:
        detail = ", ".join(f"{component} {fixed(value, 4)}" for component, value in low.items())
        rows.append(("lowest R²", fixed(min(low.values()), 4), detail))
    counts = _severities(result)
    detail = (
        ", ".join(f"{number} {name}" for name, number in counts.items()) or "the audit found nothing to report"
    )
    rows.append(("findings", str(sum(counts.values())), detail))
    return rows


def _severities(result: CampaignResult) -> dict[str, int]:
    counts = Counter(
        f"{finding.severity} (accepted)" if finding.accepted else finding.severity for finding in result.findings
    )
    return dict(sorted(counts.items()))


def citation(result: CampaignResult, version: str, created: datetime) -> str:
    """How to cite the derivatives of this report."""
    source = result.campaign.source.rstrip(". ")
    digest = result.fits[0].derivatives.provenance.inputs.get(result.path.name, "")
    text = (
        f"{result.campaign.name}: hydrodynamic derivatives identified with towtank {version}, {created:%Y-%m-%d}"
    )
    if digest:
        text += f", campaign file sha256 {digest[:16]}"
    return f"{text}. Data: {source}." if source else f"{text}."
