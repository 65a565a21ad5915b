"""Figures of a derivative set: intervals of all derivatives, and their correlation."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from ..core.derivative_set import DerivativeSet
from ..core.errors import TermError
from .figure_style import COMPONENT_COLOURS, INK, MUTED, ORANGE, PURPLE, new_axes, small_legend

if TYPE_CHECKING:
    import pandas as pd

NARROWEST, WIDEST = 5.0, 120.0
"""Per cent of the value that the figure shows at least and at most; longer intervals end in arrows."""


def derivative_forest(
    derivatives: DerivativeSet, ways: pd.DataFrame | None = None, *, ax: Axes | None = None
) -> Axes:
    """95 % interval of each derivative in per cent of its value.

    Parameters
    ----------
    derivatives : DerivativeSet
    ways : DataFrame, optional
        Table of :func:`towtank.pmm.three_ways.three_ways`: single-run and multiple-run estimates are drawn beside
        the interval of the fit.
    ax : Axes, optional

    Returns
    -------
    Axes
        One row a derivative, first at the top. An interval that holds zero reaches beyond 100 %.
    """
    count = len(derivatives)
    ax = ax if ax is not None else new_axes((6.4, 0.9 + 0.23 * count), margins=(0.8, 0.15, 0.5, 0.35))
    with np.errstate(divide="ignore", invalid="ignore"):
        size = np.abs(derivatives.values)
        interval = derivatives.conf_int()
        low = 100 * (interval["lower"].to_numpy() - derivatives.values) / size
        high = 100 * (interval["upper"].to_numpy() - derivatives.values) / size
    reach = _reach(np.concatenate([-low, high]))
    ax.set_xlim(-1.04 * reach, 1.04 * reach)
    ax.axvline(0.0, color=MUTED, linewidth=0.8)
    for row, term in enumerate(derivatives.terms):
        colour = COMPONENT_COLOURS[term.component]
        if np.isfinite(low[row]):
            ax.plot([max(low[row], -reach), min(high[row], reach)], [row, row], color=colour, linewidth=2.2)
            if high[row] > reach:
                ax.plot([-reach], [row], "<", [reach], [row], ">", color=colour, markersize=5)
        ax.plot([0.0], [row], "o", color=colour, markersize=5)
    if ways is not None:
        _draw_ways(ax, derivatives, ways, reach)
    ax.set_yticks(np.arange(count), list(derivatives.names))
    ax.set_ylim(count - 0.4, -0.6)
    ax.set_xlabel("95 % interval about the value [% of the value]")
    ax.grid(False, axis="y")
    small_legend(ax, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2, borderpad=0)
    return ax


def _reach(halves: np.ndarray) -> float:
    """Half width of the figure: room for the intervals of most derivatives."""
    finite = halves[np.isfinite(halves)]
    if not finite.size:
        return WIDEST
    return float(np.clip(4.0 * np.median(finite), NARROWEST, WIDEST))


_WAYS = (("single", "mean of single runs", "x", PURPLE), ("multiple", "multiple-run curves", "D", ORANGE))


def _draw_ways(ax: Axes, derivatives: DerivativeSet, ways: pd.DataFrame, reach: float) -> None:
    """Estimates of the other ways that lie within the figure."""
    for way, label, marker, colour in _WAYS:
        percent = dict(zip(ways["name"], ways[f"{way}_minus_fit_percent"], strict=True))
        offsets = np.array([percent.get(name, np.nan) for name in derivatives.names], dtype=float)
        inside = np.flatnonzero(np.abs(offsets) <= reach)
        ax.plot(
            offsets[inside],
            inside,
            marker,
            color=colour,
            markersize=4.5,
            markeredgecolor=INK if marker == "D" else colour,
            markeredgewidth=0.5 if marker == "D" else 1.4,
            linestyle="none",
            label=label,
        )


def correlation_map(derivatives: DerivativeSet, *, ax: Axes | None = None) -> Axes:
    """Correlation between the derivatives as a map, blue negative and orange positive.

    Parameters
    ----------
    derivatives : DerivativeSet
        With covariance.
    ax : Axes, optional

    Raises
    ------
    TermError
        When the set has no covariance.
    """
    if derivatives.covariance is None:
        raise TermError(f"set '{derivatives.name}' has no covariance", cure="fit it, or give one in its file")
    count = len(derivatives)
    if ax is None:
        side = min(max(1.4 + 0.24 * count, 4.6), 7.0)
        ax = new_axes((side + 0.2, side), margins=(0.75, 0.2, 0.75, 0.1))
    sd = np.sqrt(np.clip(np.diag(derivatives.covariance), 0.0, None))
    safe = np.where(sd > 0, sd, np.inf)
    correlation = derivatives.covariance / np.outer(safe, safe)
    ax.imshow(correlation, cmap="PuOr_r", vmin=-1.0, vmax=1.0, interpolation="nearest", aspect="equal")
    for i, j in zip(*np.nonzero(np.triu(np.abs(correlation) > 0.9, 1)), strict=True):
        for x, y in ((i, j), (j, i)):
            ax.text(x, y, f"{100 * correlation[i, j]:.0f}", ha="center", va="center", fontsize=5.5, color="white")
    size = 8 if count <= 24 else 6
    ax.set_xticks(range(count), list(derivatives.names), rotation=90, fontsize=size)
    ax.set_yticks(range(count), list(derivatives.names), fontsize=size)
    ax.grid(False)
    return ax
