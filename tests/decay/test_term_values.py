"""Packed coefficients and times."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.decay.term_values import rising_times, term_values


def test_terms_are_packed_in_order():
    assert term_values({"c1": 4.0, "b2": 0.1}).tolist() == [0.0, 0.1, 0.0, 4.0, 0.0, 0.0]
    with pytest.raises(FitError, match="no term 'd1'"):
        term_values({"d1": 1.0})


def test_times_rise():
    assert rising_times(np.arange(6)[::2]).flags.c_contiguous
    for wrong in ([0.0], [0.0, 0.0], [1.0, 0.0], [0.0, np.nan], [[0.0, 1.0]]):
        with pytest.raises(FitError, match="do not rise"):
            rising_times(np.array(wrong))
