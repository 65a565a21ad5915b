"""Exponentially damped cosine fitted to the record: linear damping of the whole decay."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .amplitude_points import AmplitudePoints, fit_points
from .damping_models import DampingModel, damping_model
from .decay_curve import DecayCurve, fit_decay_curve
from .decay_record import DecayRecord
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping


def curve_point(record: DecayRecord, curve: DecayCurve) -> AmplitudePoints:
    """Damping and frequency of an exponentially damped cosine, at its mean logarithmic amplitude.

    x = A exp(-alpha t) cos(omega_d t + e) + offset solves x'' + 2 alpha x' + (omega_d^2 + alpha^2) x = 0.
    """
    half = 0.5 * (curve.last - curve.first)
    log, phase = curve.parameters[:2], curve.parameters[2:4]
    alpha, damped = -log[1] / half, phase[1] / half
    omega = float(np.hypot(alpha, damped))
    solver = np.linalg.pinv(curve.evaluate(record.time)[3])
    by_alpha, by_damped = -solver[1] / half, solver[3] / half
    by_omega = (alpha * by_alpha + damped * by_damped) / omega
    return AmplitudePoints(
        np.array([np.exp(log[0])]), np.array([alpha]), np.array([omega]), by_alpha[None, :], by_omega[None, :]
    )


def fit_exponential_cosine(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None
) -> RollDamping:
    """Fit one exponentially damped cosine to each record; the coefficients run through their damping.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
    model : DampingModel, optional
        Linear damping when not given. More terms need several records, of different amplitude or speed.

    Raises
    ------
    FitError
        If the terms need more records, or the result does not explain them.
    """
    chosen = damping_model("linear") if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    points = [curve_point(one, fit_decay_curve(one, 1)) for one in runs]
    values, influences = fit_points(runs, points, chosen)
    return assess_influences(
        "exponential cosine",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: fit_points(
            clean, [curve_point(one, fit_decay_curve(one, 1)) for one in clean], chosen
        )[0],
        details={
            "amplitude": [float(one.amplitude[0]) for one in points],
            "alpha": [float(one.alpha[0]) for one in points],
            "omega": [float(one.omega[0]) for one in points],
        },
        choices={"curve": "A exp(-alpha t) cos(omega t + e) + offset"},
    )
