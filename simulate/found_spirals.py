"""Events of sampled spirals: the steady turns that the rudder, or the yaw rate of a reverse spiral, was held for."""

from __future__ import annotations

import numpy as np

from ..core.errors import AuditError, ReadError
from .events import Events
from .found_states import order_time, settled_end, single
from .held_levels import held_levels, settled_part
from .manoeuvre_names import NamedManoeuvre
from .sampled_channels import SampledChannels
from .trajectory import Trajectory

HELD_RUDDER = np.radians(0.8)
"""Rudder angles of a spiral differ by more than this."""

HELD_RATE = 0.025
"""Yaw rates of a reverse spiral differ by more than this share of their range."""

STILL_CHANGING = 0.05
"""A turn is not steady when its yaw rate changes by this share of the largest over an eighth of the time."""


def find_spiral(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    """Events of a direct or a reverse spiral: its steady turns.

    Parameters
    ----------
    trajectory : Trajectory
        With ``time, psi, delta``; of a noisy reverse spiral also the yaw rate.
    channels : SampledChannels
        Of the trajectory.
    named : NamedManoeuvre
        Whether the spiral is reverse.
    execute : float or None
        Time of the first order in s.

    Raises
    ------
    ReadError, AuditError
        For fewer than five steady turns, for noise as large as the steps, for a turn that is not steady.
    """
    reverse = named.kind == "reverse spiral"
    held, steady = ("r", "delta") if reverse else ("delta", "r")
    values = channels.smooth(held)
    band = HELD_RATE * float(np.ptp(values)) if reverse else HELD_RUDDER
    levels = held_levels(values, band, channels.channels["delta"])
    means = [abs(float(np.mean(values[settled_part(level)]))) for level in levels]
    if levels and means[0] < 0.5 * max(means):
        # a spiral begins with its hardest turn: what comes before is the approach
        levels = levels[1:]
    if len(levels) < 5:
        raise ReadError(
            f"{len(levels)} steady {'yaw rates' if reverse else 'rudder angles'} in this record: no spiral has so few",
            cure="give the record of at least five, each held until the other of yaw rate and rudder is steady",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
    found = {"execute": channels.state(order_time(trajectory, execute))}
    rows = np.zeros(len(channels.time), dtype=bool)
    for number, level in enumerate(levels, start=1):
        part = settled_part(level)
        if np.std(values[part]) > 0.25 * band:
            raise AuditError(
                f"'{held}' scatters by {np.degrees(np.std(values[part])):.2g} deg{'/s' if reverse else ''} where it is"
                " held: its levels cannot be told apart",
                cure="record the yaw rate itself, or filter the record",
                file=trajectory.source or None,
                place=trajectory.manoeuvre,
            )
        _require_steady(trajectory, channels, steady, part)
        rows[:] = False
        rows[part] = True
        found[f"steady {number}"] = settled_end(channels, rows)
    return single({**found, "end": channels.state(float(channels.time[-1]))})


def _require_steady(trajectory: Trajectory, channels: SampledChannels, name: str, part: slice) -> None:
    """Refuse a point of a spiral at which the ship has not come to a steady turn."""
    values = channels.smooth(name)
    half = (part.start + part.stop) // 2
    change = abs(float(np.mean(values[half : part.stop]) - np.mean(values[part.start : half])))
    if change > STILL_CHANGING * float(np.abs(values).max()):
        what, unit = ("yaw rate", "deg/s") if name == "r" else ("rudder angle", "deg")
        raise AuditError(
            f"the {what} still changes, by {np.degrees(change):.2g} {unit} before {channels.time[part.stop - 1]:.5g} s",
            cure="hold each point of a spiral until the turn is steady, or cut out those that were not",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
