"""The turning circle as it is drawn in a trial report: track, ship, and the lengths that are read off it."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from ..simulate.manoeuvre_indices import indices
from ..simulate.trajectory import Trajectory
from .figure_style import BLUE, INK, MUTED, VERMILLION, new_axes
from .typography import fixed

SIZE, MARGINS = (4.7, 4.5), (0.68, 0.12, 0.46, 0.12)
"""Of a figure with one track, in inch."""

_BOW = [[0.5, 0.0], [0.42, 0.045], [0.3, 0.07], [-0.35, 0.07], [-0.5, 0.05]]

_HULL = np.array([*_BOW, *([along, -across] for along, across in _BOW[:0:-1])])
"""Waterline in ship lengths, bow along x."""


def turning_circle(trajectory: Trajectory, ax: Axes | None = None) -> Axes:
    """Track of a turning circle with advance, transfer, tactical and steady diameter drawn in.

    Parameters
    ----------
    trajectory : Trajectory
        With its events; lengths are over ship lengths, counted from the first order.
    ax : Axes, optional

    Returns
    -------
    Axes
        x / L upwards along the original course, y / L to the right.
    """
    ax = track(trajectory, ax)
    events = trajectory.events
    assert events is not None
    length = trajectory.ship.L
    found = indices(trajectory).set_index("index")["value"]
    places = {
        name: (events.at(name, "x")[0] / length, events.at(name, "y")[0] / length)
        for name in ("execute", "heading 90", "heading 180")
    }
    x0, y0 = places["execute"]
    side = 1.0 if trajectory["psi"][-1] > trajectory["psi"][0] else -1.0
    top = max(float(np.max(trajectory["x"])) / length, x0 + 0.5)
    if "advance" in found:
        x, y = places["heading 90"]
        _span(ax, (y0 - 0.75 * side, x0), (y0 - 0.75 * side, x), f"advance {fixed(found['advance'], 2)}", side)
        _extend(ax, (y, x), (y0 - 0.95 * side, x))
        _extend(ax, (y0, x0), (y0 - 0.95 * side, x0))
        _span(ax, (y0, top + 0.35), (y, top + 0.35), f"transfer {fixed(abs(found['transfer']), 2)}", side)
        _extend(ax, (y, x), (y, top + 0.45))
    if "tactical diameter" in found:
        x, y = places["heading 180"]
        _span(
            ax,
            (y0, top + 0.95),
            (y, top + 0.95),
            f"tactical diameter {fixed(abs(found['tactical diameter']), 2)}",
            side,
        )
        _extend(ax, (y, x), (y, top + 1.05))
    if "steady diameter" in found and abs(found.get("unsteadiness", 0.0)) < 5.0:
        _steady_circle(ax, trajectory, float(found["steady diameter"]), side)
    _extend(ax, (y0, x0 - 1.1), (y0, top + 1.05))
    # room for the lengths above the track; limits that are set would be overruled by the equal scales of both axes
    lowest = min(float(np.min(trajectory["x"])) / length, x0 - 1.0) - 0.3
    ax.update_datalim([(y0, lowest), (y0, top + 1.45)])
    ax.autoscale_view()
    return ax


def track(trajectory: Trajectory, ax: Axes | None = None, *, hulls: bool = True) -> Axes:
    """Track of any manoeuvre seen from above, over ship lengths, the ship drawn at every 90 degrees of heading."""
    ax = new_axes(SIZE, margins=MARGINS) if ax is None else ax
    length = trajectory.ship.L
    x, y, psi = trajectory["x"] / length, trajectory["y"] / length, trajectory["psi"]
    ax.plot([y[0], y[0]], [x[0] - 1.0, x[0]], color=BLUE, linewidth=1.6)
    ax.plot(y, x, color=BLUE, linewidth=1.6)
    if hulls:
        for row in _every_quarter(psi):
            _ship(ax, float(x[row]), float(y[row]), float(psi[row]))
    ax.set_aspect("equal", adjustable="datalim")
    ax.set_xlabel("y / L  (to starboard)")
    ax.set_ylabel("x / L  (original course)")
    return ax


def _every_quarter(psi: np.ndarray) -> list[int]:
    """Rows of the first sample and of each further quarter turn, at most one turn."""
    turned = np.abs(psi - psi[0])
    marks = np.arange(0.0, min(float(turned.max()), 2.0 * math.pi) + 1e-9, 0.5 * math.pi)
    return [int(np.argmax(turned >= mark - 1e-9)) for mark in marks]


def _ship(ax: Axes, x: float, y: float, psi: float) -> None:
    along, across = _HULL.T
    rows = np.column_stack(
        [y + along * math.sin(psi) + across * math.cos(psi), x + along * math.cos(psi) - across * math.sin(psi)]
    )
    ax.add_patch(Polygon(rows, closed=True, facecolor=MUTED, edgecolor=INK, linewidth=0.5, alpha=0.55, zorder=2.5))


def _span(ax: Axes, a: tuple[float, float], b: tuple[float, float], text: str, side: float) -> None:
    """A line with arrows at both ends and its length written beside it."""
    ax.annotate(
        "",
        xy=a,
        xytext=b,
        arrowprops={
            "arrowstyle": "<|-|>",
            "color": INK,
            "linewidth": 0.7,
            "shrinkA": 0,
            "shrinkB": 0,
            "mutation_scale": 7,
        },
    )
    middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
    upright = abs(a[0] - b[0]) < 1e-9
    ax.annotate(
        text,
        middle,
        xytext=(-4.0 * side, 0.0) if upright else (0.0, 2.5),
        textcoords="offset points",
        ha=("right" if side > 0 else "left") if upright else "center",
        va="center" if upright else "bottom",
        rotation=90.0 if upright else 0.0,
        fontsize=7.5,
        color=INK,
    )


def _extend(ax: Axes, a: tuple[float, float], b: tuple[float, float]) -> None:
    ax.plot([a[0], b[0]], [a[1], b[1]], color=MUTED, linewidth=0.6, linestyle=(0, (4, 3)), zorder=1.5)


def _steady_circle(ax: Axes, trajectory: Trajectory, diameter: float, side: float) -> None:
    """Diameter through the centre of the steady turn, which lies across the velocity at its end."""
    length = trajectory.ship.L
    x, y = float(trajectory["x"][-1]) / length, float(trajectory["y"][-1]) / length
    course = float(trajectory["psi"][-1]) + math.atan2(trajectory["v"][-1], trajectory["u"][-1])
    cx = x - 0.5 * diameter * side * math.sin(course)
    cy = y + 0.5 * diameter * side * math.cos(course)
    ax.plot([cy], [cx], marker="+", markersize=5, markeredgewidth=0.8, color=VERMILLION)
    low = cx - 0.18 * diameter
    ax.annotate(
        f"steady diameter\n{fixed(diameter, 2)}", (cy, low), ha="center", va="top", fontsize=7.5, color=VERMILLION
    )
    ax.plot(
        [cy - 0.5 * diameter, cy + 0.5 * diameter],
        [cx, cx],
        color=VERMILLION,
        linewidth=0.7,
        linestyle=(0, (4, 3)),
    )
