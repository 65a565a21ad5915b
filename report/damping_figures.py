"""Figures of free decays: record and fit, extinction curve, equivalent damping, residuals, correlation."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from ..decay.damping_models import MOTION_UNITS
from ..decay.decay_record import DecayRecord
from ..decay.equation import simulate_decay
from ..decay.equivalent_damping import EquivalentDamping, equivalent_linear, lever_describing_function
from ..decay.extinction_curve import extinction_points
from ..decay.ikeda_comparison import IkedaComparison
from ..decay.roll_damping import RollDamping
from .drawings import Drawing
from .figure_style import (
    BLUE,
    CYCLE,
    INK,
    MUTED,
    ORANGE,
    PANEL,
    SKY,
    VERMILLION,
    decimated,
    inline_svg,
    new_axes,
    small_legend,
)

METHOD_COLOURS = {
    "logarithmic decrement": SKY,
    "exponential cosine": "#8c6d31",
    "extinction curve": CYCLE[2],
    "quasi-linear": CYCLE[3],
    "energy method": ORANGE,
    "derivation": "#999999",
    "curve, then least squares": "#7b5ea7",
    "NLS-SVM": VERMILLION,
    "integration": BLUE,
    "integration with memory": "#1b3a6b",
    "random decrement": VERMILLION,
    "joint fit": BLUE,
}
"""Colour of each method in every figure."""

SINGLE_POINTS = 8
"""So few amplitudes are drawn as points with intervals, more as a line with its band."""

COMPONENT_NAMES = ("friction", "wave", "eddy", "bilge_keel", "lift")


def shown_unit(motion: str) -> tuple[float, str]:
    """Factor from rad or m to what a figure shows, and that unit: degrees or mm."""
    return (1000.0, "mm") if MOTION_UNITS[motion] == "m" else (float(np.degrees(1.0)), "deg")


def drawn(ax: Axes, name: str, caption: str) -> Drawing:
    """A finished figure as inline SVG with its caption; `name` is unique in the page."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    return Drawing(inline_svg(figure, name, caption), caption)


def decay_record_figure(record: DecayRecord, fit: RollDamping, run: int = 0, *, ax: Axes | None = None) -> Axes:
    """The whole record, the fitted motion of its free part, and the envelope that the coefficients give.

    Parameters
    ----------
    record : DecayRecord
        Free part; the whole record behind it is drawn in grey.
    fit : RollDamping
    run : int
        Which of the fit's runs the record is.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    factor, unit = shown_unit(record.motion)
    whole = record.whole if record.whole is not None else record
    own = fit.runs[run]
    # The whole record still has the rest position that was taken off the free part.
    first = int(np.searchsorted(whole.time, record.time[0] - 0.5 * record.time_step))
    taken_off = whole.value[first : first + len(record)] - record.value
    rest = float(np.mean(taken_off)) if taken_off.size == len(record) else 0.0
    ax.plot(*decimated(whole.time, factor * (whole.value - rest)), color=MUTED, linewidth=0.7, label="record")
    ax.plot(*decimated(own.time, factor * own.fitted), color=BLUE, linewidth=1.1, label=f"fit ({fit.method})")
    time, envelope = _envelope(fit, run)
    ax.plot(time, factor * (own.offset + envelope), color=VERMILLION, linewidth=1.0, label="envelope")
    ax.plot(time, factor * (own.offset - envelope), color=VERMILLION, linewidth=1.0)
    ax.axvline(record.time[0], color=INK, linewidth=0.7, linestyle=":")
    ax.set_xlim(float(whole.time[0]), float(whole.time[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(f"{record.motion} [{unit}]")
    small_legend(ax, loc="upper right", ncols=3)
    return ax


def _envelope(fit: RollDamping, run: int) -> tuple[np.ndarray, np.ndarray]:
    """Amplitude against time by A' = -alpha_e(A) A, started from the energy of the fitted first values."""
    own = fit.runs[run]
    coefficients = fit.coefficients(own.speed)
    angle, rate = own.start
    amplitude = float(np.hypot(angle, rate / fit.omega_n))
    for _ in range(3):
        omega = float(equivalent_linear(coefficients, np.array([amplitude]), fit.model.curve)[1][0])
        amplitude = float(np.hypot(angle, rate / omega))
    time = np.linspace(own.time[0], own.time[-1], 240)
    step = float(time[1] - time[0])
    path = np.empty(time.size)
    for k in range(time.size):
        path[k] = amplitude
        alpha = equivalent_linear(coefficients, np.array([amplitude]), fit.model.curve)[0]
        half = amplitude * np.exp(-0.5 * step * alpha)
        middle = equivalent_linear(coefficients, half, fit.model.curve)[0]
        amplitude = float(amplitude * np.exp(-step * middle[0]))
    return time, path


def extinction_figure(records: Sequence[DecayRecord], fit: RollDamping, *, ax: Axes | None = None) -> Axes:
    """Loss of each half cycle against its mean amplitude, and the curve of the coefficients.

    Parameters
    ----------
    records : sequence of DecayRecord
    fit : RollDamping
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    factor, unit = shown_unit(fit.motion)
    least = 0.0
    for number, record in enumerate(records):
        mean, loss = extinction_points(record)
        least = min(least, factor * float(loss.min()))
        label = "half cycles" if len(records) == 1 else record.name
        ax.plot(
            factor * mean, factor * loss, "o", color=CYCLE[number % 6], markersize=3.2, alpha=0.85, label=label
        )
    low, high = fit.diagnostics.amplitudes
    at = np.linspace(0.0, high, 60)[1:]
    loss = _loss(fit, at, records[0].speed)
    inside = at >= low
    ax.plot(factor * at[inside], factor * loss[inside], color=INK, linewidth=1.3, label=f"{fit.method}")
    ax.plot(factor * at[~inside], factor * loss[~inside], color=INK, linewidth=0.9, linestyle=":")
    ax.set_xlim(0.0, None)
    # Noise makes losses of small swings negative: they are shown, not cut.
    ax.set_ylim(1.1 * least, None)
    ax.set_xlabel(f"mean amplitude [{unit}]")
    ax.set_ylabel(f"loss of a half cycle [{unit}]")
    small_legend(ax, loc="upper left")
    return ax


def _loss(fit: RollDamping, mean: np.ndarray, speed: float) -> np.ndarray:
    """Loss of a half cycle whose mean amplitude is given, by simulation of the half cycle from its first turn."""
    coefficients = fit.coefficients(speed)
    losses = []
    for amplitude in mean:
        alpha, omega, _ = equivalent_linear(coefficients, np.array([amplitude]), fit.model.curve)
        first = float(amplitude * np.exp(0.5 * np.pi * alpha[0] / omega[0]))
        share = float(lever_describing_function(fit.model.curve, np.array([first]))[0])
        time = np.linspace(0.0, 1.3 * np.pi / float(omega[0]) / max(share, 0.5), 200)
        path = simulate_decay(time, (first, 0.0), coefficients, curve=fit.model.curve)[:, 0]
        losses.append(first + float(path.min()))
    return np.array(losses)


def equivalent_damping_figure(
    results: Mapping[str, EquivalentDamping], *, truth: EquivalentDamping | None = None, ax: Axes | None = None
) -> Axes:
    """Equivalent damping of several methods with their bands.

    Parameters
    ----------
    results : mapping of str to EquivalentDamping
        By method.
    truth : EquivalentDamping, optional
        Of a virtual record.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    motion = next(iter(results.values())).motion
    factor, unit = shown_unit(motion)
    lows, highs = [], []
    for number, (method, one) in enumerate(results.items()):
        colour = METHOD_COLOURS.get(method, CYCLE[number % 6])
        if one.amplitude.size <= SINGLE_POINTS:
            arms = np.vstack([one.alpha - one.alpha_lower, one.alpha_upper - one.alpha])
            ax.errorbar(
                factor * one.amplitude,
                one.alpha,
                yerr=np.nan_to_num(arms),
                fmt="o",
                color=colour,
                markersize=4.0,
                linewidth=1.0,
                capsize=2.5,
                label=method,
            )
        else:
            band = (factor * one.amplitude, one.alpha_lower, one.alpha_upper)
            ax.fill_between(*band, color=colour, alpha=0.13, linewidth=0)
            ax.plot(factor * one.amplitude, one.alpha, color=colour, linewidth=1.4, label=method)
        lows.append(float(np.nanmin(one.alpha)))
        highs.append(float(np.nanmax(one.alpha)))
    if truth is not None:
        ax.plot(factor * truth.amplitude, truth.alpha, color=INK, linewidth=1.4, linestyle="--", label="truth")
    low, high = min(lows), max(highs)
    reach = high - min(low, 0.0)
    ax.set_ylim(min(0.0, low - 0.05 * reach), high + 0.18 * reach)
    ax.set_xlabel(f"amplitude [{unit}]")
    ax.set_ylabel("equivalent damping αₑ [1/s]")
    small_legend(ax, loc="upper left", ncols=2)
    return ax


def decay_residual_figure(fit: RollDamping, run: int = 0, *, ax: Axes | None = None) -> Axes:
    """Measured minus fitted motion of one run over time, with two standard deviations.

    Parameters
    ----------
    fit : RollDamping
    run : int
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    factor, unit = shown_unit(fit.motion)
    own = fit.runs[run]
    sd = factor * float(np.std(own.residual))
    ax.axhspan(-2.0 * sd, 2.0 * sd, color=BLUE, alpha=0.08, linewidth=0)
    ax.axhline(0.0, color=MUTED, linewidth=0.8)
    ax.plot(*decimated(own.time, factor * own.residual), color=INK, linewidth=0.6)
    ax.set_xlim(float(own.time[0]), float(own.time[-1]))
    ax.set_xlabel("time [s]")
    ax.set_ylabel(f"measured − fitted [{unit}]")
    return ax


def coefficient_ellipse(
    fit: RollDamping, names: tuple[str, str], *, truth: Mapping[str, float] | None = None, ax: Axes | None = None
) -> Axes:
    """Joint 95 % region of two coefficients: how far one may move when the other does.

    Parameters
    ----------
    fit : RollDamping
    names : (str, str)
        Two free terms.
    truth : mapping of str to float, optional
        True coefficients of a virtual record.
    ax : Axes, optional
    """
    from scipy.special import fdtri

    # Long tick labels must not leave the figure on the right.
    ax = ax if ax is not None else new_axes(PANEL, margins=(0.66, 0.28, 0.46, 0.12))
    places = [fit.position(name) for name in names]
    covariance = fit.cov[np.ix_(places, places)]
    values, axes = np.linalg.eigh(covariance)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    reach = np.sqrt(2.0 * float(fdtri(2.0, float(np.min(fit.t_dof)), 0.95)))
    circle = np.vstack([np.cos(angle), np.sin(angle)])
    centre = fit.params[places][:, None]
    outline = centre + reach * axes @ (np.sqrt(np.maximum(values, 0.0))[:, None] * circle)
    ax.fill(outline[0], outline[1], color=BLUE, alpha=0.15, linewidth=0)
    ax.plot(outline[0], outline[1], color=BLUE, linewidth=1.2, label="joint 95 % region")
    ax.plot(*centre[:, 0], "o", color=BLUE, markersize=4.5)
    if truth:
        ax.plot(truth.get(names[0], 0.0), truth.get(names[1], 0.0), "D", color=INK, markersize=4.5, label="truth")
    ax.set_xlabel(f"{names[0]} [{fit.units[names[0]]}]")
    ax.set_ylabel(f"{names[1]} [{fit.units[names[1]]}]")
    small_legend(ax, loc="upper right")
    return ax


def ikeda_figure(comparison: IkedaComparison, *, ax: Axes | None = None) -> Axes:
    """Measured B44-hat with its band over the stacked components of the simplified Ikeda formula.

    Parameters
    ----------
    comparison : IkedaComparison
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    table = comparison.table
    degrees = table["amplitude_deg"].to_numpy()
    floor = np.zeros(degrees.size)
    for number, name in enumerate(COMPONENT_NAMES):
        part = table[name].to_numpy()
        if not np.any(part):
            continue
        ax.fill_between(
            degrees,
            floor,
            floor + part,
            color=CYCLE[number],
            alpha=0.35,
            linewidth=0,
            label=f"Ikeda, {name.replace('_', ' ')}",
        )
        floor = floor + part
    ax.plot(degrees, table["predicted"], color=MUTED, linewidth=1.0)
    ax.fill_between(degrees, table["lower"], table["upper"], color=INK, alpha=0.2, linewidth=0)
    ax.plot(degrees, table["measured"], color=INK, linewidth=1.5, label="measured")
    ax.set_ylim(0.0, 1.45 * float(max(table["predicted"].max(), table["upper"].max())))
    ax.set_xlim(float(degrees[0]), float(degrees[-1]))
    ax.set_xlabel("roll amplitude [deg]")
    ax.set_ylabel("B44-hat [-]")
    small_legend(ax, loc="upper left", ncols=2)
    return ax
