"""Shares of the variance of an output that its uncertain inputs are responsible for: Sobol indices.

The first-order index of an input is the share that it causes alone, the total index the share that goes with it in
any combination; their difference is interaction.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import FitError
from .input_distribution import UncertainInput, check_inputs
from .polynomial_chaos import ChaosExpansion

if TYPE_CHECKING:
    import pandas as pd


def chaos_sobol(expansion: ChaosExpansion) -> pd.DataFrame:
    """Sobol indices from the coefficients of a polynomial chaos expansion (Sudret 2008).

    Parameters
    ----------
    expansion : ChaosExpansion

    Returns
    -------
    DataFrame
        One row an output and input: output, input, first, total, interaction; NaN where the output does not vary.
    """
    import pandas as pd

    rows = []
    parts, variance, orders = expansion.parts, expansion.variance, expansion.basis.orders
    for j, output in enumerate(expansion.outputs):
        for i, name in enumerate(expansion.basis.names):
            touched = orders[:, i] > 0
            alone = touched & (np.delete(orders, i, axis=1) == 0).all(axis=1)
            if variance[j] > 0.0:
                first = float(parts[alone, j].sum() / variance[j])
                total = float(parts[touched, j].sum() / variance[j])
            else:
                first = total = float("nan")
            rows.append((output, name, first, total, total - first))
    return pd.DataFrame(rows, columns=["output", "input", "first", "total", "interaction"])


def sampled_sobol(
    function: Callable[[np.ndarray], Any],
    inputs: Sequence[UncertainInput],
    *,
    power: int = 12,
    seed: int = 0,
    level: float = 0.95,
) -> pd.DataFrame:
    """Sobol indices by sampling the response itself, with confidence intervals.

    Parameters
    ----------
    function : callable
        Takes inputs of shape (n, inputs), returns outputs of shape (n,) or (n, outputs).
    inputs : sequence of UncertainInput
    power : int
        The response is evaluated ``(inputs + 2) 2^power`` times.
    seed : int
    level : float
        Of the confidence intervals, from bootstrap.

    Returns
    -------
    DataFrame
        One row an output and input: output, input, first, first_low, first_high, total, total_low, total_high.

    Raises
    ------
    FitError
        When `power` is not between 4 and 20.

    Notes
    -----
    By :func:`scipy.stats.sobol_indices`: first order of Saltelli et al. (2010), total of Jansen (1999), samples
    from a scrambled Sobol' sequence.
    """
    import pandas as pd
    from scipy.stats import sobol_indices

    chosen = tuple(inputs)
    check_inputs(chosen)
    if not 4 <= power <= 20:
        raise FitError(f"power {power} is not between 4 and 20", cure="give 10 to 14")

    def of_columns(x: np.ndarray) -> np.ndarray:
        values = np.asarray(function(x.T), dtype=float)
        return values if values.ndim == 1 else values.T

    distributions: Any = [_Quantiles(one) for one in chosen]
    found: Any = sobol_indices(func=of_columns, n=2**power, dists=distributions, rng=np.random.default_rng(seed))
    spread = found.bootstrap(confidence_level=level)
    table = {
        "first": found.first_order,
        "first_low": spread.first_order.confidence_interval.low,
        "first_high": spread.first_order.confidence_interval.high,
        "total": found.total_order,
        "total_low": spread.total_order.confidence_interval.low,
        "total_high": spread.total_order.confidence_interval.high,
    }
    columns = {key: np.atleast_2d(value) for key, value in table.items()}
    outputs = len(columns["first"])
    rows = []
    for j in range(outputs):
        name = f"y{j + 1}" if outputs > 1 else "y"
        for i, one in enumerate(chosen):
            rows.append((name, one.name, *(float(columns[key][j, i]) for key in table)))
    return pd.DataFrame(rows, columns=["output", "input", *table])


class _Quantiles:
    """The one method of a distribution that :func:`scipy.stats.sobol_indices` asks for."""

    def __init__(self, one: UncertainInput) -> None:
        self.one = one

    def ppf(self, probability: Any) -> np.ndarray:
        return self.one.quantile(probability)
