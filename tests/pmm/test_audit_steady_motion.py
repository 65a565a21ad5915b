"""The motion of steady runs."""

import math

import numpy as np
import pytest

from towtank.core import Ship
from towtank.pmm.audit_steady_motion import audit_constant_angles, audit_steady_motion, rows_at_speed
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.0, 0.4, 0.14, scale=46.6)
TIME = np.arange(0.0, 30.0, 0.05)
ONE = np.ones(len(TIME))
ALL = slice(0, len(TIME))
RUN = Run("drift", "static_drift", speed=1.5, drift_angle=0.15)
U, V = 1.5 * math.cos(0.15), -1.5 * math.sin(0.15)


def found(run=RUN, reference=0.0, **channels):
    return {item.rule for item in audit_steady_motion(channels, TIME, ALL, run, SHIP, reference)}


def test_the_prescribed_motion_is_clean():
    assert (
        found(u=U * ONE, v=V * ONE, psi=0.15 * ONE, x=1.5 * TIME, speed=1.5 * ONE, drift_angle=0.15 * ONE) == set()
    )
    assert found(v=V * ONE) == set()
    assert found(psi=0.0 * ONE, x=0.0 * TIME) == set()


def test_sway_velocity_of_midship_or_of_the_point_on_the_path():
    run = Run("circle", "steady_yaw_drift", speed=1.5, drift_angle=0.15, yaw_rate=0.2)
    for reference in (0.0, 0.5):
        for v in (V, V - 0.2 * reference):
            assert found(run, reference, u=U * ONE, v=v * ONE, r=0.2 * ONE) == set()
    assert found(run, r=0.3 * ONE) == {"amplitude-mismatch"}
    assert found(run, r=-0.2 * ONE) == {"drift-sign"}


@pytest.mark.parametrize(
    ("rule", "channels"),
    [
        ("swapped-channels", {"u": V * ONE, "v": U * ONE}),
        ("earth-fixed-velocities", {"u": 1.5 * ONE, "v": 0.0 * ONE}),
        ("drift-sign", {"u": U * ONE, "v": -V * ONE}),
        ("drift-sign", {"v": -V * ONE}),
        ("drift-sign", {"drift_angle": -0.15 * ONE}),
        ("speed-mismatch", {"u": 0.8 * U * ONE, "v": 0.8 * V * ONE}),
        ("speed-mismatch", {"x": 2.9158 * TIME}),
        ("length-in-millimetres", {"x": 1500.0 * TIME}),
        ("angle-in-degrees", {"psi": np.degrees(0.15) * ONE}),
    ],
)
def test_faults(rule, channels):
    assert rule in found(**channels)


def test_rows_at_speed():
    speed = 1.5 * np.clip(np.minimum(TIME - 3.0, 27.0 - TIME) / 2.0, 0.0, 1.0)
    rows = rows_at_speed({"speed": speed}, len(TIME))
    assert TIME[rows.start] == pytest.approx(5.0, abs=0.2)
    assert TIME[rows.stop - 1] == pytest.approx(25.0, abs=0.2)
    assert rows_at_speed({"Y": ONE}, len(TIME)) == ALL
    one_spike = np.where(np.arange(len(TIME)) == 40, 100.0, 1.5)
    assert rows_at_speed({"u": one_spike}, len(TIME)) == ALL


def test_rudder_and_heel():
    run = Run("rudder", "static_rudder", speed=1.5, rudder_angle=0.35, heel=0.1)

    def rules(**channels):
        return [item.rule for item in audit_constant_angles(channels, ALL, run)]

    assert rules(rudder_angle=0.35 * ONE, phi=0.1 * ONE) == []
    assert rules(rudder_angle=-0.35 * ONE) == ["rudder-sign"]
    assert rules(rudder_angle=20.05 * ONE) == ["angle-in-degrees"]
    assert rules(phi=5.73 * ONE) == ["angle-in-degrees"]
