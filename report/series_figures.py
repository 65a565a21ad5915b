"""Time series of a run: measured force and the force that the derivatives give for its motion."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..core.errors import FitError
from ..pmm.hull_fit import HullFit
from ..pmm.reduced_run import ReducedRun
from .figure_style import MUTED, VERMILLION, decimated, engineering_unit, new_axes

POINTS = 800
CYCLES = 4
"""Cycles of an oscillating run that are drawn."""


def time_series(fit: HullFit, run: ReducedRun, component: str, *, ax: Axes | None = None) -> Axes:
    """Measured series of one force over the window, and its reconstruction from the derivatives.

    Parameters
    ----------
    fit : HullFit
    run : ReducedRun
        A run whose series was kept.
    component : {"X", "Y", "N", "K"}
    ax : Axes, optional

    Returns
    -------
    Axes
        Grey: measured, smallest and largest value of each stretch of at most 800 points; coloured: fitted.

    Raises
    ------
    FitError
        When the series of the run was not kept.
    """
    if component not in run.series:
        raise FitError(
            f"run '{run.name}' keeps no series of {component}",
            cure="raise output.series_in_report in the campaign file",
        )
    ax = ax if ax is not None else new_axes()
    times, measured = run.window.times, run.series[component]
    if run.order:
        shown = times <= times[0] + CYCLES * run.run.period * (1 + 1e-9)
        times, measured = times[shown], measured[shown]
    smooth = np.linspace(times[0], times[-1], 240) if run.order else times[[0, -1]]
    fitted = np.broadcast_to(fit.reconstructed(run, smooth)[component], smooth.shape)
    factor, unit = engineering_unit("N" if component in "XY" else "N m", measured, fitted)
    t, values = decimated(times, measured, POINTS)
    ax.plot(t, factor * values, color=MUTED, linewidth=0.7)
    ax.plot(smooth, factor * fitted, color=VERMILLION, linewidth=1.4)
    ax.set_xlim(float(times[0]), float(times[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(f"{component} [{unit}]")
    return ax
