"""Events found in a sampled trajectory: measured ones, or time series of other programs.

Events are located between the samples. The extremes of a zig-zag are looked for between the reversals of the rudder,
so that noise on the heading makes none.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np

from ..core.errors import AuditError, ReadError, TowtankError
from .events import COLUMN_NUMBER, COLUMNS, Events, FloatArray
from .manoeuvre_names import NamedManoeuvre, read_manoeuvre_name
from .rudder_history import RudderPhase, rudder_phases, step_start
from .sampled_channels import SampledChannels
from .trajectory import Trajectory
from .trajectory_checks import audit_channels, check_samples

SETTLED_HEADING = np.radians(90.0)
"""Heading change at the end of a turn over which a noisy record is averaged."""

LEAST_TURN = np.radians(5.0)
"""A record with less heading change than this holds no turn."""

SPEED_EVENTS = tuple(range(90, 0, -10))
"""Per cent of the approach speed at which a stopping ship is noted, so that its track can be measured."""


def find_events(
    trajectory: Trajectory, *, execute: float | None = None, half_width: float | None = None
) -> Events:
    """Events of a sampled manoeuvre.

    Parameters
    ----------
    trajectory : Trajectory
        Its `manoeuvre` says what to look for; a turn or a stop needs ``time, x, y, psi``, a zig-zag ``time, psi,
        delta``. Yaw rate and velocities that were not recorded follow from heading and track.
    execute : float, optional
        Time of the first order in s; default where the rudder (the propeller, for a crash stop) begins to move.
    half_width : float, optional
        Half of the smoothing window in s; 0 interpolates. Default 0 for clean samples, else the time in which
        the ship turns by 3 degrees.

    Returns
    -------
    Events
        One draw, with the names of simulated manoeuvres. Of a noisy record, velocities, angles and rates at ``"end"``
        are means over the last 90 degrees of heading (turning) or the last tenth of the record (pull-out).

    Raises
    ------
    ReadError, AuditError
        For missing channels or values, gaps, a rudder that does not move, a heading that does not change, channels
        that contradict each other.
    """
    named = read_manoeuvre_name(trajectory.manoeuvre)
    finder, needed = _FINDERS.get(named.kind, (None, ()))
    if finder is None:
        raise TowtankError(
            f"events of a {named.kind} are not looked for in samples",
            cure="of a spiral, give the steady rudder angles and yaw rates to spiral_indices; else give the events",
            place=trajectory.manoeuvre,
        )
    check_samples(trajectory, ("time", "psi", *needed))
    audit_channels(trajectory)
    return finder(trajectory, SampledChannels(trajectory, half_width), named, execute)


def with_events(trajectory: Trajectory, *, execute: float | None = None) -> Trajectory:
    """The trajectory with its events; as it is if it has some."""
    if trajectory.events is not None:
        return trajectory
    return replace(trajectory, events=find_events(trajectory, execute=execute))


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


def _single(found: dict[str, FloatArray]) -> Events:
    return Events({name: row[np.newaxis, :] for name, row in found.items()})


def _turned(channels: SampledChannels, start: FloatArray, side: float) -> None:
    """Add the heading turned since execute, positive to the side of the manoeuvre."""
    channels.add("turned", side * (channels.channels["psi"] - start[COLUMN_NUMBER["psi"]]))


def _side_of_turn(trajectory: Trajectory, channels: SampledChannels, begin: float) -> float:
    """+1 for a turn to starboard, -1 to port; the rudder must say the same."""
    late = channels.channels["psi"][channels.time > begin]
    change = float(late[-1] - channels.value("psi", begin)) if len(late) else 0.0
    if abs(change) < LEAST_TURN:
        raise ReadError(
            f"the heading changes by {np.degrees(abs(change)):.2g} deg after the order: this is no turn",
            cure="check the column of the heading, or cut the record to the manoeuvre",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
    side = float(np.sign(change))
    if "delta" in trajectory:
        rudder = trajectory["delta"]
        helm = float(np.median(rudder[channels.time > begin]) - np.median(rudder[channels.time <= begin]))
        _same_side(side, helm, trajectory)
    return side


def _same_side(side: float, helm: float, trajectory: Trajectory) -> None:
    if abs(helm) > np.radians(1.0) and np.sign(helm) != side:
        raise AuditError(
            f"the ship turns to {'starboard' if side > 0 else 'port'} with the rudder to "
            f"{'starboard' if helm > 0 else 'port'}",
            cure="a laboratory may count rudder to port positive: read it with signs={'delta': -1}",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )


def _at_headings(channels: SampledChannels, headings: list[int], begin: float) -> dict[str, FloatArray]:
    """States at headings turned since execute; NaN where they were not reached."""
    found = {}
    for heading in headings:
        moment = channels.crossing("turned", np.radians(heading), begin, float(channels.time[-1]))
        found[f"heading {heading}"] = _state_or_nan(channels, moment)
    return found


def _state_or_nan(channels: SampledChannels, moment: float) -> FloatArray:
    return np.full(len(COLUMNS), np.nan) if np.isnan(moment) else channels.state(moment)


def _settled_end(channels: SampledChannels, rows: FloatArray) -> FloatArray:
    """State at the last sample; of a noisy record, the means over `rows` of what should be steady by then."""
    state = channels.state(float(channels.time[-1]))
    if channels.half_width == 0.0 or np.count_nonzero(rows) < 3:
        return state
    for name in ("u", "v", "phi", "p", "delta", "n"):
        if name in channels.channels:
            state[COLUMN_NUMBER[name]] = np.mean(channels.channels[name][rows])
    time = channels.time[rows] - channels.time[-1]
    slope = np.polynomial.polynomial.polyfit(time, channels.channels["psi"][rows], 1)[1]
    state[COLUMN_NUMBER["r"]] = slope
    return state


def _turning(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = order_time(trajectory, execute)
    start = channels.state(begin)
    side = _side_of_turn(trajectory, channels, begin)
    _turned(channels, start, side)
    most = float(np.degrees(channels.channels["turned"].max()))
    headings = [10, 20, 30, 60, *range(90, max(int(most), 180) + 1, 90)]
    found = {"execute": start, **_at_headings(channels, headings, begin)}
    found |= _extremes_of_track(channels, start, side, begin)
    if "phi" in trajectory:
        found["maximum heel"] = _state_or_nan(channels, _first_heel(channels, begin))
    last = channels.channels["turned"] >= channels.channels["turned"].max() - SETTLED_HEADING
    found["end"] = _settled_end(channels, last & (channels.time > begin))
    return _single(found)


def _extremes_of_track(
    channels: SampledChannels, start: FloatArray, side: float, begin: float
) -> dict[str, FloatArray]:
    """Maximum advance and maximum transfer: where the track first turns back, within the first turn."""
    course = start[COLUMN_NUMBER["psi"]]
    dx = channels.channels["x"] - start[COLUMN_NUMBER["x"]]
    dy = channels.channels["y"] - start[COLUMN_NUMBER["y"]]
    channels.add("along", dx * np.cos(course) + dy * np.sin(course))
    channels.add("across", side * (dy * np.cos(course) - dx * np.sin(course)))
    found = {}
    # The track turns back when the course over ground passes 90 and 180 degrees: some drift angle later.
    for name, channel, until in (("maximum advance", "along", 225.0), ("maximum transfer", "across", 315.0)):
        beyond = np.flatnonzero(channels.channels["turned"] > np.radians(until))
        before = float(channels.time[beyond[0]]) if len(beyond) else float(channels.time[-1])
        found[name] = _state_or_nan(channels, channels.highest(channel, begin, before))
    return found


def _first_heel(channels: SampledChannels, begin: float) -> float:
    """Moment of the largest roll angle of either side after execute."""
    level = channels.value("phi", begin)
    channels.add("heel", np.abs(channels.channels["phi"] - level))
    return channels.highest("heel", begin, float(channels.time[-1]))


def _initial_turning(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = order_time(trajectory, execute)
    start = channels.state(begin)
    _turned(channels, start, _side_of_turn(trajectory, channels, begin))
    found = {"execute": start, **_at_headings(channels, [10], begin)}
    return _single({**found, "end": channels.state(float(channels.time[-1]))})


def _put_amidships(trajectory: Trajectory) -> float:
    """Time in s at which the rudder leaves the angle of the turn; the record may begin before the turn."""
    time, delta = trajectory["time"], trajectory["delta"]
    final = float(np.median(delta[-max(len(delta) // 20, 1) :]))
    away = np.abs(delta - final)
    held = int(np.argmax(away > 0.9 * away.max()))
    return step_start(time[held:], delta[held:])


def _pull_out(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = (
        _put_amidships(trajectory)
        if execute is None and "delta" in trajectory
        else order_time(trajectory, execute)
    )
    last = channels.time >= channels.time[-1] - 0.1 * (channels.time[-1] - begin)
    return _single({"execute": channels.state(begin), "end": _settled_end(channels, last)})


def _crash_stop(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = order_time(trajectory, execute, "n")
    start = channels.state(begin)
    end = float(channels.time[-1])
    found = {"execute": start}
    for share in SPEED_EVENTS:
        level = 0.01 * share * start[COLUMN_NUMBER["u"]]
        found[f"speed {share}"] = _state_or_nan(channels, channels.crossing("u", level, begin, end, rising=False))
    found["stopped"] = _state_or_nan(channels, channels.crossing("u", 0.0, begin, end, rising=False))
    return _single({**found, "end": channels.state(end)})


def _zigzag(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    phases = rudder_phases(channels.time, trajectory["delta"])
    if execute is not None:
        phases[0] = phases[0]._replace(ordered=order_time(trajectory, execute))
    start = channels.state(phases[0].ordered)
    end = float(channels.time[-1])
    found = {"execute 1": start}
    executes = [phases[0].ordered, *_reversals(channels, phases, named, start)]
    for number, moment in enumerate(executes[1:], start=2):
        found[f"execute {number}"] = _state_or_nan(channels, moment)
    if len(executes) < 2:
        raise ReadError(
            "the rudder is never reversed in this record: this is no zig-zag",
            cure="check the column of the rudder, or name the manoeuvre 'turning'",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
    psi = COLUMN_NUMBER["psi"]
    _same_side(float(np.sign(found["execute 2"][psi] - start[psi])), phases[0].side, trajectory)
    for number, (phase, after) in enumerate(zip(phases, executes[1:]), start=1):
        before = executes[number + 1] if number + 1 < len(executes) else end
        _turned(channels, start, phase.side)
        peak = channels.highest("turned", after, before)
        found[f"extreme {number}"] = _state_or_nan(channels, peak)
        if not np.isnan(peak):
            back = channels.crossing("turned", 0.0, peak, end, rising=False)
            found[f"return {number}"] = _state_or_nan(channels, back)
    return _single({**found, "end": channels.state(end)})


def _reversals(
    channels: SampledChannels, phases: list[RudderPhase], named: NamedManoeuvre, start: FloatArray
) -> list[float]:
    """Moments of the executes that reverse the rudder: at the switching heading, or when the rudder begins to move."""
    moments = []
    for before, phase in pairwise(phases):
        moment = phase.ordered
        if named.heading is not None:
            _turned(channels, start, before.side)
            # The helm answers within the time of its own travel; a crossing elsewhere belongs to noise or drift.
            travel = 2.0 * (phase.reached - phase.ordered)
            level = np.radians(named.heading)
            crossed = channels.crossing("turned", level, before.reached, phase.reached + travel)
            moment = phase.ordered if np.isnan(crossed) else crossed
        moments.append(moment)
    return moments


_Finder = Callable[[Trajectory, SampledChannels, NamedManoeuvre, float | None], Events]

_FINDERS: dict[str, tuple[_Finder, tuple[str, ...]]] = {
    "turning": (_turning, ("x", "y")),
    "initial turning": (_initial_turning, ("x", "y")),
    "pull-out": (_pull_out, ()),
    "crash stop": (_crash_stop, ("x", "y")),
    "zigzag": (_zigzag, ("delta",)),
}
