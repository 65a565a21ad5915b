"""The page of a voyage at full scale: sinkage, clearance, extremes, budget of the sensors."""

from __future__ import annotations

import math
from datetime import datetime

import numpy as np
import pandas as pd
from matplotlib.axes import Axes

from ..squat.full_scale import FullScaleSquat
from .figure_style import BLUE, GREEN, MUTED, VERMILLION, decimated, new_axes, small_legend
from .page_table import Column, Table, make_table
from .provenance_tables import setting_text
from .ship_particulars import particulars
from .squat_page import Part, Section, drawn, findings_section, provenance_section, render_squat_page
from .typography import fixed, significant
from .voyage_outputs import Voyage

_WIDE = (7.2, 3.0)


def render_voyage(analysis: Voyage, *, created: datetime | None = None) -> str:
    """The page of a voyage as HTML that needs nothing beside itself.

    Parameters
    ----------
    analysis : Voyage
    created : datetime, optional
        Time that the page carries; the present one when not given.
    """
    heading = analysis.file.voyage
    ship = analysis.file.make_ship()
    sections = [
        Section("sinkage", "Sinkage", tuple(_sinkage(one, number) for number, one in enumerate(analysis.runs))),
        Section("extremes", "Extremes", (Part(tables=(summary_table(analysis),)),)),
    ]
    known = [(number, one) for number, one in enumerate(analysis.runs) if one.clearance is not None]
    if known:
        parts = tuple(_clearance(one, number) for number, one in known)
        sections.append(Section("clearance", "Water under the keel", parts))
    choices = tuple(
        (f"{one.run}, {name}", setting_text(value)) for one in analysis.runs for name, value in one.choices.items()
    )
    notes = tuple(f"{one.run}: {note}" for one in analysis.runs for note in one.notes)
    sections += [
        Section("budget", "Sensors", (Part(tables=(_budget_table(analysis),)),)),
        Section("choices", "Choices", (Part(notes=notes, lines=choices),)),
        findings_section(analysis.provenance.findings),
        provenance_section(analysis.provenance.inputs),
    ]
    return render_squat_page(
        heading.name,
        "squat at full scale",
        sections,
        source=heading.source,
        notes=heading.notes,
        virtual=heading.virtual,
        particulars=particulars([ship], [("Volume", ship.volume, "m³")])[:-1],
        created=created,
    )


def _sinkage(one: FullScaleSquat, number: int) -> Part:
    axes = voyage_figure(one, ax=new_axes(_WIDE))
    drawings = [drawn(axes, f"sinkage-{number}", "Light: as it was; strong: steady. Downward is deeper.")]
    if one.record.speed is not None:
        axes = voyage_speed_figure(one, ax=new_axes((7.2, 2.0)))
        drawings.append(drawn(axes, f"speed-{number}", "Through the water."))
    return Part(one.run, drawings=tuple(drawings), size="wide")


def _clearance(one: FullScaleSquat, number: int) -> Part:
    axes = voyage_clearance_figure(one, ax=new_axes(_WIDE))
    words = "Of the deepest corner, the motions of the moment included; band: two standard uncertainties."
    return Part(one.run, drawings=(drawn(axes, f"clearance-{number}", words),), size="wide")


def voyage_figure(voyage: FullScaleSquat, *, ax: Axes | None = None) -> Axes:
    """Sinkage at bow and stern over time, as it was and steady.

    Parameters
    ----------
    voyage : FullScaleSquat
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    frame = voyage.frame
    time = frame["time"].to_numpy(dtype=float)
    for name, colour in (("bow", BLUE), ("stern", VERMILLION)):
        whole, steady = (frame[f"sinkage_{name}{ending}"].to_numpy(dtype=float) for ending in ("", "_steady"))
        ax.plot(*decimated(time, whole), color=colour, linewidth=0.5, alpha=0.4)
        ax.plot(*decimated(time, steady), color=colour, linewidth=1.4, label=f"{name}, steady")
    low, high = ax.get_ylim()
    ax.set_ylim(high, low - 0.2 * (high - low))
    ax.set_xlim(float(time[0]), float(time[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel("sinkage [m]")
    small_legend(ax, loc="upper right", ncols=2)
    return ax


def voyage_speed_figure(voyage: FullScaleSquat, *, ax: Axes | None = None) -> Axes:
    """Speed through the water over time.

    Parameters
    ----------
    voyage : FullScaleSquat
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    frame = voyage.frame
    time = frame["time"].to_numpy(dtype=float)
    ax.plot(*decimated(time, frame["speed"].to_numpy(dtype=float)), color=GREEN, linewidth=1.1)
    ax.set_xlim(float(time[0]), float(time[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel("speed [m/s]")
    return ax


def voyage_clearance_figure(voyage: FullScaleSquat, *, ax: Axes | None = None) -> Axes:
    """Water under the deepest corner over time, with two standard uncertainties.

    Parameters
    ----------
    voyage : FullScaleSquat
        With a depth.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    known = voyage.clearance
    assert known is not None
    time = voyage.record.time
    reach = 2.0 * known.uncertainty
    ax.fill_between(time, known.clearance - reach, known.clearance + reach, color=BLUE, alpha=0.2, linewidth=0)
    ax.plot(*decimated(time, known.clearance), color=BLUE, linewidth=0.9)
    if np.nanmin(known.clearance) < 2.0 * reach:
        ax.axhline(0.0, color=MUTED, linewidth=1.0)
    ax.set_xlim(float(time[0]), float(time[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel("under the keel [m]")
    return ax


def summary_table(analysis: Voyage) -> Table:
    """Extremes of the voyage with the uncertainty of the sensors."""
    columns = [Column("record", "short"), Column("quantity"), Column("value", "number"), Column("unit", "short")]
    columns.append(Column("at [s]", "number"))
    columns += [Column("speed [m/s]", "number"), Column("u, RSS", "number"), Column("u, linear", "number")]
    rows = [
        (
            str(of["run"]),
            str(of["quantity"]),
            _known(of["value"], 3),
            str(of["unit"]),
            _known(of["at_time"], 4),
            _known(of["speed"], 3),
            _known(of["u_rss"], 2),
            _known(of["u_linear"], 2),
        )
        for of in analysis.summary_frame().to_dict("records")
    ]
    return make_table(columns, rows, "u: standard uncertainty of independent sensors, and all erring to one side.")


def _known(value: float, digits: int) -> str:
    return "–" if math.isnan(value) else significant(value, digits)


def _budget_table(analysis: Voyage) -> Table:
    frame = analysis.budget_frame()
    places = list(dict.fromkeys(frame["place"]))
    wide = frame.pivot(index="component", columns="place", values="contribution")
    order = [name for name in dict.fromkeys(frame["component"]) if name in wide.index]
    columns = [Column("component"), *(Column(f"{place} [m]", "number") for place in places)]
    rows = [[str(name), *(_cell(wide, str(name), place) for place in places)] for name in order]
    return make_table(columns, rows)


def _cell(wide: pd.DataFrame, name: str, place: str) -> str:
    value = float(wide.to_dict()[place][name])
    return "–" if math.isnan(value) else fixed(value, 3)
