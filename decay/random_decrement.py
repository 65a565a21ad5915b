"""Random decrement: the free decay that hides in the response to an excitation that forgets quickly.

Pieces of the record that begin alike are averaged: what the sea does after the begin averages out, the decay from that
angle stays (Cole 1968; for roll Elshafey, Haddara and Marzouk). The pieces begin at upward and, mirrored, at downward
crossings of a trigger level, so that their mean rate is zero at the begin only on average. The signature is a decay for
the linear part of the ship: it needs an excitation without a line of its own near the roll frequency, and many pieces.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding

if TYPE_CHECKING:
    import pandas as pd

FEWEST_PIECES = 100
BLOCKS = 16
"""Blocks of a record that are left out one at a time for the standard errors."""


@dataclass(frozen=True, eq=False)
class RandomDecrement:
    """Average of the pieces that begin at one level, and the decay fitted to it.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s from the begin of a piece.
    signature, error : ndarray, shape (n,)
        Mean angle in rad, and its standard error from the scatter of the pieces.
    level : float
        Trigger level in rad.
    pieces : int
    omega, omega_sd : float
        Natural frequency of the fitted decay in rad/s, and its standard error.
    zeta, zeta_sd : float
        Damping over critical damping.
    findings : tuple of Finding
    """

    time: np.ndarray
    signature: np.ndarray
    error: np.ndarray
    level: float
    pieces: int
    omega: float
    omega_sd: float
    zeta: float
    zeta_sd: float
    findings: tuple[Finding, ...]

    @property
    def alpha(self) -> float:
        """Equivalent damping in 1/s: x'' + 2 alpha x' + omega^2 x = 0."""
        return self.zeta * self.omega


def random_decrement(
    time: np.ndarray,
    angle: np.ndarray,
    *,
    level: float | None = None,
    cycles: float = 4.0,
    blocks: int = BLOCKS,
) -> RandomDecrement:
    """Signature of a record at sea and the linear decay in it.

    Parameters
    ----------
    time, angle : ndarray, shape (n,)
        Uniform in s; rad. The mean is removed.
    level : float, optional
        Trigger level in rad; sqrt(2) standard deviations of the record when not given, which uses it best.
    cycles : float
        Length of a piece in mean periods of the record.
    blocks : int
        The record is cut in so many blocks; leaving one out at a time gives the standard errors of omega and zeta.

    Raises
    ------
    FitError
        When the record is not uniform, too short, or has no crossing of the level.
    """
    t, x = np.asarray(time, dtype=float), np.asarray(angle, dtype=float)
    if t.shape != x.shape or t.size < 4 or not (np.isfinite(x).all() and np.isfinite(t).all()):
        raise FitError("times and angles of the record do not pair, or are not finite", cure="cut the gaps first")
    step = float(np.median(np.diff(t)))
    if not np.allclose(np.diff(t), step, rtol=1e-3, atol=1e-9 * abs(t[-1])):
        raise FitError("the random decrement needs uniform times", cure="resample the record")
    x = x - x.mean()
    trigger = math.sqrt(2.0) * float(x.std()) if level is None else float(level)
    if not trigger > 0.0:
        raise FitError("the trigger level is not positive", cure="give it in rad")
    ups = np.count_nonzero((x[:-1] < 0.0) & (x[1:] >= 0.0))
    if ups < 2:
        raise FitError("the record holds no roll cycles", cure="give a longer record")
    length = round(cycles * x.size / ups)
    begins, signs = _triggers(x, trigger)
    usable = begins + length <= x.size
    begins, signs = begins[usable], signs[usable]
    if begins.size < 2:
        raise FitError(
            f"{begins.size} pieces of the record begin at {math.degrees(trigger):.3g} deg",
            cure="lower the level, or give a longer record",
        )
    pieces = x[begins[:, None] + np.arange(length)] * signs[:, None]
    signature = pieces.mean(axis=0)
    relative = step * np.arange(length)
    omega, zeta = _linear_decay(relative, signature)
    place = np.minimum(begins * blocks // x.size, blocks - 1)
    spread = _jackknife(relative, pieces, place, blocks)
    return RandomDecrement(
        time=relative,
        signature=signature,
        error=pieces.std(axis=0, ddof=1) / math.sqrt(begins.size),
        level=trigger,
        pieces=int(begins.size),
        omega=omega,
        omega_sd=spread[0],
        zeta=zeta,
        zeta_sd=spread[1],
        findings=tuple(_doubts(int(begins.size), signature, relative, omega, zeta)),
    )


def damping_by_level(
    time: np.ndarray, angle: np.ndarray, levels: Sequence[float], *, cycles: float = 4.0
) -> pd.DataFrame:
    """Equivalent damping against trigger level: columns ``level_deg``, ``pieces``, ``omega``, ``omega_sd``, ``zeta``,
    ``zeta_sd``, ``alpha`` (1/s).

    Arguments as in :func:`random_decrement`, with the `levels` in rad.
    """
    import pandas as pd

    rows = []
    for level in levels:
        found = random_decrement(time, angle, level=level, cycles=cycles)
        rows.append(
            {
                "level_deg": math.degrees(level),
                "pieces": found.pieces,
                "omega": found.omega,
                "omega_sd": found.omega_sd,
                "zeta": found.zeta,
                "zeta_sd": found.zeta_sd,
                "alpha": found.alpha,
            }
        )
    return pd.DataFrame(rows)


def _triggers(x: np.ndarray, level: float) -> tuple[np.ndarray, np.ndarray]:
    """Samples after each crossing of +level (either way) and of -level (mirrored), with the sign of each."""
    found, signs = [], []
    for sign in (1.0, -1.0):
        height = sign * x - level
        rows = np.flatnonzero(height[:-1] * height[1:] < 0.0) + 1
        found.append(rows)
        signs.append(np.full(rows.size, sign))
    begins = np.concatenate(found)
    order = np.argsort(begins, kind="stable")
    return begins[order], np.concatenate(signs)[order]


def _linear_decay(time: np.ndarray, signature: np.ndarray) -> tuple[float, float]:
    """Natural frequency and damping ratio of the decaying cosine that fits best."""
    from scipy.optimize import least_squares

    cross = np.flatnonzero(signature[:-1] * signature[1:] < 0.0)
    if cross.size < 2:
        raise FitError("the signature does not oscillate", cure="take longer pieces, or another level")
    rate = math.pi * (cross.size - 1) / float(time[cross[-1]] - time[cross[0]])

    def basis(point: np.ndarray) -> np.ndarray:
        envelope = np.exp(-point[0] * rate * time)
        phase = point[1] * rate * time
        return np.column_stack([envelope * np.cos(phase), envelope * np.sin(phase)])

    def misses(point: np.ndarray) -> np.ndarray:
        columns = basis(point)
        return signature - columns @ np.linalg.lstsq(columns, signature, rcond=None)[0]

    decay, damped = least_squares(misses, [0.03, 1.0], x_scale="jac").x * rate
    omega = math.hypot(decay, damped)
    return omega, decay / omega


def _jackknife(time: np.ndarray, pieces: np.ndarray, place: np.ndarray, blocks: int) -> tuple[float, float]:
    """Standard errors of frequency and damping ratio from leaving out one block of the record at a time."""
    total, count = pieces.sum(axis=0), len(pieces)
    results = []
    for number in range(blocks):
        out = place == number
        left = count - int(out.sum())
        if 1 < left < count:
            results.append(_linear_decay(time, (total - pieces[out].sum(axis=0)) / left))
    if len(results) < 2:
        return math.nan, math.nan
    values = np.array(results)
    sd = np.sqrt((len(values) - 1) / len(values) * np.sum((values - values.mean(axis=0)) ** 2, axis=0))
    return float(sd[0]), float(sd[1])


def _doubts(pieces: int, signature: np.ndarray, time: np.ndarray, omega: float, zeta: float) -> Iterator[Finding]:
    if pieces < FEWEST_PIECES:
        yield Finding(
            "few-pieces",
            "warning",
            f"{pieces} pieces were averaged; below {FEWEST_PIECES} the waves have not averaged out",
            cure="give a longer record, or a lower level",
        )
    if not 0.0 < zeta < 1.0:
        yield Finding(
            "signature-grows",
            "warning",
            f"the signature has the damping ratio {zeta:.3g}",
            cure="the excitation has a line near the roll frequency: use the joint fit",
        )
        return
    damped = omega * math.sqrt(1.0 - zeta**2)
    envelope = np.exp(-zeta * omega * time)
    columns = np.column_stack([envelope * np.cos(damped * time), envelope * np.sin(damped * time)])
    missed = signature - columns @ np.linalg.lstsq(columns, signature, rcond=None)[0]
    r2 = 1.0 - float(missed @ missed) / float(np.sum((signature - signature.mean()) ** 2))
    if r2 < 0.9:
        yield Finding(
            "signature-no-decay",
            "warning",
            f"a decaying cosine explains the signature with R2 = {r2:.3f}",
            cure="the excitation is not broad against the roll resonance: use the joint fit",
        )
