"""Which terms belong in the model: AICc, left-out runs, and the range of the motion that is fitted."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from .linear_fit import LinearFit
from .regression import fit_linear

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class LeftOutScore:
    """Prediction of runs that were left out of the fit.

    Attributes
    ----------
    rmse : float
        Root mean square (weighted) prediction error over all rows; inf when a run alone determines a term.
    q2 : float
        1 - (prediction error / scatter about the mean)^2, the R2 of prediction.
    group_rmse : Series
        Prediction error of each run.
    undetermined : list
        Runs without which the terms cannot be separated.
    """

    rmse: float
    q2: float
    group_rmse: pd.Series
    undetermined: list[Hashable]


def left_out_runs(fit: LinearFit) -> LeftOutScore:
    """Cross-validate a fit by leaving out each group in turn, in closed form.

    Parameters
    ----------
    fit : LinearFit
        With `groups`; each row is left out alone when it has none.

    Returns
    -------
    LeftOutScore
    """
    import pandas as pd

    labels = np.arange(fit.n) if fit.groups is None else fit.geometry.labels
    alone = fit.determined_alone
    size = np.where(alone, np.inf, fit.group_rms(fit.deleted_residuals))
    series = pd.Series(size, index=pd.Index(labels, name="group"), name="rmse")
    w = np.ones(fit.n) if fit.weights is None else fit.weights
    centre = float(w @ fit.response) / float(w.sum()) if fit.has_intercept else 0.0
    spread = float(w @ (fit.response - centre) ** 2)
    press = math.inf if alone.any() else float(fit.deleted_residuals @ fit.deleted_residuals)
    q2 = 1.0 - press / spread if spread > 0.0 else math.nan
    return LeftOutScore(math.sqrt(press / fit.n), q2, series, list(labels[alone]))


def compare_models(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    models: Mapping[str, Sequence[str]],
    *,
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    n_eff: float | None = None,
) -> pd.DataFrame:
    """Compare term lists on the same rows.

    Parameters
    ----------
    design : ndarray, shape (n, p)
        All columns that any model uses.
    response, names, weights, groups :
        As :func:`.regression.fit_linear`.
    models : mapping of str to sequence of str
        Term list of each model.
    n_eff : float, optional
        Independent rows, when the n rows are autocorrelated samples: the likelihood is raised to n_eff/n and
        AICc counts n_eff rows. Without it the criteria of autocorrelated samples favour too many terms.

    Returns
    -------
    DataFrame
        Indexed by model, best AICc first: ``terms, aicc, delta, weight`` (Akaike weight), ``bic, r2_adj,
        residual_std, cv_rmse, q2, condition_number``.

    Raises
    ------
    FitError
        As :func:`.regression.fit_linear`; if there is no model or a term has no column.
    """
    import pandas as pd

    if not models:
        raise FitError("there is no model to compare", cure="give at least one list of terms")
    where = {name: j for j, name in enumerate(names)}
    rows: dict[str, dict[str, Any]] = {}
    for model, terms in models.items():
        unknown = [term for term in terms if term not in where]
        if unknown:
            raise FitError(f"model '{model}' has no column for {', '.join(unknown)}", cure="add the column")
        columns = np.asarray(design, dtype=float)[:, [where[term] for term in terms]]
        fit = fit_linear(columns, response, terms, weights=weights, groups=groups)
        score = left_out_runs(fit)
        count = float(fit.n) if n_eff is None else float(n_eff)
        deviance = -2.0 * fit.loglik * count / fit.n
        k = fit.rank + 1
        rows[model] = {
            "terms": len(terms),
            "aicc": deviance + 2.0 * k * count / (count - k - 1.0) if count > k + 1 else math.inf,
            "bic": deviance + math.log(count) * fit.rank,
            "r2_adj": fit.r2_adj,
            "residual_std": math.sqrt(fit.scale) if fit.dof > 0 else math.nan,
            "cv_rmse": score.rmse,
            "q2": score.q2,
            "condition_number": fit.condition_number,
        }
    frame = pd.DataFrame.from_dict(rows, orient="index").sort_values("aicc", kind="stable")
    frame.index.name = "model"
    best = frame["aicc"].iloc[0]
    delta = (
        (frame["aicc"] - best).to_numpy() if math.isfinite(best) else np.where(frame["aicc"] == best, 0.0, np.inf)
    )
    likelihood = np.exp(-0.5 * delta)
    frame.insert(2, "delta", delta)
    frame.insert(3, "weight", likelihood / likelihood.sum())
    return frame


def range_sensitivity(
    design: np.ndarray,
    response: np.ndarray,
    names: Sequence[str],
    x: np.ndarray,
    limits: Sequence[float],
    *,
    weights: np.ndarray | None = None,
    groups: np.ndarray | Sequence[Hashable] | None = None,
    **options: Any,
) -> pd.DataFrame:
    """Refit on the rows with abs(x) within each limit.

    Parameters
    ----------
    design, response, names, weights, groups :
        As :func:`.regression.fit_linear`.
    x : ndarray, shape (n,)
        The variable whose range is cut, for example the drift angle.
    limits : sequence of float
        Largest abs(x) of each refit.
    **options
        Passed to :func:`.regression.fit_linear`.

    Returns
    -------
    DataFrame
        One row for each limit and term: ``limit, rows, name, value, std, lower, upper``. A limit whose rows
        cannot carry the terms has nan values: the rows that are left say nothing about them.

    Raises
    ------
    FitError
        If `x` has another length than the response, or no limit leaves enough rows.
    """
    import pandas as pd

    along, y = np.abs(np.asarray(x, dtype=float)), np.asarray(response, dtype=float)
    if along.shape != y.shape:
        raise FitError(f"{along.size} values of the range variable for {y.size} rows", cure="give one a row")
    labels = None if groups is None else np.asarray(groups)
    blocks, carried = [], 0
    for limit in limits:
        kept = along <= limit * (1.0 + 1e-12)
        try:
            fit = fit_linear(
                np.asarray(design, dtype=float)[kept],
                y[kept],
                names,
                weights=None if weights is None else np.asarray(weights)[kept],
                groups=None if labels is None else labels[kept],
                **options,
            )
            table = fit.to_frame()[["value", "std", "lower", "upper"]]
            carried += 1
        except FitError:
            table = pd.DataFrame(
                np.nan, index=pd.Index(names, name="name"), columns=["value", "std", "lower", "upper"]
            )
        blocks.append(table.reset_index().assign(limit=float(limit), rows=int(kept.sum())))
    if carried == 0:
        raise FitError("no limit leaves rows enough to fit the terms", cure="use larger limits")
    return pd.concat(blocks, ignore_index=True)[["limit", "rows", "name", "value", "std", "lower", "upper"]]
