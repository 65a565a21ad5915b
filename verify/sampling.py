"""Points at which a solver is run: Latin hypercube and random samples of uncertain inputs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .input_distribution import UncertainInput, check_inputs

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike


def latin_hypercube(inputs: Sequence[UncertainInput], count: int, *, seed: int = 0) -> pd.DataFrame:
    """Samples that fall once into each of `count` slices of equal probability of every input.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    count : int
        Samples; twice the terms of the expansion is the usual oversampling (Hosder, Walters and Balch 2007).
    seed : int
        The same seed gives the same samples.

    Returns
    -------
    DataFrame, shape (count, inputs)
        One column an input, by name.

    Raises
    ------
    FitError
        When `count` is not positive.

    Notes
    -----
    By :class:`scipy.stats.qmc.LatinHypercube`.
    """
    from scipy.stats import qmc

    _positive(count)
    return _frame(inputs, qmc.LatinHypercube(len(inputs), rng=np.random.default_rng(seed)).random(count))


def random_samples(inputs: Sequence[UncertainInput], count: int, *, seed: int = 0) -> pd.DataFrame:
    """Independent samples of the inputs: plain Monte Carlo; arguments as :func:`latin_hypercube`."""
    _positive(count)
    return _frame(inputs, np.random.default_rng(seed).random((count, len(inputs))))


def strata_hit(inputs: Sequence[UncertainInput], samples: ArrayLike) -> np.ndarray:
    """How many of the slices of equal probability hold a sample, for each input.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    samples : array_like, shape (n, inputs)

    Returns
    -------
    ndarray of int, shape (inputs,)
        n for each input when the samples are a Latin hypercube.
    """
    x = np.asarray(samples, dtype=float)
    count = len(x)
    hit = []
    for i, one in enumerate(inputs):
        slices = np.clip((one.probability(x[:, i]) * count).astype(int), 0, count - 1)
        hit.append(len(set(slices.tolist())))
    return np.array(hit)


def _positive(count: int) -> None:
    if count < 1:
        raise FitError(f"{count} samples cannot be drawn", cure="give a positive number")


def _frame(inputs: Sequence[UncertainInput], probabilities: np.ndarray) -> pd.DataFrame:
    import pandas as pd

    check_inputs(tuple(inputs))
    return pd.DataFrame({one.name: one.quantile(probabilities[:, i]) for i, one in enumerate(inputs)})
