"""The quick harmonics of a prescribed motion are those of its exact path."""

import math

import numpy as np
import pytest

from towtank.pmm.expected_harmonics import expected_motion
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run

COMMON = {"speed": 1.5, "frequency": 1.1}
RUNS = [
    Run("sway", "pure_sway", sway_amplitude=0.3, sway_phase=0.4, **COMMON),
    Run("yaw", "pure_yaw", sway_amplitude=0.3, **COMMON),
    Run("yaw drift", "yaw_drift", sway_amplitude=0.25, sway_phase=1.0, drift_angle=-0.15, **COMMON),
    Run("both", "sway_yaw", sway_amplitude=0.2, yaw_amplitude=0.1, yaw_phase=0.7, drift_angle=0.05, **COMMON),
    Run("surge", "pure_surge", surge_amplitude=0.2, drift_angle=0.1, **COMMON),
    Run("dry", "dry_yaw", frequency=1.1, yaw_amplitude=0.2),
]


@pytest.mark.parametrize("run", RUNS, ids=lambda run: run.name)
@pytest.mark.parametrize("reference", [0.0, 0.4])
def test_harmonics_are_those_of_the_exact_path(run, reference):
    t = np.arange(256) / 256 * run.period
    exact = prescribed_motion(run, reference).at(t)
    want = expected_motion(run, reference)
    wave = np.exp(-1j * run.frequency * t)
    for name, first in want.first.items():
        values = exact["surge" if name == "u" else name] - (run.speed * t if name == "x" else 0.0)
        assert first == pytest.approx(2.0 * np.mean(values * wave), abs=1e-9), name
    assert want.surge == pytest.approx(exact["surge"].mean(), abs=1e-9)
    assert want.sway == pytest.approx(np.mean(exact["v"] + reference * exact["r"]), abs=1e-9)


def test_what_moves():
    sway, yaw = (expected_motion(run) for run in RUNS[:2])
    assert sway.moves("y")
    assert sway.moves("v")
    assert not sway.moves("psi")
    assert yaw.moves("r")
    assert not yaw.moves("v")
    assert not yaw.moves("x")
    assert expected_motion(RUNS[1], 0.4).moves("v")
    assert abs(expected_motion(RUNS[1], 0.4).sway_at(0.4)) < 1e-12


def test_yaw_along_the_path():
    run = RUNS[1]
    peak = abs(expected_motion(run).first["psi"])
    assert peak == pytest.approx(math.atan(0.3 * 1.1 / 1.5), rel=0.02)
