"""Waves of finite depth and their encounter, against the printed table of the benchmark."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.core.variables import GRAVITY
from towtank.squat.head_waves import met_wave, phase_at, wave_number


@pytest.mark.parametrize(
    ("period", "depth", "knots", "k", "encounter"),
    [
        (13.0, 29.0, 0, 0.03240, 13.00),
        (13.0, 29.0, 6, 0.03240, 10.77),
        (13.0, 29.0, 16, 0.03240, 8.38),
        (15.7, 17.4, 0, 0.03216, 15.70),
        (15.7, 17.4, 6, 0.03216, 12.58),
    ],
)
def test_full_scale_waves(period, depth, knots, k, encounter):
    wave = met_wave(period, depth, knots * 1852 / 3600)
    assert wave.wave_number == pytest.approx(k, rel=5e-3)
    assert wave.period_of_encounter == pytest.approx(encounter, rel=5e-3)


@pytest.mark.parametrize(
    ("period", "depth", "speed", "encounter"),
    [(1.38, 0.326, 0.872, 0.890), (1.38, 0.326, 0.327, 1.144), (1.66, 0.1956, 0.327, 1.330)],
)
def test_encounter_periods_of_the_model(period, depth, speed, encounter):
    assert met_wave(period, depth, speed).period_of_encounter == pytest.approx(encounter, abs=1e-3)


@given(st.floats(1e-3, 1e2), st.floats(1e-2, 1e4))
def test_dispersion_holds(omega, depth):
    k = wave_number(omega, depth)
    assert GRAVITY * k * math.tanh(k * depth) == pytest.approx(omega**2, rel=1e-10)


def test_limits_of_deep_and_of_shallow_water():
    assert wave_number(2.0, math.inf) == pytest.approx(4.0 / GRAVITY)
    assert wave_number(0.01, 1.0) == pytest.approx(0.01 / math.sqrt(GRAVITY), rel=1e-5)


def test_following_waves_are_met_later_and_can_be_overtaken():
    assert met_wave(13.0, 29.0, 3.0, angle=0.0).period_of_encounter > 13.0
    assert met_wave(13.0, 29.0, 30.0, angle=0.0).omega_encounter < 0.0


def test_head_waves_reach_the_bow_first():
    assert phase_at(0.0, 0.0, 1.0, k=0.5) == pytest.approx(0.5)
    assert phase_at(phase_at(1.0, 4.0, -0.05, k=2.9), -0.05, 4.0, k=2.9) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("period", "depth", "message"),
    [(13.0, -29.0, "water depth of -29 m"), (13.0, math.nan, "water depth"), (0.0, 29.0, "wave period of 0 s")],
)
def test_impossible_waves_are_named(period, depth, message):
    with pytest.raises(TowtankError, match=message):
        met_wave(period, depth)
    with pytest.raises(TowtankError, match="wave frequency"):
        wave_number(math.inf, 1.0)
