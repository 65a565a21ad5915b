"""Logarithmic decrement of successive half cycles."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .amplitude_points import AmplitudePoints, fit_points
from .damping_models import DampingModel, damping_model
from .decay_record import DecayRecord
from .extremes import extreme_influences
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping

Form = Literal["exact", "light"]


def damping_ratio(decrement: float | np.ndarray, form: Form = "exact") -> np.ndarray:
    """Damping ratio from the logarithmic decrement of a full cycle.

    ``exact``: delta = 2 pi zeta/sqrt(1 - zeta^2); ``light``: delta = 2 pi zeta, 0.5 % higher at zeta = 0.1.

    Raises
    ------
    FitError
        For an unknown form.
    """
    delta = np.asarray(decrement, dtype=float)
    if form == "exact":
        return delta / np.sqrt(4.0 * np.pi**2 + delta**2)
    if form == "light":
        return delta / (2.0 * np.pi)
    raise FitError(f"form '{form}' of the decrement is unknown", cure="use exact or light")


def decrement_points(record: DecayRecord, form: Form = "exact") -> AmplitudePoints:
    """Equivalent damping and frequency of each half cycle.

    The decrement is taken between successive swings (turning point to turning point), which no offset falsifies:
    alpha = ln(s1/s2) over the half period, at the amplitude sqrt(s1 s2)/2 of the turning point between.

    Raises
    ------
    FitError
        If a swing is not smaller than the one before it by more than rounding, everywhere.
    """
    found = record.extremes
    if found.value.size < 3:
        raise FitError(
            f"{found.value.size} turning point(s) give no decrement",
            cure="give a longer record",
            file=record.source or None,
            place=record.name,
        )
    by_time, by_height = extreme_influences(record.time, found)
    swing = found.half_swing
    signed = np.sign(np.diff(found.value))[:, None]
    swing_influence = 0.5 * signed * np.diff(by_height, axis=0)
    half_period = 0.5 * (found.time[2:] - found.time[:-2])
    half_influence = 0.5 * (by_time[2:] - by_time[:-2])
    loss = np.log(swing[:-1] / swing[1:])
    loss_influence = swing_influence[:-1] / swing[:-1, None] - swing_influence[1:] / swing[1:, None]
    alpha = loss / half_period
    alpha_influence = (loss_influence - alpha[:, None] * half_influence) / half_period[:, None]
    damped = np.pi / half_period
    damped_influence = -(damped / half_period)[:, None] * half_influence
    if form == "light":
        omega, omega_influence = damped, damped_influence
    else:
        omega = np.sqrt(damped**2 + alpha**2)
        omega_influence = (damped[:, None] * damped_influence + alpha[:, None] * alpha_influence) / omega[:, None]
    return AmplitudePoints(np.sqrt(swing[:-1] * swing[1:]), alpha, omega, alpha_influence, omega_influence)


def fit_logarithmic_decrement(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None, *, form: Form = "exact"
) -> RollDamping:
    """Coefficients through the decrements of all half cycles.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
    model : DampingModel, optional
        Linear damping when not given: the mean decrement, weighted by amplitude. Further damping terms follow the run
        of the decrement with amplitude, further restoring terms that of the half periods.
    form : {"exact", "light"}
        See :func:`damping_ratio`.

    Raises
    ------
    FitError
        If the half cycles cannot separate the terms, or the result does not explain the records.
    """
    chosen = damping_model("linear") if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    points = [decrement_points(one, form) for one in runs]
    values, influences = fit_points(runs, points, chosen)
    alpha = np.concatenate([one.alpha for one in points])
    omega = np.concatenate([one.omega for one in points])
    return assess_influences(
        "logarithmic decrement",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: fit_points(clean, [decrement_points(one, form) for one in clean], chosen)[0],
        details={
            "amplitude": np.concatenate([one.amplitude for one in points]).tolist(),
            "alpha": alpha.tolist(),
            "zeta": (alpha / omega).tolist(),
        },
        choices={"form": form, "decrement": "of swings from turning point to turning point"},
    )
