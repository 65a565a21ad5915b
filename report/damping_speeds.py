"""Damping against forward speed in the decay report."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ..decay.against_speed import against_speed, common_amplitude, speed_series
from ..decay.decay_results import DecayGroup
from .damping_figures import drawn, shown_unit
from .drawings import Drawing
from .figure_style import BLUE, new_axes
from .page_table import Column, Table, make_table
from .typography import fixed, significant


def speed_table(groups: Sequence[DecayGroup]) -> Table:
    """Coefficients of the quoted fits, one row a speed; empty without two speeds."""
    frame = against_speed(groups)
    if frame.empty:
        return make_table([Column("speed [m/s]", "number")], [])
    names = list(dict.fromkeys(frame["name"]))
    units = dict(zip(frame["name"], frame["unit"]))
    columns = [
        Column("motion"),
        Column("scale", "number"),
        Column("speed [m/s]", "number"),
        Column("Fn", "number"),
    ]
    columns += [Column(f"{name} [{units[name]}]", "number") for name in names]
    rows = []
    for (motion, scale, _, speed), part in frame.groupby(
        ["motion", "scale", "depth [m]", "speed [m/s]"], sort=False
    ):
        by_name = part.set_index("name")
        froude = float(part["Fn [-]"].iloc[0])
        row = [str(motion), f"{scale:g}", f"{speed:g}", "–" if np.isnan(froude) else fixed(froude, 3)]
        for name in names:
            row.append(significant(float(by_name.loc[name, "value"]), 4) if name in by_name.index else "–")
        rows.append(row)
    at = ", ".join(f"{value:.3g}" for value in dict.fromkeys(frame["at"].dropna()))
    unit = shown_unit(groups[0].records[0].motion)[1]
    return make_table(
        columns, rows, f"alpha_e, zeta and omega at the amplitude {at} {unit}, which all speeds held."
    )


def draw_speeds(groups: Sequence[DecayGroup]) -> list[Drawing]:
    """Equivalent damping at one amplitude, and each damping coefficient, against speed."""
    drawings = []
    for number, members in enumerate(speed_series(groups)):
        names = [name for name in members[0].preferred.model.damping if name in members[0].preferred.names]
        amplitude = common_amplitude(members)
        factor, unit = shown_unit(members[0].records[0].motion)
        drawings.append(
            drawn(
                speed_figure(members),
                f"speed-{number}-alpha",
                f"Equivalent damping at {factor * amplitude:.3g} {unit} with 95 % intervals.",
            )
        )
        drawings += [
            drawn(speed_figure(members, name), f"speed-{number}-{name}", f"{name} with 95 % intervals.")
            for name in names
        ]
    return drawings


def speed_figure(members: Sequence[DecayGroup], name: str = "alpha_e", *, ax: Axes | None = None) -> Axes:
    """One coefficient of the quoted fits, or the equivalent damping, against speed with its intervals.

    Parameters
    ----------
    members : sequence of DecayGroup
        Of one motion, scale and depth.
    name : str
        A coefficient, or ``alpha_e``.
    ax : Axes, optional
    """
    ax = ax if ax is not None else new_axes()
    frame = against_speed(members)
    own = frame[frame["name"] == name]
    value = own["value"].to_numpy(dtype=float)
    reach = np.vstack([value - own["lower95"].to_numpy(float), own["upper95"].to_numpy(float) - value])
    ax.errorbar(
        own["speed [m/s]"], value, yerr=reach, fmt="o-", color=BLUE, markersize=4, linewidth=1.0, capsize=2.5
    )
    ax.set_xlabel("speed [m/s]")
    ax.set_ylabel(f"{name} [{own['unit'].iloc[0]}]")
    low, high = float(own["lower95"].min()), float(own["upper95"].max())
    room = 0.08 * ((high - min(low, 0.0)) or 1.0)
    ax.set_ylim(min(low - room, 0.0), high + room)
    return ax
