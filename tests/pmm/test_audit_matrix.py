"""Ship and test matrix before anything is read."""

import math
from pathlib import Path

import pytest

from towtank.core import HOME, Ship
from towtank.pmm.audit_matrix import audit_matrix
from towtank.pmm.run_types import Run
from towtank.pmm.standard_matrices import STANDARD_MATRICES, standard_matrix

MODEL = Ship("model", 3.048, 0.41, 0.136, volume=0.086, mass=86.0, rho=1000.0, scale=46.6)
FULL = Ship("ship", 320.0, 58.0, 20.8, volume=312600.0)


def drift(*degrees, speed=1.5, **more):
    return [Run(f"{a}", "static_drift", speed=speed, drift_angle=math.radians(a), **more) for a in degrees]


def rules(runs, ship=MODEL, conventions=HOME):
    return {item.rule: item.severity for item in audit_matrix(runs, ship, conventions)}


@pytest.mark.parametrize("name", STANDARD_MATRICES)
@pytest.mark.parametrize("ship", [MODEL, FULL], ids=["model", "full"])
def test_programmes_of_the_literature_are_clean(name, ship):
    assert rules(standard_matrix(name, ship), ship) == {}


def test_no_run_is_no_fault():
    assert rules([]) == {}
    assert rules([Run("dry", "dry_sway", frequency=1.0, sway_amplitude=0.1)]) == {}


def test_labels_of_scale():
    long = Ship("ship", 142.0, 19.1, 6.3, scale=46.6)
    assert rules(drift(0, 4, speed=10.0), long) == {"scale-label": "error"}
    unlabelled = Ship("model", 3.048, 0.41, 0.136)
    assert rules(drift(0, 4), unlabelled) == {"scale-label": "warning"}
    assert rules(drift(0, 4), MODEL, HOME.but(scale="full")) == {"scale-label": "warning"}


@pytest.mark.parametrize(("speed", "severity"), [(3.4, "warning"), (10.45, "error")])
def test_froude_numbers_of_a_model(speed, severity):
    assert rules(drift(0, 4, speed=speed)) == {"scale-label": severity}


def test_the_speed_of_a_model_at_the_length_of_a_ship():
    assert rules(drift(0, 4, speed=1.18, file=Path("a.txt")), FULL) == {"scale-label": "warning"}
    assert rules(drift(0, 4, speed=1.0), FULL) == {}, "tables of points carry a nominal speed"


def test_mass_over_volume_is_the_density():
    salt = Ship("model", 3.048, 0.41, 0.136, volume=0.086, mass=86.0, rho=1025.0, scale=46.6)
    assert rules([], salt) == {"density": "warning"}
    light = Ship("model", 3.048, 0.41, 0.136, volume=0.086, mass=80.0, rho=1025.0, scale=46.6)
    assert rules([], light) == {}, "a model may be lighter than what it displaces"


@pytest.mark.parametrize(
    "runs",
    [
        [Run("a", "static_drift", speed=1.5, drift_angle=6.0)],
        [Run("a", "static_rudder", speed=1.5, rudder_angle=-20.0)],
        [Run("a", "static_heel", speed=1.5, heel=5.0)],
        [Run("a", "sway_yaw", speed=1.5, frequency=1.0, sway_amplitude=0.1, yaw_amplitude=8.0)],
        drift(0.05, 0.1, 0.2),
    ],
)
def test_units_of_angles(runs):
    assert rules(runs) == {"angle-in-degrees": "error"}


def test_towing_astern_and_a_single_small_angle_are_possible():
    assert rules(drift(-180, 90, 0)) == {}
    assert rules(drift(0.5, 0)) == {}
