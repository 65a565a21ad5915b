"""What a vessel rests on beyond its data: ranges that are left, terms that are missing, scales that are doubtful."""

from __future__ import annotations

from dataclasses import replace

import pytest

from towtank.datasets import load_set
from towtank.simulate.fitted_vessel import vessel_from_set
from towtank.simulate.manoeuvres import crash_stop, initial_turning, turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship, named_ships
from towtank.simulate.validity import assumed_astern, depends, doubtful_scale, left_ranges, missing_coupling

KVLCC2 = load_set("kvlcc2")


@pytest.mark.parametrize("ship", named_ships())
def test_named_ships_are_plausible_and_complete(ship):
    vessel = named_ship(ship)
    assert doubtful_scale(vessel.hull) == []
    assert missing_coupling(vessel) == []


def test_a_set_in_another_scaling_than_its_label_is_told():
    wrong = replace(KVLCC2, conventions=KVLCC2.conventions.but(force_scaling="L2"))
    said = [found.message for found in doubtful_scale(wrong)]
    assert any("times that of a slender body" in line and "L/T is 15.4" in line for line in said)
    vessel = vessel_from_set(wrong, like="kvlcc2", speed=1.18)
    told = [found.message for found in sail(vessel, initial_turning(10.0)).provenance.findings]
    assert set(said) <= set(told)


def test_a_mass_that_is_said_to_be_inside_and_is_not_is_told():
    wrong = replace(KVLCC2, conventions=KVLCC2.conventions.but(rigid_body_inertia="inside"))
    (found,) = doubtful_scale(wrong)
    assert "the added mass in sway is -0.24 of the ship's mass" in found.message
    assert "rigid_body_inertia" in found.cure


def test_an_assumed_thrust_astern_is_told_in_a_crash_stop_alone():
    vessel = named_ship("kvlcc2")
    assert assumed_astern(vessel, turning(35.0)) == []
    (found,) = assumed_astern(vessel, crash_stop())
    assert "assumed to be 0.65 of the bollard thrust" in found.message
    known = vessel.but(propeller=replace(vessel.propeller, astern_KT=0.2))
    assert assumed_astern(known, crash_stop()) == []


def test_each_range_that_is_left_is_told_once():
    vessel = named_ship("kvlcc2")
    narrow = vessel.with_hull(replace(vessel.hull, validity={"r": (-0.3, 0.3)}))
    track = sail(narrow, turning(35.0))
    (found,) = [one for one in track.provenance.findings if one.rule == "extrapolation"]
    assert "r from 0 to" in found.message
    assert left_ranges(vessel.with_hull(replace(vessel.hull, validity={})), track.frame.to_numpy()) == []


def test_terms_are_looked_up_by_force_and_variable():
    assert depends(KVLCC2, "N", "r")
    assert depends(KVLCC2, "Y", "beta", "v")
    assert not depends(KVLCC2.subset(["Yv", "Nv"]), "N", "r")
