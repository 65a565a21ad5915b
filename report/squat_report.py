"""The report of squat records: one self-contained HTML page."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime

import numpy as np

from ..squat.named_corrections import CORRECTIONS
from ..squat.squat_analysis import CONVENTIONS, SquatAnalysis
from ..squat.squat_group import SquatGroup
from ..squat.squat_run import SquatRun
from .drawings import Drawing
from .figure_style import new_axes
from .formula_figures import formula_figure
from .page_table import Column, make_table
from .provenance_tables import setting_rows
from .ship_particulars import particulars
from .squat_figures import (
    clearance_figure,
    corrected_figure,
    squat_curve_figure,
    squat_record_figure,
    squat_residual_figure,
)
from .squat_page import Part, Section, drawn, findings_section, provenance_section, render_squat_page
from .squat_prediction_page import numbers_part, source_lines
from .squat_tables import (
    clearance_table,
    corrected_table,
    fits_table,
    formula_scores_table,
    means_table,
    repeats_table,
    responses_table,
    squat_facts,
    waves_table,
    windows_table,
)

MOST_RECORDS = 12
"""Records that are drawn one by one."""

_CURVE, _WIDE, _LOW = (6.4, 3.8), (7.2, 2.3), (6.4, 2.4)
_SETTINGS = ("fairway", "channels", "window", "steps", "filter", "correction", "fit", "hull", "output")


def render_squat_report(
    analysis: SquatAnalysis,
    *,
    created: datetime | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> str:
    """The report of a squat campaign as HTML.

    Parameters
    ----------
    analysis : SquatAnalysis
    created : datetime, optional
        Time that the page carries; the present one when not given.
    progress : callable, optional
        ``progress(what, done, total)``.

    Returns
    -------
    str
        A page that needs nothing beside itself: style and drawings are inside.
    """
    heading = analysis.campaign.squat
    ship = analysis.campaign.make_ship()
    sections = [Section("means", "Steady squat", _means(analysis))]
    if any(run.waves is not None for run in analysis.runs):
        sections.append(Section("waves", "In waves", _waves(analysis)))
    for number, group in enumerate(analysis.groups):
        if progress:
            progress("drawing", number, len(analysis.groups))
        sections += _group_sections(analysis, group, number)
    if progress:
        progress("drawing", 1, 1)
    sections += [
        Section("records", "Records", _records(analysis)),
        findings_section(analysis.findings),
        Section("choices", "Choices", _choices(analysis)),
        provenance_section({run.record.name: run.record.sha256 for run in analysis.runs if run.record.sha256}),
    ]
    return render_squat_page(
        heading.name,
        "squat report",
        sections,
        source=heading.source,
        notes=heading.notes,
        virtual=heading.virtual,
        particulars=[] if ship is None else particulars([ship], [("Volume", ship.volume, "m³")])[:-1],
        facts=squat_facts(analysis),
        created=created,
    )


def _means(analysis: SquatAnalysis) -> tuple[Part, ...]:
    conventions = f"{CONVENTIONS[0].upper()}{CONVENTIONS[1:]}, shown in mm and mm/m for models."
    note = f"{conventions} ± is the standard error; neighbouring samples count once."
    parts = [
        Part(notes=(note,), tables=(means_table(analysis),)),
        Part("Windows", tables=(windows_table(analysis),)),
    ]
    if analysis.repeats:
        parts.append(Part("Repeats", tables=(repeats_table(analysis),)))
    return tuple(parts)


def _waves(analysis: SquatAnalysis) -> tuple[Part, ...]:
    note = "Mean and harmonics A cos(k ωₑ t + phase); the frequency of encounter is found with them unless it is given."
    parts = [Part(notes=(note,))]
    for run in analysis.runs:
        if run.waves is not None:
            parts.append(Part(run.name, tables=(waves_table(analysis, run.waves),)))
        if run.responses is not None:
            gauge = analysis.campaign.channels.wave
            said = f"First harmonics over the wave at gauge {gauge}, its phase moved to the centre of gravity."
            table = responses_table(analysis, run.responses)
            parts.append(Part(f"{run.name}: response to the waves", notes=(said,), tables=(table,)))
    return tuple(parts)


def _records(analysis: SquatAnalysis) -> tuple[Part, ...]:
    figures = tuple(_record(run, number) for number, run in enumerate(analysis.runs[:MOST_RECORDS]))
    more = len(analysis.runs) - len(figures)
    notes = (f"{more} further records are in the tables and not drawn.",) if more > 0 else ()
    steps = tuple((run.name, "; ".join(run.steps)) for run in analysis.runs)
    return (Part(notes=notes, drawings=figures, size="wide"), Part("What was done", lines=steps))


def _record(run: SquatRun, number: int) -> Drawing:
    axes = squat_record_figure(run, ax=new_axes(_WIDE))
    return drawn(axes, f"record-{number}", f"{run.name}. Downward is deeper; bars: means over the window.")


def _group_sections(analysis: SquatAnalysis, group: SquatGroup, number: int) -> list[Section]:
    several = len(analysis.groups) > 1
    tail = f", {group.label}" if several else ""
    length = analysis.campaign.length
    found = []
    if group.fits:
        curve, fits = group.curve, group.fits
        ends = ("sinkage_bow", "sinkage_stern")
        curves = [
            drawn(
                squat_curve_figure(curve, fits, length, ends, truth=analysis.truth, ax=new_axes(_CURVE)),
                f"curve-{number}",
                f"Sinkage at the ends, {group.label}. Bars: two standard errors of a run; bands: 95 % of the curve "
                "c Fh²/√(1 − Fh²); dotted: no points there.",
            ),
            drawn(
                squat_curve_figure(curve, fits, length, ("trim",), truth=analysis.truth, ax=new_axes(_CURVE)),
                f"trim-{number}",
                "Trim, positive by the bow.",
            ),
        ]
        residuals = [
            drawn(
                squat_residual_figure(curve, fits, length, names, ax=new_axes(_LOW)),
                f"residual-{number}-{names[0]}",
                f"{'Trim' if names[0] == 'trim' else 'Sinkage'}; dashed: two standard deviations of the scatter.",
            )
            for names in (ends, ("trim",))
        ]
        failures = group.failure_lines
        found.append(
            Section(
                f"curves-{number}",
                f"Curves{tail}",
                (Part(drawings=tuple(curves)), Part("Fits", tables=(fits_table(analysis, group),)))
                + ((Part("No curve", lines=failures),) if failures else ()),
            )
        )
        found.append(Section(f"residuals-{number}", f"Residuals{tail}", (Part(drawings=tuple(residuals)),)))
    if group.corrected is not None:
        found.append(Section(f"corrected-{number}", f"Corrected{tail}", (_corrected(analysis, group, number),)))
    if group.comparison is not None:
        found.append(Section(f"formulas-{number}", f"Beside the formulas{tail}", _formulas(group, number, length)))
    clearance = drawn(
        clearance_figure(group.curve, length, ax=new_axes(_LOW)),
        f"clearance-{number}",
        "Depth less draught less the larger of the sinkages at bow and stern.",
    )
    tables = (clearance_table(group.curve, length),)
    found.append(
        Section(
            f"clearance-{number}", f"Water under the keel{tail}", (Part(drawings=(clearance,), tables=tables),)
        )
    )
    return found


def _corrected(analysis: SquatAnalysis, group: SquatGroup, number: int) -> Part:
    chosen, length = analysis.campaign.correction, analysis.campaign.length
    assert chosen is not None
    assert group.corrected is not None
    source = CORRECTIONS[chosen.name]
    form = chosen.to or source.added_to[0]
    figure = drawn(
        corrected_figure(group.curve, group.corrected, length, ax=new_axes(_CURVE)),
        f"corrected-{number}",
        f"Open marks: as measured; filled: {form} corrected by {chosen.name}.",
    )
    note = (
        f"Correction {chosen.name}, added to the {form}: the points stand for {source.leads_to} ({source.source})."
    )
    return Part(notes=(note,), drawings=(figure,), tables=(corrected_table(group.curve, group.corrected, length),))


def _formulas(group: SquatGroup, number: int, length: float) -> tuple[Part, ...]:
    comparison = group.comparison
    assert comparison is not None
    measured = {str(name): comparison.measured[name].to_numpy(dtype=float) for name in comparison.measured}
    drawings = []
    for place in ("maximum", "bow", "stern"):
        if place in measured and np.isfinite(comparison.prediction.table[place]).any():
            axes = formula_figure(comparison.prediction, length, place, measured=measured)
            words = {"maximum": "Largest squat anywhere"}.get(place, f"Squat at the {place}")
            caption = f"{words}: formulas and measurement. Grey, dotted: outside the limits of the formula."
            drawings.append(drawn(axes, f"formula-{number}-{place}", caption))
    note = (
        "Errors are S − D, formula less measurement: positive where the formula says more squat than was measured."
    )
    return (
        Part(notes=(note,), drawings=tuple(drawings[:1]), tables=(formula_scores_table(comparison, length),)),
        Part("By place", drawings=tuple(drawings[1:])),
        numbers_part("Numbers", comparison.prediction, length, knots=False),
        Part("Sources", lines=source_lines(comparison.prediction)),
    )


def _choices(analysis: SquatAnalysis) -> tuple[Part, ...]:
    """Every setting of the campaign, those that it sets first."""
    rows = []
    for section in _SETTINGS:
        value = getattr(analysis.campaign, section, None)
        if value is not None:
            rows += setting_rows(section, value, section in analysis.campaign.model_fields_set)
    ordered = [*(row for row in rows if row[2]), *(row for row in rows if not row[2])]
    cells = [(key, text, "set" if given else "default") for key, text, given in ordered]
    return (
        Part(tables=(make_table([Column("setting", "code"), Column("value"), Column("by")], cells),), kind="long"),
    )
