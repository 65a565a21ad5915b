"""Rows of the regression of one force component: means and harmonics of all runs, with their uncertainty."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..core.terms import Term
from .reduced_run import ReducedRun

_ROUNDING = 1e-12
"""Non-dimensional columns below this are rounding, e.g. the sway velocity in pure yaw."""


@dataclass(frozen=True, eq=False)
class ForceRows:
    """Regression rows of one component.

    Attributes
    ----------
    component : str
    terms : tuple of Term
    design : ndarray, shape (n, p)
    response : ndarray, shape (n,)
        Scaled force (LT).
    sd : ndarray, shape (n,)
        Standard error of each row from the noise within its run (drawn towards runs of its kind); NaN throughout
        when some run gives none, and then rows count equally.
    run : ndarray of int, shape (n,)
        Index of each row's run.
    harmonic : ndarray of int, shape (n,)
        0 mean, 1 cos 1, 2 sin 1, 3 cos 2, ...; -1, -2, ... the condensed rows of a fit in the time domain.
    """

    component: str
    terms: tuple[Term, ...]
    design: np.ndarray
    response: np.ndarray
    sd: np.ndarray
    run: np.ndarray
    harmonic: np.ndarray

    @property
    def names(self) -> list[str]:
        """Names of the terms."""
        return [term.name for term in self.terms]

    @property
    def excited(self) -> np.ndarray:
        """Mask of the terms that some run excites; rounding of the kinematics excites nothing, shape (p,)."""
        return np.abs(self.design).max(axis=0, initial=0.0) > _ROUNDING

    def only(self, rows: np.ndarray, columns: Sequence[int] | None = None) -> ForceRows:
        """The rows of a mask or index, and the columns of `columns`."""
        keep = list(range(len(self.terms))) if columns is None else list(columns)
        return ForceRows(
            self.component,
            tuple(self.terms[i] for i in keep),
            self.design[rows][:, keep],
            self.response[rows],
            self.sd[rows],
            self.run[rows],
            self.harmonic[rows],
        )


def force_rows(runs: Sequence[ReducedRun], terms: Sequence[Term], component: str) -> ForceRows:
    """Stack the rows of one component over runs.

    Rows to which no term contributes (the mean of Y in pure sway, its second harmonics) say nothing about the
    coefficients and are left out.

    Parameters
    ----------
    runs : sequence of ReducedRun
    terms : sequence of Term
        Terms of any component; those of `component` are used.
    component : {"X", "Y", "N", "K"}
    """
    own = tuple(term for term in terms if term.component == component)
    blocks = []
    for index, run in enumerate(runs):
        if component not in run.scaled:
            continue
        design, response, sd, dof, harmonic = run.force_rows(component, own)
        blocks.append((design, response, sd, np.full(len(response), index), harmonic, dof))
    if not blocks:
        empty = np.zeros(0)
        return ForceRows(
            component, own, np.zeros((0, len(own))), empty, empty, empty.astype(int), empty.astype(int)
        )
    design, response, sd, run_index, harmonic, dof = (np.concatenate(part) for part in zip(*blocks, strict=True))
    size = np.abs(design).max(axis=0, initial=0.0)
    active = (np.abs(design) > np.maximum(1e-9 * size, _ROUNDING)).any(axis=1)
    rows = ForceRows(component, own, design, response, sd, run_index, harmonic).only(active)
    sd = _moderated_sd(rows, runs, dof[active])
    return ForceRows(component, own, rows.design, rows.response, sd, rows.run, rows.harmonic)


def _moderated_sd(rows: ForceRows, runs: Sequence[ReducedRun], dof: np.ndarray) -> np.ndarray:
    """Standard errors from noise densities that are drawn towards those of the runs of the same kind.

    One run's own estimate of its noise is itself noisy, and weights made of it would favour runs whose noise was
    underestimated by chance; yet runs may truly differ. The empirical Bayes estimate of Smyth (2004) weighs the
    two by what the spread of the estimates shows.
    """
    sd = rows.sd
    if not np.isfinite(sd).all():
        return np.full(len(sd), np.nan)
    length = np.array([run.window.count * run.window.step for run in runs])[rows.run]
    # Rows of the time domain are densities already: their directions have unit length.
    length = np.where(rows.harmonic < 0, 1.0, length)
    kind = np.array([run.order > 0 for run in runs])[rows.run]
    # Coefficients of one harmonic share a density; the mean has half the variance of a cosine. The rows -1, -2, ...
    # of the time domain are in the same order.
    row = np.where(rows.harmonic < 0, -1 - rows.harmonic, rows.harmonic)
    band = (row + 1) // 2
    density = sd**2 * length
    # No balance resolves better; weights further apart would cost digits where the data are free of noise.
    floor = max((1e-7 * np.abs(rows.response).max(initial=0.0)) ** 2, np.finfo(float).tiny)
    density = np.maximum(density, floor * length)
    for key in {(bool(k), int(b)) for k, b in zip(kind, band, strict=True)}:
        same = (kind == key[0]) & (band == key[1])
        density[same] = moderated_variances(density[same], dof[same])
    return np.sqrt(density / length)


def moderated_variances(variance: np.ndarray, dof: np.ndarray) -> np.ndarray:
    """Variances of similar samples, each drawn towards their common level.

    Smyth (2004), Statistical Applications in Genetics and Molecular Biology 3(1), section 6.2.

    Parameters
    ----------
    variance : ndarray, shape (n,)
        Positive.
    dof : ndarray, shape (n,)
        Degrees of freedom of each.
    """
    from scipy.special import digamma, polygamma

    if len(variance) < 3 or not np.isfinite(dof).all():
        return variance
    half = np.maximum(dof, 1.0) / 2.0
    level = np.log(variance) - digamma(half) + np.log(half)
    spread = float(np.var(level, ddof=1) - polygamma(1, half).mean())
    if spread <= 0:
        return np.full(len(variance), np.exp(level.mean()))
    prior = 2.0 * _inverse_trigamma(spread)
    common = float(np.exp(level.mean() + digamma(prior / 2) - np.log(prior / 2)))
    return (prior * common + 2 * half * variance) / (prior + 2 * half)


def _inverse_trigamma(value: float) -> float:
    from scipy.special import polygamma

    x = 0.5 + 1.0 / value
    for _ in range(50):
        first = float(polygamma(1, x))
        step = first * (1.0 - first / value) / float(polygamma(2, x))
        x += step
        if -step / x < 1e-8:
            break
    return x


def between_run_scatter(rows: ForceRows) -> float:
    """Scatter from run to run beyond the noise within runs, in units of the scaled force.

    Paule and Mandel (1982): the tau for which ``sum r^2 / (sd^2 + tau^2)`` equals the degrees of freedom; 0 when
    the noise within the runs explains the residuals.
    """
    n, p = rows.design.shape
    if n <= p or not np.isfinite(rows.sd).all():
        return 0.0

    def excess(tau: float) -> float:
        weight = 1.0 / np.hypot(rows.sd, tau)
        solution = np.linalg.lstsq(rows.design * weight[:, None], rows.response * weight, rcond=None)[0]
        residual = (rows.response - rows.design @ solution) * weight
        return float(residual @ residual) - (n - p)

    if excess(0.0) <= 0:
        return 0.0
    low, high = 0.0, float(np.abs(rows.response).max())
    if excess(high) > 0:
        return high
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if excess(middle) > 0 else (low, middle)
        if high - low < 1e-4 * high:
            break
    return high
