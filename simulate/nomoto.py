"""Steering indices K and T of Nomoto, first and second order, fitted to a manoeuvre.

First order: ``T dr/dt + r = K (delta - delta0)``. Second order: ``T1 T2 d2r/dt2 + (T1 + T2) dr/dt + r = K (delta -
delta0) + K T3 d(delta)/dt``. The heading that follows from the recorded rudder is fitted to the recorded heading
(output error), so that noise on the yaw rate does not bias the time constants. For given time constants the heading is
linear in all else: only they are searched for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from ..core.ship import Ship
from .events import FloatArray
from .trajectory import Trajectory
from .trajectory_checks import check_samples

LEAST_HEADING = math.radians(2.0)
"""Heading range below which nothing can be fitted."""

_MOST_SAMPLES = 2000
_GRID = 24


@dataclass(frozen=True)
class NomotoFit:
    """Fitted steering indices.

    Attributes
    ----------
    K : float
        Steady yaw rate over rudder angle in 1/s; negative with T for a ship that is unstable on a straight course.
    T : float
        Time constant in s; of second order the equivalent one, ``T1 + T2 - T3``.
    T1, T2, T3 : float
        Time constants of second order in s, T1 the longer; NaN for first order.
    neutral_rudder : float
        delta0 in rad.
    errors : dict of str to float
        Standard errors by the names above, for independent residuals: too small when the model does not fit.
    rms : float
        Root mean square of the heading residuals in rad.
    r_squared : float
        Share of the heading's variance that is explained.
    order : {1, 2}
    """

    K: float
    T: float
    T1: float
    T2: float
    T3: float
    neutral_rudder: float
    errors: dict[str, float]
    rms: float
    r_squared: float
    order: int

    def scaled(self, ship: Ship, speed: float) -> dict[str, float]:
        """K' = K L / U, T' = T U / L and Norrbin's turning index P = K' / (2 T'), for a speed in m/s."""
        gain, lag = self.K * ship.L / speed, self.T * speed / ship.L
        return {"K'": gain, "T'": lag, "P": gain / (2.0 * lag)}


def fit_nomoto(
    trajectory: Trajectory,
    order: Literal[1, 2] = 1,
    window: tuple[float, float] | None = None,
    neutral_rudder: float | None = None,
) -> NomotoFit:
    """Fit Nomoto's model to a zig-zag, a turn or any other record with a moving rudder.

    Parameters
    ----------
    trajectory : Trajectory
        With ``time, psi, delta``.
    order : {1, 2}
    window : tuple of float, optional
        Times in s between which to fit; default all.
    neutral_rudder : float, optional
        delta0 in rad where it is known; default fitted. A turn to one side tells little about it: there K is sharper
        with the rudder angle that kept the approach straight.

    Returns
    -------
    NomotoFit
        The rudder is taken to move in straight lines between samples: a sudden step needs short intervals.

    Raises
    ------
    FitError
        When rudder or heading hardly move, or the record does not determine the time constants.
    ReadError
        For missing channels or values, and gaps.

    Notes
    -----
    Hulls are not linear: K and T of a turn with much rudder are smaller than those of a zig-zag with little.
    """
    check_samples(trajectory, ("psi", "delta"))
    time, psi, delta = _uniform(trajectory, window)
    if np.ptp(psi) < LEAST_HEADING or np.ptp(delta) == 0.0:
        raise FitError(
            f"the heading ranges over {math.degrees(np.ptp(psi)):.2g} deg and the rudder over "
            f"{math.degrees(np.ptp(delta)):.2g} deg: no steering to fit",
            cure="give a zig-zag, or a turn with its approach",
            place=trajectory.manoeuvre,
        )
    search = _HeadingModel(time, psi, delta, neutral_rudder)
    lags = _first_order_lag(search) if order == 1 else _second_order_lags(search)
    if lags is None:
        raise FitError(
            "the record does not determine the time constant: the fit runs to the end of its range",
            cure="give a longer record with several reversals of the rudder, or choose window=(from, to) in s",
            place=trajectory.manoeuvre,
        )
    return search.result(lags)


def _uniform(
    trajectory: Trajectory, window: tuple[float, float] | None
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Time from zero at equal steps, heading from zero, and rudder."""
    clock = trajectory["time"]
    begin, end = (float(clock[0]), float(clock[-1])) if window is None else window
    inside = int(np.count_nonzero((clock >= begin) & (clock <= end)))
    if inside < 8:
        raise FitError(
            f"{inside} samples between {begin:g} and {end:g} s", cure="choose a window inside the record"
        )
    time = np.linspace(max(begin, clock[0]), min(end, clock[-1]), min(max(inside, 16), _MOST_SAMPLES))
    psi = np.interp(time, clock, trajectory["psi"])
    return time - time[0], psi - psi[0], np.interp(time, clock, trajectory["delta"])


class _HeadingModel:
    """Heading as a linear function of everything but the time constants."""

    def __init__(self, time: FloatArray, psi: FloatArray, rudder: FloatArray, neutral: float | None) -> None:
        delta = rudder - (neutral or 0.0)
        self.time, self.psi, self.delta, self.neutral = time, psi, delta, neutral
        self.step = float(time[1])
        self.turned = np.concatenate([[0.0], np.cumsum(0.5 * (delta[1:] + delta[:-1]) * self.step)])

    def basis(self, lags: FloatArray) -> FloatArray:
        """Columns: 1, t (unless the neutral rudder is known), decay of the initial rate and response of each lag."""
        decays = [np.expm1(-self.time / lag) for lag in lags]
        # T r' + r = delta integrates to psi = integral of delta - T r.
        responses = [self.turned - lag * self._lagged(float(lag)) for lag in lags]
        drift = [self.time] if self.neutral is None else []
        return np.column_stack([np.ones_like(self.time), *drift, *decays, *responses])

    def _lagged(self, lag: float) -> FloatArray:
        """First-order lag of the rudder, exact for a rudder that moves in straight lines between the samples."""
        from scipy.signal import lfilter

        decay = math.exp(-self.step / lag)
        mean = -math.expm1(-self.step / lag) * lag / self.step
        return lfilter([1.0 - mean, mean - decay], [1.0, -decay], self.delta, zi=[(mean - 1.0) * self.delta[0]])[0]

    def coefficients(self, lags: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Best linear coefficients and the residuals of the heading."""
        basis = self.basis(lags)
        scale = np.linalg.norm(basis, axis=0)
        solution, *_ = np.linalg.lstsq(basis / scale, self.psi, rcond=None)
        values = solution / scale
        return values, basis @ values - self.psi

    def cost(self, lags: FloatArray) -> float:
        """Sum of squared residuals in rad2."""
        residuals = self.coefficients(lags)[1]
        return float(residuals @ residuals)

    def result(self, lags: FloatArray) -> NomotoFit:
        """Indices and standard errors at the best time constants."""
        values, residuals = self.coefficients(lags)
        count = len(lags)
        gains = values[-count:]
        parameters = np.concatenate([lags, values])
        freedom = max(len(self.time) - len(parameters), 1)
        slopes = []
        for number, lag in enumerate(lags):
            moved = np.where(np.arange(count) == number, lag * (1.0 + 1e-5), lags)
            slopes.append((self.basis(moved) - self.basis(lags)) @ values / (1e-5 * lag))
        jacobian = np.column_stack([*slopes, self.basis(lags)])
        scale = np.linalg.norm(jacobian, axis=0)
        inverse = np.linalg.pinv(jacobian / scale) / scale[:, np.newaxis]
        covariance = inverse @ inverse.T * float(residuals @ residuals) / freedom
        found, errors = {}, {}
        for name, value in _indices(parameters, count, self.neutral).items():
            slope = np.array(
                [_slope(parameters, self.neutral, count, name, column) for column in range(len(parameters))]
            )
            found[name] = value
            errors[name] = float(np.sqrt(slope @ covariance @ slope))
        variance = float(np.var(self.psi))
        return NomotoFit(
            K=float(gains.sum()),
            T=found["T"],
            T1=found.get("T1", math.nan),
            T2=found.get("T2", math.nan),
            T3=found.get("T3", math.nan),
            neutral_rudder=found["neutral_rudder"],
            errors=errors,
            rms=float(np.sqrt(np.mean(residuals**2))),
            r_squared=1.0 - float(np.mean(residuals**2)) / variance,
            order=count,
        )


def _indices(parameters: FloatArray, count: int, neutral: float | None) -> dict[str, float]:
    """Indices from the time constants and the linear coefficients."""
    lags, gains = parameters[:count], parameters[-count:]
    gain = float(gains.sum())
    # The slope of the heading that no rudder explains is -K delta0.
    found = {"K": gain, "neutral_rudder": -float(parameters[count + 1]) / gain if neutral is None else neutral}
    if count == 1:
        return {**found, "T": float(lags[0])}
    # a / (1 + T1 s) + b / (1 + T2 s) = K (1 + T3 s) / ((1 + T1 s) (1 + T2 s))
    lead = float(gains[0] * lags[1] + gains[1] * lags[0]) / gain
    return {
        **found,
        "T1": float(lags[0]),
        "T2": float(lags[1]),
        "T3": lead,
        "T": float(lags.sum()) - lead,
    }


def _slope(parameters: FloatArray, neutral: float | None, count: int, name: str, column: int) -> float:
    """Derivative of an index by one parameter."""
    step = 1e-6 * (abs(parameters[column]) + 1e-9)
    up, down = parameters.copy(), parameters.copy()
    up[column] += step
    down[column] -= step
    return (_indices(up, count, neutral)[name] - _indices(down, count, neutral)[name]) / (2.0 * step)


def _first_order_lag(model: _HeadingModel) -> FloatArray | None:
    """The best time constant of either sign; None at the end of the range."""
    from scipy.optimize import minimize_scalar

    duration = float(model.time[-1])
    sizes = np.geomspace(2.0 * model.step, 3.0 * duration, 2 * _GRID)
    # An unstable ship's modes grow: beyond some sixty e-foldings they leave the range of numbers.
    trials = [(sign, size) for sign in (1.0, -1.0) for size in sizes if sign > 0.0 or duration / size < 60.0]
    sign, size = min(trials, key=lambda trial: model.cost(np.array([trial[0] * trial[1]])))
    if size in (sizes[0], sizes[-1]):
        return None
    ratio = math.log(sizes[1] / sizes[0])
    found = minimize_scalar(
        lambda logarithm: model.cost(np.array([sign * math.exp(logarithm)])),
        bounds=(math.log(size) - ratio, math.log(size) + ratio),
        method="bounded",
        options={"xatol": 1e-10},
    )
    return np.array([sign * math.exp(float(found.x))])


def _second_order_lags(model: _HeadingModel) -> FloatArray | None:
    """The best two time constants, the longer first; None at the end of the range."""
    from scipy.optimize import least_squares

    duration = float(model.time[-1])
    sizes = np.geomspace(0.5 * model.step, 3.0 * duration, _GRID)
    pairs = [
        (sign, longer, shorter)
        for sign in (1.0, -1.0)
        for longer in sizes
        for shorter in sizes
        if shorter < longer and (sign > 0.0 or duration / longer < 60.0)
    ]
    sign, longer, shorter = min(pairs, key=lambda pair: model.cost(np.array([pair[0] * pair[1], pair[2]])))
    if longer == sizes[-1]:
        return None

    def lags(logarithms: FloatArray) -> FloatArray:
        return np.array([sign, 1.0]) * np.exp(logarithms)

    def residuals(logarithms: FloatArray) -> FloatArray:
        return model.coefficients(lags(logarithms))[1]

    fit = least_squares(residuals, np.log([longer, shorter]), xtol=1e-12, ftol=1e-14, gtol=1e-14)
    best = lags(fit.x)
    return best if abs(best[0]) >= abs(best[1]) else best[::-1]
