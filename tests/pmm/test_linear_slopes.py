"""Linear derivatives straight from run summaries."""

import math

import pytest

from towtank.core import Ship
from towtank.pmm.linear_slopes import RunSummary, linear_slopes, scaled_force
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.0, 0.4, 0.14, rho=1000.0)
U = 1.5
UNIT = 0.5 * 1000.0 * 3.0 * 0.14


def drift(degrees, *, offset=0.0, **more):
    """Y' = -0.3 v' - 2 v'^3, N' = -0.15 v', X' = -0.02, with a zero error on Y."""
    v = -math.sin(math.radians(degrees))
    force = {"X": -0.02, "Y": -0.3 * v - 2.0 * v**3 + offset, "N": -0.15 * v * SHIP.L}
    run = Run(f"{degrees}", "static_drift", speed=U, drift_angle=math.radians(degrees), **more)
    return RunSummary(run, {name: UNIT * U**2 * value for name, value in force.items()})


def test_slopes_of_static_drift_do_not_mind_a_zero_error():
    for offset in (0.0, 0.05):
        found = linear_slopes([drift(a, offset=offset) for a in (-10, -4, 0, 4, 10, 20)], SHIP)
        assert found.Yv == pytest.approx(-0.3 - 2 * 0.17**2, rel=0.05)
        assert found.Nv == pytest.approx(-0.15)
        assert pytest.approx(-0.02) == found.X0
        assert found.lever == pytest.approx(0.15 / -found.Yv)


def test_large_angles_serve_where_there_are_no_small_ones():
    assert linear_slopes([drift(a) for a in (15, 20)], SHIP).Yv < -0.3


def test_runs_that_show_nothing_give_nothing():
    assert linear_slopes([], SHIP).Yv is None
    assert linear_slopes([drift(0)], SHIP).Yv is None
    assert linear_slopes([drift(a, rudder_angle=0.1) for a in (-4, 4)], SHIP).Yv is None
    assert linear_slopes([drift(a, propeller_rate=9.0) for a in (-4, 4)], SHIP).X0 is None
    still = [RunSummary(drift(a).run, {"Y": 0.0}) for a in (-4, 4)]
    assert linear_slopes(still, SHIP).Yv is None
    assert linear_slopes(still, SHIP).Nv is None


def test_slopes_of_oscillations():
    w, a = 1.2, 0.3
    sway = Run("sway", "pure_sway", speed=U, frequency=w, sway_amplitude=a)
    yaw = Run("yaw", "pure_yaw", speed=U, frequency=w, sway_amplitude=a)
    v, r = a * w, 0.2
    side = {"Y": (-0.3 * UNIT * U * v, -0.11 * UNIT * SHIP.L * v * w)}
    turn = {"N": (-0.05 * UNIT * U * SHIP.L**2 * r, -0.007 * UNIT * SHIP.L**3 * r * w)}
    found = linear_slopes(
        [RunSummary(sway, {}, side, v, v * w), RunSummary(yaw, {}, turn, r, r * w), RunSummary(yaw, {})], SHIP
    )
    assert found.sway_damping == pytest.approx(-0.3)
    assert found.sway_added_mass == pytest.approx(-0.11)
    assert found.yaw_damping == pytest.approx(-0.05)
    assert found.yaw_added_inertia == pytest.approx(-0.007)


def test_scaled_forces():
    one = drift(4)
    assert scaled_force("X", one, SHIP) == pytest.approx(-0.02)
    assert scaled_force("N", one, SHIP) == pytest.approx(0.15 * math.sin(math.radians(4)))
    assert math.isnan(scaled_force("K", one, SHIP))
