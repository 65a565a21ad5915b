"""Corrections of trials in shallow water and the guards of each."""

import math

import pytest

from towtank.core.errors import TowtankError
from towtank.core.variables import GRAVITY
from towtank.squat.speed_corrections import (
    lackenby_speed_loss,
    raven_trial_correction,
    schuster_speed_loss,
)
from towtank.squat.squat_formula import KNOT

TRIAL = {
    "speed": 7.0, "depth": 18.0, "length": 200.0, "draught": 8.0, "volume": 33000.0, "waterplane_area": 5000.0,
    "deep_viscous_resistance": 4e5, "deep_power": 6e6, "propulsive_efficiency": 0.7,
}  # fmt: skip


@pytest.mark.parametrize(("knots", "percent"), [(19, 1.434), (22, 4.55), (24, 7.45)])
def test_lackenby_over_corrects_the_rescue_cruiser_and_is_guarded(knots, percent):
    speed, area = knots * KNOT, 0.02 * 19.5**2
    found = 100 * lackenby_speed_loss(speed, 19.5, area, guarded=False)
    assert found == pytest.approx(percent, abs=0.01)
    with pytest.raises(TowtankError, match=r"Lackenby: .* 0\.020, less than 0\.05"):
        lackenby_speed_loss(speed, 19.5, area)


def test_lackenby_within_its_range():
    # A_M/h^2 = 0.25 in water so deep against the speed that the wave term vanishes
    assert lackenby_speed_loss(1.0, 20.0, 100.0) == pytest.approx(0.1242 * 0.2, abs=1e-12)


def test_schuster_by_hand_and_its_guard():
    expected = 0.05 / (1 - 0.05 - 0.36) + 0.3 * 2 / 3 * 0.6**10
    assert schuster_speed_loss(0.6, 0.05, 0.7) == pytest.approx(expected, rel=1e-14)
    with pytest.raises(TowtankError, match=r"0\.800 above 0\.7"):
        schuster_speed_loss(0.8, 0.05, 0.7)
    with pytest.raises(TowtankError, match="no flow"):
        schuster_speed_loss(0.99, 0.05, 0.7, guarded=False)


def test_trial_correction_part_by_part():
    found = raven_trial_correction(**TRIAL)
    wide, deep = 49 / (GRAVITY * 18), 49 / (0.3 * GRAVITY * 200)
    excess = wide / math.sqrt(1 - wide) - deep / math.sqrt(1 - deep)
    assert found.additional_sinkage == pytest.approx(1.46 * 33000 / 200**2 * excess)
    assert found.volume_change == pytest.approx(1.46 * 5000 / 200**2 * excess)
    assert found.viscous_power == pytest.approx(4e5 * 0.57 * (8 / 18) ** 1.79 * 7.0 / 0.7)
    assert found.sinkage_power == pytest.approx(6e6 * 2 / 3 * found.volume_change, rel=0.02)
    assert found.power == found.viscous_power + found.sinkage_power


def test_deep_water_costs_no_sinkage():
    found = raven_trial_correction(**{**TRIAL, "depth": 60.0})
    assert found.sinkage_power == 0.0
    assert 0 < found.viscous_power < raven_trial_correction(**TRIAL).viscous_power


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"speed": 9.0}, "above 0.65"),
        ({"draught": 9.1}, "T/h = 0.506"),
        ({"length": 24.7, "speed": 9.8, "depth": 25.0}, r"0\.3 g L"),
        ({"waterplane_area": 7000.0, "length": 110.0, "speed": 7.5}, "displacement changes by"),
    ],
)
def test_limits_of_the_trial_correction(change, said):
    with pytest.raises(TowtankError, match=said):
        raven_trial_correction(**{**TRIAL, **change})
