"""The complete ship about its straight course, against the linear motion of its hull and against its autopilot."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import ConventionError
from towtank.simulate.autopilot import Autopilot, closed_loop_roots, linear_nomoto
from towtank.simulate.linear_motion import linear_motion
from towtank.simulate.on_course import ship_on_course
from towtank.simulate.ships import named_ship


@pytest.mark.parametrize("name", ["kvlcc2", "kcs", "mariner", "esso190k", "dtmb5512", "s175-3dof"])
def test_without_its_rudder_a_ship_is_its_hull(name):
    vessel = named_ship(name)
    found = ship_on_course(replace(vessel, rudder=None))
    assert found.states == ("v", "r")
    # modulus terms leave the size of the disturbance
    assert found.free == pytest.approx(linear_motion(vessel.hull).free, rel=1e-4)


def test_rudder_derivatives_are_those_of_the_set():
    vessel = named_ship("mariner")
    assert ship_on_course(vessel).by_rudder == pytest.approx(linear_motion(vessel.hull).by_rudder, rel=1e-8)


def test_rudder_amidships_steadies_the_ship():
    vessel = named_ship("kvlcc2")
    bare, whole = ship_on_course(replace(vessel, rudder=None)), ship_on_course(vessel)
    assert bare.roots[0].real == pytest.approx(0.32, abs=5e-3)
    assert abs(whole.roots[0].real) < 0.02
    assert whole.by_rudder[0] < 0 < whole.by_rudder[1]


def test_disturbance_grows_at_the_largest_root():
    found = ship_on_course(named_ship("dtmb5512"))
    assert not found.stable
    values, vectors = np.linalg.eig(found.free)
    growing = vectors[:, np.argmax(values.real)].real
    assert found.free @ growing == pytest.approx(found.roots[0].real * growing)


def test_ship_that_rolls_has_roll_roots():
    found = ship_on_course(named_ship("s175-4dof"))
    assert found.states == ("v", "r", "p", "phi")
    rolling = found.roots[np.abs(found.roots.imag) > 0]
    assert len(rolling) == 2
    assert rolling[0].real < 0
    assert found.stable
    # a roll angle of its own is integrated
    assert found.free[3] == pytest.approx([0, 0, 1, 0], abs=1e-12)
    with pytest.raises(ConventionError, match="no second-order Nomoto"):
        linear_nomoto(found)


def test_autopilot_holds_the_complete_ship():
    found = ship_on_course(named_ship("kvlcc2"))
    nomoto = linear_nomoto(found)
    s = 0.2 + 1.3j
    response = np.linalg.solve(s * np.eye(2) - found.free, found.by_rudder)[1]
    assert nomoto.K * (1 + nomoto.T3 * s) / ((1 + nomoto.T1 * s) * (1 + nomoto.T2 * s)) == pytest.approx(response)
    roots = closed_loop_roots(found, Autopilot(1.0, 1.0))
    assert roots[0].real < 0
    rolling = closed_loop_roots(ship_on_course(named_ship("s175-4dof")), Autopilot(1.0, 1.0, 0.05), 0.1)
    assert len(rolling) == 7
    assert rolling[0].real < 0


def test_missing_self_propulsion_point_is_named():
    vessel = named_ship("kvlcc2")
    pushed = replace(vessel, hull=vessel.hull.with_values(R0=-5.0))
    with pytest.raises(ConventionError, match="self-propulsion point"):
        ship_on_course(pushed)
