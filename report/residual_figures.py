"""Residuals of a fit run by run, and measured against fitted values."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from ..pmm.component_fit import ComponentFit
from ..pmm.hull_fit import OUTLYING, HullFit
from .figure_style import (
    BLUE,
    COMPONENT_COLOURS,
    CYCLE,
    INK,
    MARKERS,
    MUTED,
    new_axes,
    small_legend,
    spread_evenly,
)
from .force_curves import interval_factor
from .force_figures import FORCE_NAMES, finite

MOST_ROWS = 300
"""Data that the figure of measured against fitted values shows."""

_BANDS = (("mean", 0, 0), ("1st harmonic", 1, 2), ("2nd", 3, 4), ("higher", 5, 10_000))

"""Standardised residual from which a run is named in the figure."""


def standardised_residuals(result: ComponentFit) -> np.ndarray:
    """Residuals over the standard deviation of their rows, shape (n,); 0 where that is unknown."""
    sd = result.row_sd
    known = np.isfinite(sd) & (sd > 0)
    return np.divide(result.residual, sd, out=np.zeros(len(sd)), where=known)


def _by_band(harmonic: np.ndarray) -> list[tuple[str, np.ndarray]]:
    """Rows of the mean, the first, the second and the higher harmonics, as masks; those that are there."""
    masks = [(name, (harmonic >= low) & (harmonic <= high)) for name, low, high in _BANDS]
    return [(name, mask) for name, mask in masks if mask.any()]


def residuals_by_run(fit: HullFit, component: str, *, ax: Axes | None = None) -> Axes:
    """Standardised residuals of one component over the number of the run.

    Parameters
    ----------
    fit : HullFit
    component : {"X", "Y", "N", "K"}
    ax : Axes, optional

    Returns
    -------
    Axes
        Band of plus and minus 2 standard deviations; runs beyond 4 carry their names.
    """
    ax = ax if ax is not None else new_axes()
    result = fit.components[component]
    rows, size = result.rows, standardised_residuals(result)
    ax.axhspan(-2, 2, color=BLUE, alpha=0.08, linewidth=0)
    ax.axhline(0.0, color=MUTED, linewidth=0.8)
    several = len(np.unique(rows.harmonic)) > 1
    for number, (name, chosen) in enumerate(_by_band(rows.harmonic)):
        ax.plot(
            rows.run[chosen] + 1,
            size[chosen],
            MARKERS[number],
            color=CYCLE[number] if several else INK,
            markersize=3.5,
            alpha=0.85,
            label=name if several else None,
        )
    for index in np.unique(rows.run[np.abs(size) > OUTLYING])[:4].tolist():
        own = np.flatnonzero(rows.run == index)
        worst = own[np.argmax(np.abs(size[own]))]
        text = fit.runs[index].name
        side = "right" if index > len(fit.runs) / 2 else "left"
        ax.annotate(
            text if len(text) < 24 else text[:22] + "…",
            (index + 1, size[worst]),
            xytext=(-5 if side == "right" else 5, 0),
            textcoords="offset points",
            ha=side,
            va="center",
            fontsize=7,
            color=INK,
        )
    limit = max(3.0, 1.12 * float(np.abs(size).max(initial=0.0)))
    ax.set_ylim(-limit, limit)
    ax.set_xlim(0, len(fit.runs) + 1)
    ax.xaxis.set_major_locator(MaxNLocator(5, integer=True))
    ax.set_xlabel("number of the run")
    ax.set_ylabel(f"residual of {component} [standard deviations]")
    if several:
        small_legend(
            ax,
            loc="lower center",
            bbox_to_anchor=(0.47, 0.98),
            ncols=4,
            columnspacing=0.8,
            handlelength=0.8,
            handletextpad=0.3,
            borderpad=0,
        )
    return ax


def measured_against_fitted(fit: HullFit, component: str, *, ax: Axes | None = None) -> Axes:
    """Measured means and harmonics of one component against the fitted ones, with the line of equality.

    Of more than `MOST_ROWS` rows that many are shown, spread evenly over the runs.

    Parameters
    ----------
    fit : HullFit
    component : {"X", "Y", "N", "K"}
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    result = fit.components[component]
    rows = result.rows
    fitted = rows.design @ result.params
    both = np.concatenate([fitted, rows.response])
    ends = np.array([both.min(), both.max()])
    ax.plot(ends, ends, color=MUTED, linewidth=0.9)
    shown = spread_evenly(len(fitted), MOST_ROWS)
    half = interval_factor(np.inf) * finite(result.row_sd)
    ax.errorbar(
        fitted[shown],
        rows.response[shown],
        yerr=half[shown],
        fmt="o",
        color=COMPONENT_COLOURS[component],
        markersize=3.5,
        elinewidth=0.8,
    )
    ax.set_xlabel(f"fitted {FORCE_NAMES[component]} [-]")
    ax.set_ylabel(f"measured {component}′ [-]")
    return ax
