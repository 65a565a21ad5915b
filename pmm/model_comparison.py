"""Which hull model do the runs support, and how far do the derivatives depend on the range that was fitted?"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..core.conventions import Conventions
from ..core.errors import FitError, TermError
from ..core.motion import scaled_state
from ..core.terms import Term
from ..identify import model_selection
from ..identify.linear_fit import LinearFit
from ..identify.regression import fit_linear
from .campaign_file import Fit
from .component_fit import default_stages, fit_component
from .force_rows import ForceRows, between_run_scatter, force_rows
from .reduced_run import FORCES, ReducedRun

if TYPE_CHECKING:
    import pandas as pd

COMPARISON_COLUMNS = (
    "component",
    "model",
    "terms",
    "n",
    "AICc",
    "delta_AICc",
    "weight",
    "R2",
    "residual_rms",
    "cv_rms",
    "condition_number",
    "note",
)

RANGE_COLUMNS = (
    "variable",
    "limit",
    "runs",
    "name",
    "value",
    "std",
    "change_percent",
    "change_in_std",
    "note",
)

_WITHIN = 1.0 + 1e-9


def compare_models(
    runs: Sequence[ReducedRun], candidates: Mapping[str, Sequence[Term]], settings: Fit
) -> pd.DataFrame:
    """Compare hull models on the same data, component by component.

    All candidates of a component are fitted by least squares to the same rows (those that any of them explains)
    with the same weights (noise within the runs, and the scatter between runs that the best of them leaves):
    criteria of different data cannot be compared.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group.
    candidates : mapping of str to sequence of Term
    settings : Fit
        The estimator ``ols`` weighs all rows alike; other estimators compare by weighted least squares.

    Returns
    -------
    DataFrame
        Columns component, model, terms (number), n (rows), AICc, delta_AICc, weight (Akaike), R2, residual_rms,
        cv_rms, condition_number, note; the best model of each component first. ``residual_rms`` and ``cv_rms`` are
        weighted, in scaled force (LT); ``cv_rms`` is that of each run predicted by the fit without it, infinite
        when a run alone determines a term. A candidate that cannot be fitted has NaN and a note.
    """
    import pandas as pd

    wet = [run for run in runs if not run.run.dry]
    rows: list[dict[str, object]] = []
    for component in FORCES:
        own = {name: [t for t in terms if t.component == component] for name, terms in candidates.items()}
        own = {name: terms for name, terms in own.items() if terms}
        if own and any(component in run.scaled for run in wet):
            rows += _compared(wet, own, component, settings)
    return pd.DataFrame(rows, columns=list(COMPARISON_COLUMNS))


def _compared(
    runs: Sequence[ReducedRun], candidates: Mapping[str, Sequence[Term]], component: str, settings: Fit
) -> list[dict[str, object]]:
    union: dict[str, Term] = {}
    failed: dict[str, str] = {}
    for model, terms in candidates.items():
        try:
            for run in runs:
                run.design(terms)
            union |= {term.name: term for term in terms}
        except TermError as error:
            failed[model] = error.cause
    data = force_rows(runs, tuple(union.values()), component)
    excited = {name for name, moved in zip(data.names, data.excited, strict=True) if moved}
    columns = {
        m: [t.name for t in terms if t.name in excited] for m, terms in candidates.items() if m not in failed
    }
    weights = _common_weights(data, list(columns.values()), settings)
    fits: dict[str, LinearFit] = {}
    for model, names in columns.items():
        try:
            fits[model] = fit_linear(_columns(data, names), data.response, names, weights=weights, groups=data.run)
        except FitError as error:
            failed[model] = error.cause
    rows: list[dict[str, object]] = []
    if fits:
        table = model_selection.compare_models(
            data.design,
            data.response,
            data.names,
            {model: columns[model] for model in fits},
            weights=weights,
            groups=data.run,
        )
        for row in table.itertuples():
            model = str(row.Index)
            idle = [term.name for term in candidates[model] if term.name not in excited]
            rows.append(
                {
                    "component": component,
                    "model": model,
                    "terms": row.terms,
                    "n": fits[model].n,
                    "AICc": row.aicc,
                    "delta_AICc": row.delta,
                    "weight": row.weight,
                    "R2": fits[model].r2,
                    "residual_rms": math.sqrt(fits[model].ssr / fits[model].n),
                    "cv_rms": row.cv_rmse,
                    "condition_number": row.condition_number,
                    "note": f"no run excites {', '.join(idle)}" if idle else "",
                }
            )
    for model, cause in failed.items():
        blank = dict.fromkeys(COMPARISON_COLUMNS, math.nan)
        rows.append(
            blank | {"component": component, "model": model, "terms": len(candidates[model]), "note": cause}
        )
    return rows


def _columns(data: ForceRows, names: Sequence[str]) -> np.ndarray:
    return data.design[:, [data.names.index(name) for name in names]]


def _common_weights(data: ForceRows, models: Sequence[Sequence[str]], settings: Fit) -> np.ndarray | None:
    """Weights of mean 1, so that weighted root mean squares keep the unit of the response; None for equal ones."""
    if settings.estimator == "ols" or not np.isfinite(data.sd).all():
        return None
    everything = np.arange(len(data.response))
    scatter = min(
        (
            between_run_scatter(data.only(everything, [data.names.index(name) for name in names]))
            for names in models
            if 0 < len(names) < len(everything)
        ),
        default=0.0,
    )
    weights = 1.0 / (data.sd**2 + scatter**2)
    return weights / weights.mean()


def range_sensitivity(
    runs: Sequence[ReducedRun],
    terms: Sequence[Term],
    settings: Fit,
    limits: Sequence[float] | Mapping[str, Sequence[float]],
) -> pd.DataFrame:
    """Refit the derivatives on the runs whose motion stays within limits.

    Parameters
    ----------
    runs : sequence of ReducedRun
        Runs of one group.
    terms : sequence of Term
        Terms that no run within a limit excites are left out there.
    settings : Fit
        Estimator of the refits; a bootstrapped covariance is replaced by that of the model.
    limits : sequence of float, or mapping of str to sequence of float
        Largest magnitude by variable: ``v`` (v/U), ``r`` (r L/U), ``beta`` (rad) or another variable of the
        motion, non-dimensional. A plain sequence limits v' and r', each on its own.

    Returns
    -------
    DataFrame
        Columns variable, limit, runs (number within the limit), name, value, std, change_percent and
        change_in_std (against the fit of all runs, in combined standard errors), note. Rows with an empty variable
        and an infinite limit are the fit of all runs; limits that leave out no run are not repeated.

    Raises
    ------
    TermError
        For a variable that the motion does not have.
    """
    import pandas as pd

    wet = [run for run in runs if not run.run.dry]
    if settings.covariance == "bootstrap":
        settings = settings.model_copy(update={"covariance": "model"})
    by_variable = dict(limits) if isinstance(limits, Mapping) else {"v": limits, "r": limits}
    reach = np.array([_reach(run, tuple(by_variable)) for run in wet])
    data = [force_rows(wet, terms, component) for component in FORCES]
    data = [rows for rows in data if rows.terms and len(rows.response)]
    reference = _refit(data, np.ones(len(wet), dtype=bool), terms, settings)
    rows = [_range_row("", math.inf, len(wet), term.name, reference, reference) for term in terms]
    for column, (variable, values) in enumerate(by_variable.items()):
        for limit in sorted(values):
            within = reach[:, column] <= limit * _WITHIN
            if within.all():
                continue
            refit = _refit(data, within, terms, settings)
            rows += [_range_row(variable, limit, int(within.sum()), t.name, refit, reference) for t in terms]
    return pd.DataFrame(rows, columns=list(RANGE_COLUMNS))


_Refit = Mapping[str, tuple[float, float, str]]


def _range_row(
    variable: str, limit: float, runs: int, name: str, refit: _Refit, reference: _Refit
) -> tuple[str, float, int, str, float, float, float, float, str]:
    value, std, note = refit[name]
    base, base_std, _ = reference[name]
    change, combined = value - base, math.hypot(std, base_std)
    return (
        variable,
        limit,
        runs,
        name,
        value,
        std,
        100.0 * change / abs(base) if base else math.nan,
        change / combined if combined > 0 else math.nan,
        note,
    )


def _refit(
    data: Sequence[ForceRows], within: np.ndarray, terms: Sequence[Term], settings: Fit
) -> dict[str, tuple[float, float, str]]:
    """Value, standard error and note of every term; NaN with the reason where the runs do not carry it."""
    results = {term.name: (math.nan, math.nan, "no run excites it") for term in terms}
    for rows in data:
        inside = rows.only(np.flatnonzero(within[rows.run]))
        excited = np.flatnonzero(inside.excited).tolist()
        if not excited:
            continue
        inside = inside.only(np.arange(len(inside.response)), excited)
        try:
            stages = default_stages(inside.terms) if settings.staged else None
            fit = fit_component(inside, settings, stages)
        except FitError as error:
            results |= dict.fromkeys(inside.names, (math.nan, math.nan, error.cause))
            continue
        for name, value, variance in zip(inside.names, fit.params, np.diag(fit.cov), strict=True):
            results[name] = (float(value), math.sqrt(max(float(variance), 0.0)), "")
    return results


def _reach(run: ReducedRun, variables: Sequence[str]) -> list[float]:
    """Largest magnitude of each variable in a run, non-dimensional."""
    times = np.array([run.window.start])
    if run.order:
        times = run.window.start + run.run.period * np.linspace(0.0, 1.0, 48, endpoint=False)
    state, _ = scaled_state(
        run.motion.at(times), run.ship, Conventions(velocity_scale=run.velocity_scale), run.motion.speed
    )
    for variable in variables:
        if variable not in state:
            raise TermError(f"the motion has no '{variable}'", cure=f"limit one of {', '.join(sorted(state))}")
    return [float(np.abs(state[variable]).max()) for variable in variables]
