"""Equivalent damping and frequency at single amplitudes, and the coefficients that run through them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.errors import FitError
from .damping_models import DAMPING_TERMS, DampingModel, split_speed_term
from .decay_record import DecayRecord
from .equivalent_damping import lever_describing_function


@dataclass(frozen=True, eq=False)
class AmplitudePoints:
    """Points of one record.

    Attributes
    ----------
    amplitude, alpha, omega : ndarray, shape (m,)
        Amplitude in rad or m, equivalent damping in 1/s, undamped circular frequency in rad/s.
    alpha_influence, omega_influence : ndarray, shape (m, n)
        What a unit error of each sample does to them.
    """

    amplitude: np.ndarray
    alpha: np.ndarray
    omega: np.ndarray
    alpha_influence: np.ndarray
    omega_influence: np.ndarray


def damping_columns(
    model: DampingModel, amplitude: np.ndarray, omega: np.ndarray, speed: float
) -> tuple[list[str], np.ndarray]:
    """Names of the damping terms and what one unit of each adds to alpha_e, shape (m, q)."""
    base = {
        "b1": np.full(amplitude.size, 0.5),
        "b2": 4.0 / (3.0 * math.pi) * omega * amplitude,
        "b3": 0.375 * (omega * amplitude) ** 2,
    }
    names = [name for name in model.names if split_speed_term(name)[0] in DAMPING_TERMS]
    return names, _with_speed(names, base, speed, amplitude.size)


def restoring_columns(model: DampingModel, amplitude: np.ndarray, speed: float) -> tuple[list[str], np.ndarray]:
    """Names of the restoring terms and what one unit of each adds to omega^2, shape (m, q)."""
    base = {
        "c1": lever_describing_function(model.curve, amplitude),
        "c3": 0.75 * amplitude**2,
        "c5": 0.625 * amplitude**4,
    }
    names = [name for name in model.names if split_speed_term(name)[0] not in DAMPING_TERMS]
    return names, _with_speed(names, base, speed, amplitude.size)


def _with_speed(names: Sequence[str], base: dict[str, np.ndarray], speed: float, size: int) -> np.ndarray:
    columns = np.empty((size, len(names)))
    for k, name in enumerate(names):
        term, power = split_speed_term(name)
        columns[:, k] = base[term] * speed**power
    return columns


def solve_weighted(
    model: DampingModel, names: Sequence[str], design: np.ndarray, response: np.ndarray, weights: np.ndarray
) -> tuple[dict[str, float], np.ndarray]:
    """Weighted least squares for those of `names` that are free: values, and the map from response to values.

    Raises
    ------
    FitError
        If there are fewer points than free terms, or they cannot be separated.
    """
    free = [k for k, name in enumerate(names) if name not in model.fixed]
    known = design @ np.array([model.fixed.get(name, 0.0) for name in names])
    if not free:
        return {}, np.zeros((0, response.size))
    weighted = design[:, free] * weights[:, None]
    scale = np.linalg.norm(weighted, axis=0)
    if response.size < len(free) or not (scale > 0.0).all() or np.linalg.cond(weighted / scale) > 1e10:
        raise FitError(
            f"{response.size} point(s) cannot separate {', '.join(names[k] for k in free)}",
            cure="use fewer terms, or more half cycles over a wider span of amplitudes",
        )
    solver = (np.linalg.pinv(weighted / scale) / scale[:, None]) * weights
    values = solver @ (response - known)
    return {names[k]: float(value) for k, value in zip(free, values)}, solver


def fit_points(
    records: Sequence[DecayRecord], points: Sequence[AmplitudePoints], model: DampingModel
) -> tuple[dict[str, float], list[np.ndarray]]:
    """Coefficients through the points of all records, and their influences in the order of ``model.free``.

    The points are weighted with their amplitude, because an error of the height of a turning point moves alpha by the
    error over the amplitude.

    Raises
    ------
    FitError
        If the points cannot separate the terms.
    """
    names: dict[str, list[str]] = {}
    designs: dict[str, list[np.ndarray]] = {"damping": [], "restoring": []}
    for record, one in zip(records, points):
        names["damping"], columns = damping_columns(model, one.amplitude, one.omega, record.speed)
        designs["damping"].append(columns)
        names["restoring"], columns = restoring_columns(model, one.amplitude, record.speed)
        designs["restoring"].append(columns)
    weights = np.concatenate([one.amplitude for one in points])
    weights = weights / weights.max()
    alpha = np.concatenate([one.alpha for one in points])
    squared = np.concatenate([one.omega**2 for one in points])
    values, by_alpha = solve_weighted(model, names["damping"], np.vstack(designs["damping"]), alpha, weights)
    more, by_squared = solve_weighted(model, names["restoring"], np.vstack(designs["restoring"]), squared, weights)
    values.update(more)
    order = [name for kind in ("damping", "restoring") for name in names[kind] if name not in model.fixed]
    cuts = np.cumsum([one.amplitude.size for one in points])[:-1]
    influences = []
    parts = zip(points, np.split(by_alpha, cuts, axis=1), np.split(by_squared, cuts, axis=1))
    for one, own_alpha, own_squared in parts:
        rows = np.vstack(
            [own_alpha @ one.alpha_influence, own_squared @ (2.0 * one.omega[:, None] * one.omega_influence)]
        )
        influences.append(rows[[order.index(name) for name in model.free]])
    return values, influences
