"""From runs at sampled inputs to mean, spread and shares of variance: polynomial chaos with Monte Carlo beside it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .chaos_basis import term_count
from .input_distribution import UncertainInput, check_inputs
from .monte_carlo import QUANTILES, MonteCarlo, sample_statistics
from .polynomial_chaos import OVERSAMPLING, ChaosExpansion, fit_chaos
from .sampling import strata_hit
from .sobol import chaos_sobol

if TYPE_CHECKING:
    import pandas as pd

HIGHEST_ORDER = 3
"""Order up to which an order is chosen when none is given."""

DRAWS = 100_000
"""Draws of the fitted polynomial for its quantiles and its distribution."""


@dataclass(frozen=True, eq=False)
class Propagation:
    """Uncertainty of outputs from sampled inputs.

    Attributes
    ----------
    inputs : tuple of UncertainInput
    samples : DataFrame, shape (n, inputs)
    values : DataFrame, shape (n, outputs)
    expansion : ChaosExpansion
    plain : tuple of MonteCarlo
        Statistics of the samples themselves, one an output.
    notes : tuple of str
        How the order was chosen, whether the samples are a Latin hypercube, doubts of the fit.
    seed : int
        Of the draws from the polynomial.
    """

    inputs: tuple[UncertainInput, ...]
    samples: pd.DataFrame
    values: pd.DataFrame
    expansion: ChaosExpansion
    plain: tuple[MonteCarlo, ...]
    notes: tuple[str, ...] = ()
    seed: int = 0

    @cached_property
    def draws(self) -> np.ndarray:
        """Outputs of the polynomial for random inputs, shape (draws, outputs)."""
        return self.expansion.sample(DRAWS, seed=self.seed)

    @cached_property
    def sobol(self) -> pd.DataFrame:
        """Sobol indices: output, input, first, total, interaction."""
        return chaos_sobol(self.expansion)

    def statistics(self) -> pd.DataFrame:
        """Two rows an output, one a method: mean, mean_error, sd, sample_sd, p05, p50, p95, r2, leave_one_out.

        ``sd`` of Monte Carlo divides by n, ``sample_sd`` by n - 1; ``mean_error`` is the standard error of the mean,
        of polynomial chaos that of its first coefficient.
        """
        import pandas as pd

        fit, rows = self.expansion, []
        quantiles = np.quantile(self.draws, QUANTILES, axis=0)
        for j, (name, plain) in enumerate(zip(fit.outputs, self.plain, strict=True)):
            rows.append(
                {
                    "output": name,
                    "method": "polynomial chaos",
                    "samples": fit.samples,
                    "mean": float(fit.mean[j]),
                    "mean_error": float(fit.coefficient_sd[0, j]),
                    "sd": float(fit.sd[j]),
                    "sample_sd": np.nan,
                    "p05": float(quantiles[0, j]),
                    "p50": float(quantiles[1, j]),
                    "p95": float(quantiles[2, j]),
                    "r2": float(fit.r2[j]),
                    "leave_one_out": float(fit.leave_one_out[j]),
                }
            )
            rows.append(
                {
                    "output": name,
                    "method": "Monte Carlo",
                    "samples": plain.n,
                    "mean": plain.mean,
                    "mean_error": plain.mean_error,
                    "sd": plain.population_sd,
                    "sample_sd": plain.sample_sd,
                    "p05": plain.p05,
                    "p50": plain.p50,
                    "p95": plain.p95,
                    "r2": np.nan,
                    "leave_one_out": np.nan,
                }
            )
        return pd.DataFrame(rows)


def propagate_samples(
    inputs: Sequence[UncertainInput],
    samples: pd.DataFrame,
    values: pd.DataFrame,
    *,
    order: int | None = None,
    seed: int = 0,
) -> Propagation:
    """Uncertainty of outputs that were computed at sampled inputs.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    samples : DataFrame
        A column for each input, one row a run.
    values : DataFrame
        A column for each output, one row a run.
    order : int, optional
        Total order of the polynomials; when not given, the highest up to :data:`HIGHEST_ORDER` that leaves twice as
        many runs as coefficients, and 1 at least.
    seed : int
        Of the draws from the fitted polynomial.

    Returns
    -------
    Propagation

    Raises
    ------
    FitError
        When there are too few runs for the order, a value is no number, or the runs do not separate the coefficients.
    TowtankError
        When a sample cannot come from its distribution, or an input is given twice.
    """
    chosen = tuple(inputs)
    check_inputs(chosen)
    if not len(values.columns):
        raise FitError("there is no output", cure="give the outputs in columns beside the inputs")
    notes = []
    if order is None:
        order = _affordable(len(chosen), len(values))
        notes.append(
            f"order {order} was chosen: {len(values)} runs for {term_count(len(chosen), order)} coefficients"
        )
    fit = fit_chaos(chosen, samples, values, order)
    at = samples[[one.name for one in chosen]]
    hit = strata_hit(chosen, at.to_numpy(dtype=float))
    if (hit == len(at)).all():
        notes.append("the samples are a Latin hypercube: one in each slice of equal probability of every input")
    return Propagation(
        inputs=chosen,
        samples=at.reset_index(drop=True),
        values=values.reset_index(drop=True),
        expansion=fit,
        plain=tuple(sample_statistics(values[name].to_numpy(dtype=float)) for name in values.columns),
        notes=(*notes, *fit.notes),
        seed=seed,
    )


def _affordable(inputs: int, runs: int) -> int:
    orders = [p for p in range(1, HIGHEST_ORDER + 1) if OVERSAMPLING * term_count(inputs, p) <= runs]
    return max(orders, default=1)
