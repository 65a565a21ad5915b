"""FLS: a smooth curve through the record first, then least squares of the equation on its derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from .damping_models import DampingModel
from .decay_curve import DecayCurve, fit_decay_curve
from .decay_record import DecayRecord
from .derivation_fit import Derived, averaging_window
from .fit_assessment import as_records, assess_influences, require_speeds
from .roll_damping import RollDamping

#: Degree in time of log-amplitude and phase of the curve.
DEGREE = 5
# Step of the numerical gradient by the parameters of the curve.
GRADIENT_STEP = 1e-6


def _solve(records: Sequence[DecayRecord], curves: Sequence[DecayCurve], model: DampingModel) -> np.ndarray:
    """Free terms by least squares of the equation of motion along the curves, averaged as in the derivation fit.

    Without the average a third harmonic of the curve, enlarged ninefold by two derivatives, would decide the damping.
    """
    free = [i for i, name in enumerate(model.names) if name not in model.fixed]
    known = np.array([model.fixed.get(name, 0.0) for name in model.names])
    designs, responses = [], []
    for record, curve in zip(records, curves):
        value, rate, acceleration, _ = curve.evaluate(record.time)
        window = averaging_window(record)
        along = Derived(value, rate, acceleration, slice(None), 0.0, window=window)
        columns = along.seen(model.columns(value, rate, record.speed))
        designs.append(columns[:, free])
        responses.append(-along.seen(acceleration) - columns @ known)
    return np.linalg.lstsq(np.vstack(designs), np.concatenate(responses), rcond=None)[0]


def fit_smooth_curve(
    records: DecayRecord | Sequence[DecayRecord], model: DampingModel | None = None, *, degree: int = DEGREE
) -> RollDamping:
    """Curve fit first, then least squares (FLS of the NLS-SVM paper, MASHCON 2019).

    The curve is a cosine whose log-amplitude and phase are polynomials of time, with a third harmonic.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    degree : int
        Of the polynomials.

    Raises
    ------
    FitError
        If no curve fits, nothing restores, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    curves = [fit_decay_curve(one, degree, harmonics=True) for one in runs]
    values = _solve(runs, curves, chosen)
    influences = []
    for k, (record, curve) in enumerate(zip(runs, curves)):
        gradient = np.empty((values.size, curve.parameters.size))
        for j in range(curve.parameters.size):
            moved = []
            for sign in (1.0, -1.0):
                parameters = curve.parameters.copy()
                parameters[j] += sign * GRADIENT_STEP
                changed = [*curves[:k], replace(curve, parameters=parameters), *curves[k + 1 :]]
                moved.append(_solve(runs, changed, chosen))
            gradient[:, j] = (moved[0] - moved[1]) / (2.0 * GRADIENT_STEP)
        influences.append(gradient @ np.linalg.pinv(curve.evaluate(record.time)[3]))
    return assess_influences(
        "curve, then least squares",
        runs,
        chosen,
        dict(zip(chosen.free, map(float, values))),
        influences,
        again=lambda clean: dict(
            zip(
                chosen.free,
                map(float, _solve(clean, [fit_decay_curve(one, degree, harmonics=True) for one in clean], chosen)),
            )
        ),
        choices={"curve": f"log-amplitude and phase of degree {curves[0].degree} in time, third harmonic"},
    )
