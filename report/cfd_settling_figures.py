"""Figures of a settled run: history with its cut and running mean, and a periodic run cycle by cycle."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ..cfd.settled_loads import SettledCase
from ..identify.batch_means import running_mean
from ..identify.cycle_convergence import phase_average
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
    factor, unit = _scaled(item.loads.unit(load), values[np.isfinite(values)])
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
    ax.set_ylabel(f"{load} [{unit}]" if unit else load)
    return ax


def phase_figure(item: SettledCase, load: str, *, ax: Axes | None = None) -> Axes:
    """Mean cycle of a periodic load over its kept cycles, with twice the deviation between them.

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
    drop = min(
        max(own.drop for own in (item[name].cycles for name in item.fitted) if own is not None), cycles.cycles - 1
    )
    found = phase_average(item.loads.time, item.loads.channels[load], cycles.omega, drop=drop)
    factor, unit = _scaled(item.loads.unit(load), found.mean)
    # The cycle is closed: 360 deg is 0 deg again.
    degrees = np.append(np.degrees(found.phase), 360.0)
    mean = factor * np.append(found.mean, found.mean[0])
    spread = 2.0 * factor * np.nan_to_num(np.append(found.sd, found.sd[0]))
    ax.fill_between(degrees, mean - spread, mean + spread, color=BLUE, alpha=0.18, linewidth=0)
    ax.plot(degrees, mean, color=BLUE, linewidth=1.5)
    ax.set_xlim(0.0, 360.0)
    ax.set_xticks([0, 90, 180, 270, 360])
    ax.set_xlabel(f"phase ωt [deg], {found.cycles} cycles")
    ax.set_ylabel(f"{load} [{unit}]" if unit else load)
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
    factor, unit = _scaled(item.loads.unit(load), cycles.amplitude)
    for k, colour in zip(range(min(cycles.amplitude.shape[1], 3)), (BLUE, VERMILLION, MUTED)):
        values = factor * cycles.amplitude[:, k]
        ax.plot(number, values, color=colour, linewidth=0.9)
        kept = number > cycles.drop
        ax.plot(number[kept], values[kept], "o", color=colour, markersize=4, label=f"harmonic {k + 1}")
        ax.plot(number[~kept], values[~kept], "o", color=colour, markersize=4, markerfacecolor="none")
    ax.set_xlabel("cycle")
    ax.set_ylabel(f"amplitude of {load} [{unit}]" if unit else f"amplitude of {load}")
    ax.set_ylim(bottom=0.0)
    small_legend(ax)
    return ax


def _scaled(unit: str, values: np.ndarray) -> tuple[float, str]:
    """Factor and unit of an axis; only forces and moments take a prefix."""
    return engineering_unit(unit, values) if unit in ("N", "N m") else (1.0, unit)
