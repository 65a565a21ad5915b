"""Runs to mean, spread and shares of variance."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import FitError
from towtank.verify.input_distribution import UncertainInput
from towtank.verify.propagation import propagate_samples
from towtank.verify.sampling import latin_hypercube

INPUTS = (UncertainInput("speed", "normal", (1.2, 0.05)), UncertainInput("depth", "uniform", (0.3, 0.4)))


def runs(count: int):
    samples = latin_hypercube(INPUTS, count, seed=2)
    force = 3.0 * samples["speed"] ** 2 / samples["depth"]
    return samples, pd.DataFrame({"force": force, "sinkage": 0.1 * samples["speed"]})


@pytest.mark.parametrize(("count", "order"), [(4, 1), (6, 1), (12, 2), (20, 3), (200, 3)])
def test_the_runs_decide_the_order(count, order):
    result = propagate_samples(INPUTS, *runs(count))
    assert result.expansion.basis.order == order
    assert f"order {order} was chosen: {count} runs" in result.notes[0]
    assert "Latin hypercube" in result.notes[1]


def test_both_methods_stand_in_one_table():
    result = propagate_samples(INPUTS, *runs(40), order=2)
    table = result.statistics().set_index(["output", "method"])
    assert len(table) == 4
    chaos, plain = table.loc[("force", "polynomial chaos")], table.loc[("force", "Monte Carlo")]
    assert chaos["mean"] == pytest.approx(plain["mean"], rel=5e-3)
    assert chaos["sd"] == pytest.approx(plain["sd"], rel=0.1)
    assert chaos["p05"] < chaos["p50"] < chaos["p95"]
    assert plain["sd"] == pytest.approx(plain["sample_sd"] * np.sqrt(39 / 40))
    shares = result.sobol.set_index(["output", "input"])
    assert shares.loc[("sinkage", "speed"), "first"] == pytest.approx(1.0)


def test_no_output_is_an_error():
    samples, values = runs(6)
    with pytest.raises(FitError, match="no output"):
        propagate_samples(INPUTS, samples, values[[]])
