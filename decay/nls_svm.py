"""NLS-SVM: an LS-SVM of the angle over time, differentiated in closed form, then least squares, then re-simulation.

The record is fitted with a least-squares support vector machine with a Gaussian kernel exp(-(t - s)^2/sigma^2); its
first and second derivatives are sums over the derivatives of the kernel (Mehrkanoon et al. 2012). In the equation of
motion the coefficients are then linear. Both ends are trimmed, where the kernel sees beyond the record: left in, they
spoil the quadratic term. A symmetric kernel shrinks angle, rate and acceleration alike, so that the linear terms are
not biased by smoothing. Noise in the columns biases the published form of the method; with the re-simulated motion as
instruments, the default here, it does not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..core.errors import FitError
from ..identify.linear_fit import LinearFit
from ..identify.lssvm_curve import LSSVMCurve, fit_lssvm_curve, is_uniform
from .damping_models import DampingModel
from .decay_record import DecayRecord
from .derivation_fit import Derived, averaging_window, fit_equation, resimulated_design
from .fit_assessment import as_records, assess_influences, require_speeds
from .resimulation import resimulate
from .roll_damping import RollDamping

#: Width of the kernel over the period of the decay: narrower ones fit noise, wider ones lose the shape.
SIGMA_OVER_PERIOD = 0.25
#: Periods left out at both ends.
TRIM = 0.25
#: Length in periods of the moving average of the equation; 0 is the published method.
AVERAGE = 1.0

Sigma = float | Literal["period", "loo"]


def curve_of(record: DecayRecord, *, gamma: float | None = None, sigma: Sigma = "period") -> LSSVMCurve:
    """LS-SVM of a record's coordinate.

    Parameters
    ----------
    record : DecayRecord
        Uniformly sampled.
    gamma : float, optional
        Weight of the errors; by exact leave-one-out error when not given.
    sigma : float, "period" or "loo"
        Width in s in exp(-d^2/sigma^2): given, a quarter of the period, or by leave-one-out error with gamma. The
        error of a left-out sample takes correlated noise for signal; the period does not.
    """
    width = None if sigma == "loo" else SIGMA_OVER_PERIOD * record.period if sigma == "period" else float(sigma)
    return fit_lssvm_curve(record.time, record.value, gamma=gamma, sigma=width)


def uniform(record: DecayRecord) -> DecayRecord:
    """The record on uniform times between its first and last, by a cubic spline; itself when it is uniform."""
    if is_uniform(record.time):
        return record
    from scipy.interpolate import CubicSpline

    times = np.linspace(record.time[0], record.time[-1], len(record))
    value = np.asarray(CubicSpline(record.time, record.value)(times))
    step = f"resampled to uniform steps of {times[1] - times[0]:.6g} s"
    return replace(record, time=times, value=value, rate=None, acceleration=None, steps=(*record.steps, step))


def fit_nls_svm(
    records: DecayRecord | Sequence[DecayRecord],
    model: DampingModel | None = None,
    *,
    gamma: float | None = None,
    sigma: Sigma = "period",
    trim: float = TRIM,
    average: float = AVERAGE,
    offset: bool = True,
    instruments: bool = True,
) -> RollDamping:
    """Damping of a free decay by NLS-SVM.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred.
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    gamma, sigma
        See :func:`curve_of`.
    trim : float
        Periods left out at both ends.
    average : float
        Length in periods of a moving average (Hann window) that all terms of the equation pass: it keeps the
        coefficients and takes away noise that differentiation brought up. 0 for the published method.
    offset : bool
        Fit a rest position of each record.
    instruments : bool
        Use the terms of the re-simulated motion as instruments. False is the published method, which noise biases.

    Raises
    ------
    FitError
        If nothing is left between the ends, terms cannot be separated, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = [uniform(one) for one in as_records(records)]
    require_speeds(runs, chosen)
    curves = [curve_of(one, gamma=gamma, sigma=sigma) for one in runs]
    options = _Options(trim, average, offset, instruments)
    values, solver, derived = _solve(runs, curves, chosen, options)
    everything = chosen.complete(values)
    lengths = np.cumsum([one.seen(one.value).size for one in derived])[:-1]
    influences = [
        _influence(part, one, curve, chosen, chosen.spread(record.speed) @ everything)
        for part, one, curve, record in zip(np.split(solver, lengths, axis=1), derived, curves, runs)
    ]
    first = curves[0]
    return assess_influences(
        "NLS-SVM" if instruments else "NLS-SVM, as published",
        runs,
        chosen,
        values,
        influences,
        again=lambda clean: _solve(clean, [_alike(old, one) for old, one in zip(curves, clean)], chosen, options)[
            0
        ],
        details={
            "gamma": [curve.gamma for curve in curves],
            "sigma": [curve.sigma for curve in curves],
            "leave-one-out error": [curve.loo_rmse for curve in curves],
            "effective parameters": [curve.effective_dof for curve in curves],
        },
        choices={
            "kernel": f"exp(-d^2/sigma^2), sigma {first.sigma:.4g} s ({sigma}), gamma {first.gamma:.4g} "
            f"({'given' if gamma is not None else 'leave-one-out'})",
            "trim": f"{trim:g} periods at both ends",
            "average": f"equation averaged over {average:g} periods" if average > 0.0 else "none",
            "offset": offset,
            "instruments": "re-simulated motion" if instruments else "none",
        },
    )


@dataclass(frozen=True)
class _Options:
    """Choices of one fit, as in :func:`fit_nls_svm`."""

    trim: float
    average: float
    offset: bool
    instruments: bool


def _alike(curve: LSSVMCurve, record: DecayRecord) -> LSSVMCurve:
    """LS-SVM of another record with the gamma and sigma of this one."""
    return fit_lssvm_curve(record.time, record.value, gamma=curve.gamma, sigma=curve.sigma)


def _solve(
    records: Sequence[DecayRecord], curves: Sequence[LSSVMCurve], model: DampingModel, options: _Options
) -> tuple[dict[str, float], np.ndarray, list[Derived]]:
    """Free terms, the effect of each row's error on them, and the differentiated records."""
    derived = [_derived(curve, one, options) for curve, one in zip(curves, records)]
    linear = fit_equation(records, derived, model, offset=options.offset)
    values, solver = _estimate(linear.design, linear, model)
    if options.instruments:
        # Twice: the first re-simulation still has the terms that noise has biased.
        for _ in range(2):
            everything = model.complete(values)
            motions = [resimulate(one, model, model.spread(one.speed) @ everything)[1] for one in records]
            clean = resimulated_design(linear, records, derived, model, motions)
            values, solver = _estimate(clean, linear, model)
    return values, solver, derived


def _derived(curve: LSSVMCurve, record: DecayRecord, options: _Options) -> Derived:
    """Angle, rate and acceleration of the curve, and the rows between its trimmed ends."""
    lost = round(options.trim * record.period / record.time_step)
    window = averaging_window(record, options.average)
    left = len(record) - 2 * lost - (0 if window is None else window.size - 1)
    if left < 8:
        raise FitError(
            f"{max(left, 0)} sample(s) are left between the trimmed ends of the record",
            cure="give a longer record, or trim and average less",
            file=record.source or None,
            place=record.name,
        )
    return Derived(
        curve.on_samples(0),
        curve.on_samples(1),
        curve.on_samples(2),
        slice(lost, len(record) - lost),
        cutoff=float("nan"),
        window=window,
    )


def _estimate(
    instruments: np.ndarray, linear: LinearFit, model: DampingModel
) -> tuple[dict[str, float], np.ndarray]:
    """Free terms, and what a unit error of each row of the equation does to them, shape (q, m)."""
    solver = np.linalg.solve(instruments.T @ linear.design, instruments.T)[: len(model.free)]
    return dict(zip(model.free, (solver @ linear.response).tolist())), solver


def _influence(
    part: np.ndarray, derived: Derived, curve: LSSVMCurve, model: DampingModel, coefficients: np.ndarray
) -> np.ndarray:
    """What a unit error of each measured angle does to the terms, shape (q, n), to first order.

    The error of the equation is x'' + b' x' + c' x of the smoothed error, b' and c' the slopes of damping and restoring
    at the motion. The smoother is symmetric and commutes with differentiation but for the trimmed ends, so that its
    transpose is itself, with the sign of the first derivative turned.
    """
    b1, b2, b3, c1, c3, c5 = coefficients
    x, v = derived.value, derived.rate
    shape = 1.0 if model.curve is None else model.curve.slope(x)
    by_rate = b1 + 2.0 * b2 * np.abs(v) + 3.0 * b3 * v**2
    by_value = c1 * shape + 3.0 * c3 * x**2 + 5.0 * c5 * x**4

    def smoothed(row: np.ndarray, order: int) -> np.ndarray:
        peak = float(np.abs(row).max()) or 1.0
        fitted = fit_lssvm_curve(curve.time, row / peak, gamma=curve.gamma, sigma=curve.sigma)
        return peak * fitted.on_samples(order)

    rows = derived.spread_back(part, x.size)
    return -np.array([smoothed(row, 2) - smoothed(by_rate * row, 1) + smoothed(by_value * row, 0) for row in rows])
