"""Products of orthogonal polynomials up to a total order: the basis of a polynomial chaos expansion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from ..core.errors import FitError
from .input_distribution import UncertainInput, check_inputs

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class ChaosBasis:
    """Every product of the inputs' polynomials whose orders sum up to at most `order`.

    Attributes
    ----------
    inputs : tuple of UncertainInput
        Independent of each other.
    order : int
        Total order p.
    """

    inputs: tuple[UncertainInput, ...]
    order: int

    def __post_init__(self) -> None:
        object.__setattr__(self, "inputs", tuple(self.inputs))
        check_inputs(self.inputs)
        if self.order < 0 or int(self.order) != self.order:
            raise FitError(f"the order {self.order} is no whole number from 0", cure="give 1, 2 or 3")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the inputs."""
        return tuple(one.name for one in self.inputs)

    @cached_property
    def orders(self) -> np.ndarray:
        """Order of each input's polynomial in each product, shape (terms, inputs); see :func:`total_orders`."""
        return total_orders(len(self.inputs), self.order)

    @cached_property
    def norms(self) -> np.ndarray:
        """Mean square of each product, shape (terms,)."""
        squares = [[mean_square(one, degree) for degree in range(self.order + 1)] for one in self.inputs]
        return np.array(
            [math.prod(squares[i][degree] for i, degree in enumerate(row)) for row in self.orders.tolist()]
        )

    def labels(self) -> list[str]:
        """Each product in words: ``1``, ``H``, ``H^2`` for the polynomial of order 2, ``H*T``."""
        words = []
        for row in self.orders.tolist():
            parts = [
                name if degree == 1 else f"{name}^{degree}"
                for name, degree in zip(self.names, row, strict=True)
                if degree
            ]
            words.append("*".join(parts) or "1")
        return words

    def germs(self, samples: ArrayLike) -> np.ndarray:
        """Germs of samples of the inputs, both of shape (n, inputs)."""
        x = np.atleast_2d(np.asarray(samples, dtype=float))
        if x.ndim != 2 or x.shape[1] != len(self.inputs):
            raise FitError(
                f"samples of shape {x.shape} for {len(self.inputs)} inputs",
                cure=f"give one column for each of {', '.join(self.names)}",
            )
        return np.column_stack([one.germ(x[:, i]) for i, one in enumerate(self.inputs)])

    def values(self, germs: np.ndarray) -> np.ndarray:
        """Values of the products at germs of shape (n, inputs): the matrix of shape (n, terms)."""
        tables = [
            np.stack([polynomial(one, degree, germs[:, i]) for degree in range(self.order + 1)])
            for i, one in enumerate(self.inputs)
        ]
        matrix = np.ones((len(germs), len(self.orders)))
        for i, table in enumerate(tables):
            matrix *= table[self.orders[:, i]].T
        return matrix


def term_count(inputs: int, order: int) -> int:
    """Number of terms of a total order: ``(p + d)! / (p! d!)``."""
    return math.comb(order + inputs, inputs)


def total_orders(inputs: int, order: int) -> np.ndarray:
    """Orders of all products up to a total order, shape (terms, inputs).

    Sorted by total order, then with the first input highest: 1, x1, x2, x1^2, x1 x2, x2^2.
    """
    rows = []
    for total in range(order + 1):
        # a composition of `total` is where the inputs - 1 bars stand among the units
        for bars in combinations(range(total + inputs - 1), inputs - 1):
            edges = (-1, *bars, total + inputs - 1)
            rows.append([edges[i + 1] - edges[i] - 1 for i in range(inputs)])
    return np.array(sorted(rows, key=lambda row: (sum(row), [-degree for degree in row])), dtype=int)


def polynomial(one: UncertainInput, degree: int, germ: np.ndarray) -> np.ndarray:
    """The orthogonal polynomial of an input, in its classical scaling, at values of the germ."""
    from scipy import special

    if one.family == "normal":
        return np.asarray(special.eval_hermitenorm(degree, germ))
    if one.family == "uniform":
        return np.asarray(special.eval_legendre(degree, germ))
    p = one.parameters
    if one.family == "gamma":
        return np.asarray(special.eval_genlaguerre(degree, p[0] - 1.0, germ))
    return np.asarray(special.eval_jacobi(degree, p[1] - 1.0, p[0] - 1.0, germ))


def mean_square(one: UncertainInput, degree: int) -> float:
    """Mean square of the polynomial under the density of the germ."""
    if one.family == "normal":
        return float(math.factorial(degree))
    if one.family == "uniform":
        return 1.0 / (2 * degree + 1)
    p = one.parameters
    if one.family == "gamma":
        return math.exp(math.lgamma(degree + p[0]) - math.lgamma(p[0]) - math.lgamma(degree + 1))
    alpha, beta = p[1] - 1.0, p[0] - 1.0
    if degree == 0:
        return 1.0
    # h_n / h_0 of the Jacobi weight (1 - x)^alpha (1 + x)^beta, Abramowitz and Stegun 22.2.1
    logarithm = (
        math.lgamma(degree + alpha + 1)
        + math.lgamma(degree + beta + 1)
        - math.lgamma(degree + 1)
        - math.lgamma(degree + alpha + beta + 1)
        - math.lgamma(alpha + 1)
        - math.lgamma(beta + 1)
        + math.lgamma(alpha + beta + 2)
    )
    return math.exp(logarithm) / (2 * degree + alpha + beta + 1)


def gauss_rule(one: UncertainInput, points: int) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the germ and weights of the Gauss rule of an input's distribution; the weights sum up to 1."""
    from scipy import special

    p: Sequence[float] = one.parameters
    if one.family == "normal":
        nodes, weights = special.roots_hermitenorm(points)
    elif one.family == "uniform":
        nodes, weights = special.roots_legendre(points)
    elif one.family == "gamma":
        nodes, weights = special.roots_genlaguerre(points, p[0] - 1.0)
    else:
        nodes, weights = special.roots_jacobi(points, p[1] - 1.0, p[0] - 1.0)
    return np.asarray(nodes), np.asarray(weights) / float(np.sum(weights))
