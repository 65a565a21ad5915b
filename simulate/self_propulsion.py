"""Self-propulsion point: the propeller rate at which the ship keeps its approach speed on a straight course."""

from __future__ import annotations

import numpy as np

from .compiled_kernel import sail_many
from .packing import Packed
from .parameters import PHASE_COLUMNS, SETTINGS, STATES, WATCH_COLUMNS, Setting, Shape, State, Thrust

_CALM = np.zeros(4)


def self_propulsion_rates(packed: Packed, speed: float) -> np.ndarray:
    """Propeller rate in 1/s at which each draw keeps `speed` in m/s in calm water; NaN where there is none.

    The rudder is amidships. Without a propeller the rates are 0.
    """
    if packed.shape[Shape.THRUST] == Thrust.NONE:
        return np.zeros(packed.draws)
    starts = np.zeros((packed.draws, STATES))
    starts[:, State.U] = speed
    settings = np.zeros(SETTINGS)
    settings[Setting.TOLERANCE] = 1.0
    sail_many(
        packed.shape,
        packed.products,
        packed.nodes,
        packed.parameters,
        packed.tables,
        _CALM.copy(),
        starts,
        np.zeros((0, PHASE_COLUMNS)),
        np.zeros((0, WATCH_COLUMNS)),
        np.zeros((0, 3)),
        settings,
        np.empty((packed.draws, 0, 11)),
        np.zeros((0, 11)),
        np.zeros((packed.draws, 4), dtype=np.int64),
    )
    return starts[:, State.N].copy()
