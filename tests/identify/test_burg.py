"""Burg's recursion: the compiled twin gives what the plain one gives."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from towtank.identify.burg import reflections_of
from towtank.identify.burg_compiled import compiled_recursion


def plain(row, max_order):
    reflections, innovation = reflections_of(row, max_order)
    coefficients = np.ones(1)
    for reflection in reflections:
        longer = np.append(coefficients, 0.0)
        coefficients = longer + reflection * longer[::-1]
    return coefficients, innovation


@pytest.mark.parametrize("poles", [[1.0], [1.0, -0.5], [1.0, -0.95], [1.0, -1.6, 0.9], [1.0, 0.2, 0.1, -0.4]])
@pytest.mark.parametrize("size", [11, 64, 511])
def test_compiled_and_plain_recursion_agree(poles, size):
    row = lfilter([1.0], poles, np.random.default_rng(size).standard_normal(size))
    row -= row.mean()
    coefficients, innovation = compiled_recursion(row, 12)
    expected, power = plain(row, 12)
    np.testing.assert_allclose(coefficients, expected, atol=1e-12)
    assert innovation == pytest.approx(power, rel=1e-12)


def test_a_constant_series_has_no_innovation():
    coefficients, innovation = compiled_recursion(np.zeros(50), 8)
    assert coefficients.tolist() == [1.0]
    assert innovation == 0.0
