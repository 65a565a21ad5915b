"""Events found in a sampled trajectory: measured ones, or time series of other programs.

Events are located between the samples. The extremes of a zig-zag are looked for between the reversals of the rudder,
so that noise on the heading makes none.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np

from ..core.errors import ReadError
from .events import COLUMN_NUMBER, Events, FloatArray
from .found_spirals import find_spiral
from .found_states import order_time, same_side, settled_end, single, state_or_nan, turned
from .manoeuvre_names import NamedManoeuvre, read_manoeuvre_name
from .rudder_history import RudderPhase, rudder_phases, step_start
from .sampled_channels import SampledChannels
from .trajectory import Trajectory
from .trajectory_checks import audit_channels, check_samples

SETTLED_HEADING = np.radians(90.0)
"""Heading change at the end of a turn over which a noisy record is averaged."""

LEAST_TURN = np.radians(5.0)
"""A record with less heading change than this holds no turn."""

STEADY_COURSE = 5.0
"""Degrees beside the reciprocal course within which the record of a Williamson turn ends."""

STOPPED = 0.005
"""A record that ends with less than this share of the approach speed ends at the stop."""

SPEED_EVENTS = tuple(range(90, 0, -10))
"""Per cent of the approach speed at which a stopping ship is noted, so that its track can be measured."""


def find_events(
    trajectory: Trajectory, *, execute: float | None = None, half_width: float | None = None
) -> Events:
    """Events of a sampled manoeuvre.

    Parameters
    ----------
    trajectory : Trajectory
        Its `manoeuvre` says what to look for; a turn or a stop needs ``time, x, y, psi``, a zig-zag or a spiral
        ``time, psi, delta``, a Williamson turn all of these. Yaw rate and velocities that were not recorded follow
        from heading and track. The record of a Williamson turn ends when the ship is steady on the reciprocal course.
    execute : float, optional
        Time of the first order in s; default where the rudder (the propeller, for a crash stop) begins to move.
    half_width : float, optional
        Half of the smoothing window in s; 0 interpolates. Default 0 for clean samples, else the time in which
        the ship turns by 3 degrees.

    Returns
    -------
    Events
        One draw, with the names of simulated manoeuvres. Of a noisy record, velocities, angles and rates at ``"end"``
        are means over the last 90 degrees of heading (turning) or the last tenth of the record (pull-out), and those
        of a spiral over the last quarter of each rudder angle (or yaw rate, in a reverse spiral).

    Raises
    ------
    ReadError, AuditError
        For missing channels or values, gaps, a rudder that does not move, a heading that does not change, channels
        that contradict each other.
    """
    named = read_manoeuvre_name(trajectory.manoeuvre)
    finder, needed = _FINDERS[named.kind]
    check_samples(trajectory, ("time", "psi", *needed))
    audit_channels(trajectory)
    return finder(trajectory, SampledChannels(trajectory, half_width), named, execute)


def with_events(trajectory: Trajectory, *, execute: float | None = None) -> Trajectory:
    """The trajectory with its events; as it is if it has some."""
    if trajectory.events is not None:
        return trajectory
    return replace(trajectory, events=find_events(trajectory, execute=execute))


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
        same_side(side, helm, trajectory)
    return side


def _at_headings(channels: SampledChannels, headings: list[int], begin: float) -> dict[str, FloatArray]:
    """States at headings turned since execute; NaN where they were not reached."""
    found = {}
    for heading in headings:
        moment = channels.crossing("turned", np.radians(heading), begin, float(channels.time[-1]))
        found[f"heading {heading}"] = state_or_nan(channels, moment)
    return found


def _turning(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = order_time(trajectory, execute)
    start = channels.state(begin)
    side = _side_of_turn(trajectory, channels, begin)
    turned(channels, start, side)
    most = float(np.degrees(channels.channels["turned"].max()))
    headings = [10, 20, 30, 60, *range(90, max(int(most), 180) + 1, 90)]
    found = {"execute": start, **_at_headings(channels, headings, begin)}
    found |= _extremes_of_track(channels, start, side, begin)
    if "phi" in trajectory:
        found["maximum heel"] = state_or_nan(channels, _first_heel(channels, begin))
    last = channels.channels["turned"] >= channels.channels["turned"].max() - SETTLED_HEADING
    found["end"] = settled_end(channels, last & (channels.time > begin))
    return single(found)


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
        found[name] = state_or_nan(channels, channels.highest(channel, begin, before))
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
    turned(channels, start, _side_of_turn(trajectory, channels, begin))
    found = {"execute": start, **_at_headings(channels, [10], begin)}
    return single({**found, "end": channels.state(float(channels.time[-1]))})


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
    return single({"execute": channels.state(begin), "end": settled_end(channels, last)})


def _crash_stop(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    begin = order_time(trajectory, execute, "n")
    start = channels.state(begin)
    end = float(channels.time[-1])
    found = {"execute": start}
    for share in SPEED_EVENTS:
        level = 0.01 * share * start[COLUMN_NUMBER["u"]]
        found[f"speed {share}"] = state_or_nan(channels, channels.crossing("u", level, begin, end, rising=False))
    stopped = channels.crossing("u", 0.0, begin, end, rising=False)
    if np.isnan(stopped) and abs(channels.value("u", end)) < STOPPED * start[COLUMN_NUMBER["u"]]:
        stopped = end
    found["stopped"] = state_or_nan(channels, stopped)
    return single({**found, "end": channels.state(end)})


def _williamson(
    trajectory: Trajectory, channels: SampledChannels, named: NamedManoeuvre, execute: float | None
) -> Events:
    where: dict[str, Any] = {"file": trajectory.source or None, "place": trajectory.manoeuvre}
    phases = rudder_phases(channels.time, trajectory["delta"])
    delta = trajectory["delta"] - trajectory["delta"][0]
    if len(phases) < 2 or min(delta.max(), -delta.min()) < 0.2 * np.ptp(delta):
        raise ReadError(
            "the rudder is never put over to the other side: this is no Williamson turn",
            cure="check the column of the rudder, or name the manoeuvre 'turning'",
            **where,
        )
    start = channels.state(order_time(trajectory, execute))
    shift = channels.state(phases[1].ordered)
    psi = COLUMN_NUMBER["psi"]
    side = phases[0].side
    same_side(float(np.sign(shift[psi] - start[psi])), side, trajectory)
    turned(channels, start, -side)
    end = float(channels.time[-1])
    reached = channels.crossing("turned", np.radians(179.0), float(shift[0]), end)
    left = float(np.degrees(channels.channels["turned"][-1])) - 180.0
    if np.isnan(reached) or abs(left) > STEADY_COURSE:
        raise ReadError(
            f"the record ends {abs(left):.3g} deg beside the reciprocal course",
            cure="give the record until the ship is steady on that course",
            **where,
        )
    found = {"execute": start, "shift": shift, "reciprocal": channels.state(reached)}
    beyond = channels.highest("turned", reached, end)
    found["extreme"] = state_or_nan(channels, beyond)
    return single({**found, "end": channels.state(end)})


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
        found[f"execute {number}"] = state_or_nan(channels, moment)
    if len(executes) < 2:
        raise ReadError(
            "the rudder is never reversed in this record: this is no zig-zag",
            cure="check the column of the rudder, or name the manoeuvre 'turning'",
            file=trajectory.source or None,
            place=trajectory.manoeuvre,
        )
    psi = COLUMN_NUMBER["psi"]
    same_side(float(np.sign(found["execute 2"][psi] - start[psi])), phases[0].side, trajectory)
    for number, (phase, after) in enumerate(zip(phases, executes[1:]), start=1):
        before = executes[number + 1] if number + 1 < len(executes) else end
        turned(channels, start, phase.side)
        peak = channels.highest("turned", after, before)
        found[f"extreme {number}"] = state_or_nan(channels, peak)
        if not np.isnan(peak):
            back = channels.crossing("turned", 0.0, peak, end, rising=False)
            found[f"return {number}"] = state_or_nan(channels, back)
    return single({**found, "end": channels.state(end)})


def _reversals(
    channels: SampledChannels, phases: list[RudderPhase], named: NamedManoeuvre, start: FloatArray
) -> list[float]:
    """Moments of the executes that reverse the rudder: at the switching heading, or when the rudder begins to move."""
    moments = []
    for before, phase in pairwise(phases):
        moment = phase.ordered
        if named.heading is not None:
            turned(channels, start, before.side)
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
    "williamson": (_williamson, ("x", "y", "delta")),
    "spiral": (find_spiral, ("delta",)),
    "reverse spiral": (find_spiral, ("delta",)),
}
