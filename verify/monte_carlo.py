"""Plain statistics of sampled outputs, to stand beside a polynomial chaos expansion."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..core.errors import FitError
from .input_distribution import UncertainInput
from .sampling import latin_hypercube, random_samples

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

QUANTILES = (0.05, 0.5, 0.95)


@dataclass(frozen=True)
class MonteCarlo:
    """Statistics of n samples of one output.

    Attributes
    ----------
    n : int
    mean : float
    population_sd : float
        Root of the mean square deviation: divides by n, as the literature of polynomial chaos does.
    sample_sd : float
        Divides by n - 1; NaN for one sample.
    mean_error : float
        Standard error of the mean of independent samples, sample_sd / sqrt(n); that of a Latin hypercube is smaller.
    p05, p50, p95 : float
        Quantiles of the samples.
    """

    n: int
    mean: float
    population_sd: float
    sample_sd: float
    mean_error: float
    p05: float
    p50: float
    p95: float


def sample_statistics(values: ArrayLike) -> MonteCarlo:
    """Statistics of sampled values.

    Parameters
    ----------
    values : array_like, shape (n,)

    Raises
    ------
    FitError
        When there is none, or one is no number.
    """
    y = np.asarray(values, dtype=float)
    if y.ndim != 1 or not y.size:
        raise FitError(f"values of shape {y.shape} are not samples of one output", cure="give one value a sample")
    if not np.isfinite(y).all():
        row = int(np.flatnonzero(~np.isfinite(y))[0])
        raise FitError(f"sample {row + 1} is no number", cure="drop the run that failed, or run it again")
    sample_sd = float(np.std(y, ddof=1)) if len(y) > 1 else math.nan
    low, middle, high = np.quantile(y, QUANTILES)
    return MonteCarlo(
        n=len(y),
        mean=float(np.mean(y)),
        population_sd=float(np.std(y)),
        sample_sd=sample_sd,
        mean_error=sample_sd / math.sqrt(len(y)),
        p05=float(low),
        p50=float(middle),
        p95=float(high),
    )


def propagate(
    function: Callable[[np.ndarray], Any],
    inputs: Sequence[UncertainInput],
    count: int,
    *,
    design: Literal["latin-hypercube", "random"] = "latin-hypercube",
    seed: int = 0,
) -> tuple[pd.DataFrame, np.ndarray]:
    """Sample the inputs and evaluate a response.

    Parameters
    ----------
    function : callable
        Takes inputs of shape (n, inputs), returns outputs of shape (n,) or (n, outputs): a fitted surface, a
        simulator, anything.
    inputs : sequence of UncertainInput
    count : int
        Number of samples.
    design : {"latin-hypercube", "random"}
    seed : int

    Returns
    -------
    samples : DataFrame, shape (count, inputs)
    values : ndarray, shape (count,) or (count, outputs)

    Raises
    ------
    FitError
        For an unknown design, or when the response does not return one row a sample.
    """
    if design not in ("latin-hypercube", "random"):
        raise FitError(f"unknown design '{design}'", cure="use latin-hypercube or random")
    samples = (latin_hypercube if design == "latin-hypercube" else random_samples)(inputs, count, seed=seed)
    values = np.asarray(function(samples.to_numpy()), dtype=float)
    if values.shape[:1] != (count,):
        raise FitError(
            f"the response returned shape {values.shape} for {count} samples",
            cure="return one row for each sample",
        )
    return samples, values
