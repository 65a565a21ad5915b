"""Full and sparse grids of Gauss rules."""

from itertools import product

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.verify.chaos_quadrature import quadrature
from towtank.verify.input_distribution import UncertainInput

INPUTS = (
    UncertainInput("a", "uniform", (0.0, 2.0)),
    UncertainInput("b", "normal", (1.0, 0.5)),
    UncertainInput("c", "gamma", (2.0, 0.5)),
)
_UNIFORM = [1.0, 1.0, 4.0 / 3.0, 2.0, 16.0 / 5.0, 16.0 / 3.0]
_NORMAL = [1.0, 1.0, 1.25, 1.75, 1 + 6 * 0.25 + 3 * 0.0625, 1 + 10 * 0.25 + 15 * 0.0625]
_GAMMA = [1.0, 1.0, 1.5, 3.0, 7.5, 22.5]
"""Moments of order 0 to 5."""


@pytest.mark.parametrize("grid", ["tensor", "sparse"])
def test_polynomials_up_to_twice_the_level_less_one_are_integrated_exactly(grid):
    nodes, weights = quadrature(INPUTS, 3, grid)
    assert weights.sum() == pytest.approx(1.0, abs=1e-12)
    for i, j, k in product(range(6), repeat=3):
        if i + j + k <= 5:
            mean = weights @ (nodes[:, 0] ** i * nodes[:, 1] ** j * nodes[:, 2] ** k)
            assert mean == pytest.approx(_UNIFORM[i] * _NORMAL[j] * _GAMMA[k], rel=1e-10)


def test_sparse_grids_are_smaller_for_many_inputs_and_merge_their_nodes():
    many = tuple(UncertainInput(f"x{i}", "uniform", (-1.0, 1.0)) for i in range(6))
    full, _ = quadrature(many, 3, "tensor")
    sparse, weights = quadrature(many, 3, "sparse")
    assert len(full) == 729
    assert len(sparse) < 120
    assert len(np.unique(np.round(sparse, 9), axis=0)) == len(sparse)
    assert (weights < 0).any()


def test_one_level_is_the_mean():
    nodes, weights = quadrature(INPUTS, 1, "sparse")
    np.testing.assert_allclose(nodes, [[1.0, 1.0, 1.0]])
    assert weights.tolist() == [1.0]


def test_impossible_rules_are_named():
    with pytest.raises(FitError, match="level 0"):
        quadrature(INPUTS, 0)
    with pytest.raises(FitError, match="unknown grid 'full'"):
        quadrature(INPUTS, 2, "full")
    many = tuple(UncertainInput(f"x{i}", "uniform", (-1.0, 1.0)) for i in range(9))
    with pytest.raises(FitError, match="the rule has 1953125 nodes"):
        quadrature(many, 5)
