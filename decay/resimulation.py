"""Motion that fitted coefficients give, started so that it comes closest to the record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .damping_models import DampingModel
from .decay_record import DecayRecord
from .fit_diagnostics import FittedRun

#: How a simulated decay starts: fitted, or at the record's own first sample and slope.
Start = Literal["free", "measured"]

# Gauss-Newton steps that find the initial values; they are nearly linear in the motion.
MOST_STEPS = 12
# Part of a period at the start from which the first values are read.
HEAD = 0.2


@dataclass(frozen=True, eq=False)
class Simulated:
    """A simulated record and its gradients.

    Attributes
    ----------
    value : ndarray, shape (n,)
        Coordinate with the offset.
    motion, rate : ndarray, shape (n,)
        Coordinate without the offset, and velocity.
    gradient : ndarray, shape (n, 9)
        By b1, b2, b3, c1, c3, c5, the initial coordinate and velocity, and the offset.
    """

    value: np.ndarray
    motion: np.ndarray
    rate: np.ndarray
    gradient: np.ndarray


def first_values(record: DecayRecord, offset: float = 0.0) -> tuple[float, float]:
    """Coordinate without the offset and velocity at the first sample, from a cubic through a fifth of a period."""
    if record.rate is not None:
        return float(record.value[0]) - offset, float(record.rate[0])
    count = max(int(HEAD * record.period / record.time_step), 5)
    t = record.time[:count] - record.time[0]
    fit = np.polynomial.Polynomial.fit(t, record.value[:count], 3)
    return float(fit(0.0)) - offset, float(fit.deriv()(0.0))


def simulate_record(
    record: DecayRecord,
    model: DampingModel,
    coefficients: np.ndarray,
    start: tuple[float, float],
    offset: float = 0.0,
) -> Simulated | None:
    """The record simulated with its gradients; None when the motion diverges."""
    from .equation import simulate_decay

    path = simulate_decay(record.time, start, coefficients, curve=model.curve, sensitivities=True)
    if not np.isfinite(path[-1]).all():
        return None
    gradient = np.empty((len(record), 9))
    gradient[:, :8] = path[:, 2::2]
    gradient[:, 8] = 1.0
    return Simulated(path[:, 0] + offset, path[:, 0], path[:, 1], gradient)


def resimulate(
    record: DecayRecord,
    model: DampingModel,
    coefficients: np.ndarray,
    *,
    start: Start = "free",
    offset: bool = True,
) -> tuple[FittedRun, Simulated]:
    """Simulate a record with given coefficients from the initial values that fit it best.

    Parameters
    ----------
    record : DecayRecord
    model : DampingModel
    coefficients : ndarray, shape (6,)
        At the speed of the record.
    start : {"free", "measured"}
        Whether the initial coordinate and velocity are fitted.
    offset : bool
        Whether the rest position is fitted; zero otherwise.

    Raises
    ------
    FitError
        If the motion diverges from the first values of the record.
    """
    unknowns = [6, 7] if start == "free" else []
    if offset:
        unknowns.append(8)
    state = np.array([*first_values(record), 0.0])
    simulated = simulate_record(record, model, coefficients, (state[0], state[1]), state[2])
    if simulated is None:
        raise FitError(
            "the motion with the fitted coefficients diverges",
            cure="leave out terms that the record cannot separate, or check its window",
            file=record.source or None,
            place=record.name,
        )
    cost = float(np.sum((simulated.value - record.value) ** 2))
    for _ in range(MOST_STEPS if unknowns else 0):
        columns = simulated.gradient[:, unknowns]
        step = np.linalg.lstsq(columns, record.value - simulated.value, rcond=None)[0]
        trial = state.copy()
        trial[np.array(unknowns) - 6] += step
        new = simulate_record(record, model, coefficients, (trial[0], trial[1]), trial[2])
        if new is None:
            break
        lower = float(np.sum((new.value - record.value) ** 2))
        if lower >= cost:
            break
        gain, state, simulated = cost - lower, trial, new
        cost = lower
        if gain <= 1e-10 * cost:
            break
    run = FittedRun(
        record.name,
        record.time,
        record.value,
        simulated.value,
        (float(state[0]), float(state[1])),
        float(state[2]),
        record.speed,
    )
    return run, simulated


def explained(runs: Sequence[FittedRun]) -> float:
    """R2: part of the variance of all records about their means that the simulated motion explains."""
    left = sum(float(np.sum(run.residual**2)) for run in runs)
    whole = sum(float(np.sum((run.measured - run.measured.mean()) ** 2)) for run in runs)
    return 1.0 - left / whole
