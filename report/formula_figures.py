"""Figures of the squat formulas: all of one place over speed, those outside their limits in grey, and the clearance."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from ..squat.prediction import SquatPrediction
from .figure_style import CYCLE, INK, MUTED, VERMILLION, new_axes, small_legend
from .squat_units import shown_length

if TYPE_CHECKING:
    from ..squat.forecast import SquatForecast

_DASHES = ("-", "--", "-.")
WITH_KEY = {"size": (7.2, 4.0), "margins": (0.66, 1.95, 0.46, 0.12)}
"""Size and margins of a figure whose key stands beside it."""


def formula_figure(
    prediction: SquatPrediction,
    length: float,
    place: str = "maximum",
    *,
    measured: Mapping[str, np.ndarray] | None = None,
    knots: bool = False,
    ax: Axes | None = None,
) -> Axes:
    """Squat of every formula over speed: in colour where it applies, grey where it is outside its limits.

    Parameters
    ----------
    prediction : SquatPrediction
    length : float
        Of the ship in m: models are drawn in mm.
    place : str
        ``bow``, ``stern``, ``middle`` or ``maximum``.
    measured : mapping of str to ndarray, optional
        Measured ``speed`` in m/s and `place` in m.
    knots : bool
        Full-scale knots instead of m/s.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes(**WITH_KEY)  # type: ignore[arg-type]
    factor, unit = shown_length(length)
    highest = outside = 0.0
    for number, (name, of) in enumerate(prediction.table.groupby("formula", sort=False)):
        ordered = of.sort_values("speed")
        values = factor * ordered[place].to_numpy(dtype=float)
        if not np.isfinite(values).any():
            continue
        speed = ordered["knots" if knots else "speed"].to_numpy(dtype=float)
        inside = ordered["applicable"].to_numpy(dtype=bool)
        if inside.any():
            highest = max(highest, float(np.nanmax(values[inside])))
        outside = max(outside, float(np.nanmax(values)))
        style = _DASHES[number // len(CYCLE) % len(_DASHES)]
        colour = CYCLE[number % len(CYCLE)] if inside.any() else MUTED
        if not inside.all():
            label = None if inside.any() else f"{name} (outside)"
            ax.plot(
                speed, values, color=MUTED, linewidth=0.8, linestyle=":", marker=".", markersize=3, label=label
            )
        if inside.any():
            ax.plot(
                speed, np.where(inside, values, np.nan), color=colour, linewidth=1.4, linestyle=style, label=name
            )
    if measured is not None:
        at = np.asarray(measured["speed"], dtype=float)
        value = factor * np.asarray(measured[place], dtype=float)
        highest = max(highest, float(np.nanmax(value)))
        ax.plot(at, value, "o", color=INK, markersize=5, label="measured", zorder=5)
    # a formula far beyond its limits must not flatten those that apply
    ax.set_ylim(0.0, 1.06 * (min(max(outside, highest), 2.0 * highest) if highest > 0.0 else outside))
    ax.set_xlabel("speed, full scale [kn]" if knots else "speed [m/s]")
    where = {"maximum": "largest squat", "middle": "squat at midship"}.get(place, f"squat at {place}")
    ax.set_ylabel(f"{where} [{unit}]")
    small_legend(ax, loc="center left", bbox_to_anchor=(1.02, 0.5), fontsize=7)
    return ax


def formula_clearance_figure(forecast: SquatForecast, *, knots: bool = True, ax: Axes | None = None) -> Axes:
    """Water under the keel over speed: between the least and the largest squat of the applicable formulas.

    Parameters
    ----------
    forecast : SquatForecast
    knots : bool
        Full-scale knots instead of m/s.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes((6.4, 3.2))
    factor, unit = shown_length(forecast.ship.L)
    spread = forecast.spread
    speed = spread["full-scale speed [kn]" if knots else "speed [m/s]"].to_numpy(dtype=float)
    still = factor * (forecast.fairway.depth - forecast.ship.T)
    least, middle, most = (
        still - factor * spread[name].to_numpy(dtype=float) for name in ("largest [m]", "median [m]", "least [m]")
    )
    ax.axhline(still, color=MUTED, linewidth=1.0, linestyle="--", label="at rest")
    ax.fill_between(speed, least, most, color=CYCLE[0], alpha=0.2, linewidth=0, label="applicable formulas")
    ax.plot(speed, middle, color=CYCLE[0], linewidth=1.4, label="their median")
    every = still - factor * spread["largest of all [m]"].to_numpy(dtype=float)
    ax.plot(speed, every, color=MUTED, linewidth=0.9, linestyle=":", label="largest of all formulas")
    if min(float(np.nanmin(every)), 0.0) < 0.0:
        ax.axhline(0.0, color=VERMILLION, linewidth=1.2, label="aground")
    low = max(float(np.nanmin(every)), -0.3 * still)
    reach = still - low
    ax.set_ylim(low - 0.08 * reach, still + 0.32 * reach)
    if all(b > a for a, b in pairwise(speed)):
        ax.set_xlim(float(speed[0]), float(speed[-1]))
    ax.set_xlabel("speed, full scale [kn]" if knots else "speed [m/s]")
    ax.set_ylabel(f"under the keel [{unit}]")
    small_legend(ax, loc="upper center", ncols=3)
    return ax
