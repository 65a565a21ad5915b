"""The report of rolls at sea: one self-contained HTML page."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np
from markupsafe import Markup
from matplotlib.axes import Axes

from ..core.provenance import program_versions
from ..decay.at_sea_results import AtSeaAnalysis, AtSeaRecord
from ..decay.equivalent_damping import EquivalentDamping, equivalent_linear
from ..decay.random_decrement import RandomDecrement
from ..decay.roll_damping import CONVENTIONS
from ..decay.term_values import term_values
from .damping_figures import drawn, equivalent_damping_figure
from .damping_report import choices_table
from .drawings import Drawing
from .figure_style import BLUE, CYCLE, INK, MUTED, decimated, new_axes, small_legend
from .page_table import Column, Table, make_table
from .page_template import page_environment
from .provenance_tables import findings_table, inputs_table, versions_text
from .typography import fixed, significant

HERE = Path(__file__).parent

AT_SEA_SECTIONS = {
    "records": "Records",
    "terms": "Terms by method",
    "identifiability": "What the oscillations determine",
    "equivalent": "Equivalent damping",
    "decrement": "Random decrement",
    "excitations": "Excitations",
    "findings": "Findings",
    "choices": "Choices",
    "provenance": "Provenance",
}
"""Anchor and heading of each section, in order."""

_SHOWN_OSCILLATIONS = 12
_SHOWN_SPAN = 40.0
"""Oscillations in a table, and periods of a record in a figure."""


@dataclass(frozen=True)
class AtSeaPage:
    """What the page shows of one record."""

    name: str
    record: Drawing
    terms: Table
    failures: Table
    shares: Table | None
    determined: str
    equivalent: Drawing | None
    decrement: Drawing | None
    excitations: Table | None


def render_at_sea_report(
    analysis: AtSeaAnalysis,
    *,
    created: datetime | None = None,
    progress: Callable[[str, int, int], None] | None = None,
) -> str:
    """The report of rolls at sea as HTML.

    Parameters
    ----------
    analysis : AtSeaAnalysis
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
    truth = analysis.campaign.decay.truth
    pages = []
    for number, one in enumerate(analysis.records):
        if progress:
            progress("drawing", number, len(analysis.records))
        pages.append(_record_page(one, f"s{number + 1}", truth))
    if progress:
        progress("drawing", len(pages), len(pages))
    findings = [item for one in analysis.records for item in one.all_findings]
    empty = {
        "identifiability": all(page.shares is None for page in pages),
        "equivalent": all(page.equivalent is None for page in pages),
        "decrement": all(page.decrement is None for page in pages),
        "excitations": all(page.excitations is None for page in pages),
    }
    page: dict[str, Any] = {
        "heading": analysis.campaign.decay,
        "created": moment.strftime("%Y-%m-%d %H:%M UTC"),
        "css": Markup((HERE / "report.css").read_text(encoding="utf-8")),
        "records": pages,
        "conventions": CONVENTIONS.replace(" = 0,", " = f sin(we t + phase) + f0,"),
        "findings": findings_table(dict.fromkeys(findings)),
        "choices": choices_table(analysis.campaign, ("at_sea", "output")),
        "record_steps": [
            (one.record.name, [*one.record.steps, f"first guess: {one.guessed_from}"]) for one in analysis.records
        ],
        "versions": versions_text(program_versions()),
        "inputs": inputs_table({one.record.source: one.record.sha256 for one in analysis.records}),
        "sections": {anchor: title for anchor, title in AT_SEA_SECTIONS.items() if not empty.get(anchor, False)},
    }
    return page_environment().get_template("damping_at_sea_report.html.j2").render(page)


def _record_page(one: AtSeaRecord, prefix: str, truth: dict[str, float]) -> AtSeaPage:
    found = one.equivalent()
    return AtSeaPage(
        name=one.record.name,
        record=drawn(
            sea_record_figure(one),
            f"{prefix}-record",
            f"{one.record.name}: the {_SHOWN_SPAN:g} periods with the largest oscillation"
            + ("" if one.joint is None else ", and the joint fit where it was made."),
        ),
        terms=sea_terms_table(one, truth),
        failures=make_table([Column("method"), Column("why it gave no result")], list(one.failures.items())),
        shares=None if one.joint is None else shares_table(one),
        determined=_determined(one),
        equivalent=None
        if not found
        else drawn(
            equivalent_damping_figure(found, truth=_true_damping(truth, found), ax=new_axes((6.4, 4.0))),
            f"{prefix}-equivalent",
            "Joint fit along the amplitudes of its oscillations, random decrement at its trigger levels; bands: 95 %.",
        ),
        decrement=None
        if not one.decrements
        else drawn(
            decrement_figure(one.decrements, ax=new_axes((7.2, 2.5))),
            f"{prefix}-decrement",
            "Mean of the pieces over their trigger level: the free decay of the linear part.",
        ),
        excitations=None if one.joint is None else excitations_table(one),
    )


def _true_damping(truth: dict[str, float], found: dict[str, EquivalentDamping]) -> EquivalentDamping | None:
    if not truth:
        return None
    top = max(float(one.amplitude.max()) for one in found.values())
    at = np.linspace(0.02 * top, top, 40)
    alpha, omega, _ = equivalent_linear(term_values(truth), at)
    none = np.zeros_like(at)
    return EquivalentDamping(at, omega, alpha, none, alpha, alpha, np.ones(at.size, dtype=bool), 0.95, "roll")


def sea_terms_table(one: AtSeaRecord, truth: dict[str, float]) -> Table:
    """Terms of all methods with their intervals; those of the published search have none and are shaded."""
    columns = [Column("method"), Column("model"), Column("term", "code"), Column("value", "number")]
    columns += [
        Column("±", "number", "standard error"),
        Column("95 % interval", "number"),
        Column("unit", "short"),
    ]
    if truth:
        columns.append(Column("truth", "number"))
    rows, marks = [], []
    for row in one.terms().to_dict("records"):
        known = not math.isnan(row["std"])
        cells = [row["method"], row["model"], row["name"], significant(row["value"], 4)]
        cells.append(significant(row["std"], 2) if known else "–")
        low, high = significant(row["lower95"], 4), significant(row["upper95"], 4)
        cells.append(f"{low} … {high}" if known else "–")
        cells.append(row["unit"])
        if truth:
            cells.append(significant(truth[row["name"]], 4) if row["name"] in truth else "–")
        rows.append(cells)
        marks.append("" if known else "weak")
    return make_table(columns, rows, marks=marks)


def shares_table(one: AtSeaRecord) -> Table:
    """What of each term's effect no excitation can imitate."""
    fit = one.joint
    assert fit is not None
    rows = [(name, f"{share:.1e}") for name, share in fit.own_share.items()]
    return make_table([Column("term", "code"), Column("share of its effect", "number")], rows)


def _determined(one: AtSeaRecord) -> str:
    said = []
    if one.joint is not None:
        said.append(
            f"{len(one.joint.excitations)} oscillations, R² {fixed(one.joint.r2, 5)}, condition number "
            f"{significant(one.joint.condition_number, 3)}."
        )
    if one.searched is not None:
        said.append(
            f"The largest oscillation alone, at {significant(one.searched.start, 4)} s, determines "
            f"{one.searched.determines} numbers; the published search asks nine of it."
        )
    return " ".join(said)


def excitations_table(one: AtSeaRecord) -> Table:
    """Excitation of the largest oscillations of the joint fit."""
    fit = one.joint
    assert fit is not None
    frame = fit.excitations.assign(error=100.0 * fit.amplitude_error)
    shown = frame.nlargest(_SHOWN_OSCILLATIONS, "amplitude_deg").sort_values("start")
    columns = [
        Column("start [s]", "number"),
        Column("period [s]", "number"),
        Column("amplitude [deg]", "number"),
        Column("error of the amplitude [%]", "number"),
        Column("f [rad/s²]", "number"),
        Column("ωe [rad/s]", "number"),
        Column("phase [rad]", "number"),
        Column("f0 [rad/s²]", "number"),
    ]
    rows = [
        (
            fixed(row["start"], 2),
            fixed(row["period"], 3),
            fixed(row["amplitude_deg"], 2),
            fixed(row["error"], 2),
            significant(row["f"], 4),
            fixed(row["we"], 4),
            fixed(row["phase"], 3),
            significant(row["f0"], 3),
        )
        for row in shown.to_dict("records")
    ]
    return make_table(columns, rows, f"The {len(rows)} largest of {len(frame)} oscillations.")


def sea_record_figure(one: AtSeaRecord, *, ax: Axes | None = None) -> Axes:
    """The part of a record around its largest angle, and the joint fit.

    Parameters
    ----------
    one : AtSeaRecord
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((7.2, 2.5))
    record = one.record
    half = 0.5 * _SHOWN_SPAN * 2.0 * math.pi / math.sqrt(one.guess["c1"])
    middle = float(record.time[int(np.argmax(np.abs(record.value - record.value.mean())))])
    first = max(float(record.time[0]), min(middle - half, float(record.time[-1]) - 2.0 * half))
    rows = (record.time >= first) & (record.time <= first + 2.0 * half)
    time, angle = record.time[rows], np.degrees(record.value[rows])
    ax.plot(*decimated(time, angle), color=MUTED, linewidth=0.9, label="record")
    if one.joint is not None:
        ax.plot(time, np.degrees(one.joint.fitted[rows]), color=BLUE, linewidth=1.1, label="joint fit")
    low, high = float(angle.min()), float(angle.max())
    ax.set_xlim(float(time[0]), float(time[-1]))
    ax.set_ylim(low - 0.08 * (high - low), high + 0.3 * (high - low))
    ax.set_xlabel("time [s]")
    ax.set_ylabel("roll [deg]")
    small_legend(ax, loc="upper right", ncols=2)
    return ax


def decrement_figure(decrements: tuple[RandomDecrement, ...], *, ax: Axes | None = None) -> Axes:
    """Signatures over their levels with the standard error of the best one.

    Parameters
    ----------
    decrements : tuple of RandomDecrement
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((7.2, 2.5))
    ax.axhline(0.0, color=MUTED, linewidth=0.7)
    for number, found in enumerate(sorted(decrements, key=lambda item: item.level)):
        colour = CYCLE[number % len(CYCLE)]
        relative, error = found.signature / found.level, found.error / found.level
        ax.fill_between(found.time, relative - error, relative + error, color=colour, alpha=0.15, linewidth=0)
        label = f"{math.degrees(found.level):.3g} deg, {found.pieces} pieces"
        ax.plot(found.time, relative, color=colour, linewidth=1.1, label=label)
    last = max(float(found.time[-1]) for found in decrements)
    ax.set_xlim(0.0, last)
    ax.set_ylim(-1.15, 1.6)
    ax.set_xlabel("time from the crossing [s]")
    ax.set_ylabel("signature / level [-]")
    ax.tick_params(labelcolor=INK)
    small_legend(ax, loc="upper right", ncols=2)
    return ax
