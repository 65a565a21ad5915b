"""Faults of measured trajectories that would make their indices wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import AuditError, ReadError
from .events import FloatArray
from .trajectory import Trajectory

LONGEST_GAP = 0.05
"""A gap longer than this share of the record, and than five sampling intervals, is refused."""

MOST_TURNS, MOST_TURNS_OF_A_SPIRAL = 10, 40
"""Turns of the heading in a record; more are degrees that were taken for radians."""

LEAST_HEADING = np.radians(0.1)
"""A straight course holds no yaw rate to be compared with the slope of the heading."""

_DEGREE, _MINUTE = 180.0 / np.pi, 60.0

_YAW_RATE_FAULTS = (
    (-1.0, "the signs differ: give signs={'r': -1} or signs={'psi': -1}"),
    (_DEGREE, "the yaw rate is in degrees, or the heading is not: mend the unit in its heading"),
    (1.0 / _DEGREE, "the heading is in degrees, or the yaw rate is not: mend the unit in its heading"),
    (_MINUTE, "the yaw rate is by the minute: mend the unit in its heading"),
    (1.0 / _MINUTE, "the yaw rate is by the second: mend the unit in its heading"),
)

_AGREES = 0.85
"""Correlation of two channels above which their ratio is judged."""


def check_samples(trajectory: Trajectory, needed: tuple[str, ...], file: str | Path | None = None) -> None:
    """Refuse missing channels, missing values, times out of order, and gaps.

    Parameters
    ----------
    trajectory : Trajectory
    needed : tuple of str
        Channels without which the manoeuvre has no indices.

    Raises
    ------
    ReadError
        Naming the channel, the row (from 1) or the time, and the cure.
    """
    where: dict[str, Any] = {"file": file or trajectory.source or None}
    missing = [name for name in needed if name not in trajectory]
    if missing:
        raise ReadError(
            f"channels missing for a {trajectory.manoeuvre or 'manoeuvre'}: {', '.join(missing)}",
            cure=f"the trajectory has {', '.join(map(str, trajectory.frame.columns))}; record or derive the others",
            **where,
        )
    if len(trajectory) < 8:
        raise ReadError(
            f"{len(trajectory)} samples do not describe a manoeuvre",
            cure="give at least 8, in practice ten or more a ship length",
            **where,
        )
    for name in ("time", *needed):
        bad = np.flatnonzero(~np.isfinite(trajectory[name]))
        if len(bad):
            raise ReadError(
                f"'{name}' has no value in {len(bad)} of {len(trajectory)} samples",
                cure="cut these samples out, or fill them knowingly",
                place=f"sample {bad[0] + 1}",
                **where,
            )
    _check_time(trajectory["time"], where)


def _check_time(time: FloatArray, where: dict[str, Any]) -> None:
    steps = np.diff(time)
    backward = np.flatnonzero(steps <= 0.0)
    if len(backward):
        row = int(backward[0])
        raise ReadError(
            f"time does not increase: {time[row + 1]:g} s follows {time[row]:g} s",
            cure="remove repeated or overlapping samples",
            place=f"sample {row + 2}",
            **where,
        )
    longest = int(np.argmax(steps))
    if steps[longest] > max(5.0 * float(np.median(steps)), LONGEST_GAP * float(time[-1] - time[0])):
        raise ReadError(
            f"a gap of {steps[longest]:.4g} s after {time[longest]:.6g} s; samples come every "
            f"{np.median(steps):.4g} s elsewhere",
            cure="cut the record at the gap, or fill it knowingly",
            place=f"sample {longest + 1}",
            **where,
        )


def audit_channels(trajectory: Trajectory, file: str | Path | None = None) -> None:
    """Refuse channels that contradict each other: units, signs, axes.

    The yaw rate must be the slope of the heading, and the speed through the water near the speed of the track.

    Raises
    ------
    AuditError
        Naming the channel, what was seen and expected, and the cure.
    """
    where: dict[str, Any] = {"file": file or trajectory.source or None}
    if "psi" not in trajectory or len(trajectory) < 8:
        return
    psi, time = trajectory["psi"], trajectory["time"]
    most = MOST_TURNS_OF_A_SPIRAL if "spiral" in trajectory.manoeuvre.lower() else MOST_TURNS
    if np.ptp(psi) > 2.0 * np.pi * most:
        raise AuditError(
            f"'psi' spans {np.ptp(psi):.4g} rad, {np.ptp(psi) / (2.0 * np.pi):.0f} turns",
            cure="write the unit 'psi [deg]' if it is in degrees",
            **where,
        )
    if "r" in trajectory and np.ptp(psi) > LEAST_HEADING:
        _audit_yaw_rate(time, psi, trajectory["r"], where)
    if all(name in trajectory for name in ("x", "y", "u", "v")):
        _audit_velocity(trajectory, where)


def _audit_yaw_rate(time: FloatArray, psi: FloatArray, r: FloatArray, where: dict[str, Any]) -> None:
    # Compared as headings: integrating averages noise, differentiating would magnify it.
    steps = np.diff(time)
    turned = np.concatenate([[0.0], np.cumsum(0.5 * (r[1:] + r[:-1]) * steps)])
    slope = _ratio(turned, psi)
    if slope is None or 0.8 < slope < 1.25:
        return
    cure = "mend the unit of the yaw rate in its heading, or leave the channel out"
    for factor, reason in _YAW_RATE_FAULTS:
        if abs(slope / factor - 1.0) < 0.025:
            cure = reason
    raise AuditError(f"'r' is {slope:.3g} times the slope of 'psi'", cure=cure, **where)


def _audit_velocity(trajectory: Trajectory, where: dict[str, Any]) -> None:
    north, east = trajectory.track_velocity()
    track = np.hypot(north, east)
    ratio = float(np.median(trajectory.speed()) / np.median(track)) if np.median(track) > 0.0 else 1.0
    for factor, unit in ((0.5144, "m/s read for a track in knots"), (1.9438, "knots"), (3.6, "km/h")):
        if abs(ratio / factor - 1.0) < 0.05:
            raise AuditError(
                f"the speed of u and v is {ratio:.3g} times that of the track",
                cure=f"this is the ratio of {unit}; mend the unit in the headings of u and v",
                **where,
            )
    psi = trajectory["psi"]
    turned = np.ptp(psi) > np.radians(60.0)
    body = np.hypot(
        north - trajectory["u"] * np.cos(psi) + trajectory["v"] * np.sin(psi),
        east - trajectory["u"] * np.sin(psi) - trajectory["v"] * np.cos(psi),
    )
    earth = np.hypot(north - trajectory["u"], east - trajectory["v"])
    if turned and np.median(earth) < 0.1 * np.median(track) and np.median(body) > 0.3 * np.median(track):
        raise AuditError(
            "u and v are the velocities along the earth-fixed axes",
            cure="turn them into the axes of the ship, or leave them out: they follow from the track",
            **where,
        )


def _ratio(values: FloatArray, reference: FloatArray) -> float | None:
    """Slope of `values` over `reference`, both from their first value; None when they are hardly related."""
    y, x = values - values[0], reference - reference[0]
    if not (np.isfinite(y).all() and np.isfinite(x).all()) or np.ptp(x) == 0.0 or np.ptp(y) == 0.0:
        return None
    correlation = float(x @ y) / float(np.linalg.norm(x) * np.linalg.norm(y))
    return float(x @ y) / float(x @ x) if abs(correlation) > _AGREES else None
