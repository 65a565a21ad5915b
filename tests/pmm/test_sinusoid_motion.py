"""Textbook sinusoids: closed harmonics of powers, amplitudes and phases of the motion, turning of forces."""

from __future__ import annotations

import math

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.core.terms import Term
from towtank.identify.harmonics import HarmonicProjector
from towtank.pmm.run_types import Run
from towtank.pmm.sinusoid_motion import (
    COS1,
    COS2,
    COS3,
    MEAN,
    SIN1,
    SinusoidMotion,
    conditions_are_zero,
    cosine_harmonic,
    sinusoid_motion,
)


@pytest.mark.parametrize(
    ("power", "modulus", "k", "printed"),
    [
        (1, 0, 1, 1.0),
        (2, 0, 0, 1 / 2),
        (2, 0, 2, 1 / 2),
        (3, 0, 1, 3 / 4),
        (3, 0, 3, 1 / 4),
        (4, 0, 0, 3 / 8),
        (1, 1, 1, 8 / (3 * math.pi)),
        (1, 1, 3, 8 / (15 * math.pi)),
        (1, 1, 5, -8 / (105 * math.pi)),
        (0, 1, 0, 2 / math.pi),
        (3, 0, 2, 0.0),
        (0, 0, 0, 1.0),
        (0, 0, 2, 0.0),
    ],
)
def test_harmonics_of_powers_are_those_of_the_textbooks(power: int, modulus: int, k: int, printed: float) -> None:
    assert cosine_harmonic(power, modulus, k) == pytest.approx(printed, abs=1e-15)


@pytest.mark.parametrize("name", ["Yv", "Yvvv", "Yv|v|", "Yvdot", "Y0", "Yr", "Yvvr", "Yvrr", "Yvvvvv"])
def test_column_is_the_projection_of_the_sinusoid(name: str) -> None:
    motion = SinusoidMotion("r", 0.4, 0.0, 2.5, -0.2)
    if name.startswith("Yv") and "r" not in name:
        motion = SinusoidMotion("v", 0.15, 0.0, 2.5, 0.0)
    angle = 2 * np.pi * np.arange(4000) / 4000
    velocity, acceleration = motion.amplitude * np.cos(angle), -2.5 * motion.amplitude * np.sin(angle)
    state = {
        "v": velocity if motion.velocity == "v" else np.full(4000, motion.drift),
        "r": velocity if motion.velocity == "r" else np.zeros(4000),
        "vdot": acceleration,
    }
    term = Term.parse(name)
    exact = HarmonicProjector(angle, 1.0, 3).project(np.asarray(term.column(state)))
    np.testing.assert_allclose(motion.column(term, 3), exact, atol=2e-8)


def test_resistance_keeps_its_sign() -> None:
    motion = SinusoidMotion("v", 0.15, 0.0, 2.5, 0.0)
    assert motion.column(Term.parse("R0"), 2)[MEAN] == -1.0
    assert motion.column(Term.parse("X0"), 2)[MEAN] == 1.0


def test_term_in_another_variable_contributes_nothing() -> None:
    motion = SinusoidMotion("v", 0.15, 0.0, 2.5, 0.0)
    for name in ("Yr", "Yvrr", "Yrdot", "Yd", "Yb"):
        assert not motion.column(Term.parse(name), 3).any()


@pytest.mark.parametrize(("amplitude", "phase"), [(0.2, 0.0), (-0.2, 0.0), (0.2, 1.1), (0.15, -2.5)])
def test_amplitude_and_phase_follow_the_path(reduced, hull, amplitude: float, phase: float) -> None:
    run = Run("s", "pure_sway", speed=1.5, frequency=0.9, sway_amplitude=amplitude, sway_phase=phase)
    (result,) = reduced(hull, [run])
    motion = sinusoid_motion(result)
    t = result.window.times[:50]
    sway = amplitude * 0.9 * np.cos(0.9 * t + phase) / 1.5
    np.testing.assert_allclose(motion.amplitude * np.cos(0.9 * t + motion.phase), sway, atol=1e-15)
    assert motion.amplitude > 0
    assert motion.frequency == pytest.approx(0.9 * result.ship.L / 1.5, rel=1e-15)


def test_pure_yaw_amplitude_is_the_printed_one(reduced, hull) -> None:
    """Digest of the DTC tests, Table 2: r'max = y'max w1^2, w1 = 2.5."""
    length, speed = hull.ship.L, 1.2
    run = Run("y", "pure_yaw", speed=speed, frequency=2.5 * speed / length, sway_amplitude=0.048 * length)
    (result,) = reduced(hull, [run])
    motion = sinusoid_motion(result)
    assert motion.velocity == "r"
    assert motion.amplitude == pytest.approx(0.30, rel=1e-12)
    # psi = atan(eps cos w t), so r = -r_max sin w t = r_max cos(w t + 90 deg)
    assert motion.phase == pytest.approx(math.pi / 2, abs=1e-12)


def test_drift_and_measured_heading(reduced, hull) -> None:
    run = Run("d", "yaw_drift", speed=1.2, frequency=0.9, sway_amplitude=0.1, drift_angle=math.radians(8))
    prescribed, measured = reduced(hull, [run])[0], reduced(hull, [run], motion="measured")[0]
    a, b = sinusoid_motion(prescribed), sinusoid_motion(measured)
    assert a.drift == pytest.approx(-math.sin(math.radians(8)), rel=1e-12)
    assert b.drift == pytest.approx(a.drift, rel=1e-9)
    # the measured heading is atan(y'/U), whose first harmonic is smaller by eps^2/4
    eps = 0.1 * 0.9 / 1.2
    assert b.amplitude / a.amplitude == pytest.approx(1 - eps**2 / 4, abs=eps**4)


def test_turned_force_is_in_phase_with_the_velocity() -> None:
    phase = 0.7
    motion = SinusoidMotion("v", 0.2, phase, 2.0, 0.0)
    t = 2 * np.pi * np.arange(64) / 64
    a = t + phase
    force = 0.3 + 2.0 * np.cos(a) - 0.5 * np.sin(a) + 0.25 * np.cos(2 * a) + 0.125 * np.cos(3 * a)
    coefficients = HarmonicProjector(t, 1.0, 3).project(force)
    turned, sd = motion.turned(coefficients, np.full(7, 0.1))
    expected = np.zeros(7)
    expected[[MEAN, COS1, SIN1, COS2, COS3]] = 0.3, 2.0, -0.5, 0.25, 0.125
    np.testing.assert_allclose(turned, expected, atol=1e-14)
    np.testing.assert_allclose(sd, 0.1, rtol=1e-14)


def test_turned_errors_mix_by_the_phase() -> None:
    motion = SinusoidMotion("v", 0.2, math.pi / 2, 2.0, 0.0)
    _, sd = motion.turned(np.zeros(3), np.array([0.1, 0.2, 0.4]))
    np.testing.assert_allclose(sd, [0.1, 0.4, 0.2], rtol=1e-12)


def test_steady_and_combined_runs_are_refused(reduced, hull) -> None:
    runs = [
        Run("a", "static_drift", speed=1.5, drift_angle=0.1),
        Run("b", "sway_yaw", speed=1.5, frequency=0.9, sway_amplitude=0.2, yaw_amplitude=0.1),
    ]
    for result in reduced(hull, runs):
        with pytest.raises(FitError, match=f"a {result.run.kind} run has no sinusoid relations"):
            sinusoid_motion(result)


def test_motion_without_its_velocity_is_refused(reduced, hull) -> None:
    run = Run("a", "pure_surge", speed=1.5, frequency=0.9, sway_amplitude=0.2)
    with pytest.raises(FitError, match="does not oscillate"):
        sinusoid_motion(reduced(hull, [run])[0])


def test_conditions(reduced, hull) -> None:
    heeled = reduced(hull, [Run("h", "static_drift", speed=1.5, drift_angle=0.1, heel=0.05)])[0]
    assert not conditions_are_zero(heeled)
    assert conditions_are_zero(heeled, {"phi"})
    assert not conditions_are_zero(heeled, {"delta"})
