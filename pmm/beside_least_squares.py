"""Coefficients of a robust, shrunk or constrained estimator beside those of least squares on the same rows."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from .hull_fit import HullFit

if TYPE_CHECKING:
    import pandas as pd

COLUMNS = (
    "name",
    "fit",
    "fit_std",
    "least_squares",
    "least_squares_std",
    "fit_minus_least_squares",
    "difference_in_std",
)


def beside_least_squares(fit: HullFit) -> pd.DataFrame:
    """Compare the estimate of a fit with weighted least squares.

    Parameters
    ----------
    fit : HullFit

    Returns
    -------
    DataFrame
        One row a derivative, in the conventions of the fit: value and standard error (scatter only) of both, and
        the difference, as it is and in standard errors of least squares. NaN where least squares has no answer.
    """
    import pandas as pd

    rows = []
    for component in fit.components.values():
        own = np.sqrt(np.clip(np.diag(component.cov), 0.0, None))
        plain = component.fit
        known = (
            {} if plain is None else dict(zip(plain.names, zip(plain.params, plain.bse, strict=True), strict=True))
        )
        for name, value, std in zip(component.rows.names, component.params, own, strict=True):
            theirs, error = known.get(name, (math.nan, math.nan))
            difference = value - theirs
            rows.append(
                (name, value, std, theirs, error, difference, difference / error if error > 0 else math.nan)
            )
    return pd.DataFrame(rows, columns=list(COLUMNS))
