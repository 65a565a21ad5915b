"""Froude energy method: what each quarter cycle loses is the work of the damping moment."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from ..core.errors import FitError
from .amplitude_points import solve_weighted
from .damping_models import DampingModel, split_speed_term
from .decay_record import DecayRecord
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping

#: Window in periods and degree of the moving polynomial that gives the velocity.
WINDOW = 0.4
DEGREE = 6


@dataclass(frozen=True, eq=False)
class Smoothed:
    """Coordinate from its rest position and velocity by a moving polynomial, where whole windows fit.

    Attributes
    ----------
    value, rate : ndarray, shape (m,)
    first : int
        Sample of the record that they begin with.
    value_weights, rate_weights : ndarray, shape (w,)
        Weights of the samples of a window, in the order of time.
    """

    value: np.ndarray
    rate: np.ndarray
    first: int
    value_weights: np.ndarray
    rate_weights: np.ndarray


def _smoothed(record: DecayRecord, window: float) -> Smoothed:
    from scipy.signal import savgol_coeffs

    rest = record.extremes.rest_line()(record.time)
    half = max(round(0.5 * window * record.period / record.time_step), DEGREE // 2)
    size = 2 * half + 1
    if len(record) < 2 * size:
        raise FitError(
            f"{len(record)} samples hold no two windows of {size}",
            cure="give a longer record, or a shorter window",
            file=record.source or None,
            place=record.name,
        )
    # Interior points only: a polynomial evaluated off its centre is a worse estimate.
    weights = savgol_coeffs(size, DEGREE, use="dot")
    slopes = savgol_coeffs(size, DEGREE, deriv=1, delta=record.time_step, use="dot")
    centred = record.value - rest
    value = np.correlate(centred, weights, mode="valid")
    if record.rate is not None:
        return Smoothed(value, record.rate[half:-half], half, weights, np.zeros(size))
    return Smoothed(value, np.correlate(centred, slopes, mode="valid"), half, weights, slopes)


def fit_energy_method(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None, *, window: float = WINDOW
) -> RollDamping:
    """Least squares of the energy balance over all quarter cycles.

    Between two instants, exactly and for any level of damping,
    ``[x'^2/2 + c1 G(x) + c3 x^4/4 + c5 x^6/6] = -integral (b1 x'^2 + b2 |x'|^3 + b3 x'^4) dt``, with G the integral of
    the restoring shape. Turning points and passages through the rest position bound the quarter cycles; the passages
    bring in the restoring terms.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred.
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    window : float
        Length in periods of the moving polynomial of the sixth degree that gives the velocity.

    Raises
    ------
    FitError
        If the quarter cycles cannot separate the terms, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    values, influences, count = _solve(runs, chosen, window)
    return assess_influences(
        "energy method",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: _solve(clean, chosen, window)[0],
        details={"quarter cycles": count},
        choices={"velocity": f"moving polynomial of degree {DEGREE} over {window:g} periods"},
    )


def _solve(
    runs: Sequence[DecayRecord], model: DampingModel, window: float
) -> tuple[dict[str, float], list[np.ndarray], int]:
    """Free terms, what a unit error of each sample does to them, and the number of quarter cycles."""
    from scipy.linalg import block_diag

    smoothed = [_smoothed(one, window) for one in runs]
    bounds = [_bounds(record, one) for record, one in zip(runs, smoothed)]
    balances = [_balance(record, one, rows, model) for record, one, rows in zip(runs, smoothed, bounds)]
    response = np.concatenate([one[1] for one in balances])
    # An error o of the rest position adds -c1 o times the change of x: one more column for each record.
    rest = block_diag(*[np.diff(one.value[rows])[:, None] for one, rows in zip(smoothed, bounds)])
    design = np.hstack([np.vstack([one[0] for one in balances]), rest])
    names = [*model.names, *(f"rest {k + 1}" for k in range(len(runs)))]
    everywhere, whole = solve_weighted(model, names, design, response, np.ones(response.size))
    values = {name: everywhere[name] for name in model.free}
    solver = whole[: len(model.free)]
    everything = model.complete(values)
    cuts = np.cumsum([one[1].size for one in balances])[:-1]
    influences = [
        _influence(record, one, rows, model, everything, own)
        for record, one, rows, own in zip(runs, smoothed, bounds, np.split(solver, cuts, axis=1))
    ]
    return values, influences, int(response.size)


def _bounds(record: DecayRecord, smoothed: Smoothed) -> np.ndarray:
    """Rows of the smoothed series next to turning points and passages through the rest position, in order."""
    turns = np.flatnonzero(np.diff(np.sign(smoothed.rate)) != 0.0)
    passages = np.flatnonzero(np.diff(np.sign(smoothed.value)) != 0.0)
    least = max(int(0.1 * record.period / record.time_step), 1)
    rows: list[int] = []
    for row in np.sort(np.concatenate([turns, passages])):
        if not rows or row - rows[-1] >= least:
            rows.append(int(row))
    if len(rows) < 3:
        raise FitError(
            f"the record has {max(len(rows) - 1, 0)} quarter cycle(s)",
            cure="give a longer record",
            file=record.source or None,
            place=record.name,
        )
    return np.array(rows)


def _integrals(series: np.ndarray, step: float, rows: np.ndarray) -> np.ndarray:
    """Integrals of a series between successive rows, by a cubic spline."""
    from scipy.interpolate import CubicSpline

    return np.diff(CubicSpline(step * np.arange(series.size), series).antiderivative()(step * rows))


def _balance(
    record: DecayRecord, smoothed: Smoothed, rows: np.ndarray, model: DampingModel
) -> tuple[np.ndarray, np.ndarray]:
    """Work or potential of each term for coefficients of one, shape (k, p), and the loss of kinetic energy, (k,)."""
    x, v, step = smoothed.value, smoothed.rate, record.time_step
    potential = 0.5 * x**2 if model.curve is None else model.curve.potential(x)
    base = {
        "b1": _integrals(v**2, step, rows),
        "b2": _integrals(np.abs(v) ** 3, step, rows),
        "b3": _integrals(v**4, step, rows),
        "c1": np.diff(potential[rows]),
        "c3": np.diff(0.25 * x[rows] ** 4),
        "c5": np.diff(x[rows] ** 6 / 6.0),
    }
    split = [split_speed_term(name) for name in model.names]
    design = np.column_stack([base[term] * record.speed**power for term, power in split])
    return design, -np.diff(0.5 * v[rows] ** 2)


def _influence(
    record: DecayRecord,
    smoothed: Smoothed,
    rows: np.ndarray,
    model: DampingModel,
    everything: np.ndarray,
    solver: np.ndarray,
) -> np.ndarray:
    """What a unit error of each sample does to the estimates, shape (q, n), to first order."""
    b1, b2, b3, c1, c3, c5 = model.spread(record.speed) @ everything
    x, v = smoothed.value, smoothed.rate
    shape = x if model.curve is None else model.curve(x)
    force = c1 * shape + c3 * x**3 + c5 * x**5
    slope = (2.0 * b1 * v + 3.0 * b2 * np.abs(v) * v + 4.0 * b3 * v**3) * record.time_step
    by_value, by_rate = np.zeros((rows.size - 1, x.size)), np.zeros((rows.size - 1, x.size))
    for k, (a, b) in enumerate(pairwise(rows)):
        by_value[k, a], by_value[k, b] = -force[a], force[b]
        by_rate[k, a:b] = slope[a:b]
        by_rate[k, a] -= v[a]
        by_rate[k, b] += v[b]
    result = np.empty((solver.shape[0], len(record)))
    for k, (value_row, rate_row) in enumerate(zip(solver @ by_value, solver @ by_rate)):
        result[k] = -np.convolve(value_row, smoothed.value_weights) - np.convolve(rate_row, smoothed.rate_weights)
    return result
