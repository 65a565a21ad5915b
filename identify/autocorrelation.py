"""Means of autocorrelated records: integrated time, effective number of samples, standard error.

A steady run of 6000 samples is not 6000 measurements. The standard error of its mean follows from the noise
density at frequency zero, which :mod:`.autoregression` estimates.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .autoregression import fit_autoregression


@dataclass(frozen=True, eq=False)
class MeanEstimate:
    """Mean of one record (floats), or of several channels (arrays of shape (k,)).

    Attributes
    ----------
    mean, se : float or ndarray
        Mean and its standard error, in the unit of the record.
    n_eff : float or ndarray
        Number of independent samples that would give this standard error; 1 for a constant channel.
    tau : float or ndarray
        Integrated autocorrelation time in samples, at least 1.
    dof : float or ndarray
        Degrees of freedom of `se`: fewer than n_eff - 1, because the correlation is estimated too.
    constant : bool or ndarray of bool
        True where the channel does not vary: `se` = 0 then says nothing about the measurement.
    """

    mean: float | np.ndarray
    se: float | np.ndarray
    n_eff: float | np.ndarray
    tau: float | np.ndarray
    dof: float | np.ndarray
    constant: bool | np.ndarray

    def conf_int(self, level: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limit of the t-interval of the mean at `level`."""
        from scipy.special import stdtrit

        half = stdtrit(self.dof, 0.5 + 0.5 * level) * self.se
        return np.asarray(self.mean - half), np.asarray(self.mean + half)


def mean_with_error(x: np.ndarray) -> MeanEstimate:
    """Mean with a standard error that accounts for autocorrelation.

    The standard error is never smaller than that of white noise: a periodic disturbance averages out over
    whole periods only, which the noise density at frequency zero does not know.

    Parameters
    ----------
    x : ndarray, shape (n,) or (n, k)
        Uniformly sampled record of a steady run; columns are channels.

    Returns
    -------
    MeanEstimate
        Floats for a record of shape (n,), arrays of shape (k,) for (n, k). With fewer than two samples
        the standard error is nan.

    Raises
    ------
    FitError
        If there is no sample or a value is not finite.
    """
    values = np.asarray(x, dtype=float)
    noise = fit_autoregression(values)
    n = noise.samples
    constant = noise.variance <= 0.0
    tau = np.ones(constant.size)
    np.divide(noise.density([0.0])[0], noise.variance, out=tau, where=~constant)
    # One run cannot hold less than one independent sample.
    tau = np.where(constant, float(n), np.clip(tau, 1.0, n))
    se = np.sqrt(noise.variance * tau / n) if n > 1 else np.full(constant.size, np.nan)
    dof = noise.dof([0.0])[0] if n > 1 else np.ones(constant.size)
    if values.ndim == 1:
        return MeanEstimate(
            float(values.mean()),
            float(se[0]),
            float(n / tau[0]),
            float(tau[0]),
            float(dof[0]),
            bool(constant[0]),
        )
    return MeanEstimate(values.mean(axis=0), se, n / tau, tau, dof, constant)


def integrated_time(x: np.ndarray) -> float:
    """Integrated autocorrelation time of a record (n,), in samples, at least 1.

    tau = 1 + 2 sum of the autocorrelations = S(0)/variance: n/tau samples are independent. A constant record
    has tau = n.
    """
    return float(mean_with_error(np.ravel(x)).tau)


def effective_size(x: np.ndarray) -> float:
    """Number of independent samples in a record (n,): n over the integrated autocorrelation time."""
    return float(mean_with_error(np.ravel(x)).n_eff)


def long_run_variance(x: np.ndarray, frequency: float = 0.0) -> float:
    """Two-sided noise density of a record (n,) at `frequency` (cycles a sample).

    Normalised so that var(mean) = S(0)/n, and a cosine or sine coefficient fitted at f has variance 2 S(f)/n;
    white noise has S = variance. Unit: the square of the record's.
    """
    return float(long_run_variances(np.ravel(x)[:, None], [frequency])[0, 0])


def long_run_variances(x: np.ndarray, frequencies: np.ndarray | Sequence[float]) -> np.ndarray:
    """Noise densities of the columns of `x`.

    Parameters
    ----------
    x : ndarray, shape (n, k)
        Noise, one channel a column, uniformly sampled.
    frequencies : array_like, shape (m,)
        Cycles a sample, 0 to 0.5.

    Returns
    -------
    ndarray, shape (m, k)
        :func:`long_run_variance` of each column at each frequency.
    """
    at = np.asarray(frequencies, dtype=float)
    noise = fit_autoregression(x, highest_frequency=float(np.max(np.abs(at), initial=0.0)))
    return noise.density(at)
