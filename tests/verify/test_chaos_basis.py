"""Orthogonal polynomials of total order."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.verify.chaos_basis import (
    ChaosBasis,
    gauss_rule,
    mean_square,
    polynomial,
    term_count,
    total_orders,
)
from towtank.verify.input_distribution import UncertainInput

INPUTS = [
    UncertainInput("n", "normal", (3.0, 2.0)),
    UncertainInput("u", "uniform", (1.0, 4.0)),
    UncertainInput("g", "gamma", (2.5, 1.5)),
    UncertainInput("h", "gamma", (0.7, 1.5, -2.0)),
    UncertainInput("b", "beta", (2.0, 3.0, -1.0, 4.0)),
    UncertainInput("c", "beta", (0.5, 0.5, 0.0, 1.0)),
]


@pytest.mark.parametrize("one", INPUTS, ids=str)
def test_polynomials_are_orthogonal_with_the_stated_mean_square(one):
    nodes, weights = gauss_rule(one, 12)
    table = np.array([polynomial(one, degree, nodes) for degree in range(7)])
    norms = [mean_square(one, degree) for degree in range(7)]
    np.testing.assert_allclose(
        (table * weights) @ table.T / np.sqrt(np.outer(norms, norms)), np.eye(7), atol=1e-11
    )


def test_mean_squares_of_hermite_and_legendre():
    assert [mean_square(INPUTS[0], n) for n in range(5)] == [math.factorial(n) for n in range(5)]
    assert [mean_square(INPUTS[1], n) for n in range(4)] == pytest.approx([1.0, 1.0 / 3.0, 0.2, 1.0 / 7.0])


@pytest.mark.parametrize("one", INPUTS, ids=str)
def test_the_gauss_rule_has_the_mean_and_variance_of_the_input(one):
    nodes, weights = gauss_rule(one, 3)
    x = one.value(nodes)
    assert weights @ x == pytest.approx(one.mean, rel=1e-12)
    assert weights @ (x - one.mean) ** 2 == pytest.approx(one.sd**2, rel=1e-12)


def test_terms_of_two_inputs_and_order_two_are_those_of_the_paper():
    assert total_orders(2, 2).tolist() == [[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2]]
    basis = ChaosBasis((UncertainInput("x1", "uniform", (-1, 1)), UncertainInput("x2", "uniform", (-1, 1))), 2)
    x = np.array([[0.3, -0.6]])
    np.testing.assert_allclose(
        basis.values(basis.germs(x))[0], [1, 0.3, -0.6, (3 * 0.09 - 1) / 2, -0.18, (3 * 0.36 - 1) / 2]
    )
    assert basis.labels() == ["1", "x1", "x2", "x1^2", "x1*x2", "x2^2"]
    np.testing.assert_allclose(basis.norms, [1, 1 / 3, 1 / 3, 1 / 5, 1 / 9, 1 / 5])


@pytest.mark.parametrize(("inputs", "order", "count"), [(2, 1, 3), (2, 2, 6), (1, 4, 5), (5, 3, 56), (3, 0, 1)])
def test_number_of_terms(inputs, order, count):
    orders = total_orders(inputs, order)
    assert term_count(inputs, order) == count == len(orders) == len({tuple(row) for row in orders.tolist()})
    assert orders.shape[1] == inputs
    assert orders.sum(axis=1).max(initial=0) == order


def test_wrong_orders_and_shapes_are_named():
    with pytest.raises(FitError, match="order -1"):
        ChaosBasis((INPUTS[0],), -1)
    with pytest.raises(FitError, match=r"shape \(2, 3\) for 1 inputs"):
        ChaosBasis((INPUTS[0],), 1).germs(np.zeros((2, 3)))
