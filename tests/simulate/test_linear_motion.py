"""One linear form for all conventions."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ConventionError
from towtank.datasets import load_set
from towtank.simulate.linear_motion import linear_motion


def test_mmg_set_receives_mass_and_added_mass():
    derivatives = load_set("kvlcc2")
    ship = derivatives.ship
    unit = 0.5 * ship.L**2 * ship.T
    m, xg = ship.volume / unit, ship.xG / ship.L
    motion = linear_motion(derivatives)
    assert motion.damping == pytest.approx(
        np.array([[-0.315, 0.083 - m - 0.022], [-0.137, -0.049 - m * xg]]), rel=1e-12
    )
    yaw = m * 0.25**2 + m * xg**2 + 0.011
    assert motion.mass == pytest.approx(np.array([[m + 0.223, m * xg], [m * xg, yaw]]), rel=1e-12)


def test_abkowitz_set_holds_all_of_it_already():
    derivatives = load_set("mariner")
    length_over_draught = derivatives.ship.L / derivatives.ship.T
    motion = linear_motion(derivatives)
    expected = np.array([[-1160e-5, -499e-5], [-264e-5, -166e-5]]) * length_over_draught
    assert motion.damping == pytest.approx(expected, rel=1e-12)
    # printed with the rudder positive to port
    assert motion.rudder == pytest.approx(np.array([-278e-5, 139e-5]) * length_over_draught)


def test_products_with_the_surge_velocity_are_taken_on_the_course():
    derivatives = load_set("esso-190k")
    ship = derivatives.ship
    # bis: forces over weight and speeds over sqrt(g L), so that Y'' u'' v'' is Y'' m U v / L
    unit = ship.volume / (0.5 * ship.L**2 * ship.T)
    assert linear_motion(derivatives).value("Yv") == pytest.approx(-1.205 * unit)
    assert linear_motion(derivatives).value("Nr") == pytest.approx(-0.231 * unit)


def test_depth_terms_are_taken_at_the_depth_of_the_ship():
    deep = load_set("esso-190k")
    shallow = replace(deep, ship=replace(deep.ship, depth=2.0 * deep.ship.T))
    unit = deep.ship.volume / (0.5 * deep.ship.L**2 * deep.ship.T)
    change = linear_motion(shallow).value("Nv") - linear_motion(deep).value("Nv")
    assert change == pytest.approx(-0.241 * unit)


@pytest.mark.parametrize(
    "changes",
    [
        {"force_scaling": "L2"},
        {"origin": "cog"},
        {"sway_variable": "beta"},
        {"sway_variable": "beta", "drift_sign": "+v"},
        {"axes": "forward-port-up"},
        {"rudder_sign": "port"},
        {"added_mass_coriolis": "inside"},
        {"rigid_body_inertia": "inside"},
        {"force_sign": "by-ship"},
        {"velocity_scale": "approach", "origin": 0.1},
        {"force_scaling": "bis"},
        {"force_scaling": "dimensional"},
    ],
)
def test_conventions_do_not_matter(changes):
    derivatives = load_set("kvlcc2").with_values(Yd=-0.1, Nd=0.05, Yrdot=0.0, Nvdot=0.0)
    home = linear_motion(derivatives)
    other = linear_motion(derivatives.to(derivatives.conventions.but(**changes)))
    assert other.damping == pytest.approx(home.damping, rel=1e-9)
    assert other.mass == pytest.approx(home.mass, rel=1e-9, abs=1e-12)
    assert other.rudder == pytest.approx(home.rudder, rel=1e-9)


def test_covariance_follows_the_conventions():
    derivatives = load_set("kvlcc2").subset(["Yv", "Yr", "Nv", "Nr", "Xudot", "Yvdot", "Nrdot"])
    sd = 0.05 * np.abs(derivatives.values)
    known = replace(derivatives, covariance=np.diag(sd**2))
    # Yr - m' - mx' varies with Yr and with mx'
    found = linear_motion(known).covariance(("Yr", "Yvdot"))
    assert found[0, 0] == pytest.approx((0.05 * 0.083) ** 2 + (0.05 * 0.022) ** 2)
    assert found[1, 1] == pytest.approx((0.05 * 0.223) ** 2)
    scaled = linear_motion(known.to("prime")).covariance(("Yr", "Yvdot"))
    assert scaled == pytest.approx(found, rel=1e-10)


def test_what_is_missing_is_named():
    derivatives = load_set("kvlcc2")
    with pytest.raises(ConventionError, match="has no Nr"):
        linear_motion(derivatives.subset([name for name in derivatives.names if name != "Nr"]))
    with pytest.raises(ConventionError, match="needs Xudot"):
        linear_motion(derivatives.subset([name for name in derivatives.names if name != "Xudot"]))
    steady = derivatives.subset(["Yv", "Yr", "Nv", "Nr", "Xudot"])
    assert linear_motion(steady).damping == pytest.approx(linear_motion(derivatives).damping)
    with pytest.raises(ConventionError, match="no added masses"):
        _ = linear_motion(steady).mass
    with pytest.raises(ConventionError, match="no rudder derivatives"):
        _ = linear_motion(derivatives).rudder


def test_unknown_yaw_inertia_is_named():
    with pytest.raises(ConventionError, match="yaw inertia of 'S-175 model' is not known"):
        _ = linear_motion(load_set("s175")).mass


def test_quadratic_and_coupled_terms_do_not_count():
    values = {"Yv": -0.3, "Yr": 0.05, "Nv": -0.1, "Nr": -0.05, "Xudot": -0.02}
    more = {"Yv|v|": -3.0, "Yvphi": 1.0, "Yphi": 0.4, "Yvu": -1.0, "Nvvr": -0.4, "Yveta": 2.0, "Kv": 9.0}
    ship = load_set("kvlcc2").ship
    plain = DerivativeSet.from_values("plain", ship, values, HOME)
    full = DerivativeSet.from_values("full", ship, values | more, HOME)
    assert np.array_equal(linear_motion(plain).damping, linear_motion(full).damping)
