"""Zero-phase low-pass of uniform samples."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.identify.low_pass import is_uniform, low_pass

TIME = np.arange(0.0, 100.0, 0.1)


def test_low_pass_keeps_the_slow_and_stops_the_fast():
    slow, fast = np.sin(0.6 * TIME), np.sin(12.0 * TIME)
    passed = low_pass(slow + fast, 0.1, 0.5)
    np.testing.assert_allclose(passed[50:-50], slow[50:-50], atol=1e-3)
    columns = low_pass(np.column_stack([slow, fast]), 0.1, 0.5)
    np.testing.assert_allclose(columns[50:-50, 1], 0.0, atol=1e-3)


def test_a_cutoff_beyond_the_samples_changes_nothing():
    np.testing.assert_array_equal(low_pass(np.sin(TIME), 0.1, 10.0), np.sin(TIME))


def test_uniform():
    assert is_uniform(TIME)
    assert not is_uniform(TIME**1.5)


def test_bad_input_is_named():
    with pytest.raises(FitError, match="cannot be built"):
        low_pass(TIME, 0.1, 0.0)
    with pytest.raises(FitError, match="cannot be built"):
        low_pass(TIME, 0.1, 1.0, order=40)
