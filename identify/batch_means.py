"""Means over separate stretches of a record, and over a growing one.

Batch means need no model of the noise: the scatter of the means of long batches is the error of the whole mean, as
soon as the batches are longer than the memory of the noise. They stand beside the autoregressive error of
:mod:`.autocorrelation` as its check.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .transient import require_samples

DEFAULT_BATCHES = 20


@dataclass(frozen=True, eq=False)
class BatchMeans:
    """Mean of one channel with the error that its batches show.

    Attributes
    ----------
    mean, se : float
        Mean of the record and its standard error in its unit; t-distributed with `dof` degrees of freedom.
    dof : int
        Batches less one.
    means : ndarray, shape (batches,)
        Mean of each batch.
    lag_one : float
        Correlation of neighbouring batches; far above 0 the batches are too short and `se` too small.
    """

    mean: float
    se: float
    dof: int
    means: np.ndarray
    lag_one: float

    def conf_int(self, level: float = 0.95) -> tuple[float, float]:
        """Lower and upper limit of the t-interval of the mean at `level`."""
        from scipy.special import stdtrit

        half = float(stdtrit(self.dof, 0.5 + 0.5 * level)) * self.se
        return self.mean - half, self.mean + half


def batch_means(x: np.ndarray, batches: int = DEFAULT_BATCHES) -> BatchMeans:
    """Mean and standard error by batch means (Schmeiser 1982: 10 to 30 batches).

    Parameters
    ----------
    x : ndarray, shape (n,)
        Uniformly sampled channel behind its transient.
    batches : int
        Batches of equal length; at most n/2. Samples that do not fill one are left out at the start.

    Raises
    ------
    FitError
        If fewer than eight samples are given.
    """
    values = np.asarray(x, dtype=float)
    require_samples(values.size, "for batch means")
    count = max(min(batches, values.size // 2), 2)
    length = values.size // count
    means = values[values.size - count * length :].reshape(count, length).mean(axis=1)
    about = means - means.mean()
    power = float(about @ about)
    lag_one = float(about[1:] @ about[:-1]) / power if power > 0.0 else 0.0
    return BatchMeans(
        mean=float(values.mean()),
        se=float(np.sqrt(power / (count - 1) / count)),
        dof=count - 1,
        means=means,
        lag_one=lag_one,
    )


def running_mean(x: np.ndarray) -> np.ndarray:
    """Mean of all samples up to each one.

    Parameters
    ----------
    x : ndarray, shape (n,) or (n, m)
        Channels, from the end of the transient.

    Returns
    -------
    ndarray, same shape
        Its last row is the mean.
    """
    values = np.asarray(x, dtype=float)
    counts = np.arange(1, values.shape[0] + 1, dtype=float)
    return np.cumsum(values, axis=0) / (counts if values.ndim == 1 else counts[:, None])
