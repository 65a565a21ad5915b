"""What the end of an iteration says of its last value."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.verify import iterative_limits, iterative_uncertainty

N = np.arange(200)


def test_oscillation_has_half_the_distance_of_its_limits():
    found = iterative_uncertainty(2.0 + 0.1 * np.sin(0.7 * N))
    assert found.behaviour == "oscillatory"
    assert found.value == pytest.approx(2.0, abs=2e-3)
    assert found.uncertainty == pytest.approx(0.1, rel=0.02)


@pytest.mark.parametrize("rate", [10.0, 40.0, 100.0])
def test_steady_approach_has_the_distance_to_its_limit(rate):
    history = 1.0 + np.exp(-N / rate)
    found = iterative_uncertainty(history)
    assert found.behaviour == "convergent"
    assert found.value == history[-1]
    assert found.uncertainty == pytest.approx(history[-1] - 1.0, rel=1e-6)


def test_moving_level_adds_to_the_limits():
    found = iterative_uncertainty(1.0 + np.exp(-N / 40.0) + 0.01 * np.sin(0.7 * N))
    assert found.behaviour == "mixed"
    assert found.uncertainty > 0.01


def test_drift_has_no_uncertainty():
    found = iterative_uncertainty(0.01 * N)
    assert found.behaviour == "drifting"
    assert math.isnan(found.uncertainty)
    assert "not converged" in found.note


def test_few_oscillations_take_the_range():
    found = iterative_uncertainty(np.cos(np.pi * N / 99.0), share=1.0)
    assert found.behaviour == "mixed"
    assert found.uncertainty == pytest.approx(1.0, abs=1e-3)


def test_constant_end():
    found = iterative_uncertainty(np.concatenate([np.linspace(0.0, 1.0, 50), np.ones(60)]))
    assert (found.behaviour, found.uncertainty) == ("constant", 0.0)


def test_printed_limits():
    found = iterative_limits(0.5648, 0.5641)
    assert found.value == pytest.approx(0.56445)
    assert found.uncertainty == pytest.approx(3.5e-4)
    with pytest.raises(TowtankError, match="exceeds the upper"):
        iterative_limits(1.0, 2.0)


@pytest.mark.parametrize(
    ("history", "share", "words"),
    [
        (np.ones(10), 0.5, "5 iterations"),
        (np.array([1.0] * 30 + [math.nan]), 0.5, "iteration 31 has no value"),
        (np.ones(100), 1.5, "share 1.5"),
    ],
)
def test_bad_input_is_named(history, share, words):
    with pytest.raises(TowtankError, match=words):
        iterative_uncertainty(history, share=share)
