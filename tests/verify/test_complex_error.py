"""Errors of phasors."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.verify.complex_error import complex_error, phase_difference, phasor

angles = st.floats(-10.0, 10.0)


def test_right_amplitude_in_antiphase_is_worse_than_no_motion():
    measured = phasor([1.0, 2.0], [0.3, -0.4])
    assert complex_error(-measured, measured) == pytest.approx(2.0)
    assert complex_error(np.zeros(2), measured) == pytest.approx(1.0)
    assert complex_error(measured, measured) == 0.0


def test_an_equal_amplitude_can_hide_a_large_error():
    simulation, data = phasor(0.342, math.radians(166)), phasor(0.342, math.radians(133))
    assert abs(simulation) - abs(data) == pytest.approx(0.0)
    assert complex_error(simulation, data) == pytest.approx(2 * math.sin(math.radians(16.5)))


@given(angles, angles)
def test_a_common_phase_does_not_matter(turn, phase):
    s, d = phasor([0.5, 1.0], [phase, 0.2]), phasor([0.6, 0.9], [0.1, 0.4])
    assert complex_error(s * np.exp(1j * turn), d * np.exp(1j * turn)) == pytest.approx(complex_error(s, d))


def test_phases_wrap():
    assert np.degrees(phase_difference(phasor(1, math.radians(355)), phasor(1, math.radians(2)))) == pytest.approx(
        -7
    )


def test_withheld_motions_are_left_out():
    assert complex_error([1.1, np.nan], [1.0, 2.0]) == pytest.approx(0.1)
    assert math.isnan(complex_error([1.0], [np.nan]))
    assert math.isnan(complex_error([1.0], [0.0]))


def test_negative_amplitude_and_unpaired_phasors_are_named():
    with pytest.raises(TowtankError, match=r"amplitude -18\.6 is negative"):
        phasor(-18.6, 0.0)
    with pytest.raises(TowtankError, match="cannot be paired"):
        complex_error([1.0, 2.0], [1.0])
