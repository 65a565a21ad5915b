"""Figures of a validation: the comparison error with the validation uncertainty."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from .figure_style import BLUE, MUTED, VERMILLION, new_axes, small_legend

if TYPE_CHECKING:
    import pandas as pd

WIDEST = 150.0
"""Per cent of D beyond which an error is cut and printed."""

_MARKS = {
    "validated": (BLUE, "o", "validated"),
    "not validated": (VERMILLION, "s", "not validated"),
    "not judged": (MUTED, "D", "not judged: an uncertainty is unknown"),
}


def validation_figure(validation: pd.DataFrame, *, ax: Axes | None = None) -> Axes:
    """Comparison error of each quantity in per cent of D, with bars of the validation uncertainty.

    Parameters
    ----------
    validation : DataFrame
        From :func:`~towtank.verify.validate_table` or :func:`~towtank.verify.validate_derivatives`.
    ax : Axes, optional
        Axes of a new figure when not given.

    Returns
    -------
    Axes
        Points: E = S - D in per cent of |D|, to the right where S is larger. Bars: E plus and minus U_V, in which the
        modelling error lies. A bar that reaches the line at zero is validated. Quantities with D = 0 are left out.
    """
    table = validation[validation["D"] != 0.0].reset_index(drop=True)
    count = len(table)
    if ax is None:
        ax = new_axes((6.4, 1.15 + 0.25 * max(count, 3)), margins=(_label_width(table), 0.2, 0.5, 0.4))
    size = np.abs(table["D"].to_numpy(float))
    percent = 100.0 * table["S-D"].to_numpy(float) / size
    half = 100.0 * np.nan_to_num(table["U_V"].to_numpy(float)) / size
    verdicts = table["verdict"].to_numpy()
    shown = np.clip(percent, -WIDEST, WIDEST)
    rows = np.arange(count)
    ax.axvline(0.0, color=MUTED, linewidth=0.9)
    for verdict, (colour, marker, label) in _MARKS.items():
        chosen = verdicts == verdict
        if chosen.any():
            ax.errorbar(
                shown[chosen],
                rows[chosen],
                xerr=half[chosen],
                fmt=marker,
                color=colour,
                markersize=5,
                elinewidth=1.6,
                capsize=3,
                label=label,
            )
    for row in np.flatnonzero(np.abs(percent) > WIDEST):
        side = float(np.sign(percent[row]))
        ax.annotate(
            f"{percent[row]:+.0f} %",
            (side * WIDEST, row),
            xytext=(-8 * side, 0),
            textcoords="offset points",
            ha="right" if side > 0 else "left",
            va="center",
            fontsize=7,
            color=_MARKS[str(verdicts[row])][0],
        )
    extent = np.abs(shown) + half
    reach = 1.08 * float(np.clip(extent.max(initial=0.0), 1.0, WIDEST))
    ax.set_xlim(-reach, reach)
    ax.set_yticks(rows, [str(name) for name in table["quantity"]])
    ax.set_ylim(max(count, 1) - 0.4, -0.6)
    ax.grid(False, axis="y")
    ax.set_xlabel("E = S − D ± U_V [% of |D|]")
    small_legend(ax, loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3, borderpad=0)
    return ax


def _label_width(table: pd.DataFrame) -> float:
    """Inch that the longest name needs beside the axes."""
    longest = max((len(str(name)) for name in table["quantity"]), default=0)
    return min(0.35 + 0.07 * longest, 2.6)
