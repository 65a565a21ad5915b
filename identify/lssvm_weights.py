"""Row weights that keep outliers from bending an LS-SVM."""

from __future__ import annotations

import numpy as np

from ..core.errors import FitError

# Suykens, De Brabanter, Lukas and Vandewalle (2002), Neurocomputing 48:85-105, equation (17).
FULL_WEIGHT, NO_WEIGHT, LEAST = 2.5, 3.0, 1e-4
# More outliers than this share are no outliers but a misfit.
MOST_OUTLIERS = 1.0 / 3.0


def suykens_weights(residual: np.ndarray) -> np.ndarray:
    """Weight of each row from its residual (n,), shape (n,).

    1 up to 2.5 robust standard deviations (1.483 times the median absolute deviation), falling linearly to 1e-4
    at 3 and beyond. All 1 when most residuals are alike to rounding, because nothing then tells what is usual.

    Raises
    ------
    FitError
        If more than a third of the rows would lose more than half of their weight: the fit then misses the signal
        itself, and reweighting would drop the part that it misses.
    """
    away = residual - np.median(residual)
    spread = 1.483 * float(np.median(np.abs(away)))
    if spread <= 1e-13 * float(np.max(np.abs(residual), initial=0.0)):
        return np.ones(residual.size)
    ratio = np.abs(residual) / spread
    falling = (NO_WEIGHT - ratio) / (NO_WEIGHT - FULL_WEIGHT)
    weights = np.clip(falling, LEAST, 1.0)
    lost = int(np.count_nonzero(weights < 0.5))
    if lost > MOST_OUTLIERS * residual.size:
        raise FitError(
            f"{lost} of {residual.size} rows would count as outliers: the fit is too stiff for the data",
            cure="use a larger gamma or no reweighting",
        )
    return weights
