"""LS-SVM of a uniformly sampled record: smooth curve, derivatives, bands, exact leave-one-out.

The Gaussian kernel of the time makes the system Toeplitz. Wide kernels are solved by a Fourier series
(:mod:`.toeplitz_fourier`), narrow ones as a banded system (:mod:`.toeplitz_banded`), whichever costs less; both
give the solution of the dense system.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from typing import Any

import numpy as np
from threadpoolctl import ThreadpoolController

from ..core.errors import FitError
from .lssvm_choice import Criterion, LSSVMChoice, checked_gammas, choose_gamma_sigma
from .lssvm_kernels import SigmaConvention, squared_length
from .lssvm_weights import suykens_weights
from .sandwich import FULL_LEVERAGE
from .toeplitz_banded import BandedFit, BandedSmoother, banded_cost
from .toeplitz_fourier import FourierFit, FourierSmoother, fourier_cost

GAMMAS = np.logspace(-1.0, 8.0, 10)
# Samples may stray this far from the uniform grid, in steps.
UNIFORM = 1e-5


@dataclass(frozen=True, eq=False)
class LSSVMCurve:
    """Fitted curve f(t) = sum_i alpha_i k(t, t_i) + bias.

    Attributes
    ----------
    time, response : ndarray, shape (n,)
    gamma, sigma : float
    convention : {"sigma2", "2sigma2"}
    choice : LSSVMChoice or None
        How gamma and sigma were chosen; None when both were given.
    weights : ndarray, shape (n,)
        Weight of each sample's squared error, those of the reweighting included.
    row_weights : ndarray, shape (n,)
        Weights of the reweighting alone, 1 without it.
    route : {"fourier", "banded"}
    solution : FourierFit or BandedFit
    """

    time: np.ndarray
    response: np.ndarray
    gamma: float
    sigma: float
    convention: SigmaConvention
    choice: LSSVMChoice | None
    weights: np.ndarray
    row_weights: np.ndarray
    route: str
    solution: FourierFit | BandedFit

    @property
    def step(self) -> float:
        """Sampling interval."""
        return float(self.time[-1] - self.time[0]) / (self.time.size - 1)

    @property
    def bias(self) -> float:
        """The constant b."""
        return self.solution.bias

    @property
    def fitted(self) -> np.ndarray:
        """Curve at the samples, shape (n,)."""
        return self.solution.fitted

    @property
    def resid(self) -> np.ndarray:
        """Response minus curve, shape (n,)."""
        return self.response - self.solution.fitted

    @property
    def alpha(self) -> np.ndarray:
        """Coefficients of the kernels, gamma v_i e_i, shape (n,)."""
        return self.gamma * self.weights * self.resid

    @property
    def leverage(self) -> np.ndarray:
        """Diagonal of the hat matrix, shape (n,)."""
        return 1.0 - self.solution.open

    @cached_property
    def effective_dof(self) -> float:
        """Trace of the hat matrix."""
        return float(self.leverage.sum())

    @cached_property
    def loo_residuals(self) -> np.ndarray:
        """Residual of each sample by the fit of all others with the same gamma and sigma, shape (n,)."""
        return self.resid / self.solution.open

    @cached_property
    def loo_rmse(self) -> float:
        """Root of the weighted mean square of `loo_residuals`."""
        return math.sqrt(float(self.weights @ self.loo_residuals**2) / float(self.weights.sum()))

    @cached_property
    def noise_variance(self) -> float:
        """Variance of an error of weight 1: weighted residual sum of squares over n - effective_dof."""
        return float(self.weights @ self.resid**2) / (self.time.size - self.effective_dof)

    def __call__(self, time: Any, order: int = 0) -> np.ndarray:
        """Curve, or its first or second derivative by time, at `time` (m,), shape (m,).

        Raises
        ------
        FitError
            If `order` is not 0, 1 or 2.
        """
        at = np.asarray(time, dtype=float)
        position = (at.reshape(-1) - self.time[0]) / self.step
        return self.solution.value(position, _checked_order(order)).reshape(at.shape) / self.step**order

    def on_samples(self, order: int = 0) -> np.ndarray:
        """The same at the samples themselves, by one Fourier transform where the kernel is wide, shape (n,)."""
        return self.solution.on_samples(_checked_order(order)) / self.step**order

    def std(self, time: Any, order: int = 0, *, observation: bool = False) -> np.ndarray:
        """Standard deviation of the curve or its derivative at `time` (m,), shape (m,).

        The posterior of a Gaussian process with covariance gamma s^2 k, a free constant, and independent errors of
        variance s^2 / v_i. Its intervals hold the smoothing bias on average over the record (Wahba 1983, Nychka
        1988), not at each point; errors that are correlated from sample to sample make them too short.

        Parameters
        ----------
        time : array_like, shape (m,)
        order : {0, 1, 2}
        observation : bool
            Add the variance of a new observation of weight 1 (order 0 only).
        """
        at = np.asarray(time, dtype=float)
        position = (at.reshape(-1) - self.time[0]) / self.step
        unit = self.solution.unit_variance(position, _checked_order(order)) / self.step ** (2 * order)
        if observation and order == 0:
            unit = unit + 1.0
        return np.sqrt(self.noise_variance * unit).reshape(at.shape)

    def interval(
        self, time: Any, order: int = 0, *, confidence: float = 0.95, observation: bool = False
    ) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limit at `time` (m,), see :meth:`std`; t with n - effective_dof degrees of freedom."""
        from scipy.stats import t as student

        reach = student.ppf(0.5 + 0.5 * confidence, self.time.size - self.effective_dof)
        middle, half = self(time, order), reach * self.std(time, order, observation=observation)
        return middle - half, middle + half


@cache
def _libraries() -> ThreadpoolController:
    """The loaded algebra libraries; to look for them takes longer than a short fit."""
    return ThreadpoolController()


def fit_lssvm_curve(
    time: Any,
    response: Any,
    *,
    gamma: float | None = None,
    sigma: float | None = None,
    gammas: Sequence[float] | None = None,
    sigmas: Sequence[float] | None = None,
    convention: SigmaConvention = "sigma2",
    criterion: Criterion = "loo",
    refine: bool = True,
    weights: Any = None,
    reweightings: int = 0,
) -> LSSVMCurve:
    """Fit min |w|^2 / 2 + gamma/2 sum v_i e_i^2 with y_i = w . phi(t_i) + b + e_i and a Gaussian kernel.

    Parameters
    ----------
    time, response : array_like, shape (n,)
        Uniformly sampled and increasing.
    gamma, sigma : float, optional
        Fixed values; chosen among the candidates by `criterion` when omitted. sigma has the unit of time.
    gammas, sigmas : sequence of float, optional
        Candidates: ten gammas from 0.1 to 1e8, ten sigmas from 5 steps (or a 500th of the record) to a quarter of
        the record when omitted.
    convention : {"sigma2", "2sigma2"}
        Kernel exp(-d^2/sigma^2), or exp(-d^2/(2 sigma^2)).
    criterion : {"loo", "gcv"}
        Exact leave-one-out error or generalised cross-validation, both in closed form. Both take errors for
        independent: correlated errors are mistaken for signal, and sigma is then better given.
    refine : bool
        Search between the candidates too.
    weights : array_like, shape (n,), optional
        Inverse variances up to a factor.
    reweightings : int
        Robust reweightings by :func:`.lssvm_weights.suykens_weights`; 1 is the procedure of Suykens et al. (2002).
        gamma and sigma are chosen anew after each; given ones must suit the record, because what a stiff curve
        misses of the signal looks like outliers.

    Raises
    ------
    FitError
        If samples are not finite, fewer than 4 or not uniform in time; if gamma or sigma is not positive; if the
        kernel fits neither route; or if more than a third of the samples look like outliers.
    """
    at, y, given = _checked_record(time, response, weights)
    count = at.size
    step = float(at[-1] - at[0]) / (count - 1)
    gamma_grid = checked_gammas([gamma] if gamma is not None else GAMMAS if gammas is None else gammas)
    if sigma is not None:
        sigma_grid = np.array([float(sigma)])
    elif sigmas is not None:
        sigma_grid = np.asarray(sigmas, dtype=float)
    else:
        sigma_grid = np.geomspace(max(5.0 * step, 0.002 * step * count), 0.25 * step * count, 10)
    if criterion not in ("loo", "gcv"):
        raise FitError(f"there is no criterion '{criterion}'", cure="use loo or gcv")
    if reweightings < 0:
        raise FitError(f"{reweightings} reweightings cannot be done", cure="use 0 or more")
    for value in sigma_grid:
        squared_length(float(value), convention)
    centre = float(np.mean(y))

    def smoother(value: float, v: np.ndarray | None) -> FourierSmoother | BandedSmoother:
        return _smoother(count, math.sqrt(squared_length(value, convention)) / step, v)

    def choose(v: np.ndarray | None) -> LSSVMChoice:
        total = y.size if v is None else float(v.sum())

        def score(value: float, candidates: np.ndarray) -> np.ndarray:
            prepared = smoother(value, v)
            return np.array([_criterion(prepared, y - centre, g, v, total, criterion) for g in candidates])

        return choose_gamma_sigma(score, gamma_grid, sigma_grid, refine=refine)

    own = np.ones(count)
    settled: np.ndarray | None = given
    # The systems are many and small: on a busy machine the threads of the algebra library would wait for each other.
    with _libraries().limit(limits=1, user_api="blas"):
        for left in range(reweightings, -1, -1):
            choice = choose(settled) if gamma_grid.size * sigma_grid.size != 1 else None
            best_gamma = float(gamma_grid[0]) if choice is None else choice.gamma
            best_sigma = float(sigma_grid[0]) if choice is None else choice.sigma
            solution = smoother(best_sigma, settled).solve(y, best_gamma)
            if left:
                own = suykens_weights((y - solution.fitted) * (1.0 if given is None else np.sqrt(given)))
                settled = own if given is None else own * given
    return LSSVMCurve(
        time=at,
        response=y,
        gamma=best_gamma,
        sigma=best_sigma,
        convention=convention,
        choice=choice,
        weights=np.ones(count) if settled is None else settled,
        row_weights=own,
        route="fourier" if isinstance(solution, FourierFit) else "banded",
        solution=solution,
    )


def is_uniform(time: np.ndarray) -> bool:
    """True when increasing times (n,) lie on a uniform grid to 1e-5 steps."""
    count = time.size
    if count < 2 or not time[-1] > time[0]:
        return False
    grid = np.linspace(time[0], time[-1], count)
    return bool(np.abs(time - grid).max() <= UNIFORM * (time[-1] - time[0]) / (count - 1))


def _checked_order(order: int) -> int:
    if order not in (0, 1, 2):
        raise FitError(f"there is no derivative of order {order} here", cure="use 0, 1 or 2")
    return order


def _checked_record(time: Any, response: Any, weights: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray | None]:
    at, y = np.asarray(time, dtype=float), np.asarray(response, dtype=float)
    if at.ndim != 1 or at.shape != y.shape:
        raise FitError(f"times of shape {at.shape} for a response of shape {y.shape}", cure="give one a sample")
    if at.size < 4:
        raise FitError(f"{at.size} samples make no curve", cure="give at least 4")
    for name, values in (("time", at), ("response", y)):
        if not np.isfinite(values).all():
            where = int(np.flatnonzero(~np.isfinite(values))[0])
            raise FitError(
                f"the {name} holds values that are not finite, the first at sample {where}",
                cure="fill or cut the gaps first",
            )
    if not is_uniform(at):
        raise FitError(
            "the samples are not uniform in time", cure="resample the record, or use LSSVMRegressor(solver='dual')"
        )
    if weights is None:
        return at, y, None
    v = np.asarray(weights, dtype=float)
    if v.shape != y.shape:
        raise FitError(f"{v.size} weights for {y.size} samples", cure="give one weight a sample")
    if not (np.isfinite(v).all() and (v > 0.0).all()):
        raise FitError("a weight is not positive", cure="use weights above 0")
    return at, y, v


def _smoother(count: int, width: float, weights: np.ndarray | None) -> FourierSmoother | BandedSmoother:
    # Weights couple cosines and sines: one problem of twice the size, four times the work of both.
    fourier = fourier_cost(count, width) * (1.0 if weights is None else 4.0)
    banded = banded_cost(count, width) * (1.0 if weights is None else 10.0)
    if math.isinf(min(fourier, banded)):
        raise FitError(
            f"a kernel of {width:.3g} steps is too wide for a band and too narrow for a series at {count} samples",
            cure="use a wider or narrower sigma, or resample the record",
        )
    return FourierSmoother(count, width, weights) if fourier <= banded else BandedSmoother(count, width, weights)


def _criterion(
    smoother: FourierSmoother | BandedSmoother,
    response: np.ndarray,
    gamma: float,
    weights: np.ndarray | None,
    total: float,
    criterion: Criterion,
) -> float:
    try:
        solution = smoother.solve(response, gamma)
    except FitError:
        return math.inf
    missed, open_ = response - solution.fitted, solution.open
    if criterion == "loo":
        if open_.min() <= 1.0 - FULL_LEVERAGE:
            return math.inf
        missed = missed / open_
    else:
        mean_open = float(open_.mean())
        if mean_open <= 1.0 - FULL_LEVERAGE:
            return math.inf
        missed = missed / mean_open
    squares = missed @ missed if weights is None else weights @ missed**2
    return math.sqrt(float(squares) / total)
