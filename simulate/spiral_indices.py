"""Loop of the spiral curve: rudder angle against steady yaw rate, from direct and reverse spirals."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import TowtankError
from ..core.ship import Ship
from .event_geometry import require_events
from .events import Events, FloatArray


def reverse_spiral_indices(rudder: ArrayLike, yaw_rate: ArrayLike) -> dict[str, FloatArray]:
    """Loop of a spiral curve whose every yaw rate is known: a reverse spiral, or steady turns solved for.

    Parameters
    ----------
    rudder : array_like, shape (n,)
        Mean rudder angle in radians that keeps each yaw rate; positive turns to starboard.
    yaw_rate : array_like, shape (n,)
        Steady yaw rates in rad/s, of both signs, in any order.

    Returns
    -------
    dict of str to ndarray, shape (1,)
        ``"loop width"`` (deg; 0 for a stable ship): the fall of the rudder angle over rising yaw rate, between the
        extremes of a curve of cubics that keeps the shape of the points; ``"loop height"`` (deg/s) at the
        ``"neutral rudder"`` (deg); ``"yaw rate slope"`` (1/s; NaN for an unstable ship).

    Raises
    ------
    TowtankError
        For fewer than five points, or rates of one sign only.
    """
    from scipy.interpolate import PchipInterpolator

    delta, rate = _points(rudder, yaw_rate)
    order = np.argsort(rate)
    delta, rate = delta[order], rate[order]
    if np.any(np.diff(rate) <= 0.0):
        raise TowtankError(
            "a yaw rate appears twice in a reverse spiral", cure="average the rudder angles of repeated yaw rates"
        )
    if rate[0] >= 0.0 or rate[-1] <= 0.0:
        raise TowtankError("the yaw rates of the spiral are on one side only", cure="add turns to the other side")
    curve = PchipInterpolator(rate, delta)
    grid = np.unique(np.concatenate([np.linspace(rate[0], rate[-1], 4001), rate]))
    angle = curve(grid)
    # The loop is where the rudder angle falls while the yaw rate rises: from a crest to the trough after it.
    crest = np.maximum.accumulate(angle)
    fall = crest - angle
    trough = int(np.argmax(fall))
    width = float(fall[trough])
    if width <= 0.0:
        neutral = float(curve(0.0))
        slope = 1.0 / float(curve(0.0, 1)) if float(curve(0.0, 1)) > 0.0 else np.nan
        return _result(0.0, 0.0, neutral, slope)
    peak = int(np.argmax(angle[: trough + 1]))
    neutral = 0.5 * float(angle[peak] + angle[trough])
    crossings = grid[:-1][np.diff(np.sign(angle - neutral)) != 0.0]
    return _result(width, float(np.ptp(crossings)), neutral, np.nan)


def spiral_indices(rudder: ArrayLike, yaw_rate: ArrayLike) -> dict[str, FloatArray]:
    """Loop of a direct (Dieudonne) spiral: steady yaw rates at rudder angles that fall and rise again.

    Parameters
    ----------
    rudder : array_like, shape (n,)
        Rudder angles in radians in the order of the test: from starboard to port and back, or the reverse.
    yaw_rate : array_like, shape (n,)
        Steady yaw rates in rad/s.

    Returns
    -------
    dict of str to ndarray, shape (1,)
        As `reverse_spiral_indices`. On each way the yaw rate jumps between two rudder angles of the test; the jump is
        put where the straight line between them crosses zero, so that the width is known to a step of the rudder.

    Raises
    ------
    TowtankError
        For fewer than five points, or when the rudder does not go both ways.
    """
    delta, rate = _points(rudder, yaw_rate)
    turn = int(np.argmin(delta)) if delta[0] > delta.mean() else int(np.argmax(delta))
    if turn in (0, len(delta) - 1):
        raise TowtankError(
            "the rudder of this spiral goes one way only",
            cure="give the way back too, or use reverse_spiral_indices for a curve without a loop",
        )
    ways = [_zero_rate(delta[: turn + 1], rate[: turn + 1]), _zero_rate(delta[turn:], rate[turn:])]
    width = abs(ways[0] - ways[1])
    neutral = 0.5 * (ways[0] + ways[1])
    steady = [_rate_at(delta[: turn + 1], rate[: turn + 1], neutral), _rate_at(delta[turn:], rate[turn:], neutral)]
    height = abs(steady[0] - steady[1])
    return _result(width, height if width > 0.0 else 0.0, neutral, np.nan)


def spiral_event_indices(events: Events, ship: Ship, *, reverse: bool = False) -> dict[str, FloatArray]:
    """Indices of sailed spirals, for one run or for many draws.

    Parameters
    ----------
    events : Events
        ``"steady 1"``, ``"steady 2"``, ...: rudder angle and yaw rate at the end of each.
    ship : Ship
        Not used; manoeuvres take the same arguments.
    reverse : bool
        True for a reverse spiral.

    Returns
    -------
    dict of str to ndarray, shape (draws,)
        NaN for a draw that did not get through the spiral or whose points have no curve.

    Raises
    ------
    TowtankError
        When these are events of another manoeuvre; for a single run also when its points have no curve.
    """
    require_events(events, ("steady 1", "steady 2"), "spiral")
    names = [name for name in events if name.startswith("steady ")]
    rudder = np.stack([events.at(name, "delta") for name in names], axis=1)
    rate = np.stack([events.at(name, "r") for name in names], axis=1)
    loop = reverse_spiral_indices if reverse else spiral_indices
    rows = []
    for draw in range(events.draws):
        try:
            rows.append(loop(rudder[draw], rate[draw]))
        except TowtankError:
            if events.draws == 1:
                raise
            rows.append(_result(np.nan, np.nan, np.nan, np.nan))
    return {name: np.concatenate([row[name] for row in rows]) for name in rows[0]}


def _points(rudder: ArrayLike, yaw_rate: ArrayLike) -> tuple[FloatArray, FloatArray]:
    delta, rate = np.asarray(rudder, dtype=float), np.asarray(yaw_rate, dtype=float)
    if delta.shape != rate.shape or delta.ndim != 1 or len(delta) < 5:
        raise TowtankError(
            f"a spiral of {delta.shape} rudder angles and {rate.shape} yaw rates has no curve",
            cure="give at least five pairs of rudder angle and steady yaw rate",
        )
    if not (np.isfinite(delta).all() and np.isfinite(rate).all()):
        raise TowtankError("a point of the spiral has no value", cure="leave out points that were not measured")
    return delta, rate


def _zero_rate(delta: FloatArray, rate: FloatArray) -> float:
    """Rudder angle at which the yaw rate changes its sign on one way."""
    change = np.flatnonzero(np.signbit(rate[1:]) != np.signbit(rate[:-1]))
    if len(change) == 0:
        raise TowtankError(
            "the yaw rate keeps its sign on one way of the spiral",
            cure="go on to larger rudder angles on the other side",
        )
    row = int(change[-1])
    share = rate[row] / (rate[row] - rate[row + 1])
    return float(delta[row] + share * (delta[row + 1] - delta[row]))


def _rate_at(delta: FloatArray, rate: FloatArray, angle: float) -> float:
    order = np.argsort(delta)
    return float(np.interp(angle, delta[order], rate[order]))


def _result(width: float, height: float, neutral: float, slope: float) -> dict[str, FloatArray]:
    return {
        "loop width": np.array([np.degrees(width)]),
        "loop height": np.array([np.degrees(height)]),
        "neutral rudder": np.array([np.degrees(neutral)]),
        "yaw rate slope": np.array([slope]),
    }
