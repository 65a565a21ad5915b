"""Head waves of the DTC model tests."""

import math

import pytest

from towtank.reproduce.dtc_head_waves import added_resistance_unit, depth_of, encounter_frequency
from towtank.reproduce.printed_numbers import ship_of
from towtank.squat.head_waves import met_wave

SHIP = ship_of("dtc-added-resistance")


@pytest.mark.parametrize(
    ("clearance", "speed", "omega"), [(1.0, 0.327, 5.48), (1.0, 0.872, 7.04), (0.2, 0.327, 4.72)]
)
def test_frequency_of_encounter(clearance, speed, omega):
    depth = depth_of(SHIP, clearance)
    ours = encounter_frequency(0.55 * SHIP.L, depth, speed)
    assert ours == pytest.approx(omega, abs=0.005)
    # the same wave, given by its period
    still = encounter_frequency(0.55 * SHIP.L, depth, 0.0)
    assert met_wave(2.0 * math.pi / still, depth, speed).omega_encounter == pytest.approx(ours, rel=1e-9)


def test_unit_of_added_resistance():
    assert added_resistance_unit(SHIP, 0.031175) == pytest.approx(0.783, abs=1e-3)
