"""Figures of squat: records with their windows, curves with bands, residuals, water under the keel."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..core.variables import GRAVITY
from ..squat.squat_curve import CurveFit, SquatCurve
from ..squat.squat_run import SquatRun
from .figure_style import (
    BLUE,
    CYCLE,
    GREEN,
    INK,
    MARKERS,
    MUTED,
    PURPLE,
    SKY,
    VERMILLION,
    decimated,
    new_axes,
    small_legend,
)
from .squat_units import quantity_title, shown_length, shown_quantity

QUANTITY_COLOURS = {
    "sinkage_bow": BLUE,
    "sinkage_stern": VERMILLION,
    "sinkage_midship": GREEN,
    "sinkage_cog": PURPLE,
    "trim": INK,
}
"""Colour of each quantity in every figure."""

_MARKS = dict(zip(QUANTITY_COLOURS, MARKERS, strict=False))
_TWO = 2.0
"""Standard errors that an error bar reaches to both sides."""


def colour_of(quantity: str, number: int = 0) -> str:
    """Colour of a quantity; of places with a name of their own by number."""
    return QUANTITY_COLOURS.get(quantity, CYCLE[(number + 3) % len(CYCLE)])


def squat_record_figure(run: SquatRun, *, ax: Axes | None = None) -> Axes:
    """Sinkage at bow and stern over time, the windows shaded and the means drawn.

    Parameters
    ----------
    run : SquatRun
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    record = run.record
    length = record.layout.length
    factor, unit = shown_length(length)
    for name, x in (("sinkage_bow", 0.5 * length), ("sinkage_stern", -0.5 * length)):
        colour = QUANTITY_COLOURS[name]
        ax.plot(
            *decimated(record.time, factor * record.sinkage_at(x), 500),
            color=colour,
            linewidth=0.6,
            alpha=0.75,
            label=name.removeprefix("sinkage_"),
        )
        for one in run.steady:
            if name in one.means:
                mean = factor * float(one.means[name].mean)
                ax.plot([one.window.start_time, one.window.stop_time], [mean, mean], color=colour, linewidth=2.0)
    for number, one in enumerate(run.steady):
        label = "window and mean" if number == 0 else None
        ax.axvspan(one.window.start_time, one.window.stop_time, color=SKY, alpha=0.2, linewidth=0, label=label)
    ax.set_xlim(float(record.time[0]), float(record.time[-1]))
    # the deeper the lower, as the ship does it; room above the traces for the legend
    low, high = ax.get_ylim()
    ax.set_ylim(high, low - 0.22 * (high - low))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(f"sinkage [{unit}]")
    small_legend(ax, loc="upper left", ncols=3)
    return ax


def squat_curve_figure(
    curve: SquatCurve,
    fits: Mapping[str, Mapping[str, CurveFit]],
    length: float,
    quantities: Sequence[str] = ("sinkage_bow", "sinkage_stern"),
    *,
    truth: Mapping[str, float] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Measured points over speed with two standard errors, fitted curves and their 95 % bands.

    Parameters
    ----------
    curve : SquatCurve
    fits : mapping of str to mapping of str to CurveFit
        By quantity and model; ``depth-froude`` is drawn, ``power`` where it alone is there.
    length : float
        Of the ship in m: models are drawn in mm.
    quantities : sequence of str
        Of one unit.
    truth : mapping of str to float, optional
        True c of virtual records by quantity.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    trim = quantities[0] == "trim"
    factor, unit = shown_quantity("m/m" if trim else "m", length)
    speed = curve.points["speed"].to_numpy(dtype=float)
    critical = float(np.sqrt(GRAVITY * curve.depth))
    top = min(1.06 * float(speed.max()), 0.97 * critical)
    at = np.linspace(0.0, max(top, float(speed.max())), 120)[1:]
    for number, name in enumerate(quantities):
        if name not in curve.points:
            continue
        colour = colour_of(name, number)
        models = fits.get(name, {})
        fit = models.get("depth-froude") or models.get("power")
        label = quantity_title(name)
        if fit is not None:
            below = at[at < critical] if fit.model == "depth-froude" else at
            inside = ~fit.extrapolated(below)
            middle = factor * fit.predict(below)
            low, high = (factor * edge for edge in fit.band(below))
            ax.fill_between(below, low, high, where=inside.tolist(), color=colour, alpha=0.2, linewidth=0)
            ax.plot(below, np.where(inside, middle, np.nan), color=colour, linewidth=1.7)
            ax.plot(below, np.where(inside, np.nan, middle), color=colour, linewidth=0.9, linestyle=":")
        if truth and name in truth:
            square = at**2 / (GRAVITY * curve.depth)
            with np.errstate(invalid="ignore"):
                true = factor * truth[name] * square / np.sqrt(1.0 - square)
            label_true = "truth" if number == 0 else None
            ax.plot(at, true, color=INK, linewidth=0.8, linestyle=(0, (2, 4)), label=label_true)
        errors = curve.points.get(f"{name}_se")
        ax.errorbar(
            speed,
            factor * curve.points[name].to_numpy(dtype=float),
            yerr=None if errors is None else _TWO * factor * errors.to_numpy(dtype=float),
            fmt=_MARKS.get(name, "o"),
            color=colour,
            markersize=4,
            linewidth=0.9,
            label=label,
        )
    ax.set_xlim(0.0, float(at[-1]) * 1.02)
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel(f"{'trim, bow down' if trim else 'sinkage, down'} [{unit}]")
    small_legend(ax, loc="upper left")
    return ax


def squat_residual_figure(
    curve: SquatCurve,
    fits: Mapping[str, Mapping[str, CurveFit]],
    length: float,
    quantities: Sequence[str] = ("sinkage_bow", "sinkage_stern"),
    *,
    ax: Axes | None = None,
) -> Axes:
    """Measured less fitted sinkage over speed, with two standard deviations of the first quantity's scatter.

    Parameters
    ----------
    curve : SquatCurve
    fits : mapping of str to mapping of str to CurveFit
    length : float
        Of the ship in m: models are drawn in mm.
    quantities : sequence of str
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    trim = quantities[0] == "trim"
    factor, unit = shown_quantity("m/m" if trim else "m", length)
    speed = curve.points["speed"].to_numpy(dtype=float)
    ax.axhline(0.0, color=MUTED, linewidth=0.8)
    largest = 0.0
    for number, name in enumerate(quantities):
        models = fits.get(name, {})
        fit = models.get("depth-froude") or models.get("power")
        if fit is None:
            continue
        left = factor * (curve.points[name].to_numpy(dtype=float) - fit.predict(speed))
        largest = max(largest, float(np.max(np.abs(left))), _TWO * factor * fit.residual_sd)
        colour = colour_of(name, number)
        for side in (-_TWO, _TWO):
            ax.axhline(side * factor * fit.residual_sd, color=colour, linewidth=0.8, linestyle="--")
        ax.plot(
            speed, left, _MARKS.get(name, "o"), color=colour, markersize=4, label=name.removeprefix("sinkage_")
        )
    ax.set_ylim(-1.2 * largest, 1.65 * largest)
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel(f"measured − fitted [{unit}]")
    small_legend(ax, loc="upper center", ncols=2)
    return ax


def clearance_figure(curve: SquatCurve, length: float, *, ax: Axes | None = None) -> Axes:
    """Water under the keel at the deeper end over speed, beside that at rest.

    Parameters
    ----------
    curve : SquatCurve
        With bow and stern.
    length : float
        Of the ship in m: models are drawn in mm.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    factor, unit = shown_length(length)
    speed = curve.points["speed"].to_numpy(dtype=float)
    still = factor * (curve.depth - curve.draught)
    left = factor * curve.clearance()
    ax.axhline(still, color=MUTED, linewidth=1.0, linestyle="--", label="at rest")
    ax.plot(speed, left, "o-", color=BLUE, markersize=4, linewidth=1.0, label="under way, deeper end")
    reach = max(still - float(left.min()), 0.02 * still)
    ax.set_ylim(float(left.min()) - 0.15 * reach, still + 0.45 * reach)
    ax.set_xlim(0.0, 1.05 * float(speed.max()))
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel(f"under the keel [{unit}]")
    small_legend(ax, loc="upper right", ncols=2)
    return ax


def corrected_figure(curve: SquatCurve, corrected: SquatCurve, length: float, *, ax: Axes | None = None) -> Axes:
    """Sinkage at bow and stern as measured (open) and corrected for walls or bottom (filled).

    Parameters
    ----------
    curve, corrected : SquatCurve
        Points in one order.
    length : float
        Of the ship in m: models are drawn in mm.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    factor, unit = shown_length(length)
    for name in ("sinkage_bow", "sinkage_stern"):
        colour = QUANTITY_COLOURS[name]
        place = name.removeprefix("sinkage_")
        for of, fill, label in ((curve, "none", f"{place}, measured"), (corrected, colour, f"{place}, corrected")):
            ax.plot(
                of.points["speed"],
                factor * of.points[name],
                _MARKS[name],
                color=colour,
                markerfacecolor=fill,
                markersize=5,
                label=label,
            )
    low, high = ax.get_ylim()
    ax.set_ylim(min(low, 0.0), high)
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel(f"sinkage, down [{unit}]")
    small_legend(ax, loc="upper left")
    return ax
