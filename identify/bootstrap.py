"""Bootstrap over whole runs: intervals that need no model of the noise within a run.

Runs are the independent pieces of a campaign, so runs are resampled. A replicate of least squares needs only
the sums over runs of small matrices, so that a thousand of them cost one matrix product and small solves.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..core.errors import FitError
from .linear_fit import LinearFit
from .regression import fit_linear

# Part of the replicates that may lack the runs which separate the terms.
MAX_SINGULAR_SHARE = 0.1
# Smallest eigenvalue of a replicate's information, relative to the whole campaign's, that counts as full rank.
SINGULAR_LIMIT = 1e-9

Estimator = Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass(frozen=True, eq=False)
class BootstrapResult:
    """Replicates of the coefficients.

    Attributes
    ----------
    names : tuple of str
    params : ndarray, shape (p,)
        Coefficients of the whole campaign.
    replicates : ndarray, shape (b, p)
        Coefficients of the resampled campaigns.
    jackknife : ndarray, shape (g, p)
        Coefficients without one run each; nan where the rest cannot separate the terms.
    singular : int
        Replicates dropped because their runs could not separate the terms.
    """

    names: tuple[str, ...]
    params: np.ndarray
    replicates: np.ndarray
    jackknife: np.ndarray
    singular: int

    @cached_property
    def cov(self) -> np.ndarray:
        """Covariance of the replicates, shape (p, p)."""
        return np.atleast_2d(np.cov(self.replicates, rowvar=False))

    @property
    def bse(self) -> np.ndarray:
        """Standard errors, shape (p,)."""
        return np.sqrt(np.diagonal(self.cov))

    def percentile(self, level: float = 0.95) -> np.ndarray:
        """Percentile intervals, shape (p, 2)."""
        tail = 0.5 * (1.0 - level)
        return np.quantile(self.replicates, [tail, 1.0 - tail], axis=0).T

    def bca(self, level: float = 0.95) -> np.ndarray:
        """Bias-corrected accelerated intervals (Efron 1987), shape (p, 2)."""
        from scipy.special import ndtr, ndtri

        count = self.replicates.shape[0]
        below = (self.replicates < self.params).sum(axis=0) + 0.5 * (self.replicates == self.params).sum(axis=0)
        shift = ndtri(np.clip(below / count, 0.5 / count, 1.0 - 0.5 / count))
        kept = self.jackknife[np.isfinite(self.jackknife).all(axis=1)]
        spread = kept.mean(axis=0) - kept
        size = (spread**2).sum(axis=0) ** 1.5
        acceleration = np.divide((spread**3).sum(axis=0), 6.0 * size, out=np.zeros_like(size), where=size > 0.0)
        limits = []
        for tail in (0.5 * (1.0 - level), 0.5 * (1.0 + level)):
            z = shift + ndtri(tail)
            limits.append(ndtr(shift + z / (1.0 - acceleration * z)))
        ordered = np.sort(self.replicates, axis=0)
        grid = (np.arange(count) + 0.5) / count
        columns = [
            [float(np.interp(limit[j], grid, ordered[:, j])) for limit in limits] for j in range(self.params.size)
        ]
        return np.array(columns)


def block_bootstrap(
    design: np.ndarray,
    response: np.ndarray,
    groups: np.ndarray | Sequence[Hashable],
    fit: Estimator | None = None,
    n: int = 1000,
    seed: int = 0,
    *,
    names: Sequence[str] | None = None,
    weights: np.ndarray | None = None,
) -> BootstrapResult:
    """Resample whole runs and refit.

    Parameters
    ----------
    design, response, weights :
        As :func:`.regression.fit_linear`.
    groups : sequence of n labels
        Run of each row.
    fit : callable, optional
        ``fit(design, response) -> params`` for any other estimator, called once a replicate with rows times
        the root of their weight; least squares through sums of normal equations when omitted.
    n : int
        Replicates.
    seed : int
        Seed of the random generator.
    names : sequence of p str, optional
        ``x0, x1, ...`` when omitted.

    Raises
    ------
    FitError
        As :func:`.regression.fit_linear`; with fewer than three runs; or if more than a tenth of the
        replicates cannot separate the terms.
    """
    labels = tuple(names) if names is not None else tuple(f"x{j}" for j in range(np.shape(design)[1]))
    whole = fit_linear(design, response, labels, weights=weights, groups=groups)
    sizes = whole.geometry.sizes
    if sizes.size < 3:
        raise FitError(f"{sizes.size} runs are too few to resample", cure="use at least three runs")
    drawn = np.random.default_rng(seed).integers(sizes.size, size=(n, sizes.size))
    if fit is None:
        counts = np.zeros((n, sizes.size))
        np.add.at(counts, (np.arange(n)[:, None], drawn), 1.0)
        replicates = _solve_counts(whole, counts)
        jackknife, params = _solve_counts(whole, 1.0 - np.eye(sizes.size)), whole.params
    else:
        replicates, jackknife, params = _refit(whole, fit, drawn)
    good = np.isfinite(replicates).all(axis=1)
    if good.mean() < 1.0 - MAX_SINGULAR_SHARE:
        raise FitError(
            f"{np.count_nonzero(~good)} of {n} resampled campaigns cannot separate the terms",
            cure="drop terms that few runs excite, or use covariance='cluster'",
        )
    return BootstrapResult(labels, params, replicates[good], jackknife, int(np.count_nonzero(~good)))


def _solve_counts(whole: LinearFit, counts: np.ndarray) -> np.ndarray:
    """Least squares with each run taken `counts` (b, g) times, shape (b, p); nan without full rank.

    In orthonormal coordinates the change from the fit of all runs is (sum K_g)^-1 sum z_g, with K_g = q_g' q_g and
    z_g = q_g' e_g.
    """
    geometry = whole.geometry
    turned = geometry.vectors * geometry.leverage[:, None, :]
    grams = turned @ geometry.vectors.transpose(0, 2, 1)
    scores = np.einsum("gij,gj->gi", geometry.vectors, geometry.scores)
    r = scores.shape[1]
    information = (counts @ grams.reshape(-1, r * r)).reshape(-1, r, r)
    eigenvalues, vectors = np.linalg.eigh(information)
    full = eigenvalues[:, 0] > SINGULAR_LIMIT * eigenvalues[:, -1]
    inverse = 1.0 / np.where(full[:, None], eigenvalues, 1.0)
    along = np.einsum("bji,bj->bi", vectors, counts @ scores)
    shift = np.einsum("bij,bj->bi", vectors, inverse * along)
    return np.where(full[:, None], whole.params + shift @ whole.back.T, np.nan)


def _refit(whole: LinearFit, fit: Estimator, drawn: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    root = np.ones(whole.n) if whole.weights is None else np.sqrt(whole.weights)
    rows, target = whole.design * root[:, None], whole.response * root
    codes = whole.geometry.codes
    members = [np.flatnonzero(codes == g) for g in range(whole.geometry.sizes.size)]

    def estimate(kept: np.ndarray) -> np.ndarray:
        chosen = np.concatenate([members[g] for g in kept])
        try:
            return np.asarray(fit(rows[chosen], target[chosen]), dtype=float)
        except (FitError, np.linalg.LinAlgError):
            return np.full(len(whole.names), np.nan)

    everything = np.arange(len(members))
    replicates = np.array([estimate(kept) for kept in drawn])
    jackknife = np.array([estimate(np.delete(everything, g)) for g in everything])
    return replicates, jackknife, estimate(everything)
