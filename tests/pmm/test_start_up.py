"""Transients of a virtual laboratory against numerical differentiation and integration."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.pmm.laboratory import Laboratory
from towtank.pmm.planar_motion import Oscillation
from towtank.pmm.start_up import GrowingOscillation, carriage_profile

OMEGA = 1.3


@pytest.mark.parametrize("order", [1, 2, 3])
def test_rates_of_a_growing_oscillation_are_derivatives(order):
    wave = GrowingOscillation(0.2, (0.1, 0.03), (-0.4, 0.05), rise=6.0)
    t = np.linspace(0.05, 9.0, 400)
    h = 1e-4
    lower = wave.derivative(t - h, OMEGA, order - 1)
    upper = wave.derivative(t + h, OMEGA, order - 1)
    assert wave.derivative(t, OMEGA, order) == pytest.approx((upper - lower) / (2 * h), abs=2e-6)


def test_an_oscillation_grows_from_rest_to_its_full_amplitude():
    wave = GrowingOscillation(0.2, (0.1,), (-0.4,), rise=6.0)
    full = Oscillation(0.2, (0.1,), (-0.4,))
    begin, later = np.zeros(1), np.linspace(6.0, 20.0, 50)
    for order in range(4):
        assert wave.derivative(begin, OMEGA, order)[0] == pytest.approx(0.2 if order == 0 else 0.0, abs=1e-12)
        expected = full.derivative(later, OMEGA, order)
        assert wave.derivative(later, OMEGA, order) == pytest.approx(expected, abs=1e-12)


def test_carriage_speed_is_the_integral_of_its_rate_and_travel_that_of_its_speed():
    laboratory = Laboratory(rest=2.0, ramp=5.0, duration=20.0)
    t = np.linspace(0.0, 34.0, 3401)
    share, rate, travelled = carriage_profile(t, laboratory)
    step = t[1] - t[0]

    def integral(values):
        return np.concatenate([[0.0], np.cumsum((values[1:] + values[:-1]) / 2) * step])

    assert np.abs(share - integral(rate)).max() < 1e-5
    assert np.abs(travelled - integral(share)).max() < 1e-5


def test_carriage_rests_runs_and_rests():
    laboratory = Laboratory(rest=2.0, ramp=5.0, duration=20.0)
    share, rate, travelled = carriage_profile(np.array([0.0, 2.0, 7.0, 17.0, 27.0, 32.0, 34.0]), laboratory)
    assert share == pytest.approx([0, 0, 1, 1, 1, 0, 0], abs=1e-12)
    assert rate == pytest.approx(np.zeros(7), abs=1e-12)
    assert travelled[-1] == pytest.approx(20.0 + 5.0, abs=1e-12)


def test_without_a_ramp_the_speed_is_constant():
    share, rate, travelled = carriage_profile(np.array([0.0, 3.0]), Laboratory())
    assert (share.tolist(), rate.tolist(), travelled.tolist()) == ([1, 1], [0, 0], [0, 3])
