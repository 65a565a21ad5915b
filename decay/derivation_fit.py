"""Derivation fit: ordinary least squares on the equation of motion with the differentiated record."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from ..core.findings import Finding
from ..identify.linear_fit import LinearFit
from ..identify.low_pass import FILTER_ORDER, low_pass
from ..identify.regression import fit_linear
from .coloured_noise import ColouredNoise
from .damping_models import DampingModel
from .decay_record import DecayRecord
from .dominant_frequency import derivatives
from .fit_assessment import as_records, assess, fitted_gradient, record_noise, require_speeds
from .resimulation import Simulated, Start, resimulate
from .roll_damping import RollDamping

Covariance = Literal["autocorrelated", "independent"]

#: Periods cut off both ends after differentiation, where the filter sees beyond the record.
TRIM = 0.25
#: Cut-off over the frequency of the decay; it keeps the harmonics of damping and restoring.
RECORD_CUTOFF = 6.0
#: Length in periods of the moving average of the equation.
AVERAGE = 1.0
# A bias beyond this part of a standard error is told.
TOLD_BIAS = 0.5


@dataclass(frozen=True, eq=False)
class Derived:
    """A record with its derivatives, and the rows that are fit to use.

    Attributes
    ----------
    value, rate, acceleration : ndarray, shape (n,)
        Filtered alike.
    rows : slice
    cutoff : float
        Of the filter in Hz; 0 when the derivatives came with the record.
    order : int
    window : ndarray, shape (k,), optional
        Weights of the moving average through which all terms of the equation are seen.
    """

    value: np.ndarray
    rate: np.ndarray
    acceleration: np.ndarray
    rows: slice
    cutoff: float
    order: int = FILTER_ORDER
    window: np.ndarray | None = None

    @property
    def given(self) -> bool:
        """Whether the derivatives came with the record."""
        return self.cutoff == 0.0

    def seen(self, series: np.ndarray) -> np.ndarray:
        """Terms of the equation, shape (n,) or (n, k), cut to the rows to use and averaged.

        Only whole windows are kept, so that the equation holds as exactly for the averages as for the samples.
        """
        from scipy.signal import fftconvolve

        # Cut first: the average must not see the ends, where the derivatives are wrong.
        inner = series[self.rows]
        if self.window is None:
            return inner
        window = self.window if series.ndim == 1 else self.window[:, None]
        return np.asarray(fftconvolve(inner, window, mode="valid", axes=0))

    def spread_back(self, rows: np.ndarray, samples: int) -> np.ndarray:
        """Transpose of :meth:`seen` on rows of shape (p, m): shape (p, samples)."""
        from scipy.signal import fftconvolve

        if self.window is not None:
            rows = fftconvolve(rows, self.window[None, ::-1], mode="full", axes=1)
        wide = np.zeros((rows.shape[0], samples))
        wide[:, self.rows] = rows
        return wide


def averaging_window(record: DecayRecord, length: float = AVERAGE) -> np.ndarray | None:
    """Weights of a Hann window of so many periods, with the sum 1; None for no length."""
    if length <= 0.0:
        return None
    # The zeros at both ends of the window are left out.
    window = np.hanning(max(round(length * record.period / record.time_step), 1) + 2)[1:-1]
    return np.asarray(window / window.sum())


def derive(
    record: DecayRecord,
    *,
    cutoff: float | None = None,
    average: float = AVERAGE,
    order: int = FILTER_ORDER,
    trim: float = TRIM,
) -> Derived:
    """Coordinate, velocity and acceleration through one zero-phase filter, by a quintic spline.

    Parameters
    ----------
    record : DecayRecord
    cutoff : float, optional
        Of the record, in Hz; six times the frequency of the decay when not given.
    average : float
        Length in periods of the moving average (Hann window) that all terms of the equation pass; 0 for none. It leaves
        the coefficients as they are and takes away the noise that differentiation brought up.
    order : int
        Of one pass of the Butterworth filters.
    trim : float
        Periods left out at both ends.

    Raises
    ------
    FitError
        If nothing is left between the ends.
    """
    if record.rate is not None and record.acceleration is not None:
        return Derived(record.value, record.rate, record.acceleration, slice(0, len(record)), 0.0)
    chosen = RECORD_CUTOFF / record.period if cutoff is None else cutoff
    value = low_pass(record.value, record.time_step, chosen, order)
    rate, acceleration = derivatives(record.time, value)
    lost = round(trim * record.period / record.time_step)
    rows = slice(lost, len(record) - lost)
    window = averaging_window(record, average)
    left = len(record) - 2 * lost - (0 if window is None else window.size - 1)
    if left < 8:
        raise FitError(
            f"{max(left, 0)} sample(s) are left between the ends of the record",
            cure="give a longer record, or trim and average less",
            file=record.source or None,
            place=record.name,
        )
    return Derived(value, rate, acceleration, rows, chosen, order, window)


def fit_equation(
    records: Sequence[DecayRecord],
    derived: Sequence[Derived],
    model: DampingModel,
    *,
    offset: bool = True,
) -> LinearFit:
    """Least squares of ``-x''`` on the terms of the equation, all records together.

    Parameters
    ----------
    records, derived : sequence
        The records and their derivatives.
    model : DampingModel
    offset : bool
        Whether each record has a rest position of its own: a constant column ``rest k``.

    Returns
    -------
    LinearFit
        Of the free terms and the rest positions.
    """
    blocks, responses = [], []
    for number, (record, one) in enumerate(zip(records, derived)):
        columns = one.seen(model.columns(one.value, one.rate, record.speed))
        fixed = np.array([model.fixed.get(name, 0.0) for name in model.names])
        free = [i for i, name in enumerate(model.names) if name not in model.fixed]
        rest = np.zeros((columns.shape[0], len(records) if offset else 0))
        if offset:
            rest[:, number] = 1.0
        blocks.append(np.hstack([columns[:, free], rest]))
        responses.append(-one.seen(one.acceleration) - columns @ fixed)
    names = [*model.free, *(f"rest {k + 1}" for k in range(len(records) if offset else 0))]
    return fit_linear(np.vstack(blocks), np.concatenate(responses), names)


def resimulated_design(
    linear: LinearFit,
    records: Sequence[DecayRecord],
    derived: Sequence[Derived],
    model: DampingModel,
    simulated: Sequence[Simulated],
) -> np.ndarray:
    """Instruments: the design with the terms of the re-simulated motion in place of the measured ones.

    Parameters
    ----------
    linear : LinearFit
        Of :func:`fit_equation`.
    records, derived : sequence
        As given to it.
    model : DampingModel
    simulated : sequence of Simulated
        One a record.

    Returns
    -------
    ndarray, shape of the design
        The rest positions keep their columns.
    """
    clean = linear.design.copy()
    places = [model.names.index(name) for name in model.free]
    begin = 0
    for record, one, motion in zip(records, derived, simulated):
        rows = one.seen(model.columns(motion.motion, motion.rate, record.speed))[:, places]
        clean[begin : begin + len(rows), : len(places)] = rows
        begin += len(rows)
    return clean


def fit_derivation(
    records: DecayRecord | Sequence[DecayRecord],
    model: DampingModel | None = None,
    *,
    cutoff: float | None = None,
    average: float = AVERAGE,
    order: int = FILTER_ORDER,
    trim: float = TRIM,
    offset: bool = True,
    instruments: bool = False,
    covariance: Covariance = "autocorrelated",
    start: Start = "free",
) -> RollDamping:
    """Fit the equation of motion to the differentiated record by ordinary least squares.

    Noise in the regressors biases this estimator. The bias is estimated by using the re-simulated motion as
    instruments, and told when it exceeds half a standard error.

    Parameters
    ----------
    records : DecayRecord or sequence of DecayRecord
        Free parts, centred.
    model : DampingModel, optional
        Linear plus quadratic damping when not given.
    cutoff, average, order, trim
        See :func:`derive`. They do not matter for records that bring their derivatives.
    offset : bool
        Fit a rest position of each record.
    instruments : bool
        Return the estimate with the re-simulated motion as instruments, free of the bias by noise.
    covariance : {"autocorrelated", "independent"}
        From the autocorrelation of the residual angle, or the textbook's s^2 (X'X)^-1 that takes every sample for a
        measurement of its own.
    start : {"free", "measured"}
        Initial values of the re-simulation.

    Raises
    ------
    FitError
        If the terms cannot be separated, or the result does not explain the records.
    """
    chosen = DampingModel() if model is None else model
    runs = as_records(records)
    require_speeds(runs, chosen)
    derived = [derive(one, cutoff=cutoff, average=average, order=order, trim=trim) for one in runs]
    linear = fit_equation(runs, derived, chosen, offset=offset)
    count = len(chosen.free)
    values = dict(zip(chosen.free, linear.params[:count]))
    _require_restoring(values, chosen, runs[0])
    everything = chosen.complete(values)
    fitted = [
        resimulate(one, chosen, chosen.spread(one.speed) @ everything, start=start, offset=offset) for one in runs
    ]
    clean = resimulated_design(linear, runs, derived, chosen, [sim for _, sim in fitted])
    unbiased = np.linalg.solve(clean.T @ linear.design, clean.T @ linear.response)
    if instruments:
        values = dict(zip(chosen.free, unbiased[:count]))
        everything = chosen.complete(values)
        _require_restoring(values, chosen, runs[0])
        fitted = [
            resimulate(one, chosen, chosen.spread(one.speed) @ everything, start=start, offset=offset)
            for one in runs
        ]
    simulated = [run for run, _ in fitted]
    gradients = [fitted_gradient(one, chosen, sim) for one, (_, sim) in zip(runs, fitted)]
    noise = record_noise(runs, simulated, gradients)
    dof: float | None = None
    if instruments:
        solver = np.linalg.solve(clean.T @ linear.design, clean.T)
    else:
        solver = np.linalg.pinv(linear.design)
    lengths = [one.seen(one.value).size for one in derived]
    parts = np.split(solver[:count], np.cumsum(lengths)[:-1], axis=1)
    if covariance == "independent":
        cov, dof = linear.cov[:count, :count], float(linear.dof)
    elif all(one.given for one in derived):
        # Nothing was differentiated here: the residual of the equation is the noise.
        cycles = [one.time_step / one.period for one in runs]
        left = np.split(linear.resid, np.cumsum(lengths)[:-1])
        errors = ColouredNoise.of_residuals(left, cycles, count / len(runs))
        cov, dof = errors.covariance(parts), errors.dof
    else:
        rows = [
            _angle_influence(part, one, record, chosen.spread(record.speed) @ everything, chosen)
            for part, one, record in zip(parts, derived, runs)
        ]
        cov = noise.covariance(rows)
    findings = []
    sd = np.sqrt(np.maximum(np.diagonal(cov), 1e-300))
    bias = linear.params[:count] - unbiased[:count]
    worst = int(np.argmax(np.abs(bias) / sd))
    if not instruments and abs(bias[worst]) > TOLD_BIAS * sd[worst] and not all(one.given for one in derived):
        findings.append(
            Finding(
                "noise-in-regressors",
                "warning",
                f"noise biases {chosen.free[worst]} by about {bias[worst] / sd[worst]:+.1f} standard errors",
                runs[0].source,
                runs[0].name,
                "use the integration fit, or instruments = True",
            )
        )
    return assess(
        "derivation, instruments" if instruments else "derivation",
        runs,
        chosen,
        values,
        cov,
        simulated,
        noise,
        dof=dof,
        condition=linear.condition_number,
        findings=findings,
        details={
            "r2 of the acceleration": 1.0
            - float(linear.resid @ linear.resid) / float(np.sum((linear.response - linear.response.mean()) ** 2)),
            "bias by noise": dict(zip(chosen.free, bias.tolist())),
        },
        choices={
            "derivatives": "given with the record"
            if derived[0].given
            else f"Butterworth {order}, {derived[0].cutoff:.4g} Hz, forward and backward; quintic spline; "
            f"{trim:g} periods trimmed at both ends; equation averaged over {average:g} periods",
            "covariance": covariance,
            "offset": offset,
            "start": start,
        },
    )


def _require_restoring(values: dict[str, float], model: DampingModel, record: DecayRecord) -> None:
    spring = {**values, **model.fixed}["c1"]
    if not spring > 0.0:
        raise FitError(
            f"the derivation fit gives c1 = {spring:.4g}, which does not restore",
            cure="check that the record is a free decay about its rest position, or filter less",
            file=record.source or None,
            place=record.name,
        )


def _angle_influence(
    part: np.ndarray, derived: Derived, record: DecayRecord, coefficients: np.ndarray, model: DampingModel
) -> np.ndarray:
    """What a unit error of each measured angle does to the estimates, shape (p, n), to first order.

    The equation error is (D^2 + b' D + c') F of the error of the angle: F the filter, D the derivative, b' and c' the
    slopes of damping and restoring at the motion. Estimates are `part` times it with the sign turned; the transpose
    is applied to the rows, with D turned to -D.
    """
    b1, b2, b3, c1, c3, c5 = coefficients
    x, v = derived.value, derived.rate
    shape = 1.0 if model.curve is None else model.curve.slope(x)
    by_rate = b1 + 2.0 * b2 * np.abs(v) + 3.0 * b3 * v**2
    by_value = c1 * shape + 3.0 * c3 * x**2 + 5.0 * c5 * x**4
    rows = derived.spread_back(part, len(record))
    smooth = low_pass(rows.T, record.time_step, derived.cutoff, derived.order)
    damped = low_pass((by_rate * rows).T, record.time_step, derived.cutoff, derived.order)
    sprung = low_pass((by_value * rows).T, record.time_step, derived.cutoff, derived.order)
    second = derivatives(record.time, smooth)[1]
    first = derivatives(record.time, damped)[0]
    return -(second - first + sprung).T
