"""The test function of the literature on polynomial chaos: an exponential with random height and decay."""

from __future__ import annotations

import numpy as np

from ..verify import UncertainInput, fit_chaos, latin_hypercube

INPUTS = (UncertainInput("a", "uniform", (1.0, 2.0)), UncertainInput("b", "uniform", (0.1, 0.2)))
"""Height and decay of a exp(-b x)."""

GRID = np.linspace(0.0, 10.0, 21)


def random_exponential(samples: np.ndarray, x: np.ndarray) -> np.ndarray:
    """a exp(-b x) for samples (a, b) of shape (n, 2): shape (n, len(x))."""
    return np.asarray(samples[:, :1] * np.exp(-samples[:, 1:] * x))


def exact_mean_and_sd(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean and standard deviation in closed form, by integrating over both uniform distributions."""
    mean = 1.5 * _mean_decay(x)
    square = 7.0 / 3.0 * _mean_decay(2.0 * x)
    return mean, np.sqrt(square - mean**2)


def _mean_decay(x: np.ndarray) -> np.ndarray:
    """Mean of exp(-b x) over b uniform on (0.1, 0.2)."""
    at = np.where(x == 0.0, 1.0, x)
    return np.asarray(np.where(x == 0.0, 1.0, (np.exp(-0.1 * at) - np.exp(-0.2 * at)) / (0.1 * at)))


def error_levels(count: int, *, hypercubes: int, order: int = 2) -> tuple[float, float, float]:
    """Largest relative errors over :data:`GRID` that 95 % of some Latin hypercubes stay below.

    Parameters
    ----------
    count : int
        Samples of each hypercube.
    hypercubes : int
        How many, with the seeds 0, 1, ...
    order : int
        Of the regression.

    Returns
    -------
    (float, float, float)
        Of the mean and the standard deviation by regression, and of the standard deviation of the samples.
    """
    mean, sd = exact_mean_and_sd(GRID)
    errors = []
    for seed in range(hypercubes):
        samples = latin_hypercube(INPUTS, count, seed=seed).to_numpy()
        values = random_exponential(samples, GRID)
        fit = fit_chaos(INPUTS, samples, values, order)
        computed = ((fit.mean, mean), (fit.sd, sd), (values.std(axis=0), sd))
        errors.append([np.max(np.abs(ours / exact - 1.0)) for ours, exact in computed])
    of_mean, of_sd, of_samples = np.quantile(np.array(errors), 0.95, axis=0).tolist()
    return of_mean, of_sd, of_samples
