"""Propagation of rounding: exact for linear results, zero for exact inputs, never below what happens."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.reproduce.rounding import rounding_spread, spread_of

numbers = st.lists(st.floats(-10.0, 10.0), min_size=3, max_size=3)


@given(numbers, numbers)
def test_linear_results_move_by_the_sum_of_the_sizes(weights, values):
    spread = rounding_spread(lambda x: np.dot(weights, x), values, 0.005)
    np.testing.assert_allclose(spread, 0.005 * np.abs(weights).sum(), atol=1e-13)


@given(numbers, st.integers(0, 2**32 - 1))
def test_linear_results_never_move_further(values, seed):
    matrix = np.array([[1.0, -2.0, 0.5], [0.3, 0.0, 4.0]])
    spread = rounding_spread(lambda x: matrix @ x, values, [0.5, 0.05, 0.005])
    moved = np.random.default_rng(seed).uniform(-1, 1, 3) * [0.5, 0.05, 0.005]
    assert (np.abs(matrix @ moved) <= spread + 1e-12).all()


def test_exact_numbers_contribute_nothing():
    assert rounding_spread(lambda x: x[0] * x[1], [3.0, 5.0], [0.0, 0.5]) == pytest.approx([1.5])
    assert rounding_spread(lambda x: x[0] * x[1], [3.0, 5.0], 0.0) == pytest.approx([0.0])


def test_larger_of_both_directions_counts():
    # 1/x moves further downwards of x than upwards
    assert rounding_spread(lambda x: 1 / x, [1.0], 0.5) == pytest.approx([1.0])


def test_decimals_give_half_steps():
    # 10 in 3.0 +- 0.05 and 2 +- 0.5
    assert spread_of(lambda a, b: 2 * a - b, (3.0, 1), (2.0, 0)) == pytest.approx(0.6)
