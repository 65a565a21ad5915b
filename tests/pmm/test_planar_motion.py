"""Exact kinematics against finite differences of the path and the closed forms of the DTMB 5512 paper."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.pmm.planar_motion import (
    Oscillation,
    PlanarMotion,
    measured_motion,
    path_limits,
    prescribed_motion,
)
from towtank.pmm.run_types import Run

STEP = 1e-4


def differences(values: np.ndarray) -> np.ndarray:
    """Fourth-order central difference, for the inner points."""
    return (values[:-4] - 8 * values[1:-3] + 8 * values[3:-1] - values[4:]) / (12 * STEP)


small = st.floats(-0.2, 0.2)
pair = st.tuples(small, small)


@settings(max_examples=40, deadline=None)
@given(pair, pair, pair, pair, pair, st.booleans(), st.floats(-1.0, 1.0), st.floats(0.5, 2.0))
def test_velocities_are_those_of_the_path(
    surge_cos, surge_sin, sway_cos, sway_sin, heading, along_path: bool, reference: float, omega: float
) -> None:
    motion = PlanarMotion(
        speed=1.5,
        omega=omega,
        surge=Oscillation(0.0, surge_cos, surge_sin),
        sway=Oscillation(0.1, sway_cos, sway_sin),
        heading=Oscillation(0.05, (heading[0],), (heading[1],)),
        along_path=along_path,
        reference=reference,
    )
    t = 0.7 + STEP * np.arange(41)
    at = motion.at(t)
    inner = slice(2, -2)
    psi = at["psi"][inner]
    x, y = differences(at["x"]), differences(at["y"])
    np.testing.assert_allclose(at["surge"][inner], x * np.cos(psi) + y * np.sin(psi), atol=1e-8)
    across = -x * np.sin(psi) + y * np.cos(psi)
    # x and y are those of the reference point; the velocity is that of midship
    np.testing.assert_allclose(at["v"][inner] + reference * at["r"][inner], across, atol=1e-8)
    np.testing.assert_allclose(at["r"][inner], differences(at["psi"]), atol=1e-8)
    for name, rate in (("surge", "udot"), ("v", "vdot"), ("r", "rdot")):
        np.testing.assert_allclose(at[rate][inner], differences(at[name]), atol=1e-7)


@pytest.mark.parametrize(("r_max", "w"), [(0.025, 0.841), (0.15, 0.841), (0.375, 1.08)])
def test_pure_yaw_is_that_of_table_9(r_max: float, w: float) -> None:
    """u, r, r-dot of the virtual captive tests of DTMB 5512: y = -y_max sin wt, psi = atan(-eps cos wt)."""
    speed = 1.5311
    eps = r_max / w
    run = Run("yaw", "pure_yaw", speed=speed, frequency=w, sway_amplitude=-eps * speed / w)
    t = np.linspace(0.0, 3.0, 200)
    at = prescribed_motion(run).at(t)
    cos, sin = np.cos(w * t), np.sin(w * t)
    grow = 1 + eps**2 * cos**2
    np.testing.assert_allclose(at["psi"], np.arctan(-eps * cos), rtol=0, atol=1e-15)
    np.testing.assert_allclose(at["surge"], speed * np.sqrt(grow), rtol=1e-14)
    np.testing.assert_allclose(at["v"], 0.0, atol=1e-15)
    np.testing.assert_allclose(at["r"], eps * w * sin / grow, atol=1e-15)
    np.testing.assert_allclose(
        at["rdot"], eps * w**2 * cos * (1 + eps**2 * (1 + sin**2)) / grow**2, rtol=0, atol=1e-15
    )
    np.testing.assert_allclose(at["vdot"], 0.0, atol=1e-15)
    np.testing.assert_allclose(at["udot"], -speed * eps**2 * w * sin * cos / np.sqrt(grow), rtol=0, atol=1e-15)


def test_pure_yaw_deviates_from_the_sinusoid_as_printed() -> None:
    """The speed of pure yaw with y_a = 0.3 m, T = 20 s, U = 1 m/s is modulated by 0.44 %, its mean by 0.22 %."""
    run = Run("yaw", "pure_yaw", speed=1.0, frequency=2 * math.pi / 20, sway_amplitude=0.3)
    at = prescribed_motion(run).at(np.linspace(0, 20, 400, endpoint=False))
    assert round(100 * (at["surge"].max() - 1), 2) == 0.44
    assert round(100 * (at["surge"].mean() - 1), 2) == 0.22


def test_pure_sway_of_table_8() -> None:
    run = Run("sway", "pure_sway", speed=1.5311, frequency=0.841, sway_amplitude=-0.266 / 0.841)
    t = np.linspace(0.0, 7.0, 50)
    at = prescribed_motion(run).at(t)
    np.testing.assert_allclose(at["v"], -0.266 * np.cos(0.841 * t), atol=1e-15)
    np.testing.assert_allclose(at["vdot"], 0.266 * 0.841 * np.sin(0.841 * t), atol=1e-15)
    np.testing.assert_allclose(at["surge"], 1.5311, rtol=1e-15)
    np.testing.assert_allclose(at["r"], 0.0, atol=1e-15)


def test_oblique_towing() -> None:
    run = Run("drift", "static_drift", speed=1.5, drift_angle=math.radians(10), rudder_angle=0.2, heel=-0.1)
    at = prescribed_motion(run).at(np.array([0.0, 3.0]))
    np.testing.assert_allclose(at["surge"], 1.5 * math.cos(math.radians(10)))
    np.testing.assert_allclose(at["v"], -1.5 * math.sin(math.radians(10)))
    for name in ("r", "udot", "vdot", "rdot"):
        np.testing.assert_array_equal(at[name], 0.0)
    np.testing.assert_array_equal(at["delta"], 0.2)
    np.testing.assert_array_equal(at["phi"], -0.1)


def test_circular_motion_about_a_reference_point() -> None:
    run = Run("turn", "steady_yaw_drift", speed=1.5, drift_angle=0.1, yaw_rate=0.2)
    at = prescribed_motion(run, reference=0.4).at(np.zeros(1))
    assert at["v"][0] == pytest.approx(-1.5 * math.sin(0.1) - 0.4 * 0.2)
    assert at["surge"][0] == pytest.approx(1.5 * math.cos(0.1))
    assert at["r"][0] == 0.2


def test_yaw_with_drift_keeps_the_drift_angle_of_the_path() -> None:
    beta = math.radians(8)
    run = Run("yd", "yaw_drift", speed=1.2, frequency=0.9, sway_amplitude=0.3, drift_angle=beta)
    at = prescribed_motion(run).at(np.linspace(0, 7, 60))
    np.testing.assert_allclose(np.arctan2(-at["v"], at["surge"]), beta, atol=1e-14)
    pure = prescribed_motion(Run("y", "pure_yaw", speed=1.2, frequency=0.9, sway_amplitude=0.3))
    np.testing.assert_allclose(at["r"], pure.at(np.linspace(0, 7, 60))["r"], atol=1e-15)


def test_combined_motion_has_the_phases_of_the_run() -> None:
    run = Run(
        "both",
        "sway_yaw",
        speed=1.2,
        frequency=0.9,
        sway_amplitude=0.3,
        yaw_amplitude=0.15,
        sway_phase=0.4,
        yaw_phase=-0.7,
    )
    t = np.linspace(0.0, 6.0, 30)
    at = prescribed_motion(run).at(t)
    np.testing.assert_allclose(at["y"], 0.3 * np.sin(0.9 * t + 0.4), atol=1e-15)
    np.testing.assert_allclose(at["psi"], 0.15 * np.cos(0.9 * t - 0.7), atol=1e-15)


@given(st.floats(-1, 1), st.floats(-7, 7), st.integers(0, 3))
def test_waves_and_their_derivatives(amplitude: float, phase: float, order: int) -> None:
    t = np.linspace(0.0, 5.0, 11)
    sine = Oscillation.sine_wave(amplitude, phase).derivative(t, 1.3, order)
    cosine = Oscillation.cosine_wave(amplitude, phase).derivative(t, 1.3, order)
    turn = order * math.pi / 2
    np.testing.assert_allclose(sine, amplitude * 1.3**order * np.sin(1.3 * t + phase + turn), atol=1e-13)
    np.testing.assert_allclose(cosine, amplitude * 1.3**order * np.cos(1.3 * t + phase + turn), atol=1e-13)


def test_constant_has_no_derivative() -> None:
    wave = Oscillation(2.0, (0.0, 0.5), (0.0, 0.0))
    assert wave.derivative(np.zeros(1), 2.0, 0)[0] == 2.5
    assert wave.derivative(np.zeros(1), 2.0, 2)[0] == -0.5 * 16


def test_measured_motion_is_the_prescribed_one() -> None:
    run = Run("y", "pure_yaw", speed=1.2, frequency=0.9, sway_amplitude=0.2, rudder_angle=0.1)
    prescribed = prescribed_motion(run)
    t = 3.0 + run.period * np.arange(500) / 250
    path = prescribed.at(t)
    found = measured_motion(run, t, path["x"], path["y"], path["psi"], order=7, reference=0.0)
    at = found.at(t)
    assert found.speed == pytest.approx(1.2, rel=1e-12)
    # the heading atan(y'/U) has odd harmonics that fall with eps^2/4; beyond the seventh nothing is left
    for name in ("surge", "v", "r", "udot", "vdot", "rdot", "delta"):
        np.testing.assert_allclose(at[name], path[name], atol=2e-6)


def test_measured_carriage_that_surges() -> None:
    run = Run("s", "pure_surge", speed=1.0, frequency=0.9, surge_amplitude=0.2)
    t = run.period * np.arange(300) / 150
    path = prescribed_motion(run).at(t)
    found = measured_motion(run, t, path["x"] + 4.0, path["y"], path["psi"], order=3, reference=0.0)
    assert found.speed == pytest.approx(1.0, rel=1e-12)
    np.testing.assert_allclose(found.at(t)["udot"], path["udot"], atol=1e-12)


def test_measured_motion_without_x_keeps_the_speed_of_the_run() -> None:
    run = Run("s", "pure_sway", speed=1.1, frequency=0.9, sway_amplitude=0.2)
    t = run.period * np.arange(200) / 100
    path = prescribed_motion(run, reference=0.3).at(t)
    found = measured_motion(run, t, None, path["y"], path["psi"], order=3, reference=0.3)
    assert found.speed == 1.1
    np.testing.assert_allclose(found.at(t)["v"], path["v"], atol=1e-12)


def test_path_limits() -> None:
    length = 3.0
    runs = [
        Run("d", "static_drift", speed=1.5, drift_angle=math.radians(-12)),
        Run("t", "steady_yaw", speed=1.5, yaw_rate=-0.2),
        Run("y", "pure_yaw", speed=1.5, frequency=0.9, sway_amplitude=0.4),
    ]
    limits = path_limits(runs, length)
    assert limits["v"] == pytest.approx((0.0, math.sin(math.radians(12))), abs=1e-12)
    yaw = 0.4 * 0.9**2 / 1.5 * length / 1.5
    assert limits["r"] == pytest.approx((-yaw, yaw), rel=1e-3)
    assert path_limits(runs[:2], length)["r"] == pytest.approx((-0.2 * length / 1.5, 0.0), rel=1e-12)
