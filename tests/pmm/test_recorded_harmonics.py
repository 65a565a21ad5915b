"""Quick harmonics of a record."""

import numpy as np
import pytest

from towtank.pmm.recorded_harmonics import recorded_harmonics, strongest_line
from towtank.pmm.run_types import Run

RUN = Run("sway", "pure_sway", speed=1.0, frequency=1.3, sway_amplitude=0.2)
TIME = np.arange(0.0, 26.0, 0.02)


def test_mean_first_and_second_harmonic():
    a = RUN.frequency * TIME
    channels = {"time": TIME, "y": 0.2 * np.sin(a + 0.3), "X": -2.0 + 0.5 * np.cos(2 * a), "K": np.sin(a)}
    seen = recorded_harmonics(channels, TIME, RUN)
    assert "K" not in seen
    assert seen.first["y"] == pytest.approx(-0.2j * np.exp(0.3j), abs=1e-12)
    assert seen.mean["X"] == pytest.approx(-2.0, abs=5e-3)
    assert seen.second("X") == pytest.approx(0.5, rel=0.02)
    assert seen.fit_quality("y")[0] == pytest.approx(1.0)
    assert seen.fit_quality("X")[0] < 0.05


def test_the_position_along_the_tank_loses_its_trend():
    run = Run("surge", "pure_surge", speed=1.0, frequency=1.3, surge_amplitude=0.1)
    x = 1.02 * TIME + 0.1 * np.sin(1.3 * TIME)
    seen = recorded_harmonics({"x": x}, TIME, run)
    assert seen.first["x"] == pytest.approx(-0.1j, abs=1e-9)


def test_a_slip_of_frequency_is_found():
    seen = recorded_harmonics({"y": np.sin(1.01 * RUN.frequency * TIME)}, TIME, RUN)
    explained, slip = seen.fit_quality("y")
    assert 0.9 < explained < 0.999
    assert slip == pytest.approx(0.01 * RUN.frequency, rel=0.25)


def test_no_whole_cycle_no_harmonics():
    assert recorded_harmonics({"y": TIME[:100]}, TIME[:100], RUN) is None
    assert recorded_harmonics({"K": TIME}, TIME, RUN) is None
    assert recorded_harmonics({"y": TIME[::200]}, TIME[::200], RUN) is None


@pytest.mark.parametrize("cycles", [3.3, 7.8, 40.0])
def test_the_strongest_line(cycles):
    time = np.linspace(0.0, 10.0, 5000)
    values = (
        3.0
        + np.sin(2 * np.pi * cycles / 10.0 * time + 0.4)
        + 0.05 * np.random.default_rng(0).standard_normal(5000)
    )
    frequency, share = strongest_line(values, time)
    assert frequency == pytest.approx(cycles / 10.0, abs=0.01)
    assert share > 0.9
    assert strongest_line(np.ones(100), np.arange(100.0)) == (0.0, 0.0)
