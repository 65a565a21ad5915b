"""Oscillating runs: what several channels say together."""

import numpy as np
import pytest

from towtank.core import Ship
from towtank.pmm.audit_motion import audit_oscillation
from towtank.pmm.planar_motion import prescribed_motion
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.0, 0.4, 0.14, scale=46.6)
TIME = np.arange(0.0, 40.0, 0.05)
YAW = Run("yaw", "pure_yaw", speed=1.5, frequency=1.0, sway_amplitude=0.3)
DRY = Run("dry", "dry_sway", frequency=1.0, sway_amplitude=0.3)


def motion(run, *names, reference=0.0):
    exact = prescribed_motion(run, reference).at(TIME)
    exact["u"] = exact["surge"]
    return {name: exact[name] for name in names}


def found(run, channels, reference=0.0):
    return {item.rule: item for item in audit_oscillation(channels, TIME, run, SHIP, reference)}


def test_any_choice_of_channels_is_clean():
    for names in (("y",), ("psi",), ("r", "rdot"), ("u", "v", "r", "udot", "vdot", "rdot", "psi", "y"), ()):
        assert found(YAW, motion(YAW, *names)) == {}


def test_a_phase_is_told_with_its_direction():
    late = prescribed_motion(YAW).at(TIME - 0.1)
    item = found(YAW, {"y": late["y"]})["phase-mismatch"]
    assert item.severity == "warning"
    assert "5.73 deg behind" in item.message
    early = prescribed_motion(YAW).at(TIME + 1.0)
    item = found(YAW, {"y": early["y"], "psi": early["psi"]})["phase-mismatch"]
    assert item.severity == "error"
    assert "57.3 deg ahead" in item.message


def test_an_opposite_phase_of_everything_is_no_wrong_sign():
    half = prescribed_motion(YAW).at(TIME + YAW.period / 2)
    assert set(found(YAW, {name: half[name] for name in ("y", "psi", "r", "rdot")})) == {"phase-mismatch"}


def test_the_length_behind_non_dimensional_rates():
    channels = motion(YAW, "psi", "r", "rdot")
    channels["r"], channels["rdot"] = channels["r"] * 1.25, channels["rdot"] * 1.25**2
    item = found(YAW, channels)["wrong-length"]
    assert "1.25 times the frequency" in item.message
    assert "3.75 m" in item.message
    assert "amplitude-mismatch" not in found(YAW, channels)


def test_degrees_are_no_wrong_length():
    channels = motion(YAW, "psi", "r", "rdot")
    channels["rdot"] = np.degrees(channels["rdot"])
    assert set(found(YAW, channels)) == {"angle-in-degrees"}


def test_runs_in_air_have_no_speed():
    assert found(DRY, motion(DRY, "y", "v", "vdot", "u")) == {}
    assert set(found(DRY, {"y": 1000.0 * motion(DRY, "y")["y"]})) == {"length-in-millimetres"}


def test_exchanged_forces_need_a_clear_oscillation():
    rng = np.random.default_rng(0)
    X, Y = 1.0 + 0.1 * rng.standard_normal(len(TIME)), np.zeros(len(TIME))
    assert found(YAW, {"X": X, "Y": Y}) == {}
    assert set(found(YAW, {"X": X + np.sin(TIME), "Y": Y - 2.0})) == {"swapped-channels"}


@pytest.mark.parametrize("dilution", [0.5, 3.0])
def test_a_record_of_another_frequency(dilution):
    channels = {"y": 0.3 * np.sin(dilution * TIME)}
    item = found(YAW, channels)["frequency-mismatch"]
    told = float(item.message.split("about ")[1].split(" rad/s")[0])
    assert told == pytest.approx(dilution, rel=0.01)


def test_time_in_milliseconds():
    found_here = audit_oscillation(motion(YAW, "y"), 1000.0 * TIME, YAW, SHIP, 0.0)
    assert [item.rule for item in found_here] == ["frequency-mismatch"]
    assert "milliseconds" in found_here[0].message
