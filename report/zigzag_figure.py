"""Zig-zags and other manoeuvres over time: heading, rudder, overshoots, yaw rate, speed."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from ..simulate.manoeuvre_names import read_manoeuvre_name
from ..simulate.trajectory import Trajectory
from .figure_style import BLUE, GREEN, INK, MUTED, PANEL, VERMILLION, new_axes, small_legend
from .typography import fixed

STRAIGHT = 0.01
"""Degrees of heading and rudder below which a motion is drawn as straight: the errors of the integration."""

SIZE, MARGINS = PANEL, (0.66, 0.1, 0.46, 0.3)


def zigzag(trajectory: Trajectory, ax: Axes | None = None) -> Axes:
    """Heading and rudder of a zig-zag over time, each overshoot drawn in.

    Parameters
    ----------
    trajectory : Trajectory
        With its events.
    ax : Axes, optional

    Returns
    -------
    Axes
        Time in s; angles in degrees, positive to starboard.
    """
    ax = heading_and_rudder(trajectory, ax)
    events = trajectory.events
    assert events is not None
    start = float(np.degrees(events.at("execute 1", "psi")[0]))
    named = read_manoeuvre_name(trajectory.manoeuvre)
    switch = named.heading if named.heading is not None else abs(named.rudder or 0.0)
    for sign in (1.0, -1.0):
        ax.axhline(start + sign * switch, color=MUTED, linewidth=0.6, linestyle=(0, (4, 3)), zorder=1.5)
    for number in range(1, 10):
        time, extreme = (
            events.at(f"extreme {number}", "time")[0],
            np.degrees(events.at(f"extreme {number}", "psi")[0]),
        )
        before = np.degrees(events.at(f"execute {number + 1}", "psi")[0])
        if not np.isfinite([time, extreme, before]).all():
            break
        ax.annotate(
            "",
            xy=(time, extreme),
            xytext=(time, before),
            arrowprops={"arrowstyle": "<|-|>", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0}
            | {"mutation_scale": 6},
        )
        up = extreme > before
        ax.annotate(
            f"{fixed(abs(extreme - before), 1)}°",
            (time, extreme),
            xytext=(0.0, 2.5 if up else -2.5),
            textcoords="offset points",
            ha="center",
            va="bottom" if up else "top",
            fontsize=7.5,
            color=INK,
        )
    ax.margins(y=0.14)
    return ax


def heading_and_rudder(trajectory: Trajectory, ax: Axes | None = None) -> Axes:
    """Heading and rudder angle in degrees over time."""
    ax = new_axes(SIZE, margins=MARGINS) if ax is None else ax
    time = trajectory["time"]
    ax.plot(time, np.degrees(trajectory["psi"]), color=BLUE, linewidth=1.5, label="heading ψ")
    if "delta" in trajectory:
        ax.plot(time, np.degrees(trajectory["delta"]), color=VERMILLION, linewidth=1.0, label="rudder δ")
    if max(abs(edge) for edge in ax.dataLim.intervaly) < STRAIGHT:
        ax.set_ylim(-1.0, 1.0)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("ψ, δ [deg]")
    small_legend(ax, loc="lower center", bbox_to_anchor=(0.5, 0.99), ncols=2, borderaxespad=0.0)
    return ax


def speed_and_yaw_rate(trajectory: Trajectory, ax: Axes | None = None) -> Axes:
    """Speed over the approach speed and yaw rate r L / U0 over time."""
    ax = new_axes(SIZE, margins=MARGINS) if ax is None else ax
    time, speed = trajectory["time"], trajectory.speed()
    ax.plot(time, speed / speed[0], color=GREEN, linewidth=1.3, label="U / U₀")
    ax.plot(
        time,
        trajectory["r"] * trajectory.ship.L / speed[0],
        color=BLUE,
        linewidth=1.3,
        label="r L / U₀",
    )
    if "phi" in trajectory:
        ax.plot(time, np.degrees(trajectory["phi"]) / 10.0, color=VERMILLION, linewidth=1.0, label="φ / 10°")
    ax.set_xlabel("time [s]")
    ax.set_ylabel("over approach values [–]")
    small_legend(ax, loc="lower center", bbox_to_anchor=(0.5, 0.99), ncols=3, borderaxespad=0.0)
    return ax


def spiral(trajectory: Trajectory, ax: Axes | None = None) -> Axes:
    """Steady yaw rates of a spiral over the rudder angle, in the order in which they were sailed."""
    ax = new_axes(SIZE, margins=MARGINS) if ax is None else ax
    events = trajectory.events
    assert events is not None
    steady = [name for name in events if name.startswith("steady ")]
    angles = np.degrees([events.at(name, "delta")[0] for name in steady])
    rates = np.degrees([events.at(name, "r")[0] for name in steady])
    ax.axhline(0.0, color=MUTED, linewidth=0.6)
    ax.axvline(0.0, color=MUTED, linewidth=0.6)
    way = angles if trajectory.manoeuvre.startswith("spiral") else rates
    turn = int(np.argmin(way)) if way[0] > way[-1] or way[0] > way.min() else len(way) - 1
    ax.plot(
        angles[: turn + 1], rates[: turn + 1], color=BLUE, marker="o", markersize=3.5, linewidth=1.0, label="out"
    )
    if turn < len(way) - 1:
        ax.plot(
            angles[turn:], rates[turn:], color=VERMILLION, marker="s", markersize=3.0, linewidth=1.0, label="back"
        )
        small_legend(ax, loc="upper left")
    ax.set_xlabel("rudder angle δ [deg]")
    ax.set_ylabel("steady yaw rate r [deg/s]")
    return ax
