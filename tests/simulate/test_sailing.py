"""Whole manoeuvres: published values, symmetry, scale, tolerance, current, failures."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.environment import Current, Environment
from towtank.simulate.manoeuvres import course_keeping, crash_stop, turning, zigzag
from towtank.simulate.sailing import sail, sail_events
from towtank.simulate.ships import named_ship

KVLCC2 = named_ship("kvlcc2")
FINE = 1e-9


def mirrored(vessel):
    """The same ship seen in a mirror: what depends on the side is exchanged."""
    p, r = vessel.propeller, vessel.rudder
    return vessel.but(
        propeller=replace(p, C2_positive=p.C2_negative, C2_negative=p.C2_positive),
        rudder=replace(r, gammaR_positive=r.gammaR_negative, gammaR_negative=r.gammaR_positive),
    )


def test_kvlcc2_turning_circle_has_the_computed_advance_and_tactical_diameter():
    # converged integration of the same set: 3.077 L, 1.324 L, 3.107 L to starboard, 3.088 L and 3.093 L to port
    for rudder, advance, transfer, diameter in ((35, 3.077, 1.324, 3.107), (-35, 3.088, 1.324, 3.093)):
        events = sail_events(KVLCC2, turning(rudder)).events
        assert events.at("heading 90", "x")[0] / 7.0 == pytest.approx(advance, abs=2e-3)
        assert abs(events.at("heading 90", "y")[0]) / 7.0 == pytest.approx(transfer, abs=2e-3)
        assert abs(events.at("heading 180", "y")[0]) / 7.0 == pytest.approx(diameter, abs=2e-3)


def test_kvlcc2_overshoots_are_those_of_kim_2021():
    for rudder, first, second in ((10, 5.0, 14.0), (-10, 7.2, 9.1)):
        events = sail_events(KVLCC2, zigzag(rudder)).events
        found = [abs(math.degrees(events.at(f"extreme {k}", "psi")[0])) - 10.0 for k in (1, 2)]
        assert found == pytest.approx([first, second], abs=0.3)


def test_mirrored_ship_sails_the_mirrored_track():
    starboard = sail_events(KVLCC2, turning(35), tolerance=FINE).events
    port = sail_events(mirrored(KVLCC2), turning(-35), tolerance=FINE).events
    sign = np.array([1, 1, -1, -1, 1, -1, -1, -1, -1, -1, 1])
    for name in starboard.names:
        assert port[name][0] == pytest.approx(sign * starboard[name][0], rel=1e-9, abs=1e-9)


def test_ship_without_rudder_angle_stays_straight():
    straight = sail(KVLCC2, course_keeping(200.0))
    assert np.all(straight["y"] == 0.0)
    assert straight["u"] == pytest.approx(1.18, rel=1e-9)


def test_two_scales_sail_the_same_prime_track():
    model = sail_events(KVLCC2, turning(35), tolerance=1e-7)
    ship = sail_events(KVLCC2.at_scale(1.0, rho=1025.0), turning(35), tolerance=1e-7)
    k = 45.714
    units = np.array([k**0.5, k, k, 1, k**0.5, k**0.5, k**-0.5, 1, k**-0.5, 1, k**-0.5])
    assert ship.steps[0] == model.steps[0]
    for name in model.events.names:
        assert ship.events[name][0] / units == pytest.approx(model.events[name][0], rel=1e-9, abs=1e-9)


def test_result_does_not_depend_on_the_tolerance_below_one_millionth():
    coarse, fine = (sail_events(KVLCC2, zigzag(20), tolerance=t).events for t in (1e-6, 1e-10))
    for k in (1, 2, 3):
        there, here = coarse.at(f"extreme {k}", "psi")[0], fine.at(f"extreme {k}", "psi")[0]
        assert there == pytest.approx(here, abs=3e-6)


def test_default_tolerance_of_draws_is_enough_for_the_indices():
    for programme in (turning(35), zigzag(10)):
        coarse, fine = (sail_events(KVLCC2, programme, tolerance=t).events for t in (1e-4, FINE))
        for name in coarse.names:
            assert coarse.at(name, "psi")[0] == pytest.approx(fine.at(name, "psi")[0], abs=math.radians(0.02))
            if name.startswith("heading"):
                assert coarse.at(name, "x")[0] == pytest.approx(fine.at(name, "x")[0], abs=7e-3)
                assert coarse.at(name, "y")[0] == pytest.approx(fine.at(name, "y")[0], abs=7e-3)


def test_uniform_current_only_carries_the_track():
    calm = sail_events(KVLCC2, zigzag(10), tolerance=FINE).events
    stream = Environment(current=Current(math.hypot(0.2, 0.1), math.atan2(-0.1, 0.2)))
    carried = sail_events(KVLCC2, zigzag(10), tolerance=FINE, environment=stream).events
    for name in calm.names:
        t = calm.at(name, "time")[0]
        assert carried.at(name, "time")[0] == pytest.approx(t, rel=1e-8)
        assert carried.at(name, "x")[0] == pytest.approx(calm.at(name, "x")[0] + 0.2 * t, abs=1e-6)
        assert carried.at(name, "y")[0] == pytest.approx(calm.at(name, "y")[0] - 0.1 * t, abs=1e-6)


def test_printed_dtmb_5512_set_diverges_and_says_so():
    with pytest.raises(SimulationError, match="diverges"):
        sail(named_ship("dtmb5512"), turning(35))
    draws = sail_events(named_ship("dtmb5512"), turning(35))
    assert draws.failures() == {"the motion diverges": 1}
    assert not draws.completed[0]


def test_manoeuvre_that_is_never_completed_is_an_error():
    with pytest.raises(SimulationError, match="never reached"):
        sail(KVLCC2, turning(35, heading=360.0), patience=1.0)


def test_order_beyond_the_gear_is_an_error():
    with pytest.raises(SimulationError, match="gear stops at 40"):
        sail(KVLCC2.but(gear=replace(KVLCC2.gear, limit=math.radians(40.0))), turning(50))


def test_astern_needs_a_propeller():
    with pytest.raises(SimulationError, match="nothing is known about its thrust there"):
        sail(named_ship("mariner"), crash_stop())


@pytest.mark.parametrize("name", ["kvlcc2", "kcs", "dtc", "s175-3dof", "s175-4dof"])
def test_named_ship_with_an_open_water_diagram_stops_by_an_assumed_thrust_which_is_a_finding(name):
    vessel = named_ship(name)
    found = sail(vessel, crash_stop())
    assert found.events.at("stopped", "u")[0] == pytest.approx(0.0, abs=1e-9)
    assumed = [finding for finding in found.provenance.findings if finding.rule == "assumption"]
    assert len(assumed) == 1
    assert f"{0.65 * vessel.propeller.KT[0]:.4g}" in assumed[0].message
    given = vessel.but(propeller=replace(vessel.propeller, astern_KT=0.65 * float(vessel.propeller.KT[0])))
    again = sail(given, crash_stop())
    assert again.events.at("stopped", "x")[0] == found.events.at("stopped", "x")[0]
    assert all(finding.rule != "assumption" for finding in again.provenance.findings)


def test_draws_that_fail_are_counted_among_those_that_do_not():
    values = np.repeat(KVLCC2.hull.values[None], 3, axis=0)
    values[1, KVLCC2.hull.names.index("Yvvv")] = 50.0
    sailed = sail_events(KVLCC2, turning(35), values)
    assert sailed.completed.tolist() == [True, False, True]
    single = sail_events(KVLCC2, turning(35)).events
    for number in (0, 2):
        assert np.array_equal(sailed.events["heading 90"][number], single["heading 90"][0])


def test_leaving_the_measured_range_is_a_finding():
    hull = replace(KVLCC2.hull, validity={"v": (-0.1, 0.1), "r": (-2.0, 2.0)})
    found = sail(KVLCC2.with_hull(hull), turning(35)).provenance.findings
    assert [finding.rule for finding in found] == ["extrapolation"]
    assert "v from" in found[0].message
