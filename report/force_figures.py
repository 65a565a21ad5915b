"""Forces of a fit against drift angle, yaw rate or amplitude: points with error bars, curve with its 95 % band."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..pmm.hull_fit import HullFit
from .figure_style import CYCLE, INK, MARKERS, new_axes, small_legend, spread_evenly
from .force_curves import Sweep, curve_along, harmonic_name, interval_factor, motion_amplitude

MOST_RUNS = 40
"""Runs of one kind that a figure of harmonics shows."""

FORCE_NAMES = {"X": "surge force X′", "Y": "sway force Y′", "N": "yaw moment N′", "K": "roll moment K′"}


def force_fit(fit: HullFit, sweep: Sweep, component: str, *, legend: bool = True, ax: Axes | None = None) -> Axes:
    """Steady forces against one variable.

    Parameters
    ----------
    fit : HullFit
    sweep : Sweep
        One of :func:`~towtank.report.force_curves.sweeps`.
    component : {"X", "Y", "N", "K"}
    legend : bool
        Name the curves inside the axes.
    ax : Axes, optional
        Axes of a new figure when not given.

    Returns
    -------
    Axes
        Points with bars of 95 % (noise within the run and scatter between runs), curve with its 95 % band.
    """
    ax = ax if ax is not None else new_axes()
    spread = row_spread(fit, component)
    for number, curve in enumerate(sweep.curves):
        colour, marker = curve_colour(number), MARKERS[number % len(MARKERS)]
        x, value, half = curve_along(fit, curve, sweep.variable, component)
        shown = sweep.shown(x)
        ax.fill_between(shown, value - half, value + half, color=colour, alpha=0.18, linewidth=0)
        ax.plot(shown, value, color=colour, linewidth=1.4, label=curve.label or None)
        runs = [index for index in curve.runs if component in fit.runs[index].scaled]
        measured = np.array([fit.runs[index].scaled[component][0] for index in runs])
        bars = np.array([spread.get((index, 0), 0.0) for index in runs])
        ink = INK if len(sweep.curves) == 1 else colour
        ax.errorbar(
            sweep.shown(curve.x[[curve.runs.index(index) for index in runs]]),
            measured,
            yerr=bars,
            fmt=marker,
            color=ink,
            markersize=4,
            elinewidth=0.9,
        )
    ax.set_xlabel(sweep.label)
    ax.set_ylabel(f"{FORCE_NAMES[component]} [-]")
    if legend:
        small_legend(ax, loc="best")
    return ax


def curve_colour(number: int) -> str:
    """Colour of a curve of a sweep."""
    return CYCLE[number % len(CYCLE)]


def amplitude_fit(fit: HullFit, kind: str, component: str, *, most: int = 3, ax: Axes | None = None) -> Axes:
    """Harmonics of the runs of one kind against the amplitude of their motion, measured and fitted.

    Parameters
    ----------
    fit : HullFit
    kind : str
        Run type, e.g. ``pure_sway``.
    component : {"X", "Y", "N", "K"}
    most : int
        Number of harmonics shown: the largest ones.
    ax : Axes, optional

    Returns
    -------
    Axes
        Filled markers with bars of 95 % are measured; open ones, joined, are fitted. Of more than `MOST_RUNS` runs
        that many are shown.
    """
    ax = ax if ax is not None else new_axes()
    result = fit.components[component]
    rows = result.rows
    chosen = np.array([fit.runs[index].run.kind == kind for index in rows.run.tolist()], dtype=bool)
    sizes = {
        int(h): float(np.abs(rows.response[chosen & (rows.harmonic == h)]).max())
        for h in np.unique(rows.harmonic[chosen])
    }
    fitted = rows.design @ result.params
    factor = interval_factor(np.inf)
    label = ""
    known: dict[int, tuple[float, str]] = {}
    for number, harmonic in enumerate(sorted(sorted(sizes, key=lambda h: -sizes[h])[:most])):
        colour, marker = CYCLE[number], MARKERS[number]
        where = np.flatnonzero(chosen & (rows.harmonic == harmonic))
        where = where[spread_evenly(len(where), MOST_RUNS)]
        amplitudes = []
        for index in rows.run[where].tolist():
            if index not in known:
                known[index] = motion_amplitude(fit.runs[index])
            amplitude, label = known[index]
            amplitudes.append(amplitude)
        x = np.array(amplitudes)
        order = np.argsort(x, kind="stable")
        x, where = x[order], where[order]
        ax.errorbar(
            x,
            rows.response[where],
            yerr=factor * finite(result.row_sd[where]),
            fmt=marker,
            color=colour,
            markersize=4,
            elinewidth=0.9,
            label=harmonic_name(harmonic),
        )
        ax.plot(x, fitted[where], color=colour, linewidth=1.0, marker=marker, markersize=7, fillstyle="none")
    ax.set_xlabel(label)
    ax.set_ylabel(f"{FORCE_NAMES[component]} [-]")
    small_legend(ax, loc="best")
    return ax


def row_spread(fit: HullFit, component: str) -> dict[tuple[int, int], float]:
    """Half width of 95 % of each datum: (run, harmonic) -> scaled force."""
    result = fit.components[component]
    half = interval_factor(np.inf) * finite(result.row_sd)
    return dict(
        zip(zip(result.rows.run.tolist(), result.rows.harmonic.tolist(), strict=True), half.tolist(), strict=True)
    )


def finite(values: np.ndarray) -> np.ndarray:
    """The values with 0 for what is not a number."""
    return np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0)
