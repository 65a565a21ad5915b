"""Manoeuvres of the gallery: the counting of a widely used program, heel."""

import pytest

from towtank.reproduce.sailed_manoeuvres import largest_heel, overshoots, turn, turn_after_approach
from towtank.simulate.manoeuvres import turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship


def test_after_a_straight_approach_both_countings_agree():
    vessel = named_ship("kvlcc2")
    plain, counted = turn(vessel, -35.0), turn_after_approach(vessel, -35.0)
    length = vessel.ship.L
    late = 0.4 * vessel.speed
    assert counted["advance"] == pytest.approx(plain["advance"] * length - late, abs=2e-3)
    assert counted["tactical diameter"] == pytest.approx(plain["tactical diameter"] * length, rel=1e-4)
    assert counted["radius"] == pytest.approx(0.5 * plain["steady diameter"] * length, rel=1e-3)


def test_overshoots_are_mirrored_for_a_symmetric_ship():
    vessel = named_ship("dtc")
    assert overshoots(vessel, 20.0) == pytest.approx(overshoots(vessel, -20.0), abs=1e-6)


def test_heel_is_outward():
    vessel = named_ship("s175-4dof")
    port, starboard = (largest_heel(sail(vessel, turning(angle, 360.0))) for angle in (-15.0, 15.0))
    assert starboard == pytest.approx(-port, abs=1e-6)
    assert starboard < -10.0


def test_roll_is_told_for_a_ship_that_rolls():
    assert "roll peak" not in turn_after_approach(named_ship("mariner"), 15.0)
    found = turn_after_approach(named_ship("s175-4dof"), 15.0)
    assert found["roll peak"] < found["roll end"] < 0.0
