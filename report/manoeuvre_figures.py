"""Figures of simulated manoeuvres and their ensembles: fans of tracks, histograms of indices, elasticities."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from ..core.errors import SimulationError
from ..simulate.criteria import CRITERIA, judged, length_over_speed
from ..simulate.ensembles import Ensemble
from ..simulate.index_definitions import definition_of
from ..simulate.track_fan import TrackFan
from .figure_style import BLUE, INK, MUTED, SKY, VERMILLION, new_axes, small_legend

BAND = (0.05, 0.95)
"""Quantiles at the edges of a band."""

FAINT = 0.25
"""Opacity of single draws and of bands."""

BARS = 40
"""Largest number of bars of a histogram."""


def trajectory_fan(fan: TrackFan, *, ax: Axes | None = None, tracks: bool = True) -> Axes:
    """Tracks of the draws of a manoeuvre, their band and the unperturbed track.

    Parameters
    ----------
    fan : TrackFan
        From :meth:`~towtank.simulate.ensembles.Ensemble.fan`.
    ax : Axes, optional
    tracks : bool
        Draw the single tracks, not the band alone.

    Returns
    -------
    Axes
        Advance upwards and transfer to the right, in ship lengths. Light band: 5 to 95 per cent of the draws, across
        the track.
    """
    ax = ax if ax is not None else new_axes()
    L = fan.length
    if tracks:
        lines = np.stack([fan.tracks["y"], fan.tracks["x"]], axis=2) / L
        ax.add_collection(LineCollection(list(lines), colors=MUTED, linewidths=0.4, alpha=FAINT))
    left, right = fan.track_band(*BAND)
    outline = np.vstack([left, right[::-1]]) / L
    outline = outline[np.all(np.isfinite(outline), axis=1)]
    ax.fill(outline[:, 1], outline[:, 0], color=SKY, alpha=FAINT, linewidth=0.0, label="5 to 95 % of the draws")
    ax.plot(fan.unperturbed["y"] / L, fan.unperturbed["x"] / L, color=BLUE, linewidth=1.4, label="unperturbed")
    ax.set_aspect("equal", adjustable="datalim")
    ax.autoscale_view()
    ax.set_xlabel("transfer y / L")
    ax.set_ylabel("advance x / L")
    return ax


def heading_fan(fan: TrackFan, *, ax: Axes | None = None, tracks: bool = True) -> Axes:
    """Heading of the draws of a zig-zag over time, their band, and heading and rudder of the unperturbed vessel.

    Parameters
    ----------
    fan : TrackFan
    ax : Axes, optional
    tracks : bool
        Draw the single headings, not the band alone.

    Returns
    -------
    Axes
        Degrees over seconds; light band: 5 to 95 per cent of the draws at each time.

    Raises
    ------
    SimulationError
        For a fan of turning circles, which has no common time.
    """
    if fan.along != "time":
        raise SimulationError(
            f"tracks of {fan.manoeuvre} are compared at equal headings, not times", cure="use trajectory_fan"
        )
    ax = ax if ax is not None else new_axes()
    if tracks:
        headings = np.degrees(fan.tracks["psi"])
        lines = [np.column_stack([fan.grid, heading]) for heading in headings]
        ax.add_collection(LineCollection(lines, colors=MUTED, linewidths=0.4, alpha=FAINT))
    lower, upper = (np.degrees(edge) for edge in fan.band("psi", *BAND))
    ax.fill_between(fan.grid, lower, upper, color=SKY, alpha=FAINT, linewidth=0.0, label="5 to 95 % of the draws")
    ax.plot(fan.grid, np.degrees(fan.unperturbed["psi"]), color=BLUE, linewidth=1.4, label="heading, unperturbed")
    ax.plot(fan.grid, np.degrees(fan.unperturbed["delta"]), color=VERMILLION, linewidth=0.9, label="rudder")
    ax.set_xlim(0.0, float(fan.grid[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel("heading, rudder [deg]")
    return ax


def manoeuvre_fan(fan: TrackFan, *, ax: Axes | None = None, tracks: bool = True) -> Axes:
    """The fan as it is usually drawn: headings over time for a zig-zag, tracks for all else."""
    draw = heading_fan if fan.manoeuvre.startswith("zigzag") else trajectory_fan
    return draw(fan, ax=ax, tracks=tracks)


def index_histogram(ensemble: Ensemble, manoeuvre: str, index: str, *, ax: Axes | None = None) -> Axes:
    """Distribution of an index over the draws, with the unperturbed value and the limit of a criterion.

    Parameters
    ----------
    ensemble : Ensemble
    manoeuvre, index : str
        E.g. ``"zigzag +10/10"``, ``"overshoot 2"``.
    ax : Axes, optional

    Returns
    -------
    Axes
        Draws in each class; draws beyond the limit in another colour. A limit far from all draws is told in the
        legend, not drawn.

    Raises
    ------
    SimulationError
        When no draw has this index.
    """
    values = ensemble.draws_of(manoeuvre, index)
    drawn = values[np.isfinite(values)]
    if not len(drawn):
        raise SimulationError(f"no draw has an {index} of {manoeuvre}", cure="see the failures of the ensemble")
    ax = ax if ax is not None else new_axes(margins=(0.66, 0.1, 0.46, 0.3))
    unit = definition_of(index).unit
    limit = criterion_limit(ensemble, manoeuvre, index)
    width = _class_width(drawn)
    first = np.floor(drawn.min() / width)
    edges = width * np.arange(first, np.ceil(drawn.max() / width) + 2)
    counts, _ = np.histogram(drawn, edges)
    ax.bar(edges[:-1], counts, width, align="edge", color=SKY, linewidth=0.0)
    if limit is not None and drawn.max() > limit:
        # the class in which the limit lies is split there
        beyond, _ = np.histogram(drawn[drawn > limit], edges)
        starts = np.maximum(edges[:-1], limit)
        ax.bar(
            starts, beyond, np.clip(edges[1:] - starts, 0.0, None), align="edge", color=VERMILLION, linewidth=0.0
        )
    value = ensemble.unperturbed[manoeuvre].get(index, np.nan)
    if np.isfinite(value):
        ax.axvline(value, color=INK, linewidth=1.0, label="unperturbed")
    if limit is not None:
        # a draw without a value does not pass, as in the table of the criteria
        share = float(np.sum(drawn <= limit)) / len(values)
        text = f"IMO limit {limit:.4g} {unit}, passed by {100.0 * share:.4g} %"
        if limit - drawn.max() <= drawn.max() - drawn.min():
            ax.axvline(limit, color=VERMILLION, linewidth=1.2, linestyle="--", label=text)
        else:
            ax.plot([], [], color=VERMILLION, linewidth=1.2, linestyle="--", label=text)
    ax.set_xlabel(f"{index}, {manoeuvre}" + (f" [{unit}]" if unit != "-" else ""))
    ax.set_ylabel("draws")
    small_legend(ax, loc="lower center", bbox_to_anchor=(0.45, 0.99), ncols=2, borderaxespad=0.0)
    return ax


def criterion_limit(ensemble: Ensemble, manoeuvre: str, index: str) -> float | None:
    """Limit of IMO resolution MSC.137(76) for an index of a manoeuvre; None when there is none."""
    ratio = length_over_speed(ensemble.vessel.ship, ensemble.vessel.speed)
    for criterion in CRITERIA:
        if criterion.index == index and judged(criterion, manoeuvre):
            return criterion.limit(ratio)
    return None


def elasticity_bars(
    ensemble: Ensemble, manoeuvre: str, index: str, *, most: int = 10, ax: Axes | None = None
) -> Axes:
    """Elasticities of an index, the largest first, from the regression and from central differences.

    Parameters
    ----------
    ensemble : Ensemble
    manoeuvre, index : str
    most : int
        Largest number of parameters.
    ax : Axes, optional

    Returns
    -------
    Axes
        Bars: per cent of the index per per cent of the parameter over the draws, with 95 % intervals; marks: at the
        unperturbed vessel. Where the regression cannot tell parameters apart the bars are those of the differences.

    Raises
    ------
    SimulationError
        When the index has no elasticities.
    """
    ensemble.draws_of(manoeuvre, index)
    table = ensemble.elasticities
    table = table[(table["manoeuvre"] == manoeuvre) & (table["index"] == index)]
    table = table[np.isfinite(table["first_order"]) | np.isfinite(table["elasticity"])]
    if table.empty:
        raise SimulationError(f"{index} of {manoeuvre} has no elasticities", cure="choose an index that is not 0")
    bars = table["elasticity"].fillna(table["first_order"])
    order = bars.abs().sort_values(ascending=False).index[:most]
    table, bars = table.loc[order], bars.loc[order]
    ax = ax if ax is not None else new_axes(margins=(1.45, 0.1, 0.46, 0.12))
    places = np.arange(len(order))
    ax.barh(places, bars, height=0.7, color=np.where(bars < 0.0, SKY, BLUE).tolist(), linewidth=0.0)
    ax.errorbar(
        bars, places, xerr=1.96 * table["standard_error"].fillna(0.0), fmt="none", ecolor=INK, elinewidth=0.8
    )
    ax.plot(table["first_order"], places, linestyle="none", marker="D", markersize=3.0, color=VERMILLION)
    ax.axvline(0.0, color=INK, linewidth=0.7)
    ax.set_yticks(places, [str(name) for name in table["parameter"]])
    ax.invert_yaxis()
    ax.grid(False, axis="y")
    ax.set_xlabel(f"per cent of {index} per per cent")
    return ax


def _class_width(drawn: np.ndarray) -> float:
    """Width of the classes of a histogram: that of Freedman and Diaconis (1981), at most `BARS` classes."""
    spread = float(drawn.max() - drawn.min())
    if spread == 0.0:
        return abs(float(drawn[0])) * 0.01 or 1.0
    low, high = np.quantile(drawn, (0.25, 0.75))
    return max(2.0 * float(high - low) / len(drawn) ** (1.0 / 3.0), spread / BARS)
