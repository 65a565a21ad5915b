"""Sail a programme with a vessel: one trajectory, or the events of many draws."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import SimulationError
from ..core.provenance import Provenance
from .events import Events
from .packing import pack
from .parameters import SETTINGS, STATES, Parameter, Setting, Shape, State, Status
from .programme import MAXIMUM_HEEL, Programme
from .vessel import Vessel

if TYPE_CHECKING:
    from .environment import Environment
    from .packing import Packed
    from .trajectory import Trajectory

FloatArray = np.ndarray

TOLERANCE = 1e-7
"""Error allowed in a step of a single run, in units of L, U0 and rad."""

DRAW_TOLERANCE = 1e-4
"""The same for draws of an ensemble."""

PATIENCE = 300.0
"""Longest duration of a phase in units of L/U0; a ship that has not completed it is said to fail."""

_STATUS = {
    Status.DIVERGED: (
        "the motion diverges",
        "the derivatives do not hold for so large a motion; order a smaller rudder angle",
    ),
    Status.REVERSED: (
        "the flow through the propeller and past the rudder reverses",
        "their models hold for motion ahead; order a smaller rudder angle",
    ),
    Status.COLLAPSED: ("the step size collapses", "the forces are not smooth there; check the derivatives"),
    Status.TOO_MANY_STEPS: ("the integration takes too many steps", "raise the tolerance"),
    Status.NOT_COMPLETED: (
        "the manoeuvre is not completed: its condition is never reached",
        "the ship may not answer its rudder; sail a spiral to see it",
    ),
    Status.TRACK_FULL: ("there are more samples than were expected", "choose a longer interval"),
}


def status_in_words(status: int) -> str:
    """How a draw ended: ``completed``, or why not."""
    return "completed" if status == Status.COMPLETED else _STATUS[status][0]


@dataclass(frozen=True, eq=False)
class SailedDraws:
    """Events of many draws and how each ended.

    Attributes
    ----------
    events : Events
        One row a draw.
    status : ndarray of int, shape (draws,)
        :class:`~towtank.simulate.parameters.Status`; 0 is completed.
    steps : ndarray of int, shape (draws,)
        Accepted steps.
    rates : ndarray, shape (draws,)
        Propeller rate of the approach in 1/s.
    """

    events: Events
    status: np.ndarray
    steps: np.ndarray
    rates: FloatArray

    @property
    def completed(self) -> np.ndarray:
        """Draws that completed the manoeuvre, shape (draws,) of bool."""
        return self.status == Status.COMPLETED

    def failures(self) -> dict[str, int]:
        """Number of draws for each way of failing, in words."""
        return {
            _STATUS[kind][0]: int(np.sum(self.status == kind)) for kind in _STATUS if np.any(self.status == kind)
        }


def sail(
    vessel: Vessel,
    programme: Programme,
    speed: float | None = None,
    *,
    environment: Environment | None = None,
    interval: float | None = None,
    tolerance: float = TOLERANCE,
    patience: float = PATIENCE,
) -> Trajectory:
    """Sail one manoeuvre.

    Parameters
    ----------
    vessel : Vessel
    programme : Programme
        From :mod:`towtank.simulate.manoeuvres`.
    speed : float, optional
        Approach speed in m/s; the vessel's when not given.
    environment : Environment, optional
        Current, wind and waves; none when not given.
    interval : float, optional
        Time between samples in s; 0.05 L/U0 when not given.
    tolerance : float
        Error allowed in a step, in units of L, U0 and rad.
    patience : float
        Longest duration of a phase in units of L/U0.

    Returns
    -------
    Trajectory
        With its events; ``provenance.findings`` tells which ranges of validity were left.

    Raises
    ------
    SimulationError
        When the motion diverges or the manoeuvre is not completed, with the time and the state.
    """
    from .trajectory import Trajectory
    from .validity import assumed_astern, left_ranges, missing_coupling

    vessel = vessel if speed is None else vessel.but(speed=speed)
    packed = pack(vessel)
    tick = vessel.ship.L / vessel.speed
    gap = 0.05 * tick if interval is None else interval
    samples = _sample_room(programme, gap, tick, patience)
    track = np.zeros((samples, 11))
    raw, results, rates = _run(packed, programme, environment, tolerance, patience, track, gap, None)
    frame = track[: results[0, 3]]
    _raise_failure(results[0, 0], vessel, programme, frame)
    findings = (
        *vessel.findings,
        *assumed_astern(vessel, programme),
        *missing_coupling(vessel),
        *left_ranges(vessel, frame),
    )
    provenance = Provenance(
        source=vessel.hull.provenance.source,
        choices={
            **programme.choices,
            "approach speed [m/s]": vessel.speed,
            "propeller rate of the approach [1/s]": float(rates[0]),
            "tolerance": tolerance,
            "steps": int(results[0, 1]),
        },
        findings=findings,
        misprints=vessel.hull.provenance.misprints,
    )
    columns = dict(zip(("time", "x", "y", "psi", "u", "v", "r", "phi", "p", "delta", "n"), frame.T, strict=True))
    if not packed.shape[Shape.ROLL]:
        del columns["phi"], columns["p"]
    return Trajectory.from_columns(
        columns,
        vessel.ship,
        programme.name,
        events=_events(packed, programme, raw),
        source=vessel.name,
        provenance=provenance,
    )


def sail_events(
    vessel: Vessel,
    programme: Programme,
    draws: FloatArray | None = None,
    changes: Mapping[str, FloatArray] | None = None,
    *,
    speed: float | None = None,
    environment: Environment | None = None,
    rates: FloatArray | None = None,
    tolerance: float = DRAW_TOLERANCE,
    patience: float = PATIENCE,
) -> SailedDraws:
    """Sail one manoeuvre with many draws of the vessel's numbers; only the events are kept.

    Parameters
    ----------
    vessel, programme, speed, environment, tolerance, patience
        As in :func:`sail`.
    draws : ndarray, shape (draws, terms), optional
        Values of the hull derivatives, in the order of ``vessel.hull``.
    changes : mapping of str to ndarray, shape (draws,), optional
        Draws of other numbers by name (:meth:`Vessel.parameter_names`).
    rates : ndarray, shape (draws,), optional
        Propeller rates of the approach; found for each draw when not given and the vessel has none.

    Returns
    -------
    SailedDraws
        A draw that fails has rows of NaN after its last event and a status; nothing is raised.
    """
    vessel = vessel if speed is None else vessel.but(speed=speed)
    packed = pack(vessel, draws, changes)
    raw, results, found = _run(packed, programme, environment, tolerance, patience, np.zeros((0, 11)), 0.0, rates)
    return SailedDraws(_events(packed, programme, raw), results[:, 0].copy(), results[:, 1].copy(), found)


def _run(
    packed: Packed,
    programme: Programme,
    environment: Environment | None,
    tolerance: float,
    patience: float,
    track: FloatArray,
    interval: float,
    rates: FloatArray | None,
) -> tuple[FloatArray, np.ndarray, FloatArray]:
    from .compiled_kernel import sail_many

    vessel = packed.vessel
    _check(packed, programme)
    tick = vessel.ship.L / vessel.speed
    rates = _approach_rates(packed) if rates is None else np.asarray(rates, dtype=float)
    starts = np.zeros((packed.draws, STATES))
    starts[:, State.U] = vessel.speed
    starts[:, State.N] = rates
    phases, watches, schedule = programme.packed(tick, patience)
    if len(schedule):
        starts[:, State.DELTA] = schedule[0, 1]
        if not math.isnan(schedule[0, 2]):
            starts[:, State.N] = schedule[0, 2]
    settings = np.zeros(SETTINGS)
    # the error of the steps must not hide that a motion is steady
    settings[Setting.TOLERANCE] = min(tolerance, 0.01 * programme.steadiness())
    settings[Setting.MAX_STEPS] = 1_000_000
    settings[Setting.INTERVAL] = interval
    settings[Setting.MAX_STEP] = 10.0 * tick
    events = np.empty((packed.draws, len(programme.event_names()), 11))
    results = np.zeros((packed.draws, 4), dtype=np.int64)
    sail_many(
        packed.shape,
        packed.products,
        packed.nodes,
        packed.parameters,
        packed.tables,
        np.zeros(4) if environment is None else environment.packed(vessel.ship),
        starts,
        phases,
        watches,
        schedule,
        settings,
        events,
        track,
        results,
    )
    return events, results, rates


def _approach_rates(packed: Packed) -> FloatArray:
    """Propeller rate of the approach of each draw."""
    from .self_propulsion import self_propulsion_rates

    vessel = packed.vessel
    if vessel.rate is not None:
        rates = np.full(packed.draws, vessel.rate)
    else:
        rates = self_propulsion_rates(packed, vessel.speed)
        if packed.draws == 1 and math.isnan(rates[0]):
            raise SimulationError(
                f"'{vessel.name}' has no self-propulsion point at {vessel.speed:.4g} m/s",
                cure="check resistance and open-water diagram, or give the propeller rate",
            )
    return rates * vessel.engine.power ** (1.0 / 3.0)


def _check(packed: Packed, programme: Programme) -> None:
    vessel = packed.vessel
    largest, limit = programme.largest_rudder(), float(packed.parameters[:, Parameter.GEAR_LIMIT].min())
    if largest > limit * (1.0 + 1e-9):
        raise SimulationError(
            f"{programme.name} orders {math.degrees(largest):.4g} deg of rudder, but the gear stops at"
            f" {math.degrees(limit):.4g} deg",
            cure="order less, or raise the limit of the steering gear",
        )
    steered = vessel.rudder is not None or any("delta" in term.variables for term in vessel.hull.terms)
    if not steered:
        raise SimulationError(
            f"'{vessel.name}' has neither a rudder nor rudder terms", cure="give a Rudder or terms such as Yd, Nd"
        )
    if programme.goes_astern() and not packed.shape[Shape.ASTERN]:
        raise SimulationError(
            f"{programme.name} orders the propeller astern, but nothing is known about its thrust there",
            cure="give the propeller's astern_KT",
        )


def _sample_room(programme: Programme, interval: float, tick: float, patience: float) -> int:
    if not interval > 0.0:
        raise SimulationError(f"the interval of the samples is {interval} s", cure="give a positive time")
    longest = sum(patience * tick if math.isinf(p.duration) else p.duration for p in programme.phases)
    return int(min(longest / interval + 3, 2_000_000))


def _raise_failure(status: int, vessel: Vessel, programme: Programme, frame: FloatArray) -> None:
    if status == Status.COMPLETED:
        return
    cause, cure = _STATUS[int(status)]
    last = frame[-1]
    raise SimulationError(
        f"'{vessel.name}', {programme.name}: {cause} after {last[0]:.4g} s (u = {last[4]:.3g} m/s,"
        f" v = {last[5]:.3g} m/s, r = {math.degrees(last[6]):.3g} deg/s,"
        f" rudder {math.degrees(last[9]):.3g} deg)",
        cure=cure,
    )


def _events(packed: Packed, programme: Programme, raw: FloatArray) -> Events:
    rows = {name: raw[:, row].copy() for row, name in enumerate(programme.event_names())}
    if not packed.shape[Shape.ROLL]:
        rows.pop(MAXIMUM_HEEL, None)
    return Events(rows)
