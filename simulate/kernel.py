"""Integration of a programme: adaptive steps that land on the kinks of the steering gear, and events."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .crossings import condition, locate
from .equations import derivative
from .given_orders import give_order, keep_torque, land, next_kink
from .parameters import STATES, Condition, Inflow, Parameter, Phase, Setting, Shape, State, Status, Watch
from .runge_kutta import STAGES, dense_output, step
from .step_limits import diverges, error_weights, goes_astern, unsteadiness

_SMALLEST_STEP = 1e-9
_FIRST_STEP = 0.25
_GROWTH = 5.0


@compiled
def sail_one(
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    p: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    start: np.ndarray,
    phases: np.ndarray,
    watches: np.ndarray,
    schedule: np.ndarray,
    settings: np.ndarray,
    events: np.ndarray,
    track: np.ndarray,
    result: np.ndarray,
    control: np.ndarray,
    value: np.ndarray,
    slopes: np.ndarray,
    room: np.ndarray,
    pending: np.ndarray,
) -> None:
    """Sail the programme with one row of numbers; see :func:`sail_draws`."""
    state, after, reference, weight, other = room[0], room[1], room[2], room[3], room[4]
    copy_state(start, state)
    copy_state(start, reference)
    error_weights(p, start, settings[Setting.TOLERANCE], weight)
    tick = p[Parameter.LENGTH] / p[Parameter.SPEED]
    if shape[Shape.TORQUE] == 1:
        keep_torque(shape, p, start)
    for w in range(watches.shape[0]):
        pending[w, 0] = 1.0
    for i in range(4):
        result[i] = 0
    time = 0.0
    if settings[Setting.INTERVAL] > 0.0:
        result[3] = write_sample(track, result[3], time, state)

    for phase in range(phases.shape[0]):
        order = phases[phase]
        begin = time
        row = 0
        give_order(order, shape, p, start, state, control)
        if order[Phase.EXECUTE] == 1.0:
            copy_state(state, reference)
        if order[Phase.START_EVENT] >= 0.0:
            write_event(events, int(order[Phase.START_EVENT]), time, state)
        for w in range(watches.shape[0]):
            pending[w, 1] = watch_value(watches[w], phase, state, reference, environment)
        stop = condition(
            order[Phase.END], order[Phase.END_VALUE], order[Phase.END_SIGN], state, reference, environment
        )
        kink = math.inf
        bends = True
        h = _FIRST_STEP * tick
        while True:
            if bends:
                kink = next_kink(order, p, state, control, schedule, time, begin, row)
                derivative(state, control, shape, products, nodes, p, tables, environment, value, slopes[0])
                bends = False
            if result[1] + result[2] >= settings[Setting.MAX_STEPS]:
                result[0] = Status.TOO_MANY_STEPS
                return
            wanted = min(h, settings[Setting.MAX_STEP])
            left = min(kink, begin + order[Phase.DURATION]) - time
            lands = wanted >= left * (1.0 - 1e-12)
            length = left if lands else wanted
            if not lands and 2.0 * wanted > left:
                # two equal steps to a kink, rather than a long one and a splinter
                length = 0.5 * left
            error = step(
                state,
                length,
                control,
                shape,
                products,
                nodes,
                p,
                tables,
                environment,
                value,
                slopes,
                after,
                weight,
            )
            if not error <= 1.0:
                result[2] += 1
                factor = 0.9 * error**-0.2 if error > 1.0 else 0.1
                h = length * max(factor, 0.1)
                if h < _SMALLEST_STEP * tick:
                    result[0] = Status.DIVERGED if diverges(p, after) else Status.COLLAPSED
                    return
                continue
            result[1] += 1
            factor = 0.9 * error**-0.2 if error > 0.0 else _GROWTH
            proposal = length * min(max(factor, 0.2), _GROWTH)
            # a step that was cut to land on a kink says nothing against a longer one
            h = max(h, proposal) if lands and length < wanted else proposal
            theta = 1.0
            ended = False
            if order[Phase.END] == Condition.STEADY:
                ended = unsteadiness(p, state, slopes) < order[Phase.END_VALUE]
            elif order[Phase.END] != Condition.NONE:
                reached = condition(
                    order[Phase.END], order[Phase.END_VALUE], order[Phase.END_SIGN], after, reference, environment
                )
                if stop < 0.0 <= reached:
                    ended = True
                    theta = locate(
                        order[Phase.END],
                        order[Phase.END_VALUE],
                        order[Phase.END_SIGN],
                        reference,
                        environment,
                        state,
                        after,
                        length,
                        slopes,
                        stop,
                        reached,
                        other,
                    )
                stop = reached
            for w in range(watches.shape[0]):
                if pending[w, 0] == 0.0:
                    continue
                before = pending[w, 1]
                behind = watch_value(watches[w], phase, after, reference, environment)
                pending[w, 1] = behind
                if before < 0.0 <= behind:
                    watch = watches[w]
                    at = locate(
                        watch[Watch.CONDITION],
                        watch[Watch.VALUE],
                        watch[Watch.SIGN],
                        reference,
                        environment,
                        state,
                        after,
                        length,
                        slopes,
                        before,
                        behind,
                        other,
                    )
                    if at <= theta:
                        place = int(watch[Watch.EVENT])
                        dense_output(state, after, length, slopes, at, other)
                        if watch[Watch.CONDITION] != Condition.ROLL_RATE:
                            pending[w, 0] = 0.0
                        elif abs(other[State.PHI]) <= abs(events[place, State.PHI + 1]):
                            # of the extremes of the roll angle the largest is kept
                            continue
                        write_event(events, place, time + at * length, other)
            if settings[Setting.INTERVAL] > 0.0:
                while True:
                    at = (result[3] * settings[Setting.INTERVAL] - time) / length
                    if at > theta:
                        break
                    if result[3] >= track.shape[0]:
                        result[0] = Status.TRACK_FULL
                        return
                    dense_output(state, after, length, slopes, at, other)
                    result[3] = write_sample(track, result[3], time + at * length, other)
            if diverges(p, after):
                result[0] = Status.DIVERGED
                return
            if after[State.U] < 0.0 and shape[Shape.RUDDER] != Inflow.NONE and not goes_astern(phases):
                result[0] = Status.REVERSED
                return
            if ended and theta < 1.0:
                dense_output(state, after, length, slopes, theta, other)
                copy_state(other, state)
                time += theta * length
                break
            time += length
            copy_state(after, state)
            copy_state(slopes[STAGES - 1], slopes[0])
            if ended:
                break
            if lands:
                if time >= begin + order[Phase.DURATION] * (1.0 - 1e-12):
                    if order[Phase.DURATION_ENDS] == 0.0:
                        result[0] = Status.NOT_COMPLETED
                        return
                    break
                time = kink
                row += 1
                land(order, control, p, state)
                bends = True
        if order[Phase.END_EVENT] >= 0.0:
            write_event(events, int(order[Phase.END_EVENT]), time, state)
    if settings[Setting.INTERVAL] > 0.0 and result[3] < track.shape[0] and track[result[3] - 1, 0] < time:
        result[3] = write_sample(track, result[3], time, state)
    result[0] = Status.COMPLETED


@compiled
def watch_value(
    watch: np.ndarray, phase: int, state: np.ndarray, reference: np.ndarray, environment: np.ndarray
) -> float:
    """Condition of a watched event; NaN, which crosses nothing, in a phase in which it is not watched."""
    if watch[Watch.PHASE] >= 0.0 and watch[Watch.PHASE] != phase:
        return math.nan
    return condition(watch[Watch.CONDITION], watch[Watch.VALUE], watch[Watch.SIGN], state, reference, environment)


@compiled
def write_event(events: np.ndarray, row: int, time: float, state: np.ndarray) -> None:
    """Time and state at an event."""
    events[row, 0] = time
    for i in range(State.INTEGRAL):
        events[row, i + 1] = state[i]


@compiled
def write_sample(track: np.ndarray, row: int, time: float, state: np.ndarray) -> int:
    """Write one row of the track; returns the number of rows."""
    write_event(track, row, time, state)
    return row + 1


@compiled
def copy_state(source: np.ndarray, target: np.ndarray) -> None:
    """Copy a state."""
    for i in range(STATES):
        target[i] = source[i]
