"""A programme sailed by many draws: the one entry to the compiled kernel."""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from .kernel import sail_one
from .parameters import CONTROLS, NODES, STATES
from .runge_kutta import STAGES


@njit(
    "void(i8[::1], i8[:, ::1], i8[::1], f8[:, ::1], f8[::1], f8[::1], f8[:, ::1], f8[:, ::1], f8[:, ::1],"
    " f8[:, ::1], f8[::1], f8[:, :, ::1], f8[:, ::1], i8[:, ::1])",
    cache=True,
    error_model="numpy",
    nogil=True,
)
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
) -> None:
    """Sail the programme once for each row of `parameters`.

    Parameters
    ----------
    shape, products, nodes, parameters, tables
        From :func:`towtank.simulate.packing.pack`.
    environment : ndarray
        From :class:`towtank.simulate.environment.Environment`.
    starts : ndarray, shape (draws, 11)
        States at the start.
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
    """
    control = np.zeros(CONTROLS)
    value = np.zeros(NODES + products.shape[0])
    slopes = np.zeros((STAGES, STATES))
    room = np.zeros((5, STATES))
    pending = np.zeros((watches.shape[0], 2))
    for draw in range(parameters.shape[0]):
        events[draw] = math.nan
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
