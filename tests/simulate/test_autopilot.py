"""Autopilot gains, Nomoto constants of a linear set, closed-loop roots."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core.errors import ConventionError, TowtankError
from towtank.datasets import load_set
from towtank.simulate.autopilot import Autopilot, closed_loop_matrix, closed_loop_roots, linear_nomoto
from towtank.simulate.linear_motion import linear_motion
from towtank.simulate.stability import straight_line_roots

MARINER = linear_motion(load_set("mariner"))
TANKER = linear_motion(load_set("kvlcc2").with_values(Yd=-0.08, Nd=0.04))


def test_mariner_has_the_constants_of_the_handbook():
    # Fossen's handbook at 15 knots: K = 0.185 1/s, T1 = 118.0 s, T2 = 7.8 s, T3 = 18.5 s
    time = MARINER.ship.L / 7.7175
    found = linear_nomoto(MARINER)
    assert found.K / time == pytest.approx(0.185, abs=5e-4)
    assert found.T1 * time == pytest.approx(118.0, abs=0.05)
    assert found.T2 * time == pytest.approx(7.8, abs=0.05)
    assert found.T3 * time == pytest.approx(18.5, abs=0.05)
    first_order = found.T
    assert first_order == pytest.approx((found.T1 + found.T2).real - found.T3)


def test_constants_are_the_step_response():
    # transfer function from rudder to yaw rate at a complex frequency
    found = linear_nomoto(TANKER)
    s = 0.3 + 0.7j
    state = np.linalg.solve(s * TANKER.mass - TANKER.damping, TANKER.rudder)
    expected = found.K * (1 + found.T3 * s) / ((1 + found.T1 * s) * (1 + found.T2 * s))
    assert state[1] == pytest.approx(expected)


def test_unstable_ship_has_a_negative_time_constant():
    found = linear_nomoto(TANKER)
    assert found.T1.real < 0 < found.T2.real
    assert found.K < 0


def test_without_gains_the_ship_is_left_to_itself():
    roots = closed_loop_roots(TANKER, Autopilot(0.0))
    alone, _ = straight_line_roots(TANKER)
    assert sorted(roots.real) == pytest.approx(sorted([*alone.real, 0.0]))


def test_autopilot_holds_an_unstable_ship():
    assert closed_loop_roots(TANKER, Autopilot(0.0))[0].real > 0
    assert closed_loop_roots(TANKER, Autopilot(2.0, 2.0))[0].real < 0
    assert closed_loop_roots(TANKER, Autopilot(-2.0, 2.0))[0].real > 0


@given(st.floats(0.1, 3.0), st.floats(0.4, 2.0), st.floats(0.5, 5.0), st.floats(0.3, 10.0))
@settings(max_examples=50, deadline=None)
def test_poles_are_placed(frequency, damping, gain, time):
    pilot = Autopilot.for_nomoto(gain, time, frequency, damping)
    # T r. + r = K delta with delta = -(Kp psi + Kd r)
    polynomial = [time, 1 + gain * pilot.derivative, gain * pilot.proportional]
    assert np.array(polynomial) / time == pytest.approx([1, 2 * damping * frequency, frequency**2], rel=1e-9)


def test_integral_adds_a_root_and_keeps_the_others_near():
    pilot = Autopilot.for_nomoto(2.0, 3.0, 0.8, 0.9, 0.1)
    assert pilot.integral == pytest.approx(0.1 * 0.8 * pilot.proportional)
    roots = closed_loop_roots(MARINER, pilot)
    assert len(roots) == 4
    assert np.all(roots.real < 0)


def test_steering_lag_takes_damping_away():
    pilot = Autopilot(2.0, 1.0)
    quick, slow = closed_loop_roots(TANKER, pilot, 1e-6), closed_loop_roots(TANKER, pilot, 0.3)
    at_once = closed_loop_roots(TANKER, pilot)
    assert len(quick) == len(at_once) + 1
    assert quick[0].real == pytest.approx(at_once[0].real, abs=1e-5)
    assert slow[0].real > quick[0].real


def test_matrix_is_that_of_the_equations():
    pilot = Autopilot(1.5, 0.7, 0.2)
    matrix = closed_loop_matrix(TANKER, pilot, 0.4)
    state = np.array([0.02, -0.1, 0.3, 0.5, 0.05])
    rates = matrix @ state
    force = TANKER.damping @ state[:2] + TANKER.rudder * state[4]
    assert TANKER.mass @ rates[:2] == pytest.approx(force)
    assert rates[2:4] == pytest.approx([state[1], state[2]])
    order = -(1.5 * state[2] + 0.7 * state[1] + 0.2 * state[3])
    assert rates[4] == pytest.approx((order - state[4]) / 0.4)


def test_dimensional_gains():
    assert Autopilot(2.0, 3.0, 0.5).dimensional(200.0, 10.0) == pytest.approx((2.0, 60.0, 0.025))
    with pytest.raises(TowtankError, match="must be positive"):
        Autopilot(1.0).dimensional(200.0, 0.0)


def test_gains_that_cannot_be():
    with pytest.raises(TowtankError, match="the rudder must turn the ship"):
        Autopilot.for_nomoto(0.0, 1.0, 1.0)
    with pytest.raises(ConventionError, match="no rudder derivatives"):
        closed_loop_roots(linear_motion(load_set("kvlcc2")), Autopilot(1.0))


def test_prime_gains_hold_at_every_speed():
    assert math.isclose(
        Autopilot(1.0, 2.0).dimensional(100.0, 5.0)[1], 2 * Autopilot(1.0, 2.0).dimensional(100.0, 10.0)[1]
    )
