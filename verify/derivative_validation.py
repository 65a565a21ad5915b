"""Validation of hydrodynamic derivatives: a computed set against a measured one, term by term and as a whole."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..core.derivative_set import DerivativeSet
from ..core.derivative_table import unit_line
from ..core.errors import TowtankError
from .matched_derivatives import MatchedDerivatives, match_derivatives
from .validation import COVERAGE, validate_value, validation_frame

if TYPE_CHECKING:
    import pandas as pd


def validate_derivatives(
    simulation: DerivativeSet,
    data: DerivativeSet,
    *,
    numerical: Mapping[str, float] | None = None,
    coverage: float = COVERAGE,
    required: float | Mapping[str, float] | None = None,
) -> pd.DataFrame:
    """Validate the derivatives that two sets share.

    Parameters
    ----------
    simulation : DerivativeSet
        S, e.g. from CFD. Without `numerical` its whole covariance counts as U_SN: give the set whose covariance holds
        fit and grid together.
    data : DerivativeSet
        D, e.g. from model tests; its covariance gives U_D. The simulation is converted to its conventions.
    numerical : mapping of str to float, optional
        Expanded numerical uncertainty by derivative, named, signed and scaled as in `data`. The covariance of
        `simulation` then counts as U_input: what the fit to the computed forces leaves open.
    coverage : float
        Coverage factor that turns standard errors into U, and that `numerical` has.
    required : float or mapping of str to float, optional
        Uncertainty that the use can bear, for all or by derivative.

    Returns
    -------
    DataFrame
        Columns of :data:`~towtank.verify.validation.VALIDATION_COLUMNS`, ordered as `data`. ``attrs``: ``coverage``,
        ``sentences``, ``conventions``, ``only_simulation``, ``only_data``, ``notes``; and, when both sets have a
        covariance, ``chi2`` = E' C^-1 E over all derivatives together with ``degrees_of_freedom`` and ``p_value``,
        which count correlated derivatives once (NaN otherwise).

    Raises
    ------
    ConventionError
        When the sets cannot be brought into one convention or share no derivative.
    TowtankError
        When `numerical` names no shared derivative, or holds a negative value.
    """
    matched = match_derivatives(data, simulation)
    if numerical is not None and not set(numerical) & set(matched.names):
        raise TowtankError(
            f"numerical uncertainties of {', '.join(list(numerical)[:4])} belong to no shared derivative",
            cure=f"the sets share {', '.join(matched.names)}",
        )
    notes = []
    if matched.turned_because:
        notes.append(
            "the data were converted to the conventions of the simulation, because it cannot be converted: "
            + matched.turned_because
        )
    if numerical is not None and simulation.covariance is None:
        notes.append("the simulation has no covariance: the scatter of its fit is counted as zero")
    of_data = coverage * np.sqrt(np.diag(matched.a_covariance))
    of_fit = coverage * np.sqrt(np.diag(matched.b_covariance))
    results = []
    for i, name in enumerate(matched.names):
        grid = float(of_fit[i]) if numerical is None else float(numerical.get(name, math.nan))
        fit = 0.0 if numerical is None or math.isnan(of_fit[i]) else float(of_fit[i])
        results.append(
            validate_value(
                float(matched.b[i]),
                float(matched.a[i]),
                U_D=float(of_data[i]),
                U_SN=grid,
                U_input=fit,
                coverage=coverage,
                required=required.get(name) if isinstance(required, Mapping) else required,
                quantity=name,
            )
        )
    frame = validation_frame(results)
    chi2, freedom, probability = _together(matched, numerical, coverage)
    frame.attrs |= {
        "conventions": unit_line(matched.set_a),
        "only_simulation": list(matched.only_b),
        "only_data": list(matched.only_a),
        "notes": notes,
        "chi2": chi2,
        "degrees_of_freedom": freedom,
        "p_value": probability,
    }
    return frame


def _together(
    matched: MatchedDerivatives, numerical: Mapping[str, float] | None, coverage: float
) -> tuple[float, int, float]:
    """All differences together against their joint covariance: chi squared, degrees of freedom, probability."""
    from scipy.special import chdtrc

    if numerical is None:
        joint = matched.a_covariance + matched.b_covariance
    else:
        own = np.array([numerical.get(name, math.nan) for name in matched.names]) / coverage
        joint = matched.a_covariance + np.nan_to_num(matched.b_covariance) + np.diag(own**2)
    size = np.sqrt(np.diag(joint))
    if not (np.isfinite(joint).all() and (size > 0.0).all()):
        return math.nan, 0, math.nan
    # in units of the standard uncertainties: the derivatives differ by orders of magnitude
    values, vectors = np.linalg.eigh(joint / np.outer(size, size))
    kept = values > 1e-10 * values[-1]
    scores = (vectors.T @ ((matched.b - matched.a) / size))[kept] ** 2 / values[kept]
    chi2, freedom = float(scores.sum()), int(kept.sum())
    return chi2, freedom, float(chdtrc(freedom, chi2))
