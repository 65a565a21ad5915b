"""A manoeuvre as a programme: phases of orders, each with its end, and the events to be watched."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..core.errors import SimulationError
from .parameters import PHASE_COLUMNS, WATCH_COLUMNS, Condition, Order

MAXIMUM_HEEL = "maximum heel"
"""Event of ships that roll alone."""


@dataclass(frozen=True)
class End:
    """Condition that ends a phase, or marks a watched event: a function rising through zero.

    Attributes
    ----------
    condition : float
        One of ``parameters.Condition``.
    value : float
        In SI and radians: heading turned, yaw rate, surge velocity, lateral distance.
    sign : {1, -1}
        Direction: +1 to starboard.
    """

    condition: float
    value: float = 0.0
    sign: float = 1.0


@dataclass(frozen=True)
class Phase:
    """One order and the time until the next.

    Attributes
    ----------
    order : float
        One of ``parameters.Order``: rudder angle, course, yaw rate or schedule.
    target : float
        Rudder angle in rad (starboard positive), course in rad, yaw rate in rad/s.
    gains : (float, float, float)
        Of an autopilot: on the error, on the yaw rate in s, on the integral of the error in 1/s (course); for a yaw
        rate: on the error in s, none, on its integral.
    gains_scaled : bool
        The gain on the yaw rate is in units of L/U0, that on the integral in U0/L.
    rate : float, optional
        Propeller rate that is ordered, in 1/s, or as a multiple of that of the approach.
    rate_is_factor : bool
    end : End, optional
        None: the phase ends with its duration.
    duration : float
        Longest time in s.
    may_run_out : bool
        True when the end of the duration is a regular end.
    execute : bool
        Headings and places of conditions count from the beginning of this phase.
    begins, ends : str
        Names of the events at the beginning and at the end; empty for none.
    watched : mapping of str to End
        Events watched in this phase alone.
    """

    order: float = Order.ANGLE
    target: float = 0.0
    gains: tuple[float, float, float] = (0.0, 0.0, 0.0)
    gains_scaled: bool = False
    rate: float | None = None
    rate_is_factor: bool = False
    end: End | None = None
    duration: float = math.inf
    may_run_out: bool = False
    execute: bool = False
    begins: str = ""
    ends: str = ""
    watched: Mapping[str, End] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Programme:
    """Phases and watched events.

    Attributes
    ----------
    name : str
        As a trajectory's `manoeuvre`, e.g. ``"turning +35"``.
    phases : tuple of Phase
    watched : mapping of str to End
        Events watched in all phases.
    schedule : ndarray, shape (n, 3), optional
        Times in s, rudder angles in rad, propeller rates in 1/s (NaN: left alone).
    choices : mapping
        How the manoeuvre was defined, for the provenance.
    """

    name: str
    phases: tuple[Phase, ...]
    watched: Mapping[str, End] = field(default_factory=dict)
    schedule: np.ndarray | None = None
    choices: Mapping[str, Any] = field(default_factory=dict)

    def event_names(self) -> tuple[str, ...]:
        """Names of all events, in the order of the programme."""
        names: dict[str, None] = {}
        for phase in self.phases:
            if phase.begins:
                names[phase.begins] = None
            names.update(dict.fromkeys(phase.watched))
            if phase.execute:
                names.update(dict.fromkeys(self.watched))
        names.update(dict.fromkeys(self.watched))
        names.update(dict.fromkeys(phase.ends for phase in self.phases if phase.ends))
        return tuple(names)

    def largest_rudder(self) -> float:
        """Largest rudder angle ordered, rad."""
        angles = [abs(phase.target) for phase in self.phases if phase.order == Order.ANGLE]
        if self.schedule is not None:
            angles.append(float(np.abs(self.schedule[:, 1]).max()))
        return max(angles, default=0.0)

    def goes_astern(self) -> bool:
        """True when the propeller is ordered astern."""
        scheduled = self.schedule is not None and bool(np.any(self.schedule[:, 2] < 0.0))
        return scheduled or any((phase.rate or 0.0) < 0.0 for phase in self.phases)

    def steadiness(self) -> float:
        """Smallest acceleration, in units of U0 and L, that a phase waits for; infinite when none does."""
        ends = [phase.end for phase in self.phases if phase.end and phase.end.condition == Condition.STEADY]
        return min((end.value for end in ends), default=math.inf)

    def packed(self, tick: float, patience: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Tables of phases, watched events and schedule for the kernel.

        Parameters
        ----------
        tick : float
            L/U0 in s.
        patience : float
            Longest duration of a phase that names none, in units of L/U0.
        """
        names = {name: row for row, name in enumerate(self.event_names())}
        phases = np.zeros((len(self.phases), PHASE_COLUMNS))
        watches = []
        for number, phase in enumerate(self.phases):
            end = phase.end or End(Condition.NONE)
            duration = patience * tick if math.isinf(phase.duration) else phase.duration
            phases[number] = [
                phase.order,
                phase.target,
                phase.gains[0],
                phase.gains[1] * (tick if phase.gains_scaled else 1.0),
                phase.gains[2] / (tick if phase.gains_scaled else 1.0),
                math.nan if phase.rate is None else phase.rate,
                phase.rate_is_factor,
                phase.execute,
                names.get(phase.begins, -1),
                end.condition,
                end.value,
                end.sign,
                names.get(phase.ends, -1),
                duration,
                phase.may_run_out,
            ]
            watches += [_watch(watch, number, names[name]) for name, watch in phase.watched.items()]
        watches += [_watch(watch, -1, names[name]) for name, watch in self.watched.items()]
        table = np.array(watches, dtype=float).reshape(-1, WATCH_COLUMNS)
        schedule = np.zeros((0, 3)) if self.schedule is None else np.ascontiguousarray(self.schedule, dtype=float)
        if len(schedule) and (len(schedule) < 2 or not np.all(np.diff(schedule[:, 0]) > 0.0)):
            raise SimulationError(
                "the times of a schedule do not ascend", cure="sort the rows and name each time once"
            )
        return phases, table, schedule


def _watch(watch: End, phase: int, row: int) -> list[float]:
    return [watch.condition, watch.value, watch.sign, float(phase), float(row)]
