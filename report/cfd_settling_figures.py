"""Figures of a settled run: history with its cut and running mean, and a periodic run cycle by cycle."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ..cfd.settled_loads import SettledCase
from ..identify.batch_means import running_mean
from .figure_style import BLUE, MUTED, VERMILLION, decimated, engineering_unit, new_axes, small_legend

POINTS = 600
# The vertical range is that of the settled part and as much above and below: an impulsive start would flatten it.
MARGIN = 1.0


def running_mean_figure(item: SettledCase, load: str, *, ax: Axes | None = None) -> Axes:
    """History of one load, the cut of its transient, and the running mean from there on.

    Parameters
    ----------
    item : SettledCase
    load : str
        ``X``, ``Y``, ``N``, ...
    ax : Axes, optional

    Returns
    -------
    Axes
        Grey: history, smallest and largest value of each stretch; vertical line: cut; blue: running mean; band: mean
        with its 95 % interval. A diverged run shows its history alone.
    """
    ax = ax if ax is not None else new_axes()
    channel, cut = item[load], item.settling.cut_time
    time, values = item.loads.time, item.loads.channels[load]
    factor, unit = engineering_unit("N" if load in "XYZ" else "N m", values[np.isfinite(values)])
    t, shown = decimated(time, factor * values, POINTS)
    ax.plot(t, shown, color=MUTED, linewidth=0.7)
    window = factor * values
    if math.isfinite(cut) and math.isfinite(channel.mean):
        kept = time >= cut
        window = window[kept]
        mean, half = factor * channel.mean, factor * channel.half_width()
        ax.axvline(cut, color=VERMILLION, linewidth=1.0, linestyle="--")
        ax.axhspan(mean - half, mean + half, color=BLUE, alpha=0.18, linewidth=0)
        ax.plot(*decimated(time[kept], factor * running_mean(values[kept]), POINTS), color=BLUE, linewidth=1.5)
    low, high = float(np.nanmin(window)), float(np.nanmax(window))
    margin = MARGIN * (high - low) or 1e-3 * max(abs(high), 1e-12)
    ax.set_ylim(low - margin, high + margin)
    ax.set_xlim(float(time[0]), float(time[-1]))
    ax.set_xlabel("time [s]" if item.loads.index_name == "time" else "iteration")
    ax.set_ylabel(f"{load} [{unit}]")
    return ax


def cycle_figure(item: SettledCase, load: str, *, ax: Axes | None = None) -> Axes:
    """Amplitudes of the harmonics of each cycle of a periodic load, those of dropped cycles hollow.

    Parameters
    ----------
    item : SettledCase
    load : str
        A load with cycles.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    cycles = item[load].cycles
    assert cycles is not None
    number = np.arange(1, cycles.cycles + 1)
    factor, unit = engineering_unit("N" if load in "XYZ" else "N m", cycles.amplitude)
    for k, colour in zip(range(min(cycles.amplitude.shape[1], 3)), (BLUE, VERMILLION, MUTED)):
        values = factor * cycles.amplitude[:, k]
        ax.plot(number, values, color=colour, linewidth=0.9)
        kept = number > cycles.drop
        ax.plot(number[kept], values[kept], "o", color=colour, markersize=4, label=f"harmonic {k + 1}")
        ax.plot(number[~kept], values[~kept], "o", color=colour, markersize=4, markerfacecolor="none")
    ax.set_xlabel("cycle")
    ax.set_ylabel(f"amplitude of {load} [{unit}]")
    ax.set_ylim(bottom=0.0)
    small_legend(ax)
    return ax
