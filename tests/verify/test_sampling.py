"""Latin hypercubes and random samples."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.sampling import latin_hypercube, random_samples, strata_hit

INPUTS = (UncertainInput("speed", "normal", (1.2, 0.05)), UncertainInput("depth", "uniform", (0.3, 0.4)))


@pytest.mark.parametrize("count", [1, 6, 40])
def test_a_latin_hypercube_hits_every_slice_once(count):
    samples = latin_hypercube(INPUTS, count, seed=3)
    assert list(samples.columns) == ["speed", "depth"]
    assert strata_hit(INPUTS, samples.to_numpy()).tolist() == [count, count]


def test_the_seed_decides():
    first, again, other = (latin_hypercube(INPUTS, 8, seed=seed).to_numpy() for seed in (1, 1, 2))
    np.testing.assert_array_equal(first, again)
    assert not np.allclose(first, other)


def test_random_samples_miss_slices():
    samples = random_samples(INPUTS, 60, seed=0)
    assert (strata_hit(INPUTS, samples.to_numpy()) < 55).all()
    assert samples["depth"].between(0.3, 0.4).all()


@pytest.mark.parametrize("draw", [latin_hypercube, random_samples])
def test_no_sample_is_an_error(draw):
    with pytest.raises(FitError, match="0 samples"):
        draw(INPUTS, 0)
