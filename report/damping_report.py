"""The report of free decays: one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from markupsafe import Markup

from ..core.provenance import program_versions
from ..core.ship import Ship
from ..decay.against_speed import against_speed
from ..decay.decay_campaign import DecayCampaign
from ..decay.decay_results import DecayAnalysis, DecayGroup, ship_of
from ..decay.roll_damping import CONVENTIONS
from .damping_drawings import DampingDrawings, draw_group
from .damping_memory import memory_table
from .damping_speeds import draw_speeds, speed_table
from .damping_tables import (
    equivalent_table,
    failures_table,
    ikeda_table,
    method_notes,
    method_table,
    models_table,
    ratio_facts,
    ratio_sentence,
    records_table,
    terms_table,
)
from .page_table import Column, Table, make_table
from .page_template import page_environment
from .provenance_tables import findings_table, inputs_table, setting_rows, versions_text
from .ship_particulars import Particular, particulars

HERE = Path(__file__).parent

SECTIONS = {
    "records": "Records",
    "damping": "Damping by method",
    "equivalent": "Equivalent damping",
    "extinction": "Extinction curve",
    "verdict": "What can be identified",
    "speeds": "Against speed",
    "memory": "Radiation memory",
    "ikeda": "Beside Ikeda",
    "residuals": "Residuals",
    "findings": "Findings",
    "choices": "Choices",
    "provenance": "Provenance",
}
"""Anchor and heading of each section, in order."""


@dataclass(frozen=True)
class GroupPage:
    """What the page shows of one group of records."""

    label: str
    preferred: str
    facts: list[tuple[str, str, str]]
    methods: Table
    failures: Table
    equivalent: Table
    ratio: str
    terms: Table
    models: Table | None
    ikeda: Table | None
    limits: tuple[str, ...]
    drawn: DampingDrawings
    memory: Table | None
    memory_known: str


def render_damping_report(
    analysis: DecayAnalysis,
    *,
    created: datetime | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> str:
    """The report of a decay campaign as HTML.

    Parameters
    ----------
    analysis : DecayAnalysis
    created : datetime, optional
        Time that the page carries; the present one when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    str
        A page that needs nothing beside itself: style and drawings are inside.
    """
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    groups = []
    for number, group in enumerate(analysis.groups):
        if progress:
            progress("drawing", number, len(analysis.groups))
        groups.append(_group(group, f"g{number + 1}", analysis))
    if progress:
        progress("drawing", len(groups), len(groups))
    records = [record for group in analysis.groups for record in group.records]
    findings = [item for group in analysis.groups for item in group.all_findings]
    empty = {
        "ikeda": all(group.ikeda is None for group in analysis.groups),
        "memory": all(group.memory is None for group in analysis.groups),
        "speeds": len(against_speed(analysis.groups)) == 0,
    }
    ship = ship_of(analysis)
    page: dict[str, Any] = {
        "heading": analysis.campaign.decay,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "particulars": [] if ship is None else particulars([ship], _roll_particulars(ship)),
        "groups": groups,
        "records": records_table(analysis),
        "speeds": speed_table(analysis.groups),
        "speed_drawings": draw_speeds(analysis.groups),
        "conventions": CONVENTIONS,
        "method_notes": method_notes(),
        "findings": findings_table(dict.fromkeys(findings)),
        "choices": choices_table(analysis.campaign, ("reduction", "fit", "ikeda", "memory", "output")),
        "record_steps": [(record.name, record.steps) for record in records],
        "versions": versions_text(program_versions()),
        "inputs": inputs_table(_inputs(analysis)),
        "sections": {anchor: title for anchor, title in SECTIONS.items() if not empty.get(anchor, False)},
    }
    return page_environment().get_template("damping_report.html.j2").render(page)


def _group(group: DecayGroup, prefix: str, analysis: DecayAnalysis) -> GroupPage:
    fit = group.preferred
    return GroupPage(
        label=group.label,
        preferred=f"By the {fit.method} fit, {fit.model.label}",
        facts=ratio_facts(group),
        methods=method_table(group, analysis.truth),
        failures=failures_table(group),
        equivalent=equivalent_table(group),
        ratio=ratio_sentence(group),
        terms=terms_table(group),
        models=models_table(group),
        ikeda=None if group.ikeda is None else ikeda_table(group.ikeda),
        limits=() if group.ikeda is None else tuple(item.message for item in group.ikeda.findings),
        drawn=draw_group(group, prefix, analysis.truth),
        memory=None if group.memory is None else memory_table(group.memory),
        memory_known="" if group.memory is None else group.memory.known,
    )


def choices_table(campaign: DecayCampaign, sections: Sequence[str]) -> Table:
    """Every setting of some sections of a campaign, those that it sets first."""
    rows = []
    for section in sections:
        value = getattr(campaign, section)
        if value is not None:
            given = section in campaign.model_fields_set
            rows += setting_rows(section, value, given)
    ordered = [*(row for row in rows if row[2]), *(row for row in rows if not row[2])]
    cells = [(key, text, "set" if given else "default") for key, text, given in ordered]
    return make_table([Column("setting", "code"), Column("value"), Column("by")], cells)


def _inputs(analysis: DecayAnalysis) -> dict[str, str]:
    """Files with their digest: records, and tables of radiation."""
    records = [record for group in analysis.groups for record in group.records]
    tables = [group.memory.table for group in analysis.groups if group.memory is not None]
    digests = {record.source: record.sha256 for record in records} | {one.source: one.sha256 for one in tables}
    return {source: digest for source, digest in digests.items() if digest}


def _roll_particulars(ship: Ship) -> list[Particular]:
    """Particulars that roll depends on."""
    return [
        ("Volume", ship.volume, "m³"),
        ("Metacentric height GM", ship.GM, "m"),
        ("Centre of gravity KG", ship.KG, "m"),
    ]
