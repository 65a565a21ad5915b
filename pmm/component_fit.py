"""Fit of one force component: estimator, covariance, diagnostics, and the linear map from data to coefficients."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from ..core.errors import FitError
from ..core.terms import Term
from ..identify.regression import LinearFit, fit_linear
from .campaign_file import Fit
from .force_rows import ForceRows, between_run_scatter


@dataclass(frozen=True, eq=False)
class ComponentFit:
    """Coefficients of one component.

    Attributes
    ----------
    rows : ForceRows
    params : ndarray, shape (p,)
    cov : ndarray, shape (p, p)
        Scatter only (type A).
    influence : ndarray, shape (p, n)
        ``params = influence @ response`` (to first order for estimators that are not linear).
    fit : LinearFit or None
        Least-squares fit with its diagnostics, on the weights of the estimate.
    weights : ndarray, shape (n,)
        Inverse of each row's variance, up to the scale s^2.
    scatter : float
        Run-to-run scatter beyond the noise within runs, scaled force.
    row_sd : ndarray, shape (n,)
        Standard deviation of each row that the covariance stands on.
    notes : tuple of str
    """

    rows: ForceRows
    params: np.ndarray
    cov: np.ndarray
    influence: np.ndarray
    fit: LinearFit | None
    weights: np.ndarray
    scatter: float
    row_sd: np.ndarray
    notes: tuple[str, ...] = ()
    extra: Mapping[str, object] = field(default_factory=dict)

    @property
    def residual(self) -> np.ndarray:
        """Response less fit, shape (n,)."""
        return self.rows.response - self.rows.design @ self.params

    @property
    def dof(self) -> float:
        """Degrees of freedom of the residual."""
        return float(max(len(self.rows.response) - len(self.params), 1))


def fit_component(
    rows: ForceRows,
    settings: Fit,
    stages: Sequence[Sequence[str]] | None = None,
    prior: Mapping[str, float] | None = None,
) -> ComponentFit:
    """Fit the coefficients of one component.

    Parameters
    ----------
    rows : ForceRows
    settings : Fit
    stages : sequence of sequences of str, optional
        Names fitted in turn, each stage with the earlier ones held fixed, on the rows that hold no later term.
    prior : mapping of str to float, optional
        Values towards which the constrained estimator draws, e.g. those of an empirical set.

    Raises
    ------
    FitError
        When a term is not excited, or terms cannot be separated; the message names them.
    """
    fixed = {name: value for name, value in settings.fixed.items() if name in rows.names}
    if fixed:
        return _with_fixed(rows, settings, stages, prior, fixed)
    if len(rows.response) < len(rows.terms):
        raise FitError(
            f"{len(rows.response)} data for {len(rows.terms)} terms of {rows.component}",
            cure="fit fewer terms or add runs",
        )
    rows = _unexcited_refused(rows)
    # Scaling by runs' own noise and by the scatter between runs; without any noise estimate rows count equally.
    scatter = between_run_scatter(rows)
    known = bool(np.isfinite(rows.sd).all())
    weighted = known and settings.estimator != "ols"
    weights = 1.0 / (rows.sd**2 + scatter**2) if weighted else np.ones(len(rows.response))
    fit = _least_squares(rows, settings, weights)
    notes: list[str] = []
    if fit.dof == 0:
        if not weighted:
            raise FitError(
                f"{len(rows.response)} data for {len(rows.terms)} terms of {rows.component} leave no residual that "
                "tells the uncertainty",
                cure="fit fewer terms or add runs",
            )
        fit = replace(fit, scale=1.0, cov=_known_noise_covariance(rows.design, weights))
        notes.append("as many data as terms: the uncertainty is that of the noise within runs alone")
    if not known:
        notes.append("no noise estimate for some runs: all rows count equally")
    elif scatter > 0:
        notes.append(f"scatter between runs {scatter:.3g} added to the noise within runs")
    params, cov, influence, extra = _estimate(rows, settings, fit, weights, stages, prior, notes)
    scale = float(fit.scale)
    row_sd = np.sqrt(scale / weights)
    return ComponentFit(
        rows, params, cov, influence, fit, weights, scatter if known else 0.0, row_sd, tuple(notes), extra
    )


_MENDS_DEPENDENCE = ("ridge", "tsvd", "lssvm", "constrained")
"""Estimators that choose among the solutions of data which cannot separate all terms."""


def _least_squares(rows: ForceRows, settings: Fit, weights: np.ndarray) -> LinearFit:
    try:
        return fit_linear(
            rows.design,
            rows.response,
            rows.names,
            weights=weights,
            groups=rows.run,
            covariance="cluster" if settings.covariance == "cluster" else "model",
            allow_singular=settings.estimator in _MENDS_DEPENDENCE,
        )
    except FitError as error:
        cure = error.cure.replace(
            "allow_singular=True", "set fit.estimator = 'ridge', 'tsvd', 'lssvm' or 'constrained'"
        )
        raise FitError(error.cause, cure=cure) from None


def _known_noise_covariance(design: np.ndarray, weights: np.ndarray) -> np.ndarray:
    inverse = _weighted_inverse(design, np.sqrt(weights))
    return (inverse / weights) @ inverse.T


def _unexcited_refused(rows: ForceRows) -> ForceRows:
    dead = [name for name, excited in zip(rows.names, rows.excited, strict=True) if not excited]
    if dead:
        raise FitError(
            f"no run excites {', '.join(dead)}", cure="leave the term out of the model or add runs that vary it"
        )
    return rows


def _with_fixed(
    rows: ForceRows,
    settings: Fit,
    stages: Sequence[Sequence[str]] | None,
    prior: Mapping[str, float] | None,
    fixed: Mapping[str, float],
) -> ComponentFit:
    """Fit the rest with some coefficients held at given values, which then carry no uncertainty."""
    held = np.array([fixed.get(name, 0.0) for name in rows.names])
    free = [i for i, name in enumerate(rows.names) if name not in fixed]
    reduced = rows.only(np.arange(len(rows.response)), free)
    reduced = ForceRows(
        rows.component,
        reduced.terms,
        reduced.design,
        rows.response - rows.design @ held,
        rows.sd,
        rows.run,
        rows.harmonic,
    )
    note = "held fixed: " + ", ".join(f"{name} = {value:g}" for name, value in fixed.items())
    if not free:
        n = len(rows.response)
        spread = np.full(n, float(np.sqrt(np.mean(reduced.response**2))) if n else 0.0)
        nothing = np.zeros((len(held), len(held)))
        return ComponentFit(rows, held, nothing, np.zeros((len(held), n)), None, np.ones(n), 0.0, spread, (note,))
    inner = fit_component(reduced, settings.model_copy(update={"fixed": {}}), stages, prior)
    params = held.copy()
    params[free] = inner.params
    cov = np.zeros((len(held), len(held)))
    cov[np.ix_(free, free)] = inner.cov
    influence = np.zeros((len(held), len(rows.response)))
    influence[free] = inner.influence
    return ComponentFit(
        rows,
        params,
        cov,
        influence,
        inner.fit,
        inner.weights,
        inner.scatter,
        inner.row_sd,
        (*inner.notes, note),
        inner.extra,
    )


def _estimate(
    rows: ForceRows,
    settings: Fit,
    fit: LinearFit,
    weights: np.ndarray,
    stages: Sequence[Sequence[str]] | None,
    prior: Mapping[str, float] | None,
    notes: list[str],
) -> tuple[np.ndarray, np.ndarray, np.ndarray, dict[str, object]]:
    params, cov = np.asarray(fit.params, float), np.asarray(fit.cov, float)
    influence = _weighted_inverse(rows.design, np.sqrt(weights))
    extra: dict[str, object] = {}
    if stages is not None:
        influence = staged_influence(rows, weights, stages)
        params = influence @ rows.response
        cov = (influence * (float(fit.scale) / weights)) @ influence.T
        notes.append("staged: " + " | ".join(" ".join(stage) for stage in stages))
    elif settings.estimator == "huber":
        from ..identify.robust import fit_huber

        robust = fit_huber(rows.design, rows.response, rows.names, weights=weights, tuning=settings.huber_c)
        params, cov = np.asarray(robust.params), np.asarray(robust.cov)
        influence = _weighted_inverse(rows.design, np.sqrt(weights * robust.row_weights))
        notes.append(f"Huber loss, c = {settings.huber_c:g} standard deviations")
    elif settings.estimator in ("ridge", "tsvd"):
        params, cov, influence = _shrunk(rows, settings, weights, notes)
    elif settings.estimator == "lssvm":
        params, cov, influence = _support_vectors(rows, weights, notes)
    elif settings.estimator == "constrained":
        params, cov, influence, extra = _constrained(rows, settings, weights, float(fit.scale), prior, notes)
    if settings.covariance == "bootstrap":
        from ..identify.bootstrap import block_bootstrap

        boot = block_bootstrap(
            rows.design,
            rows.response,
            rows.run,
            weights=weights,
            n=settings.replicates,
            seed=settings.seed,
        )
        cov = np.asarray(boot.cov)
        notes.append(f"covariance from {settings.replicates} bootstrap samples of whole runs")
    return params, cov, influence, extra


def _weighted_inverse(design: np.ndarray, root: np.ndarray) -> np.ndarray:
    """Matrix of weighted least squares: params = matrix @ response."""
    return np.linalg.pinv(design * root[:, None]) * root


def _shrunk(
    rows: ForceRows, settings: Fit, weights: np.ndarray, notes: list[str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    from ..identify.ridge import fit_ridge, fit_truncated_svd

    if settings.estimator == "ridge":
        result = fit_ridge(rows.design, rows.response, rows.names, weights=weights, groups=rows.run)
        notes.append(f"ridge, penalty {result.penalty:.3g} by leaving out runs")
    else:
        result = fit_truncated_svd(rows.design, rows.response, rows.names, weights=weights, groups=rows.run)
        notes.append(f"truncated SVD, {result.kept} of {len(rows.terms)} directions by leaving out runs")
    notes.append("intervals do not hold the bias of shrinking")
    # The same shrinking, written as a matrix on the response: columns at unit weighted mean square.
    root = np.sqrt(weights)
    weighted = rows.design * root[:, None]
    size = np.sqrt((weighted**2).mean(axis=0))
    u, d, vt = np.linalg.svd(weighted / size, full_matrices=False)
    if settings.estimator == "ridge":
        inverse = d / (d**2 + result.penalty)
    else:
        inverse = np.where(np.arange(len(d)) < result.kept, 1.0 / d, 0.0)
    influence = ((vt.T * inverse) @ u.T) / size[:, None] * root
    return np.asarray(result.params), np.asarray(result.cov), influence


def _support_vectors(
    rows: ForceRows, weights: np.ndarray, notes: list[str]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    from ..identify.lssvm_linear import fit_lssvm

    constant = [term.name for term in rows.terms if not term.factors]
    means = rows.harmonic == 0
    # A constant force shows in means alone; the model's own constant takes the place of the bias.
    bias = False if constant or not means.any() else means.astype(float)
    result = fit_lssvm(
        rows.design, rows.response, rows.names, bias=bias, free=constant, weights=weights, groups=rows.run
    )
    notes.append(f"LS-SVM with linear kernel, gamma {result.gamma:.3g} by leaving out runs")
    if not isinstance(bias, bool):
        notes.append(f"bias {result.bias:.3g}, standard deviation {result.bias_std:.2g}, of the means")
    notes.append("intervals do not hold the bias of shrinking")
    return np.asarray(result.params), np.asarray(result.cov), np.asarray(result.influence)


def staged_influence(rows: ForceRows, weights: np.ndarray, stages: Sequence[Sequence[str]]) -> np.ndarray:
    """Linear map from data to coefficients when stages are fitted in turn.

    Each stage uses the rows to which no later term contributes, less what the earlier stages explain, so that the
    uncertainty of an early stage reaches the later ones.

    Raises
    ------
    FitError
        When a stage has too few rows.
    """
    names = rows.names
    n, p = rows.design.shape
    influence = np.zeros((p, n))
    done: list[int] = []
    for number, stage in enumerate(stages, start=1):
        now = [names.index(name) for name in stage if name in names]
        if not now:
            continue
        later = [i for i in range(p) if i not in done and i not in now]
        size = np.abs(rows.design).max(axis=0)
        own = (np.abs(rows.design[:, now]) > 1e-9 * size[now]).any(axis=1)
        free = ~(np.abs(rows.design[:, later]) > 1e-9 * size[later]).any(axis=1) if later else np.ones(n, bool)
        use = own & free
        if use.sum() < len(now):
            raise FitError(
                f"stage {number} ({' '.join(names[i] for i in now)}) has {int(use.sum())} data",
                cure="use the fit of all runs together (staged = false) or add runs of that kind",
            )
        solve = _weighted_inverse(rows.design[use][:, now], np.sqrt(weights[use]))
        rest = np.zeros((int(use.sum()), n))
        rest[np.arange(len(rest)), np.flatnonzero(use)] = 1.0
        if done:
            rest -= rows.design[use][:, done] @ influence[done]
        influence[now] = solve @ rest
        done += now
    if len(done) != p:
        left = [names[i] for i in range(p) if i not in done]
        raise FitError(f"no stage fits {', '.join(left)}", cure="name every term in one stage")
    return influence


def default_stages(terms: Sequence[Term]) -> list[list[str]]:
    """Drift, then yaw, then coupling: the fitting order of the inland-ship paper (MASHCON 2019)."""
    groups: list[list[str]] = [[], [], []]
    for term in terms:
        variables = set(term.variables)
        drift = bool(variables & {"v", "beta", "vdot"})
        yaw = bool(variables & {"r", "rdot"})
        groups[2 if drift and yaw else 1 if yaw else 0].append(term.name)
    return [group for group in groups if group]


def _constrained(
    rows: ForceRows,
    settings: Fit,
    weights: np.ndarray,
    scale: float,
    prior: Mapping[str, float] | None,
    notes: list[str],
) -> tuple[np.ndarray, np.ndarray, np.ndarray, dict[str, object]]:
    from ..identify.constrained import fit_constrained

    wishes = None
    if prior:
        wishes = {
            name: (prior[name], abs(prior[name]) * settings.prior_relative_sd)
            for name in rows.names
            if prior.get(name, 0.0) != 0.0
        }
        notes.append(f"prior: {settings.prior}, {100 * settings.prior_relative_sd:g} % standard deviation")
    limits = {
        name: (-np.inf if low is None else low, np.inf if high is None else high)
        for name, (low, high) in settings.bounds.items()
        if name in rows.names
    }
    equations = [(item.terms, item.value) for item in settings.equalities if set(item.terms) <= set(rows.names)]
    result = fit_constrained(
        rows.design,
        rows.response,
        rows.names,
        bounds=limits,
        equalities=equations,
        prior=wishes,
        noise_sd=float(np.sqrt(scale)) or None,
        weights=weights,
    )
    if result.active:
        notes.append("constraints that bind: " + ", ".join(result.active))
    cov = np.asarray(result.cov)
    return (
        np.asarray(result.params),
        cov,
        cov @ (rows.design * weights[:, None]).T / float(result.scale),
        {"active": result.active},
    )
