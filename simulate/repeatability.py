"""Repeated free-running tests: mean of an index and its uncertainty by Student's distribution."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..core.errors import TowtankError

if TYPE_CHECKING:
    import pandas as pd

FEWEST = 3
"""Two tests say hardly anything: Student's factor is 12.7 there."""


class Repeatability(NamedTuple):
    """What repeated tests say about one index.

    Attributes
    ----------
    tests : int
        Number of tests.
    mean, sd : float
        Mean, and standard deviation of one test.
    sd_of_mean : float
        ``sd / sqrt(tests)``.
    uncertainty : float
        Half of the interval of the mean, ``t sd_of_mean``.
    relative : float
        Uncertainty over the mean in per cent.
    """

    tests: int
    mean: float
    sd: float
    sd_of_mean: float
    uncertainty: float
    relative: float


def mean_uncertainty(tests: int, mean: float, sd: float, confidence: float = 0.95) -> Repeatability:
    """Uncertainty of a mean from the number of tests, their mean and their standard deviation.

    Raises
    ------
    TowtankError
        For fewer than three tests.

    References
    ----------
    ITTC 7.5-02-06-05; used for the free-running tests of DTC, 5th MASHCON, 2019.
    """
    from scipy.stats import t as student

    if tests < FEWEST:
        raise TowtankError(
            f"{tests} repeated test(s) give no uncertainty", cure=f"give at least {FEWEST}, better five"
        )
    of_mean = sd / math.sqrt(tests)
    half = float(student.ppf(0.5 + 0.5 * confidence, tests - 1)) * of_mean
    return Repeatability(tests, mean, sd, of_mean, half, 100.0 * half / abs(mean) if mean else math.nan)


def repeatability(values: ArrayLike, confidence: float = 0.95) -> Repeatability:
    """Uncertainty of the mean of an index over repeated tests; values of shape (n,), NaN are left out.

    Raises
    ------
    TowtankError
        For fewer than three tests.
    """
    known = np.asarray(values, dtype=float)
    known = known[np.isfinite(known)]
    spread = float(np.std(known, ddof=1)) if len(known) > 1 else math.nan
    return mean_uncertainty(len(known), float(known.mean()) if len(known) else math.nan, spread, confidence)


def repeated_indices(tables: Iterable[pd.DataFrame], confidence: float = 0.95) -> pd.DataFrame:
    """Mean and uncertainty of every index over repeated tests of one manoeuvre.

    Parameters
    ----------
    tables : iterable of DataFrame
        One for each test, from :func:`~towtank.simulate.manoeuvre_indices.indices`.
    confidence : float

    Returns
    -------
    DataFrame
        Columns manoeuvre, index, unit, tests, mean, sd, sd_of_mean, uncertainty, relative (%). Indices that occurred in
        fewer than three tests are left out.

    Raises
    ------
    TowtankError
        When no index occurred in three tests.
    """
    import pandas as pd

    together = pd.concat(list(tables), ignore_index=True)
    rows = []
    for (manoeuvre, index, unit), group in together.groupby(["manoeuvre", "index", "unit"], sort=False):
        if len(group) >= FEWEST:
            rows.append((manoeuvre, index, unit, *repeatability(group["value"], confidence)))
    if not rows:
        raise TowtankError(
            "no index occurred in three tests of one manoeuvre",
            cure="give tests of the same manoeuvre, with the same name and unit of lengths",
        )
    return pd.DataFrame(rows, columns=["manoeuvre", "index", "unit", *Repeatability._fields])
