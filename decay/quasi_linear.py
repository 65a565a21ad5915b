"""Quasi-linear analysis: a damped cosine over a window of a cycle that slides along the decay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..core.errors import FitError
from .amplitude_points import AmplitudePoints, fit_points
from .damping_models import DampingModel
from .decay_curve import fit_decay_curve
from .decay_record import DecayRecord
from .exponential_cosine import curve_point
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping

#: Half cycles in a window.
WINDOW = 3


def quasi_linear_points(record: DecayRecord, window: int = WINDOW) -> AmplitudePoints:
    """Equivalent damping and frequency of windows that start at each turning point.

    Parameters
    ----------
    record : DecayRecord
    window : int
        Half cycles in a window.

    Raises
    ------
    FitError
        If the record is shorter than a window, or a window is too short for a fit.
    """
    found = record.extremes
    if window < 2 or found.value.size <= window:
        raise FitError(
            f"windows of {window} half cycles do not fit into {found.value.size - 1}",
            cure="use 2 half cycles or more, and a longer record",
            file=record.source or None,
            place=record.name,
        )
    parts = []
    for k in range(found.value.size - window):
        rows = slice(int(found.index[k]), int(found.index[k + window]) + 1)
        # The turning points of the whole record are kept: those of so short a piece cannot be detected.
        piece = replace(record, time=record.time[rows], value=record.value[rows], rate=None, acceleration=None)
        own = found.part(slice(k, k + window + 1))
        piece.__dict__["extremes"] = replace(own, index=own.index - rows.start)
        point = curve_point(piece, fit_decay_curve(piece, 1))
        alpha, omega = np.zeros((1, len(record))), np.zeros((1, len(record)))
        alpha[:, rows], omega[:, rows] = point.alpha_influence, point.omega_influence
        parts.append(replace(point, alpha_influence=alpha, omega_influence=omega))
    return AmplitudePoints(
        np.concatenate([one.amplitude for one in parts]),
        np.concatenate([one.alpha for one in parts]),
        np.concatenate([one.omega for one in parts]),
        np.vstack([one.alpha_influence for one in parts]),
        np.vstack([one.omega_influence for one in parts]),
    )


def fit_quasi_linear(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None, *, window: int = WINDOW
) -> RollDamping:
    """Coefficients through the equivalent damping and frequency of sliding windows.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    window : int
        Half cycles in a window.

    Raises
    ------
    FitError
        If the windows cannot separate the terms, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    points = [quasi_linear_points(one, window) for one in runs]
    values, influences = fit_points(runs, points, chosen)
    return assess_influences(
        "quasi-linear",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: fit_points(clean, [quasi_linear_points(one, window) for one in clean], chosen)[0],
        details={
            "amplitude": np.concatenate([one.amplitude for one in points]).tolist(),
            "alpha": np.concatenate([one.alpha for one in points]).tolist(),
            "omega": np.concatenate([one.omega for one in points]).tolist(),
        },
        choices={"window": f"{window} half cycles, starting at each turning point"},
    )
