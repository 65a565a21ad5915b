"""Two derivative sets in one figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .comparison import DISAGREEMENT
from .figure_style import BLUE, MUTED, VERMILLION, new_axes, small_legend

if TYPE_CHECKING:
    import pandas as pd

WIDEST = 150.0
"""Per cent of A beyond which a difference is cut, with an arrow."""


def comparison_figure(comparison: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Difference of B from A for each common derivative, in per cent of A.

    Parameters
    ----------
    comparison : DataFrame
        From :func:`~towtank.report.comparison.compare_sets`.
    ax : Axes, optional
        Axes of a new figure when not given.

    Returns
    -------
    Axes
        Grey bars: 95 % of A; coloured points: B with its 95 %, to the right where its magnitude is larger;
        orange-red where the two differ by more than three combined standard uncertainties.
    """
    table = comparison[comparison["name"].isin(comparison.attrs["common"])]
    table = table[table["A"] != 0.0].reset_index(drop=True)
    count = len(table)
    ax = ax if ax is not None else new_axes((6.4, 1.0 + 0.23 * count), margins=(0.8, 0.15, 0.5, 0.35))
    a, b = table["A"].to_numpy(float), table["B"].to_numpy(float)
    size = np.abs(a)
    percent = 100.0 * (b - a) / a
    half_a = 196.0 * np.nan_to_num(table["A_std"].to_numpy(float)) / size
    half_b = 196.0 * np.nan_to_num(table["B_std"].to_numpy(float)) / size
    differ = np.abs(np.nan_to_num(table["z"].to_numpy(float))) > DISAGREEMENT
    rows = np.arange(count)
    ax.axvline(0.0, color=MUTED, linewidth=0.9)
    ax.barh(rows, 2 * half_a, left=-half_a, height=0.62, color=MUTED, alpha=0.25, label="95 % of A")
    for colour, chosen, label in (
        (BLUE, ~differ, "B with 95 %"),
        (VERMILLION, differ, "B, beyond 3 standard uncertainties"),
    ):
        if chosen.any():
            at = np.clip(percent[chosen], -WIDEST, WIDEST)
            ax.errorbar(
                at,
                rows[chosen],
                xerr=half_b[chosen],
                fmt="o",
                color=colour,
                markersize=5,
                elinewidth=1.6,
                label=label,
            )
    for row in np.flatnonzero(np.abs(percent) > WIDEST):
        side = np.sign(percent[row])
        ax.annotate(
            f"{percent[row]:+.0f} %",
            (side * WIDEST, row),
            xytext=(-8 * side, 0),
            textcoords="offset points",
            ha="right" if side > 0 else "left",
            va="center",
            fontsize=7,
            color=VERMILLION if differ[row] else BLUE,
        )
    extent = np.concatenate([np.abs(percent) + half_b, half_a])
    reach = float(np.clip(extent.max(initial=0.0), 5.0, WIDEST))
    ax.set_xlim(-1.08 * reach, 1.08 * reach)
    ax.set_yticks(rows, [str(name) for name in table["name"]])
    ax.set_ylim(count - 0.4, -0.6)
    ax.grid(False, axis="y")
    ax.set_xlabel("(B - A)/A [%]")
    small_legend(ax, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderpad=0)
    return ax
