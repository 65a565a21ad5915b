"""Plain statistics of sampled outputs."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.monte_carlo import propagate, sample_statistics

INPUTS = (UncertainInput("a", "uniform", (1.0, 2.0)), UncertainInput("b", "uniform", (0.1, 0.2)))


def test_force_of_the_paper_to_every_printed_digit():
    ours = sample_statistics([-6.8951, -7.0056, -6.8918, -6.8447, -7.1009, -6.8869])
    assert round(ours.mean, 4) == -6.9375
    assert round(ours.population_sd, 4) == 0.0879
    assert round(ours.sample_sd, 4) == 0.0963
    assert ours.mean_error == pytest.approx(ours.sample_sd / math.sqrt(6))


def test_one_sample_has_no_spread():
    ours = sample_statistics([2.0])
    assert (ours.mean, ours.population_sd, ours.p05, ours.p95) == (2.0, 0.0, 2.0, 2.0)
    assert math.isnan(ours.sample_sd)


@pytest.mark.parametrize(("values", "message"), [([], "not samples"), ([1.0, np.inf], "sample 2 is no number")])
def test_what_is_no_sample_is_named(values, message):
    with pytest.raises(FitError, match=message):
        sample_statistics(values)


def test_a_latin_hypercube_is_closer_to_the_mean_than_random_samples():
    errors = {}
    for design in ("latin-hypercube", "random"):
        means = [
            propagate(lambda x: x[:, 0] * np.exp(-2.0 * x[:, 1]), INPUTS, 32, design=design, seed=seed)[1].mean()
            for seed in range(40)
        ]
        errors[design] = np.std(means)
    assert errors["latin-hypercube"] < 0.3 * errors["random"]


def test_responses_of_a_wrong_shape_and_unknown_designs_are_named():
    with pytest.raises(FitError, match=r"shape \(1,\) for 4 samples"):
        propagate(lambda x: np.zeros(1), INPUTS, 4)
    with pytest.raises(FitError, match="unknown design 'grid'"):
        propagate(lambda x: x, INPUTS, 4, design="grid")
