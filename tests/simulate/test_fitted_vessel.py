"""A derivative set as a ship: parts from a named ship when asked, else the names of what is missing."""

from dataclasses import replace

import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError, DatasetError, SimulationError
from towtank.core.ship import Ship
from towtank.datasets import load_set
from towtank.simulate.cross_flow import CrossFlow
from towtank.simulate.fitted_vessel import vessel_from_set
from towtank.simulate.manoeuvres import initial_turning
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship, named_ships
from towtank.simulate.validity import missing_coupling

BARE = Ship("bare hull", 3.5, 0.635, 0.2275)


def fitted(**changes):
    values = {"R0": 0.02, "Yv": -0.3, "Yr": 0.08, "Nv": -0.13, "Nr": -0.05} | changes
    return DerivativeSet.from_values("fitted", BARE, values, HOME)


def test_everything_that_is_missing_is_named():
    with pytest.raises(SimulationError) as error:
        vessel_from_set(fitted())
    for part in (
        "propeller",
        "rudder",
        "steering gear",
        "approach speed",
        "volume or mass",
        "Izz or kzz",
        "Yvdot",
    ):
        assert part in str(error.value)
    assert "resistance" not in str(error.value)


def test_resistance_is_asked_for():
    bare = fitted().subset(["Yv", "Yr", "Nv", "Nr"])
    with pytest.raises(SimulationError, match="resistance"):
        vessel_from_set(bare, like="kvlcc2")


@pytest.mark.parametrize(("left_out", "lacking"), [("Nr", "damping of yaw"), ("Yv", "damping of sway")])
def test_damping_is_asked_for(left_out, lacking):
    names = [name for name in ("R0", "Yv", "Yr", "Nv", "Nr") if name != left_out]
    with pytest.raises(SimulationError, match=f"cannot be sailed: it lacks the {lacking}"):
        vessel_from_set(fitted().subset(names), like="kvlcc2")


def test_cross_flow_drag_damps_too():
    drag = CrossFlow([-0.5, 0.0, 0.5], [0.8, 0.8, 0.8], [1.0, 1.0, 1.0])
    bare = fitted().subset(["R0", "Nv"])
    assert vessel_from_set(bare, like="kvlcc2", cross_flow=drag).cross_flow is drag


def test_coupling_that_was_not_measured_is_told():
    vessel = vessel_from_set(fitted().subset(["R0", "Yv", "Nr"]), like="kvlcc2")
    said = [found.message for found in sail(vessel, initial_turning(10.0)).provenance.findings]
    assert sum("sway force does not depend on the yaw rate" in line for line in said) == 1
    assert sum("yaw moment does not depend on the drift" in line for line in said) == 1
    for ship in named_ships():
        assert missing_coupling(named_ship(ship)) == [], ship


def test_parts_of_a_named_ship_are_enlarged_to_the_hull():
    donor = named_ship("kvlcc2")
    vessel = vessel_from_set(fitted(), like="kvlcc2")
    assert pytest.approx(0.5) == vessel.propeller.D / donor.propeller.D
    assert vessel.rudder.area == pytest.approx(0.25 * donor.rudder.area)
    assert vessel.gear.rate == pytest.approx(donor.gear.rate * 2**0.5)
    assert vessel.speed == pytest.approx(donor.speed / 2**0.5)
    assert vessel.ship.displacement_mass == pytest.approx(donor.ship.displacement_mass / 8 * 1.025)
    assert vessel.ship.kzz == pytest.approx(0.875)
    assert vessel.hull["Yvdot"] == -0.223
    assert set(vessel.sources) == {
        "hull", "propeller", "rudder", "steering gear", "speed", "added masses", "inertia",
    }  # fmt: skip


def test_what_the_set_holds_stays():
    vessel = vessel_from_set(replace(fitted(Yvdot=-0.2, Nrdot=-0.01), reference_speed=0.9), like="kvlcc2")
    assert (vessel.speed, vessel.hull["Yvdot"], vessel.hull["Xudot"]) == (0.9, -0.2, -0.022)
    assert vessel.sources["added masses"] == "Xudot of kvlcc2"


def test_rudder_derivatives_and_deviations_need_no_rudder_and_no_propeller():
    mariner = named_ship("mariner")
    vessel = vessel_from_set(load_set("mariner"), gear=mariner.gear)
    assert (vessel.rudder, vessel.propeller) == (None, None)
    donated = vessel_from_set(load_set("mariner"), like="kvlcc2")
    assert (donated.rudder, donated.propeller) == (None, None)


def test_added_masses_come_out_of_other_conventions():
    kcs = named_ship("kcs")
    vessel = vessel_from_set(fitted(), like=kcs)
    assert vessel.hull["Yvdot"] == pytest.approx(-44324.18 / (0.5 * kcs.ship.L**2 * kcs.ship.T))
    # the Mariner's are in L^2 scaling with its own mass inside
    mariner = named_ship("mariner")
    vessel = vessel_from_set(fitted(), like=mariner, rudder=kcs.rudder, propeller=kcs.propeller)
    assert vessel.hull["Yvdot"] == pytest.approx(-748e-5 * mariner.ship.L / mariner.ship.T)
    with pytest.raises(ConventionError, match="yaw inertia of 'Esso"):
        vessel_from_set(fitted(), like="esso190k")


def test_an_unknown_donor_is_answered():
    with pytest.raises(DatasetError, match="kvlcc2"):
        vessel_from_set(fitted(), like="kvlcc3")
