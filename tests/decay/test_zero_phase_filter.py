import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.zero_phase_filter import derivatives, dominant_frequency, is_uniform, low_pass

TIME = np.arange(0.0, 100.0, 0.1)


def test_dominant_frequency_in_spite_of_drift_and_rest():
    decay = np.where(TIME > 20.0, 0.3 * np.exp(-0.02 * (TIME - 20.0)) * np.sin(0.6 * (TIME - 20.0)), 0.0)
    assert dominant_frequency(TIME, decay + 0.005 * TIME) == pytest.approx(0.6 / (2.0 * np.pi), rel=0.02)


def test_low_pass_keeps_the_slow_and_stops_the_fast():
    slow, fast = np.sin(0.6 * TIME), np.sin(12.0 * TIME)
    passed = low_pass(slow + fast, 0.1, 0.5)
    np.testing.assert_allclose(passed[50:-50], slow[50:-50], atol=1e-3)
    columns = low_pass(np.column_stack([slow, fast]), 0.1, 0.5)
    np.testing.assert_allclose(columns[50:-50, 1], 0.0, atol=1e-3)


def test_a_cutoff_beyond_the_samples_changes_nothing():
    np.testing.assert_array_equal(low_pass(np.sin(TIME), 0.1, 10.0), np.sin(TIME))


def test_derivatives_of_a_sine():
    rate, acceleration = derivatives(TIME, np.sin(0.6 * TIME))
    np.testing.assert_allclose(rate, 0.6 * np.cos(0.6 * TIME), atol=1e-7)
    np.testing.assert_allclose(acceleration, -0.36 * np.sin(0.6 * TIME), atol=1e-6)


def test_uniform():
    assert is_uniform(TIME)
    assert not is_uniform(TIME**1.5)


def test_bad_input_is_named():
    with pytest.raises(FitError, match="cannot be built"):
        low_pass(TIME, 0.1, 0.0)
    with pytest.raises(FitError, match="cannot be built"):
        low_pass(TIME, 0.1, 1.0, order=40)
    with pytest.raises(FitError, match="does not move"):
        dominant_frequency(TIME, np.ones(TIME.size))
