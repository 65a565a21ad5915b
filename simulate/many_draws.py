"""A programme sailed by many draws: the one entry to the compiled kernel."""

from __future__ import annotations

import math

import numpy as np

from .compilation import compiled
from .kernel import sail_one
from .parameters import State
from .straight_course import balanced_rate


@compiled
def sail_draws(
    shape: np.ndarray,
    products: np.ndarray,
    nodes: np.ndarray,
    parameters: np.ndarray,
    tables: np.ndarray,
    environment: np.ndarray,
    starts: np.ndarray,
    phases: np.ndarray,
    watches: np.ndarray,
    schedule: np.ndarray,
    settings: np.ndarray,
    events: np.ndarray,
    track: np.ndarray,
    results: np.ndarray,
    control: np.ndarray,
    value: np.ndarray,
    slopes: np.ndarray,
    room: np.ndarray,
    pending: np.ndarray,
) -> None:
    """Sail the programme once for each row of `parameters`.

    Parameters
    ----------
    shape, products, nodes, parameters, tables
        From :func:`towtank.simulate.packing.pack`.
    environment : ndarray
        From :class:`towtank.simulate.environment.Environment`.
    starts : ndarray, shape (draws, 12)
        States at the start. Of a programme without phases nothing is sailed: the propeller rates become those of the
        self-propulsion point.
    phases, watches : ndarray
        From :class:`towtank.simulate.programme.Programme`.
    schedule : ndarray, shape (n, 3)
        Times, rudder angles and propeller rates (NaN: left alone) of a schedule.
    settings : ndarray
        See ``parameters.Setting``.
    events : ndarray, shape (draws, events, 11)
        Written: time and state at each event; rows of NaN where it did not occur.
    track : ndarray, shape (samples, 11)
        Written: samples of the last draw at the interval of the settings.
    results : ndarray of int64, shape (draws, 4)
        Written: status, accepted steps, rejected steps, samples in `track`.
    control, value, slopes, room, pending
        Room to work in: :func:`towtank.simulate.compiled_kernel.sail_many`.
    """
    for draw in range(parameters.shape[0]):
        if phases.shape[0] == 0:
            starts[draw, State.N] = balanced_rate(
                starts[draw, State.U],
                shape,
                products,
                nodes,
                parameters[draw],
                tables,
                environment,
                control,
                room[0],
                value,
                slopes[0],
            )
            continue
        for event in range(events.shape[1]):
            for column in range(events.shape[2]):
                events[draw, event, column] = math.nan
        sail_one(
            shape,
            products,
            nodes,
            parameters[draw],
            tables,
            environment,
            starts[draw],
            phases,
            watches,
            schedule,
            settings,
            events[draw],
            track,
            results[draw],
            control,
            value,
            slopes,
            room,
            pending,
        )
