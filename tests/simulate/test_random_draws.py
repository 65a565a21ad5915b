"""Random numbers: each draw has its own, mirrored draws, strata, the distribution."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.special import ndtr
from scipy.stats import kstest

from towtank.core.errors import SimulationError
from towtank.simulate.random_draws import standard_normals, uniform_shares


@pytest.mark.parametrize("columns", [1, 3, 4, 31])
def test_a_draw_does_not_depend_on_how_many_others_there_are(columns):
    many = uniform_shares(50, columns, seed=7)
    np.testing.assert_array_equal(uniform_shares(20, columns, seed=7), many[:20])
    np.testing.assert_array_equal(uniform_shares(13, columns, seed=7, first=29), many[29:42])


def test_draws_share_no_numbers():
    assert len(np.unique(uniform_shares(500, 7, seed=1))) == 3500


def test_another_seed_gives_other_numbers():
    assert not np.any(standard_normals(10, 5, seed=1) == standard_normals(10, 5, seed=2))


@pytest.mark.parametrize("sampling", ["random", "antithetic", "latin hypercube"])
def test_numbers_are_standard_normal(sampling):
    numbers = standard_normals(4000, 3, seed=5, sampling=sampling)
    assert numbers.shape == (4000, 3)
    for column in numbers.T:
        assert kstest(column, "norm").pvalue > 1e-3
    assert np.abs(np.corrcoef(numbers.T) - np.eye(3)).max() < 0.05


def test_antithetic_draws_come_in_mirrored_pairs():
    numbers = standard_normals(7, 4, seed=3, sampling="antithetic")
    np.testing.assert_array_equal(numbers[0:6:2], -numbers[1:6:2])
    np.testing.assert_array_equal(numbers[0::2], standard_normals(4, 4, seed=3))


def test_latin_hypercube_has_one_draw_in_each_stratum():
    shares = ndtr(standard_normals(100, 6, seed=3, sampling="latin hypercube"))
    for column in shares.T:
        np.testing.assert_array_equal(np.sort(np.floor(100 * column)), np.arange(100))
    assert np.abs(np.corrcoef(shares.T) - np.eye(6)).max() < 0.4


def test_unknown_sampling_is_an_error_with_the_known_ones():
    with pytest.raises(SimulationError, match=r"'sobol' is not known.*antithetic"):
        standard_normals(10, 2, sampling="sobol")
