"""Figures of scores: measured and computed curves, errors over speed, bars of quality and of mean error."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..squat.code_scores import CodeScores
from ..squat.curve_table import CASE
from .figure_style import CYCLE, INK, MARKERS, MUTED, new_axes, small_legend
from .squat_units import quantity_title

_SMALL = {"m": 0.1, "m/m": 0.1}
"""Below this a length or slope is shown in thousandths."""


def code_colours(scores: CodeScores) -> dict[str, str]:
    """Colour of each computation in every figure."""
    return {one.name: CYCLE[number % len(CYCLE)] for number, one in enumerate(scores.codes)}


def by_label(scores: CodeScores) -> str:
    """Label of the axis that the curves run over."""
    return f"{scores.measured.by} [{scores.measured.units[scores.measured.by] or '-'}]"


def shown_units(scores: CodeScores) -> dict[str, tuple[float, str]]:
    """Factor and unit in which each quantity is shown: mm and mm/m where m and m/m would be small numbers."""
    found = {}
    for name in scores.measured.quantities:
        unit = scores.measured.units[name]
        largest = float(np.nanmax(np.abs(scores.measured.frame[name].to_numpy(dtype=float))))
        small = unit in _SMALL and largest < _SMALL[unit]
        found[name] = (1000.0, f"m{unit}") if small else (1.0, unit or "-")
    return found


def score_curve_figure(scores: CodeScores, quantity: str, case: str = "", *, ax: Axes | None = None) -> Axes:
    """Measured points with two standard uncertainties where they are known, and the computed curves.

    Parameters
    ----------
    scores : CodeScores
    quantity : str
    case : str
        Of the experiment; empty where it has no cases.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    by, measured = scores.measured.by, scores.measured
    factor, unit = shown_units(scores)[quantity]
    for number, (name, colour) in enumerate(code_colours(scores).items()):
        code = scores.codes[number]
        if quantity not in code.frame:
            continue
        rows = code.frame[code.frame[CASE] == case].sort_values(by)[[by, quantity]].dropna()
        marker = MARKERS[(number + 1) % len(MARKERS)]
        ax.plot(
            rows[by], factor * rows[quantity], f"{marker}-", color=colour, markersize=3, linewidth=1.1, label=name
        )
    rows = measured.frame[measured.frame[CASE] == case]
    error = 2.0 * factor * measured.errors.loc[rows.index, quantity] if quantity in measured.errors else None
    ax.errorbar(
        rows[by],
        factor * rows[quantity],
        yerr=error,
        fmt="o",
        color=INK,
        markersize=4.5,
        linewidth=0.9,
        label="measured",
    )
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.1 * (high - low) * (1 + len(scores.codes)))
    ax.set_xlabel(by_label(scores))
    ax.set_ylabel(f"{quantity_title(quantity)} [{unit}]")
    small_legend(ax, loc="upper left", ncols=1 if len(scores.codes) < 4 else 2)
    return ax


def score_error_figure(scores: CodeScores, quantity: str, *, ax: Axes | None = None) -> Axes:
    """Computed less measured, point by point.

    Parameters
    ----------
    scores : CodeScores
    quantity : str
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    by = scores.measured.by
    factor, unit = shown_units(scores)[quantity]
    rows = scores.points[scores.points["quantity"] == quantity]
    ax.axhline(0.0, color=MUTED, linewidth=0.8)
    for number, (name, colour) in enumerate(code_colours(scores).items()):
        own = rows[rows["code"] == name]
        if not own.empty:
            marker = MARKERS[(number + 1) % len(MARKERS)]
            ax.plot(own[by], factor * own["S - D"], marker, color=colour, markersize=4.5, label=name)
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 0.1 * (high - low) * (1 + len(scores.codes)))
    ax.set_xlabel(by_label(scores))
    ax.set_ylabel(f"S − D, {quantity_title(quantity)} [{unit}]")
    small_legend(ax, loc="upper left", ncols=1 if len(scores.codes) < 4 else 2)
    return ax


def quality_figure(scores: CodeScores, *, ax: Axes | None = None) -> Axes:
    """Quality Q of each computation and quantity over all cases, in per cent; smaller is better.

    Parameters
    ----------
    scores : CodeScores
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((6.4, 3.2))
    totals = scores.totals
    quantities = [str(name) for name in dict.fromkeys(totals["quantity"])]
    bars = {
        code: 100.0 * own.set_index("quantity")["Q"].reindex(quantities).to_numpy(dtype=float)
        for code, own in totals.groupby("code", sort=False)
    }
    _bars(ax, scores, quantities, {str(code): values for code, values in bars.items()})
    ax.set_ylabel("quality Q [%]")
    return ax


def mean_error_figure(scores: CodeScores, unit: str, *, ax: Axes | None = None) -> Axes:
    """Mean error S - D of each computation with the standard deviation of its errors, for the quantities of one unit.

    Parameters
    ----------
    scores : CodeScores
    unit : str
        As it is shown: see :func:`shown_units`.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((6.4, 3.2))
    shown = shown_units(scores)
    used = dict.fromkeys(str(name) for name in scores.points["quantity"])
    quantities = [name for name in used if shown[name][1] == unit]
    factor = shown[quantities[0]][0]
    rows = scores.points[scores.points["quantity"].isin(quantities)]
    bars, spread = {}, {}
    for code, own in rows.groupby("code", sort=False):
        errors = own.groupby("quantity")["S - D"]
        bars[str(code)] = factor * errors.mean().reindex(quantities).to_numpy(dtype=float)
        spread[str(code)] = factor * errors.std().reindex(quantities).to_numpy(dtype=float)
    ax.axhline(0.0, color=MUTED, linewidth=0.8)
    _bars(ax, scores, quantities, bars, spread)
    ax.set_ylabel(f"mean of S − D [{unit}]")
    return ax


def _bars(
    ax: Axes,
    scores: CodeScores,
    quantities: Sequence[str],
    bars: Mapping[str, np.ndarray],
    spread: Mapping[str, np.ndarray] | None = None,
) -> None:
    """Bars of each computation side by side, one group a quantity, the key above them."""
    colours = code_colours(scores)
    width = 0.8 / len(colours)
    for number, (code, colour) in enumerate(colours.items()):
        if code not in bars:
            continue
        place = np.arange(len(quantities)) + (number - 0.5 * (len(colours) - 1)) * width
        ax.bar(place, bars[code], 0.92 * width, color=colour, label=code)
        if spread is not None:
            known = np.isfinite(spread[code])
            if known.any():
                ax.errorbar(
                    place[known],
                    bars[code][known],
                    yerr=spread[code][known],
                    fmt="none",
                    ecolor=INK,
                    elinewidth=0.9,
                    capsize=3,
                )
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + (0.1 + 0.07 * ((len(colours) + 2) // 3)) * (high - low))
    ax.set_xlim(-0.6, max(len(quantities), 3) - 0.4)
    ax.set_xticks(range(len(quantities)), [name.removeprefix("sinkage_") for name in quantities])
    ax.grid(False, axis="x")
    ax.set_xlabel("quantity")
    small_legend(ax, loc="upper left", ncols=min(len(colours), 3))
