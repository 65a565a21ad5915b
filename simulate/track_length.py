"""Length of the track of midship between events."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .events import COLUMN_NUMBER, Events, FloatArray

_POINTS, _WEIGHTS = (0.5 * part for part in np.polynomial.legendre.leggauss(8))
_POINTS = _POINTS + 0.5


def track_length(events: Events, names: Sequence[str]) -> FloatArray:
    """Length of the track in m through events in their order, shape (draws,).

    Between two events the track is the cubic with their positions and velocities. In a current the velocities
    through the water are not those of the track: remove it first.

    Parameters
    ----------
    events : Events
    names : sequence of str
        From the first to the last, which must have occurred; one between them that did not is passed over.
    """
    watched = [name for name in names if name in events]
    if len(watched) < 2 or watched[0] != names[0] or watched[-1] != names[-1]:
        return np.full(events.draws, np.nan)
    last = events[watched[0]]
    total = np.zeros(events.draws)
    for name in watched[1:]:
        rows = events[name]
        occurred = np.isfinite(rows[:, 0])
        total = np.where(occurred, total + _cubic_length(last, rows), total)
        last = np.where(occurred[:, np.newaxis], rows, last)
    return np.where(occurred, total, np.nan)


def _cubic_length(first: FloatArray, last: FloatArray) -> FloatArray:
    """Length of the cubic between two states of shape (draws, 11)."""
    duration = (last[:, 0] - first[:, 0])[:, np.newaxis]
    chord = (last - first)[:, [COLUMN_NUMBER["x"], COLUMN_NUMBER["y"]]]
    start, end = duration * _velocity(first), duration * _velocity(last)
    s = _POINTS[:, np.newaxis, np.newaxis]
    # Slope of the cubic Hermite polynomial over the fraction s of the time between the events.
    slope = 6.0 * s * (1.0 - s) * chord + (1.0 - s) * (1.0 - 3.0 * s) * start + s * (3.0 * s - 2.0) * end
    return _WEIGHTS @ np.hypot(slope[..., 0], slope[..., 1])


def _velocity(state: FloatArray) -> FloatArray:
    """Velocity in earth axes in m/s, shape (draws, 2)."""
    u, v, psi = (state[:, COLUMN_NUMBER[name]] for name in ("u", "v", "psi"))
    return np.column_stack([u * np.cos(psi) - v * np.sin(psi), u * np.sin(psi) + v * np.cos(psi)])
