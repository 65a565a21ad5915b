"""Extinction curve: loss of amplitude in a half cycle against the mean amplitude, with Bertin's coefficient."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .amplitude_points import restoring_columns, solve_weighted
from .damping_models import DAMPING_TERMS, DampingModel, split_speed_term
from .decay_record import DecayRecord
from .extremes import extreme_influences
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping

#: Power of the mean amplitude that each damping term's loss runs with.
LETTERS = {"b1": "a", "b2": "b", "b3": "c"}


def extinction_points(record: DecayRecord) -> tuple[np.ndarray, np.ndarray]:
    """Mean amplitude and loss of each half cycle, shape (m - 1,) each, heights counted from the rest position."""
    height = record.extremes.amplitudes()
    return 0.5 * (height[:-1] + height[1:]), height[:-1] - height[1:]


def fit_extinction_curve(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None
) -> RollDamping:
    """Loss = a m + b m^2 + c m^3 by least squares, and the damping terms that it stands for to first order.

    a = pi b1/(2 omega), b = 4/3 b2, c = 3 pi/8 omega b3 (angles in rad). With quadratic damping alone b is Bertin's N.
    The first order leaves a bias of a few per cent in c; the integration fit has none.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
    model : DampingModel, optional
        Linear plus quadratic damping (a and b) when not given.

    Raises
    ------
    FitError
        If the half cycles cannot separate the terms, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    values, influences = _solve(runs, chosen)
    loss = np.concatenate([extinction_points(one)[1] for one in runs])
    mean = np.concatenate([extinction_points(one)[0] for one in runs])
    return assess_influences(
        "extinction curve",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: _solve(clean, chosen)[0],
        details={
            "mean amplitude": mean.tolist(),
            "loss": loss.tolist(),
            "polynomial": _polynomial(mean, loss, chosen),
            "Bertin N [1/deg]": (np.degrees(loss) / np.degrees(mean) ** 2).tolist()
            if runs[0].motion != "heave"
            else [],
        },
        choices={"heights": "from the fitted rest position", "weights": "equal"},
    )


def _solve(runs: Sequence[DecayRecord], chosen: DampingModel) -> tuple[dict[str, float], list[np.ndarray]]:
    """Free terms, and what a unit error of each sample of each record does to them, shapes (q, n)."""
    names = [name for name in chosen.names if split_speed_term(name)[0] in DAMPING_TERMS]
    losses, designs, squares, springs, by_loss, by_square = [], [], [], [], [], []
    springs_names: list[str] = []
    for record in runs:
        found = record.extremes
        mean, loss = extinction_points(record)
        by_time, by_height = extreme_influences(record.time, found)
        by_height = np.sign(found.value - found.rest_line()(found.time))[:, None] * by_height
        half_period = np.diff(found.time)
        # The undamped frequency, whose square is the restoring: the decrement of the half cycle is added.
        decay = np.log1p(loss / np.maximum(mean - 0.5 * loss, 1e-300)) / half_period
        squared = (np.pi / half_period) ** 2 + decay**2
        omega = np.sqrt(squared)
        base = {"b1": 0.5 * np.pi / omega * mean, "b2": 4.0 / 3.0 * mean**2, "b3": 0.375 * np.pi * omega * mean**3}
        columns = [base[term] * record.speed**power for term, power in (split_speed_term(name) for name in names)]
        designs.append(np.column_stack(columns) if columns else np.zeros((mean.size, 0)))
        losses.append(loss)
        squares.append(squared)
        springs_names, spring = restoring_columns(chosen, mean, record.speed)
        springs.append(spring)
        by_loss.append(by_height[:-1] - by_height[1:])
        by_square.append(-(2.0 * np.pi**2 / half_period**3)[:, None] * np.diff(by_time, axis=0))
    response = np.concatenate(losses)
    values, solver = solve_weighted(chosen, names, np.vstack(designs), response, np.ones(response.size))
    weights = np.concatenate([extinction_points(one)[0] for one in runs])
    more, spring_solver = solve_weighted(
        chosen, springs_names, np.vstack(springs), np.concatenate(squares), weights / weights.max()
    )
    values.update(more)
    order = [name for name in (*names, *springs_names) if name not in chosen.fixed]
    cuts = np.cumsum([one.size for one in losses])[:-1]
    influences = []
    parts = zip(np.split(solver, cuts, axis=1), np.split(spring_solver, cuts, axis=1), by_loss, by_square)
    for own, own_spring, loss_influence, square_influence in parts:
        rows = np.vstack([own @ loss_influence, own_spring @ square_influence])
        influences.append(rows[[order.index(name) for name in chosen.free]])
    return values, influences


def _polynomial(mean: np.ndarray, loss: np.ndarray, model: DampingModel) -> dict[str, float]:
    """Coefficients a, b, c of the curve as the field writes them, in rad or m."""
    letters = [LETTERS[name] for name in model.damping]
    powers = ["abc".index(letter) + 1 for letter in letters]
    design = np.column_stack([mean**power for power in powers])
    return dict(zip(letters, map(float, np.linalg.lstsq(design, loss, rcond=None)[0])))
