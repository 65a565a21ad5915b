"""Several speeds in one record: the steps of a computation whose speed rises, each with the last part of its stay."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..core.errors import FitError
from .sinkage_record import SinkageRecord
from .steady_squat import SteadySquat, reduce_steady

LEVEL_TOLERANCE = 0.01
"""Part of the largest speed by which the speed may wander on a step."""


def speed_steps(time: np.ndarray, speed: np.ndarray, *, shortest: float) -> list[tuple[float, float]]:
    """Begin and end in s of each stretch on which the speed stays.

    Parameters
    ----------
    time, speed : ndarray, shape (n,)
        In s and m/s.
    shortest : float
        A stay shorter than this, in s, is part of a ramp.

    Returns
    -------
    list of (float, float)
        In the order of time; stretches at rest are left out.

    Raises
    ------
    FitError
        When a value is missing or the speed stays nowhere that long.
    """
    t, v = np.asarray(time, dtype=float), np.asarray(speed, dtype=float)
    if not (np.isfinite(t).all() and np.isfinite(v).all()):
        raise FitError("time or speed is missing in places", cure="cut the record there")
    if t.size < 2:
        raise FitError(f"{t.size} sample(s) hold no step", cure="give the whole record")
    tolerance = LEVEL_TOLERANCE * float(np.max(np.abs(v)))
    found, first = [], 0
    low = high = v[0]
    for row in range(1, t.size + 1):
        inside = row < t.size and max(high, v[row]) - min(low, v[row]) <= 2.0 * tolerance
        if inside:
            low, high = min(low, v[row]), max(high, v[row])
            continue
        stays = t[row - 1] - t[first] >= shortest
        if stays and abs(0.5 * (low + high)) > 2.0 * tolerance:
            found.append((float(t[first]), float(t[row - 1])))
        if row < t.size:
            first, low, high = row, v[row], v[row]
    if not found:
        raise FitError(
            f"the speed stays nowhere for {shortest:g} s", cure="ask for a shorter stay or check the speed channel"
        )
    return found


def reduce_speed_steps(
    record: SinkageRecord,
    *,
    shortest: float,
    last: float,
    depth: float | None = None,
    places: Mapping[str, float] | None = None,
    run: str = "",
) -> list[SteadySquat]:
    """Steady squat on every step of speed, averaged over the last seconds of each.

    Parameters
    ----------
    record : SinkageRecord
        With a speed.
    shortest : float
        A stay shorter than this, in s, is part of a ramp.
    last : float
        Seconds at the end of each step that are averaged: what comes before is the ramp and the settling.
    depth, places
        As in :func:`.steady_squat.reduce_steady`.
    run : str
        Name; the steps are ``<run> 1``, ``<run> 2``, ...

    Raises
    ------
    FitError
        When there is no speed, no step, or `last` is longer than a step.
    """
    if record.speed is None:
        raise FitError(
            "speed steps need the speed", cure="name the speed channel in the layout", file=record.name or None
        )
    reduced = []
    for number, (begin, end) in enumerate(speed_steps(record.time, record.speed, shortest=shortest), start=1):
        if last > end - begin:
            raise FitError(
                f"step {number} stays for {end - begin:.4g} s, shorter than the {last:g} s to be averaged",
                cure="average less, or ask for longer stays",
                file=record.name or None,
            )
        reduced.append(
            reduce_steady(
                record,
                rule="key-times",
                start=end - last,
                stop=end,
                depth=depth,
                places=places,
                run=f"{run or record.name} {number}",
            )
        )
    return reduced
