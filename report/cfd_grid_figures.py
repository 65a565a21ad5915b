"""Convergence plots of derivatives that were found on several grids."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes

from ..cfd.grid_study import GridStudy
from .figure_style import BLUE, GREEN, MUTED, VERMILLION, new_axes


def derivative_convergence_figure(study: GridStudy, name: str, *, ax: Axes | None = None) -> Axes:
    """One derivative against the grid spacing.

    Parameters
    ----------
    study : GridStudy
    name : str
        A derivative of the study.
    ax : Axes, optional

    Returns
    -------
    Axes
        Points: value on each grid, bars: twice the standard error of its fit; wide grey bar: numerical uncertainty
        of the finest grid; curve and cross: error ``c h^p`` with the observed order, and its limit; green line: truth
        of a virtual sweep; orange-red square: measured value with its 95 %.
    """
    ax = ax if ax is not None else new_axes()
    row = next(row for row in study.uncertainty.table.to_dict("records") if row["name"] == name)
    h = study.spacings
    values = np.array([one[name] for one in study.sets])
    errors = np.array([2.0 * one.bse[name] for one in study.sets], dtype=float)
    ax.errorbar(h[:1], values[:1], yerr=row["U_num"], color=MUTED, elinewidth=5.0, alpha=0.4, fmt="none")
    ax.errorbar(h, values, yerr=errors, fmt="o", color=BLUE, markersize=4.5, elinewidth=1.1, capsize=2)
    limit, order = float(row["extrapolated"]), float(row["order"])
    if math.isfinite(limit) and math.isfinite(order) and order > 0.0:
        fine = np.linspace(0.0, float(h.max()), 80)
        ax.plot(fine, limit + (values[0] - limit) * (fine / h[0]) ** order, color=BLUE, linewidth=1.0)
        ax.plot([0.0], [limit], "x", color=BLUE, markersize=6)
    if study.truth is not None:
        known = study.truth.to(study.derivatives.conventions)
        if name in known:
            ax.axhline(known[name], color=GREEN, linewidth=1.2, linestyle="--")
    if study.reference is not None:
        measured = study.reference.to(study.derivatives.conventions)
        if name in measured:
            half = float(np.nan_to_num(2.0 * measured.bse[name]))
            ax.errorbar(
                [-0.12], [measured[name]], yerr=[half], fmt="s", color=VERMILLION, markersize=4, elinewidth=1.1
            )
    ax.set_xlim(-0.25, 1.08 * float(h.max()))
    ax.set_xlabel("relative grid spacing h")
    ax.set_ylabel(name)
    return ax
