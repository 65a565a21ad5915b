"""Noise of virtual campaigns: sizes, correlation, reproducibility."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import CampaignError
from towtank.pmm.noise import SILENT, Noise, autoregressive, quantised, reference_forces

REFERENCE = {"X": 2.0, "Y": 10.0, "N": 5.0}


def still(n: int) -> dict[str, np.ndarray]:
    return {name: np.zeros(n) for name in REFERENCE}


def test_no_noise_returns_the_forces_and_the_zero():
    forces = {"Y": np.arange(4.0)}
    assert SILENT.silent
    assert SILENT.readings(forces, REFERENCE, "a")["Y"] == pytest.approx([0, 1, 2, 3], abs=0)
    assert SILENT.readings(forces, REFERENCE, "a", {"Y": 3.0})["Y"] == pytest.approx([3, 4, 5, 6], abs=0)


def test_white_noise_has_the_stated_share_of_each_reference():
    reading = Noise(white=0.02, seed=1).readings(still(40000), REFERENCE, "a")
    for name, reference in REFERENCE.items():
        assert reading[name].std() == pytest.approx(0.02 * reference, rel=0.02)
    assert abs(np.corrcoef(reading["X"], reading["Y"])[0, 1]) < 0.03


def test_autoregressive_noise_has_the_stated_spread_and_memory():
    values = Noise(ar1=0.05, rho=0.8, seed=2).readings(still(30000), REFERENCE, "a")["Y"]
    assert values.std() == pytest.approx(0.5, rel=0.04)
    for lag in (1, 3):
        assert np.corrcoef(values[:-lag], values[lag:])[0, 1] == pytest.approx(0.8**lag, abs=0.04)


def test_autoregression_is_stationary_from_its_first_sample():
    white = np.random.default_rng(3).standard_normal((20000, 8))
    spread = autoregressive(white, 0.95).std(axis=0)
    assert spread == pytest.approx(np.ones(8), rel=0.03)


def test_autoregression_follows_its_recursion():
    white = np.random.default_rng(4).standard_normal(30)
    expected = [white[0]]
    for shock in white[1:]:
        expected.append(0.7 * expected[-1] + np.sqrt(1 - 0.49) * shock)
    assert autoregressive(white, 0.7) == pytest.approx(expected, abs=1e-14)


def test_a_run_keeps_its_noise_whatever_else_is_made():
    noise = Noise(white=0.01, ar1=0.02, drift=0.01, offset=0.01, seed=5)
    first = {name: noise.readings(still(50), REFERENCE, name) for name in ("a", "b", "c")}
    again = {name: noise.readings(still(50), REFERENCE, name) for name in ("c", "a")}
    for run, readings in again.items():
        for channel in REFERENCE:
            assert np.array_equal(readings[channel], first[run][channel])
    assert not np.array_equal(first["a"]["Y"], first["b"]["Y"])
    other = replace(noise, seed=6).readings(still(50), REFERENCE, "a")
    assert not np.array_equal(other["Y"], first["a"]["Y"])


def test_gain_is_shared_by_all_runs_and_differs_between_campaigns():
    noise = Noise(gain_bias=0.02, seed=7)
    forces = {name: np.full(3, value) for name, value in REFERENCE.items()}
    ratios = [noise.readings(forces, REFERENCE, run)["Y"] / forces["Y"] for run in ("a", "b", "c")]
    assert np.ptp(ratios) == 0.0
    gains = np.array([Noise(gain_bias=0.02, seed=seed).gains["Y"] for seed in range(400)])
    assert gains.mean() == pytest.approx(1.0, abs=0.004)
    assert gains.std() == pytest.approx(0.02, rel=0.12)


def test_offset_and_drift_vary_from_run_to_run_with_the_stated_spread():
    names = [f"run {i}" for i in range(500)]
    offset = Noise(offset=0.03, seed=8)
    levels = np.array([offset.readings(still(5), REFERENCE, name)["Y"] for name in names])
    assert np.ptp(levels, axis=1).max() == 0.0
    assert levels[:, 0].std() == pytest.approx(0.3, rel=0.12)
    drift = Noise(drift=0.03, seed=8)
    ramps = np.array([drift.readings(still(5), REFERENCE, name)["Y"] for name in names])
    assert ramps[:, 0] == pytest.approx(np.zeros(500), abs=0)
    assert ramps[:, -1].std() == pytest.approx(0.3, rel=0.12)
    assert ramps[:, 2] == pytest.approx(ramps[:, -1] / 2)


def test_readings_are_whole_steps_of_the_converter():
    reading = Noise(white=0.1, quantum=0.01, seed=9).readings(still(200), REFERENCE, "a", {"Y": 0.033})["Y"]
    steps = reading / 0.1
    assert steps == pytest.approx(np.round(steps), abs=1e-9)
    assert len(np.unique(np.round(steps))) > 10
    assert quantised(np.array([0.26, -0.26]), 0.1) == pytest.approx([0.3, -0.3])
    assert quantised(np.array([0.26]), 0.0) == pytest.approx([0.26])


@pytest.mark.parametrize("rho", [0.0, 0.9])
def test_density_gives_the_variance_of_means_and_harmonics(rho):
    noise = Noise(white=0.05, ar1=0.1, rho=rho)
    n, cycles = 400, 8
    names = [f"run {i}" for i in range(1000)]
    samples = np.array([noise.readings(still(n), REFERENCE, name)["Y"] for name in names])
    density = 100.0 * noise.density(np.array([0.0, cycles / n]))
    cosine = 2.0 / n * samples @ np.cos(2 * np.pi * cycles / n * np.arange(n))
    assert samples.mean(axis=1).var() == pytest.approx(density[0] / n, rel=0.15)
    assert cosine.var() == pytest.approx(2 * density[1] / n, rel=0.15)


def test_reference_is_the_largest_force_of_the_campaign():
    runs = [{"X": np.array([1.0, -3.0]), "Y": np.zeros(2)}, {"X": np.array([2.0]), "Y": np.zeros(1)}]
    assert reference_forces(runs) == {"X": 3.0, "Y": 1.0}


@pytest.mark.parametrize(
    ("values", "place"),
    [({"white": -0.1}, "noise.white"), ({"ar1": float("nan")}, "noise.ar1"), ({"rho": 1.0}, "noise.rho")],
)
def test_sizes_that_are_none_are_refused_by_name(values, place):
    with pytest.raises(CampaignError) as caught:
        Noise(**values)
    assert caught.value.place == place
    assert caught.value.cure
