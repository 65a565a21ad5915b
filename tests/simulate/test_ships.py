"""Named ships are complete, say where their numbers come from, and unknown names are answered."""

import math

import pytest

from towtank.core.errors import DatasetError
from towtank.datasets import load_set
from towtank.simulate.ships import named_ship, named_ships


@pytest.mark.parametrize("name", list(named_ships()))
def test_every_ship_is_complete(name):
    vessel = named_ship(name)
    assert vessel.name == name
    assert vessel.sources["hull"]
    assert vessel.gear.rate > 0.0
    assert {"Xudot", "Yvdot", "Nrdot"} <= set(vessel.hull.names)
    steered = any("delta" in term.variables for term in vessel.hull.terms)
    assert steered == (vessel.rudder is None)
    driven_by_terms = any("u" in term.variables for term in vessel.hull.terms if term.component == "X")
    assert driven_by_terms == (vessel.propeller is None)
    assert "\n" not in named_ships()[name]


def test_case_blanks_and_hyphens_do_not_count():
    assert named_ship("KVLCC2").name == "kvlcc2"
    assert named_ship("Esso 190k").name == "esso190k"
    assert named_ship("S175 4DOF").name == "s175-4dof"


@pytest.mark.parametrize(("wrong", "near"), [("kvlc2", "kvlcc2"), ("s175", "s175-3dof"), ("marina", "mariner")])
def test_unknown_names_are_answered_with_the_nearest(wrong, near):
    with pytest.raises(DatasetError, match=f"no ship '{wrong}'.*{near}"):
        named_ship(wrong)


def test_the_tanker_knows_the_depth_and_others_do_not():
    assert math.isinf(named_ship("esso190k").ship.depth)
    assert "Yuvz" not in named_ship("esso190k", depth_ratio=2.5).hull
    shallow = named_ship("esso190k", depth_ratio=1.2)
    assert shallow.ship.depth == pytest.approx(1.2 * 18.46)
    # z = 1 / 0.2 = 5
    assert shallow.hull["Yuvz"] == pytest.approx(-0.85 * (1.0 - 0.8 / 5.0))
    (term,) = [term for term in shallow.hull.terms if term.name == "Yuvz"]
    assert term.variables == ("v", "surge", "depth")
    with pytest.raises(DatasetError, match=r"kvlcc2.*depth.*esso190k"):
        named_ship("kvlcc2", depth_ratio=1.5)


def test_misprints_are_corrected_unless_asked_otherwise():
    assert named_ship("s175-3dof").hull["Nrrr"] == -0.0422
    assert named_ship("s175-3dof", corrected=False).hull["Nrrr"] == -0.4220
    printed, right = (named_ship("dtc", corrected=flag).rudder.area for flag in (False, True))
    assert printed / right == pytest.approx(0.0095 / 0.0183)
    assert named_ship("s175-3dof-regression", corrected=False).hull["Yv|v|"] == 0.90020


def test_the_misprint_of_a_fitting_is_told_with_those_of_the_derivatives():
    told = named_ship("dtc").hull.provenance.misprints
    assert "rudder area_over_LT: 0.0183 used for the printed 0.0095: aspect ratio and eta" in told[-1]
    told = named_ship("dtc", corrected=False).hull.provenance.misprints
    assert "rudder area_over_LT: 0.0095 as printed, 0.0183 is right" in told[-1]
    assert any(sentence.startswith("Yr:") for sentence in told)


def test_what_a_paper_leaves_out_is_completed_and_said():
    regression, measured = named_ship("s175-3dof-regression"), load_set("s175")
    for name in ("Xuu", "Xvv", "Xvr", "Xrr"):
        assert regression.hull[name] == measured[name]
    (resistance,) = [term for term in regression.hull.terms if term.name == "Xuu"]
    assert resistance.variables == ("surge",)
    assert regression.ship.kzz == 0.25 * 3.5
    assert "not printed" in regression.sources["rudder"]
    assert named_ship("dtc").hull["Yvdot"] == -0.1625
    assert "Clarke" in named_ship("dtc").sources["added_mass"]
    assert "Clarke" in named_ship("dtc").hull.provenance.history[-1]
    assert "speed of the moment" in regression.hull.provenance.history[-1]
    assert named_ship("dtc").rate == 4.42
    assert named_ship("s175-4dof").inertia.lx == 0.0313
