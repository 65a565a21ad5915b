"""Which wrong factor means what."""

import math

import pytest

from towtank.core import Ship
from towtank.pmm.audit_factors import (
    compare_angle,
    compare_sign,
    compare_size,
    compare_speed,
    explain_angle,
    explain_length,
    explain_speed,
    is_opposite,
)
from towtank.pmm.run_types import Run

SHIP = Ship("model", 3.0, 0.4, 0.14, scale=46.6)


@pytest.mark.parametrize("ratio", [1.0, 1.2, 50.0, 0.0, -57.3])
def test_factors_without_meaning(ratio):
    assert explain_angle(ratio) == ""
    assert explain_speed(ratio, 46.6) == ""
    assert explain_length(ratio) == ""


def test_angles_and_lengths():
    assert "degrees were" in explain_angle(180 / math.pi)
    assert "radians were" in explain_angle(math.pi / 180)
    assert "millimetres were" in explain_length(1010.0)
    assert "centimetres were" in explain_length(99.0)
    assert "millimetres" in explain_length(0.00099)


@pytest.mark.parametrize(
    ("ratio", "word"), [(1.9438, "knots"), (3.6, "km/h"), (math.sqrt(46.6), "full-scale"), (0.001, "mm/s")]
)
def test_speeds(ratio, word):
    assert word in explain_speed(ratio, 46.6)


def test_the_root_of_scale_one_explains_nothing():
    assert explain_speed(1.02, 1.0) == ""


@pytest.mark.parametrize(("ratio", "severity"), [(1.04, None), (1.1, "warning"), (1.4, "error"), (0.5, "error")])
def test_sizes(ratio, severity):
    found = compare_size("psi", ratio, "an amplitude", "0.1")
    assert [item.severity for item in found] == ([severity] if severity else [])
    assert all(item.rule == "amplitude-mismatch" for item in found)


def test_units_belong_to_their_kind_of_channel():
    assert compare_size("psi", 57.3, "", "")[0].rule == "angle-in-degrees"
    assert compare_size("y", 57.3, "", "")[0].rule == "amplitude-mismatch"
    assert compare_size("y", 1000.0, "", "")[0].rule == "length-in-millimetres"


@pytest.mark.parametrize(
    ("speed", "severity"), [(1.02, None), (1.1, "warning"), (1.5, "error"), (1.9438, "error")]
)
def test_speed_comparison(speed, severity):
    assert [item.severity for item in compare_speed("u", speed, 1.0, SHIP)] == ([severity] if severity else [])


def test_constant_angles_and_signs():
    assert compare_angle("psi", 0.1, 0.1, "drift-sign") == []
    assert compare_angle("psi", -0.1, 0.1, "drift-sign")[0].rule == "drift-sign"
    assert compare_angle("psi", -5.73, 0.1, "drift-sign")[0].rule == "angle-in-degrees"
    assert compare_angle("psi", 0.0, 0.1, "drift-sign") == []
    run = Run("a", "static_drift", speed=1.0, drift_angle=0.1)
    assert "5.73 deg" in compare_sign("v", 0.1, -0.1, "m/s", run)[0].message
    assert compare_sign("v", 0.0, -0.1, "m/s", run) == []
    assert is_opposite(-0.9, 1.0)
    assert not is_opposite(0.9, 1.0)
