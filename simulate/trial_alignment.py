"""A trial laid beside a simulated manoeuvre: from its first order on, in axes that begin there."""

from __future__ import annotations

import math

import numpy as np

from ..core.errors import ReadError
from .manoeuvre_names import read_manoeuvre_name
from .manoeuvres import schedule
from .programme import Programme
from .trajectory import Trajectory
from .vessel import Vessel

FloatArray = np.ndarray

SLOWEST, FASTEST = 0.2, 2.5
"""Approach speed of a trial over that of the ship; beyond, one of them is at another scale."""


def from_order(trial: Trajectory, begin: float) -> Trajectory:
    """The trial from the first order on, in axes that begin there with the course of the approach.

    Parameters
    ----------
    trial : Trajectory
    begin : float
        Time of the first order in s.
    """
    rows = trial["time"] > begin
    course = _at_time(trial, "psi", begin)
    columns = {name: _from(trial, name, begin) for name in map(str, trial.frame.columns)}
    columns["time"] = columns["time"] - begin
    columns["psi"] = columns["psi"] - course
    if "x" in trial and "y" in trial:
        north = columns["x"] - _at_time(trial, "x", begin)
        east = columns["y"] - _at_time(trial, "y", begin)
        columns["x"] = north * math.cos(course) + east * math.sin(course)
        columns["y"] = east * math.cos(course) - north * math.sin(course)
    if rows.sum() < 8:
        raise ReadError(
            f"{rows.sum()} samples after the first order at {begin:g} s do not describe a manoeuvre",
            cure="give a longer record",
            file=trial.source or None,
        )
    return Trajectory.from_columns(
        columns,
        trial.ship,
        trial.manoeuvre,
        source=trial.source,
        provenance=trial.provenance.and_then(f"time, place and course from the first order at {begin:.6g} s"),
    )


def approach_speed(trial: Trajectory, begin: float) -> float:
    """Mean speed before the first order, or at it where the record begins there, in m/s."""
    before = trial["time"] <= begin + 1e-9
    speeds = trial.speed()
    speed = float(np.mean(speeds[before])) if before.any() else float(speeds[0])
    if not speed > 0.0:
        raise ReadError(
            "the trial has no approach speed",
            cure="give u and v, or x and y, from before the first order; or the speed",
            file=trial.source or None,
        )
    return speed


def _at_time(trial: Trajectory, channel: str, time: float) -> float:
    return float(np.interp(time, trial["time"], trial[channel]))


def replayed(trial: Trajectory, begin: float) -> Programme:
    """Programme of the trial's own rudder, and propeller where it was recorded, from the first order on."""
    if "delta" not in trial:
        raise ReadError(
            "the trial has no rudder angle to be sailed again",
            cure="record 'delta [deg]', or name the manoeuvre",
            file=trial.source or None,
        )
    rate = _from(trial, "n", begin) if "n" in trial else None
    return schedule(_from(trial, "time", begin) - begin, np.degrees(_from(trial, "delta", begin)), rate)


def _from(trial: Trajectory, channel: str, begin: float) -> FloatArray:
    """A channel from a time on, its value at that time in front."""
    return np.concatenate([[_at_time(trial, channel, begin)], trial[channel][trial["time"] > begin]])


def require_scale(trial: Trajectory, speed: float, vessel: Vessel) -> None:
    """Refuse a trial that approaches with a speed at which a ship of this size is not tried: it has another scale."""
    ratio = speed / vessel.speed
    if not SLOWEST < ratio < FASTEST:
        raise ReadError(
            f"the trial approaches with {speed:.4g} m/s, '{vessel.name}' of {vessel.ship.L:.4g} m is sailed at"
            f" {vessel.speed:.4g} m/s",
            cure="give a ship at the scale of the trial, check the unit of its speed, or say --speed",
            file=trial.source or None,
        )


def require_side(measured: Trajectory) -> None:
    """Refuse a rudder that goes to the other side first than the name of the manoeuvre says."""
    named = read_manoeuvre_name(measured.manoeuvre)
    if named.rudder is None or "delta" not in measured:
        return
    delta = measured["delta"] - measured["delta"][0]
    first = float(delta[int(np.argmax(np.abs(delta) > 0.5 * np.abs(delta).max()))])
    if first * named.rudder < 0.0:
        sides = ("starboard", "port") if first > 0.0 else ("port", "starboard")
        raise ReadError(
            f"the rudder goes to {sides[0]} first, that of '{measured.manoeuvre}' to {sides[1]}",
            cure="name the other side, or turn the sign of the rudder angle (--rudder-port)",
            file=measured.source or None,
        )


def require_approach(measured: Trajectory) -> None:
    """Refuse the record of a pull-out that begins in the turn: it is sailed from the straight approach on."""
    if not measured.manoeuvre.startswith("pull-out") or len(measured) < 2:
        return
    rate = np.gradient(measured["psi"], measured["time"])
    if abs(float(rate[0])) > 0.5 * float(np.abs(rate).max()):
        raise ReadError(
            "the record of this pull-out begins in the turn",
            cure="give it from the straight approach on, or index it alone",
            file=measured.source or None,
        )
