"""Signs that fail together tell whose sign is wrong."""

import math
from dataclasses import replace

import pytest

from towtank.core import Ship
from towtank.pmm.audit_signs import audit_exchanged_forces, audit_rudder_sign, audit_signs
from towtank.pmm.linear_slopes import LinearSlopes, RunSummary
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.0, 0.4, 0.14, rho=1000.0)
SOUND = LinearSlopes(-0.3, -0.15, -0.02, 0.5, -0.3, -0.11, -0.05, -0.007)
DRIFT = LinearSlopes(-0.3, -0.15, -0.02, 0.5)


def turned(slopes, *names):
    return replace(slopes, **{name: -getattr(slopes, name) for name in names})


ALL = ("Yv", "Nv", "X0", "sway_damping", "sway_added_mass", "yaw_damping", "yaw_added_inertia")


@pytest.mark.parametrize(
    "slopes", [SOUND, DRIFT, LinearSlopes(), replace(DRIFT, X0=None), replace(SOUND, Nv=0.01)]
)
def test_sound_signs(slopes):
    assert audit_signs(slopes) == []


@pytest.mark.parametrize(
    ("slopes", "rule", "place"),
    [
        (turned(SOUND, *ALL), "force-sign", "X, Y, N"),
        (turned(DRIFT, "Yv", "Nv", "X0"), "force-sign", "X, Y, N"),
        (turned(DRIFT, "Yv", "Nv"), "drift-sign", "static drift"),
        (turned(SOUND, "Yv", "Nv"), "drift-sign", "static drift"),
        (turned(replace(DRIFT, Nv=None), "Yv"), "drift-sign", "static drift"),
        (turned(DRIFT, "Yv"), "force-sign", "Y"),
        (turned(SOUND, "Yv", "sway_damping", "sway_added_mass"), "force-sign", "Y"),
        (turned(SOUND, *(name for name in ALL if name != "X0")), "force-sign", "Y and N"),
        (turned(SOUND, "Nv", "yaw_damping", "yaw_added_inertia"), "force-sign", "N"),
        (turned(DRIFT, "X0"), "force-sign", "X"),
    ],
)
def test_wrong_signs(slopes, rule, place):
    found = audit_signs(slopes)
    assert [(item.rule, item.place) for item in found] == [(rule, place)]
    assert found[0].severity == ("warning" if place == "X" else "error")


def test_a_positive_added_mass_alone_is_no_matter_of_sign():
    assert audit_signs(turned(SOUND, "sway_added_mass", "yaw_added_inertia")) == []


def drift(degrees, **force):
    v = -math.sin(math.radians(degrees))
    unit = 0.5 * SHIP.rho * SHIP.L * SHIP.T * 1.5**2
    true = {"X": -0.02 - 0.05 * v**2, "Y": -0.3 * v - 1.8 * v**3, "N": -0.15 * v * SHIP.L}
    run = Run(f"{degrees}", "static_drift", speed=1.5, drift_angle=math.radians(degrees))
    return RunSummary(run, {name: unit * value for name, value in true.items()})


@pytest.mark.parametrize("angles", [(-20, -10, -5, 0, 5, 10, 20), (0, 3, 6, 9, 12), (5, 10, 15, 20)])
def test_exchanged_forces(angles):
    runs = [drift(a) for a in angles]
    assert audit_exchanged_forces(runs, SHIP) == []
    crossed = [replace(one, mean_force={"X": one.mean_force["Y"], "Y": one.mean_force["X"]}) for one in runs]
    assert [item.rule for item in audit_exchanged_forces(crossed, SHIP)] == ["swapped-channels"]
    assert audit_exchanged_forces(crossed[:3], SHIP) == []


def rudder(degrees, slope, drift_angle=0.0):
    unit = 0.5 * SHIP.rho * SHIP.L * SHIP.T * 1.5**2
    angle = math.radians(degrees)
    kind = "drift_rudder" if drift_angle else "static_rudder"
    run = Run(f"{degrees}", kind, speed=1.5, rudder_angle=angle, drift_angle=drift_angle)
    force = {"Y": -slope * angle + 2.0 * drift_angle, "N": 0.5 * slope * angle * SHIP.L}
    return RunSummary(run, {name: unit * value for name, value in force.items()})


def test_the_sign_of_the_rudder():
    for drift_angle in (0.0, 0.1):
        assert audit_rudder_sign([rudder(a, 0.05, drift_angle) for a in (-20, 0, 20)], SHIP) == []
        found = audit_rudder_sign([rudder(a, -0.05, drift_angle) for a in (-20, 0, 20)], SHIP)
        assert [item.rule for item in found] == ["rudder-sign"]


def test_rudders_that_show_nothing():
    assert audit_rudder_sign([rudder(a, -0.001) for a in (-20, 20)], SHIP) == []
    assert audit_rudder_sign([rudder(20, -0.05)], SHIP) == []
    assert audit_rudder_sign([rudder(20, -0.05), rudder(-20, -0.05, 0.1)], SHIP) == []
