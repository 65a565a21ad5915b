"""Manoeuvres of the gallery: a vessel in, the indices that papers print out."""

from __future__ import annotations

import math

from ..simulate.events import Events
from ..simulate.manoeuvres import turning, zigzag
from ..simulate.parameters import Condition
from ..simulate.programme import End, Phase, Programme
from ..simulate.sailing import sail
from ..simulate.trajectory import Trajectory
from ..simulate.turning_indices import turning_indices
from ..simulate.vessel import Vessel
from ..simulate.zigzag_indices import zigzag_indices

ORDER_AFTER = 99.5
"""Seconds after which a widely used program gives an order said to come at 100 s: it rounds the time."""

COUNTED_AFTER = 99.9
"""Seconds after which it takes the place of that order: the sample before 100 s."""

SAMPLES_EVERY = 0.2
"""Seconds between samples where the largest heel is wanted: a hundredth of the roll period of the ships here."""


def turn(vessel: Vessel, rudder: float, heading: float = 540.0) -> dict[str, float]:
    """Indices of a turning circle with `rudder` degrees; lengths in L (see `turning_indices`)."""
    trajectory = sail(vessel, turning(rudder, heading))
    assert trajectory.events is not None
    found = turning_indices(trajectory.events, vessel.ship)
    return {name: float(values[0]) for name, values in found.items()}


def overshoots(vessel: Vessel, rudder: float, heading: float | None = None, count: int = 2) -> list[float]:
    """Overshoot angles of a zig-zag in degrees."""
    trajectory = sail(vessel, zigzag(rudder, heading, overshoots=count))
    assert trajectory.events is not None
    found = zigzag_indices(trajectory.events, vessel.ship)
    return [float(found[f"overshoot {number}"][0]) for number in range(1, count + 1)]


def largest_heel(trajectory: Trajectory) -> float:
    """Sampled heel of largest size, degrees, with its sign."""
    heel = trajectory["phi"]
    return math.degrees(float(heel[abs(heel).argmax()]))


def turn_after_approach(vessel: Vessel, rudder: float, rate: float | None = None) -> dict[str, float]:
    """Turn as a widely used program counts it: from a run of 100 s with the rudder amidships.

    An asymmetric ship has left its course by then. Headings are absolute, the advance counts from the place at
    99.9 s, transfer and tactical diameter from the x axis.

    Parameters
    ----------
    vessel : Vessel
    rudder : float
        Degrees, positive to starboard.
    rate : float, optional
        Propeller rate that is ordered at the start, 1/s.

    Returns
    -------
    dict of str to float
        ``advance``, ``transfer``, ``tactical diameter``, ``radius`` in m; for a ship that rolls ``roll peak`` and
        ``roll end`` in degrees.
    """
    side = math.copysign(1.0, rudder)
    angle = math.radians(rudder)
    marks = {f"heading {mark}": End(Condition.TURNED, math.radians(mark), side) for mark in (90, 180)}
    phases = (
        Phase(rate=rate, duration=ORDER_AFTER, may_run_out=True, execute=True, begins="execute"),
        Phase(target=angle, duration=COUNTED_AFTER - ORDER_AFTER, may_run_out=True, ends="counted"),
        Phase(target=angle, end=End(Condition.TURNED, math.radians(720.0), side), ends="end"),
    )
    programme = Programme(f"turning {rudder:+g} after an approach", phases, marks)
    trajectory = sail(vessel, programme, interval=SAMPLES_EVERY)
    assert trajectory.events is not None
    events: Events = trajectory.events

    def at(event: str, column: str) -> float:
        return float(events.at(event, column)[0])

    speed = math.hypot(at("end", "u"), at("end", "v"))
    found = {
        "advance": at("heading 90", "x") - at("counted", "x"),
        "transfer": side * at("heading 90", "y"),
        "tactical diameter": side * at("heading 180", "y"),
        "radius": speed / abs(at("end", "r")),
    }
    if "phi" in trajectory:
        found |= {"roll peak": largest_heel(trajectory), "roll end": math.degrees(at("end", "phi"))}
    return found
