"""Errors that all runs share: they do not average out, however many runs there are.

A calibration factor, an alignment angle or a water density is wrong by the same amount in every run. A unit of
it changes the response by a known effect e_j; the coefficients then move by b_j = A e_j, where params = A y,
and the covariance of the coefficients grows by sum u_j^2 b_j b_j' beside that of the scatter.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..core.errors import FitError
from .linear_fit import LinearFit

Distribution = Literal["normal", "uniform", "triangular"]
Perturbation = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


def estimator_matrix(fit: LinearFit) -> np.ndarray:
    """Matrix A of params = A @ response, shape (p, n)."""
    root = 1.0 if fit.weights is None else np.sqrt(fit.weights)
    return fit.back @ fit.q.T * root


def bias_contributions(
    estimator: np.ndarray | LinearFit, effects: np.ndarray, uncertainties: np.ndarray | Sequence[float]
) -> np.ndarray:
    """Change of the coefficients by one standard uncertainty of each shared error.

    Parameters
    ----------
    estimator : LinearFit, or ndarray of shape (p, n)
        The fit, or the matrix A of params = A @ response.
    effects : ndarray, shape (n, k)
        Change of each row's response by a unit of each error.
    uncertainties : array_like, shape (k,)
        Standard uncertainties (one sigma) of the errors.

    Returns
    -------
    ndarray, shape (p, k)

    Raises
    ------
    FitError
        If shapes disagree or an uncertainty is negative.
    """
    e, u = np.asarray(effects, dtype=float), np.asarray(uncertainties, dtype=float)
    e = e[:, None] if e.ndim == 1 else e
    u = np.atleast_1d(u)
    rows = estimator.n if isinstance(estimator, LinearFit) else estimator.shape[1]
    if e.shape != (rows, u.size):
        raise FitError(
            f"effects of shape {e.shape} for {rows} rows and {u.size} uncertainties",
            cure="give one column of effects for each shared error",
        )
    if not (u >= 0.0).all():
        raise FitError("an uncertainty is negative", cure="give standard uncertainties")
    if isinstance(estimator, LinearFit):
        root = 1.0 if estimator.weights is None else np.sqrt(estimator.weights)[:, None]
        return estimator.back @ (estimator.q.T @ (e * root)) * u
    return estimator @ e * u


def propagate_bias(
    estimator: np.ndarray | LinearFit, effects: np.ndarray, uncertainties: np.ndarray | Sequence[float]
) -> np.ndarray:
    """Covariance that shared errors add to the coefficients, first order.

    Parameters
    ----------
    estimator, effects, uncertainties :
        As :func:`bias_contributions`.

    Returns
    -------
    ndarray, shape (p, p)
        sum_j b_j b_j'. The combined covariance is this plus the fit's own.

    Raises
    ------
    FitError
        As :func:`bias_contributions`.
    """
    moved = bias_contributions(estimator, effects, uncertainties)
    return moved @ moved.T


@dataclass(frozen=True, eq=False)
class BiasSample:
    """Coefficients under drawn errors.

    Attributes
    ----------
    params : ndarray, shape (draws, p)
        One set of coefficients a draw, scatter and shared errors together.
    """

    params: np.ndarray

    @property
    def cov(self) -> np.ndarray:
        """Combined covariance, shape (p, p)."""
        return np.atleast_2d(np.cov(self.params, rowvar=False))

    @property
    def bse(self) -> np.ndarray:
        """Combined standard uncertainties, shape (p,)."""
        return np.sqrt(np.diagonal(self.cov))

    def interval(self, level: float = 0.95) -> np.ndarray:
        """Central coverage intervals, shape (p, 2)."""
        tail = 0.5 * (1.0 - level)
        return np.quantile(self.params, [tail, 1.0 - tail], axis=0).T


def monte_carlo_bias(
    fit: LinearFit,
    effects: np.ndarray | Perturbation,
    uncertainties: np.ndarray | Sequence[float],
    *,
    n: int = 2000,
    seed: int = 0,
    distribution: Distribution = "normal",
) -> BiasSample:
    """Draw shared errors (type B) and scatter (type A) together and refit.

    Parameters
    ----------
    fit : LinearFit
        Fit of the measured campaign; its covariance is the scatter's.
    effects : ndarray of shape (n_rows, k), or callable
        Effects as in :func:`propagate_bias`; or ``perturb(errors) -> (design, response)`` for errors that
        change the terms themselves (an angle, a speed), with `errors` of shape (k,) and the measured campaign
        at zero.
    uncertainties : array_like, shape (k,)
        Standard uncertainties.
    n : int
        Draws.
    seed : int
        Seed of the random generator.
    distribution : {"normal", "uniform", "triangular"}
        Shape of the shared errors, each with its standard uncertainty.

    Raises
    ------
    FitError
        As :func:`bias_contributions`; if the distribution is unknown or a perturbed campaign cannot be fitted.
    """
    u = np.atleast_1d(np.asarray(uncertainties, dtype=float))
    rng = np.random.default_rng(seed)
    errors = _draw(rng, distribution, (n, u.size)) * u
    values, vectors = np.linalg.eigh(fit.cov)
    scatter = rng.standard_normal((n, fit.params.size)) @ (vectors * np.sqrt(np.maximum(values, 0.0))).T
    if not callable(effects):
        shift = bias_contributions(fit, effects, np.ones(u.size))
        return BiasSample(fit.params + errors @ shift.T + scatter)
    root = 1.0 if fit.weights is None else np.sqrt(fit.weights)
    moved = np.empty((n, fit.params.size))
    for row, error in zip(moved, errors):
        design, response = effects(error)
        solution, _, rank, _ = np.linalg.lstsq((design.T * root).T, response * root, rcond=None)
        if rank < solution.size:
            raise FitError("a perturbed campaign cannot separate the terms", cure="check the perturbation")
        row[:] = solution
    return BiasSample(moved + scatter)


def _draw(rng: np.random.Generator, distribution: str, shape: tuple[int, int]) -> np.ndarray:
    if distribution == "normal":
        return rng.standard_normal(shape)
    if distribution == "uniform":
        return rng.uniform(-np.sqrt(3.0), np.sqrt(3.0), shape)
    if distribution == "triangular":
        return rng.triangular(-np.sqrt(6.0), 0.0, np.sqrt(6.0), shape)
    raise FitError(f"there is no distribution '{distribution}'", cure="use normal, uniform or triangular")
