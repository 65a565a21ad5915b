"""States at the orders and in the steady parts of a sampled manoeuvre."""

from __future__ import annotations

import numpy as np

from ..core.errors import AuditError, ReadError
from .events import COLUMN_NUMBER, COLUMNS, Events, FloatArray
from .rudder_history import step_start
from .sampled_channels import SampledChannels
from .trajectory import Trajectory


def order_time(trajectory: Trajectory, execute: float | None = None, channel: str = "delta") -> float:
    """Time in s of the first order: as given, or when the rudder (or another channel) begins to move.

    Raises
    ------
    ReadError
        For a time outside the record, a channel that is missing, or one that does not move.
    """
    time = trajectory["time"]
    if execute is not None:
        if not time[0] <= execute < time[-1]:
            raise ReadError(
                f"execute = {execute:g} s is outside the record from {time[0]:g} to {time[-1]:g} s",
                cure="give a time inside the record",
                file=trajectory.source or None,
            )
        return float(execute)
    if channel not in trajectory:
        raise ReadError(
            f"without the channel '{channel}' the order cannot be found",
            cure="give the channel, or execute=<time in s>",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
    return step_start(time, trajectory[channel], "rudder" if channel == "delta" else "propeller rate")


def single(found: dict[str, FloatArray]) -> Events:
    """Events of one draw from states of shape (11,)."""
    return Events({name: row[np.newaxis, :] for name, row in found.items()})


def turned(channels: SampledChannels, start: FloatArray, side: float) -> None:
    """Add the heading turned since execute, positive to the side of the manoeuvre."""
    channels.add("turned", side * (channels.channels["psi"] - start[COLUMN_NUMBER["psi"]]))


def same_side(side: float, helm: float, trajectory: Trajectory) -> None:
    """Refuse a ship that turns to the other side than her rudder: one of the two has the wrong sign.

    Parameters
    ----------
    side : {1.0, -1.0}
        To which the ship turns; +1 is starboard.
    helm : float
        Change of the rudder angle in rad.
    trajectory : Trajectory
        Named in the error.

    Raises
    ------
    AuditError
    """
    if abs(helm) > np.radians(1.0) and np.sign(helm) != side:
        raise AuditError(
            f"the ship turns to {'starboard' if side > 0 else 'port'} with the rudder to "
            f"{'starboard' if helm > 0 else 'port'}",
            cure="a laboratory may count rudder to port positive: read it with signs={'delta': -1}",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )


def state_or_nan(channels: SampledChannels, moment: float) -> FloatArray:
    """State at a moment, shape (11,); NaN for a moment that is NaN: the event did not occur."""
    return np.full(len(COLUMNS), np.nan) if np.isnan(moment) else channels.state(moment)


def settled_end(channels: SampledChannels, rows: FloatArray) -> FloatArray:
    """State at the last of `rows`; of a noisy record, the means over them of what should be steady by then."""
    last = float(channels.time[rows][-1])
    state = channels.state(last)
    if channels.half_width == 0.0 or np.count_nonzero(rows) < 3:
        return state
    for name in ("u", "v", "phi", "p", "delta", "n"):
        if name in channels.channels:
            state[COLUMN_NUMBER[name]] = np.mean(channels.channels[name][rows])
    time = channels.time[rows] - last
    slope = np.polynomial.polynomial.polyfit(time, channels.channels["psi"][rows], 1)[1]
    state[COLUMN_NUMBER["r"]] = slope
    return state
