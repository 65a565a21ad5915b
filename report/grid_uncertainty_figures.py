"""Convergence plots: values against cell size with the fitted law, the extrapolated value and the uncertainty."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ..verify.curve_uncertainty import CurveUncertainty
from ..verify.eca_hoekstra import LOWEST_ORDER
from ..verify.numerical_uncertainty import DEFAULT, NumericalUncertainty
from ..verify.triplet_uncertainty import UncertaintyEstimate
from .figure_style import BLUE, CYCLE, INK, MUTED, SKY, VERMILLION, new_axes, small_legend

if TYPE_CHECKING:
    from matplotlib.axes import Axes

CONVERGENCE = (4.3, 3.0)


def convergence_figure(
    result: NumericalUncertainty,
    *,
    method: str = DEFAULT,
    spacing_name: str = "relative cell size h / h₁",
    ax: Axes | None = None,
) -> Axes:
    """Values of one quantity over cell size or time step.

    The law is that of the least squares through four grids or more, else the power law through the three finest; an
    oscillating or diverging triplet has none, and its values are joined by a dotted line. Below an order of 0.5 it is
    the law with the limited order that counts. The bar at the finest grid is the uncertainty.

    Parameters
    ----------
    result : NumericalUncertainty
    method : str
        Whose uncertainty and extrapolated value are drawn.
    spacing_name : str
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes(CONVERGENCE, margins=(0.82, 0.12, 0.46, 0.12))
    chosen = result.by(method)
    h = np.linspace(0.0, float(result.spacings[-1]) * 1.03, 200)
    law = _law(result, chosen, h)
    if law is None:
        ax.plot(result.spacings, result.values, color=MUTED, linewidth=0.9, linestyle=":")
    else:
        curve, label = law
        ax.plot(h, curve, color=BLUE, linewidth=1.3, label=label)
    if math.isfinite(chosen.uncertainty):
        low, high = result.fine - chosen.uncertainty, result.fine + chosen.uncertainty
        ax.axhspan(low, high, color=SKY, alpha=0.22, linewidth=0.0)
        ax.errorbar(
            [1.0],
            [result.fine],
            yerr=[chosen.uncertainty],
            color=INK,
            linewidth=1.0,
            capsize=3.0,
            label=f"U, {chosen.method}",
        )
    if math.isfinite(chosen.extrapolated):
        ax.plot(
            [0.0],
            [chosen.extrapolated],
            "D",
            color=VERMILLION,
            markersize=5.0,
            label="extrapolated",
            clip_on=False,
        )
    ax.plot(result.spacings, result.values, "o", color=INK, markersize=4.5, label="computed")
    ax.set_xlim(0.0, float(h[-1]))
    low, high = ax.get_ylim()
    # room for the legend above the points
    ax.set_ylim(low, high + 0.30 * (high - low))
    ax.set_xlabel(spacing_name)
    ax.set_ylabel(f"{result.quantity}{f' [{result.unit}]' if result.unit else ''}")
    small_legend(ax, loc="upper left", ncols=2)
    return ax


def _law(
    result: NumericalUncertainty, chosen: UncertaintyEstimate, h: np.ndarray
) -> tuple[np.ndarray, str] | None:
    if result.least_squares is not None:
        fit = result.least_squares.fit
        name = f"h^{fit.order:.2f}" if fit.form == "h^p" else fit.form
        return fit.at(h), f"fit, {name}"
    triplet = result.triplet
    if triplet is None or triplet.behaviour != "monotone convergent":
        return None
    limit, order = triplet.extrapolated, triplet.order
    if order < LOWEST_ORDER and chosen.order >= LOWEST_ORDER:
        # the limit of the observed order lies far off the plot
        limit, order = chosen.extrapolated, chosen.order
    return limit + (result.fine - limit) * h**order, f"h^{order:.2f}"


def curve_uncertainty_figure(result: CurveUncertainty, *, name: str = "", ax: Axes | None = None) -> Axes:
    """A curve on all grids, with the uncertainty of the finest.

    Parameters
    ----------
    result : CurveUncertainty
    name : str
        Of the points.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((6.4, 3.4), margins=(0.82, 0.12, 0.46, 0.12))
    values = np.array([one.values for one in result.local])
    size = result.uncertainty
    ax.fill_between(
        result.points,
        values[:, 0] - size,
        values[:, 0] + size,
        color=SKY,
        alpha=0.3,
        linewidth=0.0,
        label="U (95 %)",
    )
    for grid in reversed(range(values.shape[1])):
        ax.plot(
            result.points,
            values[:, grid],
            marker="o",
            markersize=3.0,
            linewidth=1.4 if grid == 0 else 0.9,
            color=CYCLE[grid % 6],
            label="finest grid" if grid == 0 else f"h / h₁ = {result.local[0].spacings[grid]:.3g}",
        )
    first = result.local[0]
    ax.set_xlabel(name or "point")
    ax.set_ylabel(f"{first.quantity.rpartition(' at ')[0]}{f' [{first.unit}]' if first.unit else ''}")
    small_legend(ax, loc="best", ncols=2)
    return ax
