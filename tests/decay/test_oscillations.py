"""Oscillations of a record: where they part, their harmonics, and what they can determine."""

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.oscillations import split_oscillations

TIME = np.arange(0.0, 30.0, 0.05)


def test_oscillations_of_a_sine():
    found = split_oscillations(TIME, 0.1 * np.sin(TIME - 0.3))
    assert len(found) == 3 + 1 - (found[0].rows.start > 200)
    for item in found:
        assert item.period == pytest.approx(2.0 * math.pi, rel=1e-3)
        assert item.amplitude == pytest.approx(0.1, rel=1e-3)
        assert item.harmonics[0] == pytest.approx(0.1, rel=1e-2)
        assert item.determines() == 3


def test_a_level_of_ones_own():
    x = 0.1 * np.sin(TIME) + 0.05
    at_mean, at_zero = (split_oscillations(TIME, x, level=level) for level in (0.05, 0.0))
    assert TIME[at_mean[0].rows.start] == pytest.approx(2.0 * math.pi, abs=0.05)
    assert TIME[at_zero[0].rows.start] == pytest.approx(2.0 * math.pi - math.asin(0.5), abs=0.05)


def test_harmonics_count_when_they_stand_out():
    x = 0.1 * (np.sin(TIME) + 0.05 * np.sin(2.0 * TIME) + 0.03 * np.sin(3.0 * TIME))
    (item, *_) = split_oscillations(TIME, x)
    assert item.harmonics[:3] == pytest.approx([0.1, 0.005, 0.003], rel=0.05)
    assert item.determines() == 7
    # Three standard errors of a harmonic with 126 samples are above the second and the third.
    assert item.determines(noise=0.02) == 3


def test_small_oscillations_can_be_left_out():
    x = 0.1 * np.exp(-0.1 * TIME) * np.sin(TIME)
    everything = split_oscillations(TIME, x, level=0.0)
    large = split_oscillations(TIME, x, level=0.0, least_amplitude=0.03)
    assert len(large) < len(everything)
    assert min(item.amplitude for item in large) >= 0.03


def test_records_without_oscillations_are_refused():
    with pytest.raises(FitError, match="no whole oscillation"):
        split_oscillations(TIME, TIME)
    with pytest.raises(FitError, match="samples, of which no shape"):
        split_oscillations(TIME[::15], np.sin(TIME[::15]))
