"""Dominant frequency of a decay, and its derivatives."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.dominant_frequency import derivatives, dominant_frequency

TIME = np.arange(0.0, 100.0, 0.1)


def test_dominant_frequency_in_spite_of_drift_and_rest():
    decay = np.where(TIME > 20.0, 0.3 * np.exp(-0.02 * (TIME - 20.0)) * np.sin(0.6 * (TIME - 20.0)), 0.0)
    assert dominant_frequency(TIME, decay + 0.005 * TIME) == pytest.approx(0.6 / (2.0 * np.pi), rel=0.02)


def test_derivatives_of_a_sine():
    rate, acceleration = derivatives(TIME, np.sin(0.6 * TIME))
    np.testing.assert_allclose(rate, 0.6 * np.cos(0.6 * TIME), atol=1e-7)
    np.testing.assert_allclose(acceleration, -0.36 * np.sin(0.6 * TIME), atol=1e-6)


def test_a_record_that_does_not_move_is_an_error():
    with pytest.raises(FitError, match="does not move"):
        dominant_frequency(TIME, np.ones(TIME.size))
