"""The page of a squat result: sections of notes, drawings and tables, self-contained."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Literal

from markupsafe import Markup
from matplotlib.axes import Axes

from ..core.findings import Finding
from ..core.provenance import program_versions
from .drawings import Drawing
from .figure_style import inline_svg
from .page_table import Table
from .page_template import page_environment
from .provenance_tables import findings_table, inputs_table, versions_text

HERE = Path(__file__).parent


@dataclass(frozen=True)
class Part:
    """Something of a section: heading, notes, drawings, tables, remarks (name, text), in this order."""

    title: str = ""
    notes: tuple[str, ...] = ()
    drawings: tuple[Drawing, ...] = ()
    tables: tuple[Table, ...] = ()
    lines: tuple[tuple[str, str], ...] = ()
    size: Literal["large", "wide", "panel"] = "large"
    kind: str = ""


@dataclass(frozen=True)
class Section:
    """A section of a page with the anchor that leads to it."""

    anchor: str
    title: str
    parts: tuple[Part, ...]


def drawn(ax: Axes, name: str, caption: str) -> Drawing:
    """The figure of some axes with its caption; `name` is unique in the page."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    return Drawing(inline_svg(figure, re.sub(r"[^A-Za-z0-9_-]+", "-", name), caption), caption)


def findings_section(findings: Iterable[Finding]) -> Section:
    """What audit and reduction said."""
    table = findings_table(dict.fromkeys(findings))
    part = Part(tables=(table,), kind="long") if table.rows else Part(notes=("Nothing was found to report.",))
    return Section("findings", "Findings", (part,))


def provenance_section(inputs: Mapping[str, str]) -> Section:
    """Programs and files."""
    tables = (inputs_table(inputs),) if inputs else ()
    return Section(
        "provenance",
        "Provenance",
        (Part(notes=(f"Programs: {versions_text(program_versions())}.",), tables=tables),),
    )


def render_squat_page(
    title: str,
    kicker: str,
    sections: Sequence[Section],
    *,
    source: str = "",
    notes: str = "",
    virtual: bool = False,
    particulars: Sequence[tuple[str, str, str]] = (),
    facts: Sequence[tuple[str, str, str]] = (),
    created: datetime | None = None,
) -> str:
    """The page as HTML that needs nothing beside itself.

    Parameters
    ----------
    title, kicker : str
        Heading, and the line above it.
    sections : sequence of Section
    source, notes : str
        Below the heading.
    virtual : bool
        Say that the data were not measured.
    particulars : sequence of (str, str, str)
        Name, value, unit.
    facts : sequence of (str, str, str)
        What, number, detail: the numbers that are looked for first.
    created : datetime, optional
        Time that the page carries; the present one when not given.
    """
    moment = (created or datetime.now(UTC)).astimezone(UTC)
    return (
        page_environment()
        .get_template("squat_page.html.j2")
        .render(
            title=title,
            kicker=kicker,
            source=source,
            notes=notes,
            virtual=virtual,
            particulars=particulars,
            facts=facts,
            sections=sections,
            created=moment.strftime("%Y-%m-%d %H:%M UTC"),
            css=Markup((HERE / "report.css").read_text(encoding="utf-8")),
        )
    )
