"""Figures of propagated uncertainty: distribution of an output, shares of variance."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .figure_style import BLUE, CYCLE, INK, MUTED, SKY, VERMILLION, new_axes, small_legend

if TYPE_CHECKING:
    from ..verify.propagation import Propagation

BINS = 60


def distribution_figure(
    propagation: Propagation, output: str, *, measured: float | None = None, ax: Axes | None = None
) -> Axes:
    """Distribution of an output from the fitted polynomial, with the runs and, where known, the measurement.

    Parameters
    ----------
    propagation : Propagation
    output : str
        Name of the output.
    measured : float, optional
    ax : Axes, optional
        Axes of a new figure when not given.

    Returns
    -------
    Axes
        Area: density; ticks at its foot: the runs; lines: mean of polynomial chaos with one standard deviation to
        both sides, mean of the runs, measurement.
    """
    ax = new_axes((4.7, 2.7)) if ax is None else ax
    fit = propagation.expansion
    j = fit.outputs.index(output)
    mean, sd, plain = float(fit.mean[j]), float(fit.sd[j]), propagation.plain[j]
    if sd > 0.0:
        density, edges = np.histogram(propagation.draws[:, j], bins=BINS, density=True)
        ax.stairs(density, edges, fill=True, color=SKY, alpha=0.45, label="polynomial chaos")
        ax.axvspan(mean - sd, mean + sd, color=BLUE, alpha=0.10, linewidth=0.0)
    ax.axvline(mean, color=BLUE, linewidth=1.4, label="its mean ± sd")
    ax.axvline(plain.mean, color=INK, linewidth=1.1, linestyle="--", label="mean of the runs")
    if measured is not None:
        ax.axvline(measured, color=VERMILLION, linewidth=1.4, linestyle="-.", label="measured")
    runs = propagation.values[output].to_numpy(float)
    ax.plot(runs, np.zeros(len(runs)), "|", color=INK, markersize=9, clip_on=False, label="runs")
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel(output)
    ax.set_ylabel("density")
    small_legend(ax, loc="best")
    return ax


def sobol_figure(propagation: Propagation, *, ax: Axes | None = None) -> Axes:
    """Share of the variance of each output that each input causes alone, and what they cause together.

    Parameters
    ----------
    propagation : Propagation
    ax : Axes, optional
        Axes of a new figure when not given.

    Returns
    -------
    Axes
        One bar an output; the rest up to 1 is interaction of inputs.
    """
    outputs = propagation.expansion.outputs
    ax = new_axes((6.0, 1.1 + 0.3 * len(outputs)), margins=(1.2, 0.2, 0.5, 0.4)) if ax is None else ax
    rows, left = np.arange(len(outputs)), np.zeros(len(outputs))
    table = propagation.sobol
    for place, one in enumerate(propagation.inputs):
        share = table.loc[table["input"] == one.name, "first"].to_numpy(float)
        share = np.nan_to_num(share)
        ax.barh(rows, share, left=left, height=0.62, color=CYCLE[place % len(CYCLE)], label=one.name)
        left = left + share
    rest = np.where(left > 0.0, 1.0 - left, 0.0)
    if (rest > 1e-6).any():
        ax.barh(rows, rest, left=left, height=0.62, color=MUTED, alpha=0.5, label="together")
    ax.set_xlim(0.0, 1.0)
    ax.set_yticks(rows, list(outputs))
    ax.set_ylim(len(outputs) - 0.4, -0.6)
    ax.grid(False, axis="y")
    ax.set_xlabel("share of the variance")
    small_legend(ax, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderpad=0)
    return ax
