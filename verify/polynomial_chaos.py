"""Non-intrusive polynomial chaos: mean, standard deviation and shares of variance of what a solver returns.

A response is written as a sum of polynomials of the uncertain inputs that are orthogonal under their distribution,
``Y = sum c_i Phi_i(xi)``. The mean is the first coefficient and the variance ``sum c_i^2 <Phi_i^2>`` over the others.
Two ways to the coefficients, both from finished runs of the solver:

* **projection** (:func:`project_chaos`): runs at the nodes of a Gauss rule, ``c_i = <Y Phi_i> / <Phi_i^2>``;
* **regression** (:func:`fit_chaos`): runs anywhere, best a Latin hypercube with twice as many runs as coefficients,
  least squares by QR.

The inputs must be independent; where their samples are correlated the notes of the result say so.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..core.errors import FitError
from .chaos_basis import ChaosBasis, term_count
from .chaos_quadrature import Grid, quadrature
from .input_distribution import UncertainInput

if TYPE_CHECKING:
    import pandas as pd
    from numpy.typing import ArrayLike

OVERSAMPLING = 2.0
"""Samples for each coefficient that Hosder, Walters and Balch (2007) recommend for regression."""

LARGEST_CONDITION = 1e8
"""Condition number of the scaled regression matrix from which the samples do not separate the coefficients."""

CORRELATED = 0.3
"""Correlation between the samples of two inputs from which the notes warn."""


@dataclass(frozen=True, eq=False)
class ChaosExpansion:
    """A response as a sum of orthogonal polynomials of its uncertain inputs.

    Attributes
    ----------
    basis : ChaosBasis
    outputs : tuple of str
    coefficients : ndarray, shape (terms, outputs)
        Of the polynomials in their classical scaling (:mod:`towtank.verify.input_distribution`).
    coefficient_sd : ndarray, shape (terms, outputs)
        Standard errors of the regression; NaN for a projection and for as many samples as terms.
    method : {"regression", "projection"}
    samples : int
    condition : float
        Condition number of the regression matrix with normalised polynomials; NaN for a projection.
    r2, leave_one_out : ndarray, shape (outputs,)
        Coefficient of determination, and the mean square error of leaving out each sample over the variance of the
        samples: 0 is perfect, 1 no better than the mean. NaN for a projection.
    notes : tuple of str
    """

    basis: ChaosBasis
    outputs: tuple[str, ...]
    coefficients: np.ndarray
    coefficient_sd: np.ndarray
    method: Literal["regression", "projection"]
    samples: int
    condition: float
    r2: np.ndarray
    leave_one_out: np.ndarray
    notes: tuple[str, ...] = ()

    @property
    def oversampling(self) -> float:
        """Samples for each coefficient."""
        return self.samples / len(self.basis.orders)

    @property
    def mean(self) -> np.ndarray:
        """Expected value of each output."""
        return np.array(self.coefficients[0])

    @property
    def parts(self) -> np.ndarray:
        """Variance that each term adds, shape (terms, outputs); 0 for the constant."""
        parts = self.coefficients**2 * self.basis.norms[:, None]
        parts[0] = 0.0
        return parts

    @property
    def variance(self) -> np.ndarray:
        """Variance of each output; 0 where it is no more than rounding of the mean."""
        total = self.parts.sum(axis=0)
        return np.where(total > (1e-13 * self.mean) ** 2, total, 0.0)

    @property
    def sd(self) -> np.ndarray:
        """Standard deviation of each output."""
        return np.sqrt(self.variance)

    def predict(self, samples: ArrayLike) -> np.ndarray:
        """Outputs at values of the inputs: shape (n, inputs) to (n, outputs)."""
        return np.asarray(self.basis.values(self.basis.germs(samples)) @ self.coefficients)

    def sample(self, count: int = 100_000, *, seed: int = 0) -> np.ndarray:
        """Outputs for random inputs, shape (count, outputs): for distributions and quantiles."""
        from .sampling import random_samples

        return self.predict(random_samples(self.basis.inputs, count, seed=seed).to_numpy())

    def coefficient_frame(self) -> pd.DataFrame:
        """One row a coefficient: output, term, orders of each input, coefficient, sd, norm, share of the variance."""
        import pandas as pd

        frames = []
        parts, variance = self.parts, self.variance
        for j, name in enumerate(self.outputs):
            share = parts[:, j] / variance[j] if variance[j] > 0.0 else np.full(len(parts), np.nan)
            frame = pd.DataFrame({"output": name, "term": self.basis.labels()})
            for i, own in enumerate(self.basis.names):
                frame[f"order of {own}"] = self.basis.orders[:, i]
            frame["coefficient"] = self.coefficients[:, j]
            frame["coefficient_sd"] = self.coefficient_sd[:, j]
            frame["norm"] = self.basis.norms
            frame["share"] = share
            frames.append(frame)
        return pd.concat(frames, ignore_index=True)


def fit_chaos(
    inputs: Sequence[UncertainInput],
    samples: ArrayLike | pd.DataFrame,
    values: ArrayLike | pd.DataFrame,
    order: int,
) -> ChaosExpansion:
    """Polynomial chaos by regression on samples.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    samples : array_like, shape (n, inputs), or DataFrame with a column for each input
        Values of the inputs, in their units.
    values : array_like, shape (n,) or (n, outputs), or DataFrame
        What the solver returned; the columns of a frame name the outputs.
    order : int
        Total order of the polynomials.

    Returns
    -------
    ChaosExpansion

    Raises
    ------
    FitError
        When there are fewer samples than coefficients, a value is no number, or the samples cannot separate the
        coefficients.
    """
    basis = ChaosBasis(tuple(inputs), order)
    at = _in_order(basis, samples)
    names, y = _outputs(values)
    if len(at) != len(y):
        raise FitError(f"{len(at)} samples of the inputs but {len(y)} of the outputs", cure="give one row a run")
    count, terms = len(y), term_count(len(basis.inputs), order)
    if count < terms:
        raise FitError(
            f"{count} samples are too few for order {order} in {len(basis.inputs)} input(s): {terms} coefficients",
            cure=f"lower the order, or run {int(OVERSAMPLING * terms)} samples",
        )
    matrix = basis.values(basis.germs(at)) / np.sqrt(basis.norms)
    left, singular, right = np.linalg.svd(matrix, full_matrices=False)
    condition = float(singular[0] / singular[-1]) if singular[-1] > 0.0 else float("inf")
    if condition > LARGEST_CONDITION:
        raise FitError(
            f"the samples do not separate the {terms} coefficients (condition number {condition:.1e})",
            cure="lower the order, or sample every input over its whole range",
        )
    scaled = right.T @ ((left.T @ y) / singular[:, None])
    residual = y - matrix @ scaled
    leverage = np.sum(left**2, axis=1)
    free = count - terms
    spread = np.full(scaled.shape, np.nan)
    if free:
        error = np.sqrt(np.sum(residual**2, axis=0) / free)
        spread = np.sqrt(np.sum((right.T / singular) ** 2, axis=1))[:, None] * error
    r2, loo = _quality(y, residual, leverage)
    root = np.sqrt(basis.norms)[:, None]
    return ChaosExpansion(
        basis=basis,
        outputs=names,
        coefficients=scaled / root,
        coefficient_sd=spread / root,
        method="regression",
        samples=count,
        condition=condition,
        r2=r2,
        leave_one_out=loo,
        notes=tuple(_doubts(basis, at, count, terms)),
    )


def project_chaos(
    inputs: Sequence[UncertainInput],
    order: int,
    response: Callable[[np.ndarray], Any] | ArrayLike | pd.DataFrame,
    *,
    level: int | None = None,
    grid: Grid = "tensor",
) -> ChaosExpansion:
    """Polynomial chaos by projection with a Gauss rule.

    Parameters
    ----------
    inputs : sequence of UncertainInput
    order : int
        Total order of the polynomials.
    response : callable, or array_like, shape (n,) or (n, outputs), or DataFrame
        Takes the inputs of all nodes, shape (n, inputs), and returns the outputs; or the outputs themselves at the
        nodes of ``quadrature(inputs, level, grid)``, in that order.
    level : int, optional
        Of the rule, :func:`towtank.verify.chaos_quadrature.quadrature`; order + 1 when not given, which is exact
        when the response is a polynomial of that order.
    grid : {"tensor", "sparse"}

    Returns
    -------
    ChaosExpansion

    Raises
    ------
    FitError
        When the number of values is not that of the nodes, or a value is no number.
    """
    basis = ChaosBasis(tuple(inputs), order)
    wanted = order + 1 if level is None else level
    nodes, weights = quadrature(basis.inputs, wanted, grid)
    names, y = _outputs(response(nodes) if callable(response) else response)
    if len(y) != len(nodes):
        raise FitError(
            f"{len(y)} values for the {len(nodes)} nodes of the {grid} grid of level {wanted}",
            cure="run the solver at the nodes of quadrature(inputs, level, grid)",
        )
    matrix = basis.values(np.column_stack([one.germ(nodes[:, i]) for i, one in enumerate(basis.inputs)]))
    coefficients = (matrix * weights[:, None]).T @ y / basis.norms[:, None]
    unknown = np.full(len(names), np.nan)
    notes = []
    if wanted <= order:
        notes.append(
            f"level {wanted} cannot resolve order {order}: products of polynomials are not integrated exactly"
        )
    return ChaosExpansion(
        basis=basis,
        outputs=names,
        coefficients=coefficients,
        coefficient_sd=np.full(coefficients.shape, np.nan),
        method="projection",
        samples=len(nodes),
        condition=float("nan"),
        r2=unknown,
        leave_one_out=unknown.copy(),
        notes=tuple(notes),
    )


def _in_order(basis: ChaosBasis, samples: Any) -> np.ndarray:
    """Samples with the inputs in the order of the basis, shape (n, inputs)."""
    if hasattr(samples, "columns"):
        missing = [name for name in basis.names if name not in samples.columns]
        if missing:
            raise FitError(
                f"the samples have no column '{missing[0]}'",
                cure=f"they have {', '.join(map(str, samples.columns))}",
            )
        return np.asarray(samples[list(basis.names)].to_numpy(dtype=float))
    x = np.asarray(samples, dtype=float)
    return x[:, None] if x.ndim == 1 and len(basis.inputs) == 1 else np.atleast_2d(x)


def _outputs(values: Any) -> tuple[tuple[str, ...], np.ndarray]:
    """Names and values of the outputs, shape (n, outputs); refuses what is no number."""
    y = np.asarray(values, dtype=float)
    y = y[:, None] if y.ndim == 1 else y
    if y.ndim != 2 or not y.size:
        raise FitError(f"outputs of shape {y.shape}", cure="give one row a run and one column an output")
    if hasattr(values, "columns"):
        names = tuple(str(name) for name in values.columns)
    else:
        names = tuple(f"y{j + 1}" if y.shape[1] > 1 else "y" for j in range(y.shape[1]))
    bad = np.argwhere(~np.isfinite(y))
    if len(bad):
        row, column = bad[0].tolist()
        raise FitError(
            f"{names[column]} of sample {row + 1} is no number",
            cure="drop the run that failed from inputs and outputs, or run it again",
        )
    return names, y


def _quality(y: np.ndarray, residual: np.ndarray, leverage: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """R squared and relative leave-one-out error of each output; NaN where the samples do not vary."""
    count, unknown = len(y), np.full(y.shape[1], np.nan)
    total = np.sum((y - y.mean(axis=0)) ** 2, axis=0)
    varies = total > 1e-24 * np.sum(y**2, axis=0)
    safe = np.where(varies, total, 1.0)
    r2 = np.where(varies, 1.0 - np.sum(residual**2, axis=0) / safe, unknown)
    open_rows = 1.0 - leverage
    if np.any(open_rows < 1e-9):
        # a sample that the fit follows exactly cannot be left out
        return r2, unknown
    left_out = np.sum((residual / open_rows[:, None]) ** 2, axis=0)
    return r2, np.where(varies & (count > 1), left_out / safe, unknown)


def _doubts(basis: ChaosBasis, samples: np.ndarray, count: int, terms: int) -> list[str]:
    notes = []
    if count == terms:
        notes.append(
            f"{count} samples for {terms} coefficients: the fit passes through all, nothing tells its error"
        )
    elif count < OVERSAMPLING * terms:
        notes.append(f"{count / terms:.2g} samples a coefficient; {OVERSAMPLING:g} are recommended")
    if len(basis.inputs) > 1 and count > 2:
        correlation = np.corrcoef(samples, rowvar=False)
        for i, first in enumerate(basis.names):
            for j in range(i):
                if abs(correlation[i, j]) > CORRELATED:
                    notes.append(
                        f"samples of {basis.names[j]} and {first} are correlated ({correlation[i, j]:+.2f}): "
                        "their coefficients are not fully separated"
                    )
    return notes
