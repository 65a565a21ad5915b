"""Sine and cosine in one: the library's to rounding, at every quadrant and beyond the reach of its own reduction."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.simulate.circular import sine_and_cosine

plain = sine_and_cosine.py_func


@given(st.floats(-2e5, 2e5))
def test_sine_and_cosine_are_those_of_the_library(angle):
    sine, cosine = plain(angle)
    assert sine == pytest.approx(math.sin(angle), abs=3e-16)
    assert cosine == pytest.approx(math.cos(angle), abs=3e-16)


@pytest.mark.parametrize("quarter", range(-8, 9))
def test_quadrants_join(quarter):
    at = quarter * math.pi / 2
    for angle in np.nextafter(at + math.pi / 4, [-math.inf, math.inf]):
        sine, cosine = plain(angle)
        assert sine == pytest.approx(math.sin(angle), abs=3e-16)
        assert cosine == pytest.approx(math.cos(angle), abs=3e-16)


def test_what_is_no_number_stays_none():
    assert all(math.isnan(part) for part in plain(math.nan))
