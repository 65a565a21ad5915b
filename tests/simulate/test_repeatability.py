"""Repeated tests."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.index_definitions import index_frame
from towtank.simulate.repeatability import mean_uncertainty, repeatability, repeated_indices


def test_student_factor_of_five_tests():
    found = mean_uncertainty(5, 10.0, 1.0)
    assert found.uncertainty == pytest.approx(2.7764 / 5**0.5, rel=1e-4)
    assert found.relative == pytest.approx(10.0 * found.uncertainty)


def test_values_give_their_own_mean_and_spread():
    values = [9.5, 9.8, 10.1, np.nan, 9.8]
    found = repeatability(values)
    assert (found.tests, found.mean, found.sd) == pytest.approx((4, 9.8, np.std([9.5, 9.8, 10.1, 9.8], ddof=1)))


def test_interval_covers_the_true_mean_as_often_as_it_says():
    draws = np.random.default_rng(8).normal(10.0, 1.0, (400, 4))
    found = [repeatability(row, 0.9) for row in draws]
    covered = np.mean([abs(one.mean - 10.0) <= one.uncertainty for one in found])
    assert covered == pytest.approx(0.9, abs=0.045)


@pytest.mark.parametrize("values", [[], [1.0], [1.0, 2.0], [1.0, np.nan, 2.0]])
def test_two_tests_are_not_enough(values):
    with pytest.raises(TowtankError, match="give no uncertainty -> give at least 3"):
        repeatability(values)


def test_table_over_tests_of_one_manoeuvre():
    tables = [index_frame({"advance": 3.0 + 0.1 * n, "overshoot 1": 5.0}, "turning +35") for n in range(3)]
    tables[0] = tables[0].iloc[:1]
    found = repeated_indices(tables)
    assert found["index"].tolist() == ["advance"]
    assert found.loc[0, "mean"] == pytest.approx(3.1)
    assert found.loc[0, "sd"] == pytest.approx(0.1)
    with pytest.raises(TowtankError, match="no index occurred in three tests"):
        repeated_indices(tables[:2])
