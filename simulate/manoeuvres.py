"""Standard manoeuvres as programmes. Angles in degrees, positive to starboard; ITTC 7.5-04-02-01."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ..core.errors import SimulationError
from .parameters import Condition, Order
from .programme import MAXIMUM_HEEL, End, Phase, Programme

STEADY = 1e-4
"""Acceleration, in units of U0**2/L and (U0/L)**2, below which a motion is steady."""

STEADIED = 0.01
"""The same for a ship that has been steadied on a course: she still gains the last twentieth of her speed."""


def turning(rudder: float = 35.0, heading: float = 540.0) -> Programme:
    """Turning circle: rudder to `rudder` degrees until the heading has changed by `heading` degrees.

    Events: ``execute``; ``heading 10``, ``20``, ``30``, ``60`` and every 90 up to the end; ``maximum advance``,
    ``maximum transfer``; ``maximum heel`` (largest roll angle to the outer side, at its extreme) of a ship that rolls;
    ``end``.
    """
    side = _side(rudder)
    marks = [mark for mark in (10, 20, 30, 60, *range(90, int(heading), 90)) if mark < heading]
    watched = {f"heading {mark}": End(Condition.TURNED, math.radians(mark), side) for mark in marks}
    watched["maximum advance"] = End(Condition.ADVANCE_RATE)
    watched["maximum transfer"] = End(Condition.TRANSFER_RATE, 0.0, side)
    watched[MAXIMUM_HEEL] = End(Condition.ROLL_RATE, 0.0, side)
    end = End(Condition.TURNED, math.radians(heading), side)
    phase = Phase(target=math.radians(rudder), end=end, execute=True, begins="execute", ends="end")
    return Programme(f"turning {rudder:+g}", (phase,), watched, choices={"rudder [deg]": rudder})


def zigzag(rudder: float = 10.0, heading: float | None = None, overshoots: int = 3) -> Programme:
    """Zig-zag: the rudder is reversed whenever the heading has changed by `heading` degrees to the rudder's side.

    Parameters
    ----------
    rudder : float
        First rudder angle in degrees; positive executes to starboard first.
    heading : float, optional
        Switching heading in degrees; ``abs(rudder)`` when not given.
    overshoots : int
        Number of heading extremes, after which the manoeuvre ends.

    Notes
    -----
    Events: ``execute 1``, ``execute 2``, ``extreme 1`` (yaw rate zero after execute 2), ``return 1`` (heading back at
    the original course, before execute 3), ..., ``end``.
    """
    side = _side(rudder)
    switch = math.radians(abs(rudder) if heading is None else heading)
    if not 0.0 < switch < 0.5 * math.pi:
        raise SimulationError(
            f"a zig-zag cannot switch at {math.degrees(switch):g} deg",
            cure="give a heading above 0 and below 90 deg",
        )
    angle = abs(math.radians(rudder))
    phases = [
        Phase(target=side * angle, end=End(Condition.TURNED, switch, side), execute=True, begins="execute 1")
    ]
    for number in range(2, overshoots + 2):
        side = -side
        watched = {f"extreme {number - 1}": End(Condition.YAW_RATE, 0.0, -side)}
        last = number == overshoots + 1
        if not last:
            watched[f"return {number - 1}"] = End(Condition.TURNED, 0.0, side)
        phases.append(
            Phase(
                target=side * angle,
                end=End(Condition.YAW_RATE, 0.0, -side) if last else End(Condition.TURNED, switch, side),
                begins=f"execute {number}",
                ends="end" if last else "",
                watched=watched,
            )
        )
    name = f"zigzag {rudder:+g}/{math.degrees(switch):g}"
    return Programme(name, tuple(phases), choices={"rudder [deg]": rudder, "heading [deg]": math.degrees(switch)})


def _side(rudder: float) -> float:
    if rudder == 0.0:
        raise SimulationError("a rudder angle of 0 turns to neither side", cure="give an angle in degrees")
    return math.copysign(1.0, rudder)


def initial_turning(rudder: float = 10.0, heading: float = 10.0) -> Programme:
    """Initial turning: rudder to `rudder` degrees until the heading has changed by `heading` degrees.

    Events: ``execute``; ``heading 10`` (or the heading given); ``end``.
    """
    side = _side(rudder)
    end = End(Condition.TURNED, math.radians(heading), side)
    phase = Phase(
        target=math.radians(rudder), end=end, execute=True, begins="execute", ends=f"heading {heading:g}"
    )
    return Programme(
        f"initial turning {rudder:+g}",
        (phase, Phase(target=math.radians(rudder), duration=0.0, may_run_out=True, ends="end")),
        choices={"rudder [deg]": rudder, "heading [deg]": heading},
    )


def pull_out(rudder: float = 20.0, duration: float | None = None, steady: float = STEADY) -> Programme:
    """Pull-out: from a steady turn the rudder is put amidships, until the yaw rate is steady again.

    Parameters
    ----------
    rudder : float
        Rudder angle of the turn in degrees.
    duration : float, optional
        Time in s with the rudder amidships; until the motion is steady when not given.
    steady : float
        Acceleration in units of U0 and L below which a motion is steady.

    Notes
    -----
    Events: ``turn`` (rudder to the turn), ``execute`` (rudder amidships), ``end``.
    """
    side = _side(rudder)
    until = End(Condition.STEADY, steady)
    turn = Phase(target=side * abs(math.radians(rudder)), end=until, execute=True, begins="turn")
    out = Phase(
        end=None if duration is not None else until,
        duration=math.inf if duration is None else duration,
        may_run_out=duration is not None,
        execute=True,
        begins="execute",
        ends="end",
    )
    return Programme(
        f"pull-out {rudder:+g}", (turn, out), choices={"rudder [deg]": rudder, "steady below": steady}
    )


def spiral(
    angles: Sequence[float] = (25, 20, 15, 10, 5, 3, 1, 0, -1, -3, -5, -10, -15, -20, -25),
    there_and_back: bool = True,
    steady: float = STEADY,
) -> Programme:
    """Direct spiral (Dieudonne): steady yaw rate at each of a row of rudder angles, then back.

    Events: ``execute``; ``steady 1``, ``steady 2``, ... at the end of each rudder angle; ``end``. The rudder angle
    and the yaw rate of each are in its row.
    """
    way = [*angles, *list(angles)[-2::-1]] if there_and_back else list(angles)
    phases = [
        Phase(
            target=math.radians(angle),
            end=End(Condition.STEADY, steady),
            execute=number == 1,
            begins="execute" if number == 1 else "",
            ends=f"steady {number}",
        )
        for number, angle in enumerate(way, start=1)
    ]
    return _closed("spiral", phases, {"rudder angles [deg]": tuple(way), "steady below": steady})


def reverse_spiral(
    yaw_rates: Sequence[float],
    gain: float,
    integral: float,
    steady: float = STEADY,
) -> Programme:
    """Reverse spiral (Bech): the rudder angle that holds each of a row of yaw rates, by an autopilot.

    Parameters
    ----------
    yaw_rates : sequence of float
        Degrees a second, positive to starboard, in the order in which they are sailed.
    gain : float
        Rudder angle over the error of the yaw rate, s.
    integral : float
        Rudder angle over the integral of the error.
    steady : float
        Acceleration in units of U0 and L below which a motion is steady.

    Notes
    -----
    Events: ``execute``; ``steady 1``, ...; ``end``. An unstable ship has steady points here that the direct spiral
    cannot reach.
    """
    phases = [
        Phase(
            order=Order.YAW_RATE,
            target=math.radians(rate),
            gains=(gain, 0.0, integral),
            end=End(Condition.STEADY, steady),
            execute=number == 1,
            begins="execute" if number == 1 else "",
            ends=f"steady {number}",
        )
        for number, rate in enumerate(yaw_rates, start=1)
    ]
    choices = {"yaw rates [deg/s]": tuple(yaw_rates), "gain [s]": gain, "integral gain": integral}
    return _closed("reverse spiral", phases, choices)


def crash_stop(astern: float = 1.0) -> Programme:
    """Crash stop: propeller astern at `astern` times the rate of the approach, rudder amidships, until u = 0.

    Events: ``execute``; ``speed 90``, ``speed 80``, ... ``speed 10`` (per cent of the approach); ``stopped``.
    """
    if not astern > 0.0:
        raise SimulationError(f"a crash stop with {astern} times the rate astern does not stop")
    phase = Phase(
        rate=-astern,
        rate_is_factor=True,
        end=End(Condition.SURGE, 0.0, -1.0),
        execute=True,
        begins="execute",
        ends="stopped",
        watched={f"speed {share}": End(Condition.SURGE, share / 100.0, -1.0) for share in range(90, 0, -10)},
    )
    return Programme("crash stop", (phase,), choices={"rate astern over rate ahead": astern})


def williamson(
    rudder: float = 35.0,
    first: float = 60.0,
    short: float = 20.0,
    gain: float = 1.0,
    integral: float = 0.05,
    steady: float = STEADIED,
) -> Programme:
    """Williamson turn: back on the reciprocal course, on the own track, and steadied there.

    Parameters
    ----------
    rudder : float
        Rudder angle in degrees, first to its side.
    first : float
        Heading change at which the rudder is put over to the other side.
    short : float
        Degrees short of the reciprocal course at which the autopilot takes over.
    gain : float
        Rudder angle over course error of that autopilot; its yaw rate gain is one ship length of the approach.
    integral : float
        Rudder angle over the integral of the course error in U0/L, once the course is reached: a ship that carries
        weather helm is held on the course, not beside it.
    steady : float
        Acceleration in units of U0 and L below which the ship is steady on the reciprocal course.

    Notes
    -----
    Events: ``execute``; ``shift`` (rudder to the other side); ``reciprocal less`` (autopilot takes over);
    ``reciprocal`` (heading first within 1 degree of the reciprocal course); ``extreme`` (heading furthest beyond it;
    none when the ship does not swing over); ``end`` (steady on the reciprocal course, her speed regained).
    """
    side = _side(rudder)
    angle = abs(math.radians(rudder))
    turn = Phase(
        target=side * angle,
        end=End(Condition.TURNED, math.radians(first), side),
        execute=True,
        begins="execute",
        ends="shift",
    )
    back = Phase(
        target=-side * angle,
        end=End(Condition.TURNED, math.pi - math.radians(short), -side),
        ends="reciprocal less",
    )
    meet = Phase(
        order=Order.COURSE,
        target=-side * math.pi,
        gains=(gain, gain, 0.0),
        gains_scaled=True,
        end=End(Condition.TURNED, math.pi - math.radians(1.0), -side),
        ends="reciprocal",
    )
    hold = replace(
        meet,
        gains=(gain, gain, integral),
        end=End(Condition.STEADY, steady),
        ends="end",
        watched={"extreme": End(Condition.YAW_RATE, 0.0, -side)},
    )
    choices = {
        "rudder [deg]": rudder,
        "first [deg]": first,
        "short [deg]": short,
        "gain": gain,
        "integral gain [U0/L]": integral,
        "steady below": steady,
    }
    return Programme(f"williamson {rudder:+g}", (turn, back, meet, hold), choices=choices)


def course_keeping(
    duration: float,
    gain: float = 1.0,
    yaw_gain: float = 0.0,
    integral: float = 0.0,
    course: float = 0.0,
) -> Programme:
    """Course keeping or change by a three-term autopilot, ``delta = gain (course - psi) - yaw_gain r + integral``.

    Parameters
    ----------
    duration : float
        Time in s.
    gain : float
        Rudder angle over course error.
    yaw_gain : float
        Rudder angle over yaw rate, s.
    integral : float
        Rudder angle over the integral of the course error, 1/s.
    course : float
        Course in degrees, positive to starboard of the initial one.

    Notes
    -----
    Events: ``execute``, ``end``.
    """
    if not (math.isfinite(gain) and math.isfinite(yaw_gain) and math.isfinite(integral)):
        raise SimulationError(f"gains {gain}, {yaw_gain}, {integral} of an autopilot", cure="give finite numbers")
    if not abs(course) <= 360.0:
        raise SimulationError(f"a course of {course:g} deg", cure="give -360 to 360 deg from the original course")
    phase = Phase(
        order=Order.COURSE,
        target=math.radians(course),
        gains=(gain, yaw_gain, integral),
        duration=duration,
        may_run_out=True,
        execute=True,
        begins="execute",
        ends="end",
    )
    choices = {"gain": gain, "yaw gain [s]": yaw_gain, "integral gain [1/s]": integral, "course [deg]": course}
    return Programme("course keeping", (phase,), choices=choices)


def schedule(
    time: Sequence[float] | np.ndarray,
    rudder: Sequence[float] | np.ndarray,
    rate: Sequence[float] | np.ndarray | None = None,
) -> Programme:
    """Rudder angles, and propeller rates, as they were in a trial; linear between the given times.

    Parameters
    ----------
    time : array_like, shape (n,)
        s, ascending; the motion begins at the first.
    rudder : array_like, shape (n,)
        Rudder angle as it was, not as ordered, in degrees.
    rate : array_like, shape (n,), optional
        Propeller rate in 1/s; that of the approach throughout when not given.

    Notes
    -----
    Events: ``execute``, ``end``.
    """
    t = np.asarray(time, dtype=float)
    n = np.full(len(t), np.nan) if rate is None else np.asarray(rate, dtype=float)
    table = np.column_stack([t, np.radians(np.asarray(rudder, dtype=float)), n])
    if len(t) < 2 or not np.all(np.isfinite(table[:, :2])):
        raise SimulationError(
            "a schedule needs two or more rows of time and rudder angle, without blanks",
            cure="fill or remove the incomplete rows",
        )
    phase = Phase(
        order=Order.SCHEDULE,
        duration=float(t[-1] - t[0]),
        may_run_out=True,
        execute=True,
        begins="execute",
        ends="end",
    )
    return Programme("schedule", (phase,), schedule=table)


def _closed(name: str, phases: list[Phase], choices: dict[str, Any]) -> Programme:
    """Programme whose last phase also marks the event ``end``."""
    last = phases[-1]
    finish = replace(last, end=None, duration=0.0, may_run_out=True, execute=False, begins="", ends="end")
    return Programme(name, (*phases, finish), choices=choices)
