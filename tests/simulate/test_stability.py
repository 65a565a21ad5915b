"""Straight-line stability: criterion, levers, roots, and how sure they are."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core.errors import ConventionError
from towtank.core.scales import mass_coefficient
from towtank.datasets import load_set
from towtank.simulate.linear_motion import linear_motion
from towtank.simulate.routh_hurwitz import is_hurwitz
from towtank.simulate.stability import (
    criterion_abkowitz,
    criterion_mmg,
    straight_line_roots,
    straight_line_stability,
)

LINEAR = ["Yv", "Yr", "Nv", "Nr", "Xudot", "Yvdot", "Nrdot"]


def uncertain(share=0.05):
    derivatives = load_set("kvlcc2").subset(LINEAR)
    return replace(derivatives, covariance=np.diag((share * derivatives.values) ** 2))


def test_mariner_is_stable_with_the_time_constants_of_the_handbook():
    # Fossen's handbook: T1 = 118.0 s, T2 = 7.8 s at 15 knots
    derivatives = load_set("mariner")
    found = straight_line_stability(derivatives)
    assert found.stable
    seconds = -derivatives.ship.L / derivatives.reference_speed / found.roots.real
    assert seconds[0] == pytest.approx(118.0, abs=0.05)
    assert seconds[1] == pytest.approx(7.8, abs=0.05)


@pytest.mark.parametrize("key", ["kvlcc2", "esso-190k", "kcs", "dtmb5512-efd"])
def test_ships_that_are_unstable(key):
    found = straight_line_stability(load_set(key))
    assert not found.stable
    assert found.margin < 0
    assert found.roots[0].real > 0 > found.roots[1].real


def test_both_forms_of_the_criterion():
    derivatives = load_set("kvlcc2")
    ship = derivatives.ship
    m, xg = mass_coefficient(ship), ship.xG / ship.L
    linear = [derivatives[name] for name in ("Yv", "Yr", "Nv", "Nr")]
    expected = straight_line_stability(derivatives).criterion
    assert criterion_mmg(*linear, m, 0.022, xg) == pytest.approx(expected)
    inside = derivatives.to("added-mass-inside")
    linear = [inside[name] for name in ("Yv", "Yr", "Nv", "Nr")]
    assert criterion_abkowitz(*linear, m, xg) == pytest.approx(expected)
    assert expected == pytest.approx(-0.0131, abs=1e-4)


def test_criterion_takes_arrays():
    yaw = np.array([-0.03, -0.1])
    found = criterion_mmg(-0.3, 0.05, -0.1, yaw, 0.2, 0.02, 0.0)
    assert found == pytest.approx([0.009 - 0.017, 0.03 - 0.017])


@given(st.floats(0.2, 3.0), st.floats(0.2, 3.0), st.floats(-0.5, 2.0), st.floats(0.2, 4.0))
@settings(max_examples=60, deadline=None)
def test_criterion_levers_and_roots_agree(sway, turn, lever, damping):
    ship = load_set("kvlcc2")
    derivatives = ship.with_values(
        Yv=sway * ship["Yv"], Yr=0.1 * turn, Nv=lever * ship["Nv"], Nr=damping * ship["Nr"]
    )
    found = straight_line_stability(derivatives)
    if abs(found.criterion) > 1e-9:
        assert found.stable == (found.margin > 0) == bool(found.roots[0].real < 0)
        motion = linear_motion(derivatives)
        polynomial = np.poly(np.linalg.solve(motion.mass, motion.damping))
        assert found.stable == is_hurwitz(polynomial)


@pytest.mark.parametrize("changes", [{"origin": "cog"}, {"sway_variable": "beta"}, {"force_scaling": "L2"}])
def test_conventions_do_not_matter(changes):
    derivatives = uncertain()
    home = straight_line_stability(derivatives)
    other = straight_line_stability(derivatives.to(derivatives.conventions.but(**changes)))
    assert other.criterion == pytest.approx(home.criterion, rel=1e-9)
    assert other.criterion_sd == pytest.approx(home.criterion_sd, rel=1e-6)
    assert other.roots == pytest.approx(home.roots, rel=1e-9)
    assert other.roots_sd == pytest.approx(home.roots_sd, rel=1e-6)


def test_uncertainty_is_that_of_many_draws():
    derivatives = uncertain(0.05)
    found = straight_line_stability(derivatives)
    rng = np.random.default_rng(5)
    draws = rng.multivariate_normal(derivatives.values, derivatives.covariance, size=400)
    criteria, levers, roots = [], [], []
    for draw in draws:
        one = straight_line_stability(derivatives.with_values(**dict(zip(LINEAR, draw, strict=True))))
        criteria.append(one.criterion)
        levers.append((one.sway_lever, one.damping_lever))
        roots.append(one.roots.real)
    assert found.criterion_sd == pytest.approx(np.std(criteria), rel=0.12)
    assert (found.sway_lever_sd, found.damping_lever_sd) == pytest.approx(np.std(levers, axis=0), rel=0.12)
    assert found.roots_sd == pytest.approx(np.std(roots, axis=0), rel=0.12)


def test_probability_of_stability():
    derivatives = uncertain(0.25)
    found = straight_line_stability(derivatives)
    expected = 0.5 * (1 + math.erf(found.criterion / found.criterion_sd / math.sqrt(2)))
    assert found.probability == pytest.approx(expected)
    rng = np.random.default_rng(6)
    draws = rng.multivariate_normal(derivatives.values, derivatives.covariance, size=20000)
    values = dict(zip(LINEAR, draws.T, strict=True))
    ship = derivatives.ship
    stable = criterion_mmg(
        *(values[name] for name in ("Yv", "Yr", "Nv", "Nr")),
        mass_coefficient(ship),
        -values["Xudot"],
        ship.xG / ship.L,
    )
    assert found.probability == pytest.approx(float(np.mean(stable > 0)), abs=0.03)
    assert 0.02 < found.probability < 0.5


def test_certain_sets_are_certain():
    derivatives = load_set("kvlcc2").subset(LINEAR)
    known = replace(derivatives, covariance=np.zeros((len(LINEAR),) * 2))
    assert straight_line_stability(known).probability == 0.0
    assert math.isnan(straight_line_stability(derivatives).probability)
    assert np.isnan(straight_line_stability(derivatives).roots_sd).all()


def test_gradient_of_complex_roots():
    derivatives = load_set("kvlcc2").with_values(Nv=0.3, Nr=-0.05).subset(LINEAR)
    found = straight_line_stability(derivatives)
    assert found.roots[0].imag != 0
    step = 1e-6
    covariance = np.zeros((len(LINEAR),) * 2)
    place = LINEAR.index("Nr")
    covariance[place, place] = 1.0
    sd = straight_line_stability(replace(derivatives, covariance=covariance)).roots_sd
    moved = straight_line_stability(derivatives.with_values(Nr=-0.05 + step))
    assert sd[0] == pytest.approx(abs(moved.roots[0].real - found.roots[0].real) / step, rel=1e-4)


def test_sets_without_inertia_have_no_roots_and_say_why():
    found = straight_line_stability(load_set("pcc-hd1.5"))
    assert found.stable
    assert np.isnan(found.roots).all()
    assert found.without_inertia == "the set has no added masses"
    with pytest.raises(ConventionError, match="no added masses"):
        straight_line_roots(linear_motion(load_set("pcc-hd1.5")))


def test_table():
    frame = straight_line_stability(uncertain()).to_frame().set_index("quantity")
    assert frame.loc["criterion C", "value"] == pytest.approx(-0.0131, abs=1e-4)
    assert frame.loc["root 1, real part", "value"] == pytest.approx(0.32, abs=5e-3)
    assert frame["sd"].notna().sum() == 5


def test_no_levers_without_sway_damping():
    with pytest.raises(ConventionError, match="no levers"):
        straight_line_stability(load_set("kvlcc2").with_values(Yv=0.0))
