"""Uncertainty of a simulation from its inputs."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify import fit_chaos, latin_hypercube
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.input_uncertainty import input_uncertainty, shared_inputs


def test_independent_inputs_add_up_as_squares():
    assert input_uncertainty([3.0, 4.0], [0.1, 0.1]) == pytest.approx(2.0 * 0.5)
    assert input_uncertainty([3.0], [0.1], coverage=1.0) == pytest.approx(0.3)


def test_correlated_inputs_may_cancel():
    covariance = np.array([[1.0, 0.9], [0.9, 1.0]])
    assert input_uncertainty([1.0, -1.0], covariance, coverage=1.0) == pytest.approx(np.sqrt(0.2))
    assert input_uncertainty([1.0, 1.0], covariance, coverage=1.0) == pytest.approx(np.sqrt(3.8))


def test_a_straight_response_has_the_uncertainty_of_its_polynomial_chaos():
    inputs = (UncertainInput("speed", "normal", (1.2, 0.02)), UncertainInput("depth", "normal", (0.33, 0.01)))
    samples = latin_hypercube(inputs, 12)
    fit = fit_chaos(inputs, samples, 4.0 * samples["speed"] - 9.0 * samples["depth"], 1)
    assert input_uncertainty([4.0, -9.0], [0.02, 0.01], coverage=1.0) == pytest.approx(fit.sd[0])


def test_a_quantity_that_only_one_side_uses_is_not_shared():
    assert shared_inputs([2.0, 0.0], [0.0, 3.0], [0.1, 0.1]) == 0.0
    assert shared_inputs([2.0, 1.0], [4.0, 0.0], [0.1, 0.1]) == pytest.approx(0.08)


@pytest.mark.parametrize(
    ("g", "covariance", "message"),
    [
        ([1.0, 2.0], [0.1], "covariance of shape"),
        ([1.0, 2.0], [[1.0, 0.5], [0.0, 1.0]], "not symmetric"),
        ([1.0, 2.0], [[1.0, 2.0], [2.0, 1.0]], "negative variance"),
        ([1.0, 2.0], [[1.0, np.nan], [np.nan, 1.0]], "not symmetric"),
    ],
)
def test_what_is_no_covariance_is_named(g, covariance, message):
    with pytest.raises(TowtankError, match=message):
        input_uncertainty(g, covariance)
