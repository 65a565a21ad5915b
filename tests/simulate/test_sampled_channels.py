"""Channels between their samples."""

import math

import numpy as np
import pytest

from towtank.simulate.sampled_channels import SampledChannels, white_noise
from towtank.simulate.trajectory import Trajectory


def cubic(hull, step=2.0):
    time = np.arange(0.0, 40.0, step)
    psi = 1e-4 * (time - 30.0) ** 2 * time / 10.0
    return Trajectory.from_columns({"time": time, "psi": psi, "delta": 0.1 * psi}, hull, "zigzag 10/10")


def test_clean_cubics_are_interpolated_exactly(hull):
    channels = SampledChannels(cubic(hull))
    assert channels.half_width == 0.0
    for moment in (0.3, 11.1, 38.0):
        assert channels.value("psi", moment) == pytest.approx(1e-5 * (moment - 30.0) ** 2 * moment, abs=1e-14)


def test_crossing_and_highest_are_located_exactly(hull):
    channels = SampledChannels(cubic(hull))
    assert channels.highest("psi", 0.0, 29.0) == pytest.approx(10.0, abs=1e-9)
    found = channels.crossing("psi", 0.02, 0.0, 29.0)
    assert channels.value("psi", found) == pytest.approx(0.02, abs=1e-14)
    assert found < 10.0
    falling = channels.crossing("psi", 0.02, 0.0, 29.0, rising=False)
    assert 10.0 < falling < 30.0


def test_what_does_not_happen_is_nan(hull):
    channels = SampledChannels(cubic(hull))
    assert math.isnan(channels.crossing("psi", 1.0, 0.0, 40.0))
    assert math.isnan(channels.highest("psi", 12.0, 29.0))
    assert math.isnan(channels.value("phi", 3.0))
    assert np.isnan(channels.state(3.0)[7])


def test_noise_is_measured_and_smoothed_away(circle):
    clean = circle().trajectory()
    level = math.radians(0.3)
    noisy = clean.with_columns(
        "noise", psi=clean["psi"] + level * np.random.default_rng(5).standard_normal(len(clean))
    )
    assert white_noise(noisy["psi"]) == pytest.approx(level, rel=0.2)
    assert white_noise(clean["psi"]) < 1e-9
    channels = SampledChannels(noisy)
    assert channels.half_width == pytest.approx(math.radians(3.0) / circle().rate, rel=0.2)
    error = channels.smooth("psi") - clean["psi"]
    assert np.std(error) < 0.7 * level
    assert SampledChannels(noisy, half_width=0.0).smooth("psi") == pytest.approx(noisy["psi"])


def test_irregular_samples_are_taken_as_they_are(circle):
    turn = circle()
    time = np.sort(np.random.default_rng(2).uniform(0.0, 200.0, 150))
    columns = turn.columns(time)
    channels = SampledChannels(Trajectory.from_columns(columns, turn.trajectory().ship, "turning"))
    assert channels.crossing("psi", 0.5 * math.pi, 0.0, 200.0) == pytest.approx(
        0.5 * math.pi / turn.rate, abs=1e-9
    )
