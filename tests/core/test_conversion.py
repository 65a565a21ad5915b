"""Conversions keep the force, go both ways exactly, and carry the covariance."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core import Conventions, DerivativeSet, Ship
from towtank.core.conventions import CHOICES, preset
from towtank.core.errors import ConventionError

SHIP = Ship("test hull", L=7.0, B=1.27, T=0.46, volume=3.27, xG=0.25, kzz=1.75, rho=1000.0)
VALUES = {
    "R0": 0.022, "Xvv": -0.04, "Xvr": 0.002, "Xrr": 0.011, "Xvvvv": 0.771, "Xudot": -0.022,
    "Yv": -0.315, "Yr": 0.083, "Yvvv": -1.607, "Yvvr": 0.379, "Yvrr": -0.391, "Yrrr": 0.008, "Yvdot": -0.223,
    "Yrdot": 0.01, "Nv": -0.137, "Nr": -0.049, "Nvvv": -0.03, "Nvvr": -0.294, "Nvrr": 0.055, "Nrrr": -0.013,
    "Nvdot": 0.004, "Nrdot": -0.011, "Yd": -0.05, "Nd": 0.025, "Yphi": 0.01, "Yvphiphi": 0.13,
}  # fmt: skip


def make_set(values=None, conventions=None, seed=0):
    values = values or VALUES
    root = np.random.default_rng(seed).normal(size=(len(values),) * 2) * 1e-3
    return DerivativeSet.from_values(
        "test", SHIP, values, conventions or Conventions(), covariance=root @ root.T, reference_speed=1.18
    )


def motion(size=0.05, n=40, seed=1):
    rng = np.random.default_rng(seed)

    def small(scale):
        return rng.uniform(-1, 1, n) * size * scale

    speed = 1.18
    return {
        "surge": np.full(n, speed), "v": small(speed), "r": small(speed / SHIP.L), "udot": small(0.1),
        "vdot": small(0.1), "rdot": small(0.01), "phi": small(1.0), "delta": small(1.0),
    }  # fmt: skip


origins = st.one_of(st.sampled_from(["midship", "cog"]), st.integers(-100, 100).map(lambda n: n / 1000))
conventions = st.builds(
    Conventions,
    origin=origins,
    **{key: st.sampled_from(sorted(CHOICES[key])) for key in CHOICES if key != "scale"},
)


@settings(max_examples=60, deadline=None)
@given(a=conventions, b=conventions)
def test_round_trip_is_exact(a, b):
    start = make_set().to(a)
    back = start.to(b).to(a)
    assert set(back.names) == set(start.names)
    order = [back.names.index(name) for name in start.names]
    scale = np.abs(start.values).max()
    np.testing.assert_allclose(back.values[order], start.values, rtol=1e-10, atol=1e-12 * scale)
    cov = back.covariance[np.ix_(order, order)]
    np.testing.assert_allclose(cov, start.covariance, rtol=1e-8, atol=1e-12 * np.abs(start.covariance).max())


SCALES_AND_SIGNS = ["axes", "force_scaling", "rudder_sign", "angle_unit", "force_sign", "drift_sign"]


@pytest.mark.parametrize("key", SCALES_AND_SIGNS)
def test_scales_and_signs_round_trip_to_rounding(key):
    start = make_set()
    for choice in CHOICES[key]:
        back = start.to(start.conventions.but(**{key: choice})).to(start.conventions)
        assert back.names == start.names
        np.testing.assert_allclose(back.values, start.values, rtol=1e-12)
        np.testing.assert_allclose(back.covariance, start.covariance, rtol=1e-11, atol=1e-20)


@pytest.mark.parametrize(
    "change",
    [
        {"force_scaling": "L2"},
        {"force_scaling": "bis"},
        {"force_scaling": "dimensional"},
        {"axes": "forward-port-up"},
        {"rudder_sign": "port"},
        {"angle_unit": "deg"},
    ],
)
def test_force_is_the_same_to_rounding(change):
    start = make_set()
    other = start.to(start.conventions.but(**change))
    ours, theirs = start.forces(motion(0.4)), other.forces(motion(0.4))
    for component in "XYN":
        np.testing.assert_allclose(theirs[component], ours[component], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    "change",
    [
        {"sway_variable": "beta"},
        {"sway_variable": "beta", "drift_sign": "+v"},
        {"velocity_scale": "approach"},
        {"sway_variable": "beta", "velocity_scale": "approach"},
        {"origin": "cog"},
        {"origin": -0.1, "sway_variable": "beta"},
        {"origin": 0.05, "velocity_scale": "approach", "force_scaling": "L2"},
    ],
)
def test_force_differs_only_beyond_the_degree_of_the_model(change):
    # halving the motion must divide the difference by 2**4 (lateral, degree 3) or 2**5 (surge, degree 4)
    start = make_set()
    other = start.to(start.conventions.but(**change))

    def difference(size, component):
        m = motion(size) | {"phi": np.zeros(40)}
        return np.abs(start.forces(m)[component] - other.forces(m)[component]).max()

    for component, least in (("X", 20.0), ("Y", 14.0), ("N", 14.0)):
        coarse, fine = difference(0.04, component), difference(0.02, component)
        force = np.abs(start.forces(motion(0.04))[component]).max()
        assert coarse < 2e-3 * force
        assert fine < 1e-13 * force or coarse / fine > least


def test_drift_angle_coefficients_match_the_chain_rule():
    # v' = -sin(beta): Yb = -Yv; Ybbb = -(Yvvv) + Yv/6 ; R0 alone is unchanged
    other = make_set({"R0": 0.02, "Yv": -0.3, "Yvvv": -1.6}).to("drift-angle")
    assert other["R0"] == pytest.approx(0.02, abs=1e-15)
    assert other["Yb"] == pytest.approx(0.3)
    assert other["Ybbb"] == pytest.approx(1.6 - 0.3 / 6)


def test_marin_drift_sign_turns_odd_terms():
    ittc = make_set({"Yb": 0.156, "Yb|b|": 0.293, "Yr": 0.03, "Ybbr": -0.1, "Ybrr": 0.3},
                    Conventions(sway_variable="beta"))  # fmt: skip
    marin = ittc.to("drift-angle-marin")
    for name in ("Yb", "Yb|b|", "Ybrr"):
        assert marin[name] == -ittc[name]
    for name in ("Yr", "Ybbr"):
        assert marin[name] == ittc[name]


def test_added_mass_moves_into_yr_and_xvr():
    inside = make_set().to("added-mass-inside")
    assert inside["Yr"] == pytest.approx(0.083 - 0.022)
    assert inside["Xvr"] == pytest.approx(0.002 + 0.223)
    # -mx u r with u = U sqrt(1 - v'^2) is -mx' (r' - v'^2 r'/2)
    assert inside["Yvvr"] == pytest.approx(0.379 + 0.022 / 2)


@pytest.mark.parametrize("form", ["inside", "outside-with-munk"])
def test_added_mass_inside_is_the_coriolis_force(form):
    start, m = make_set({**VALUES, "Yrdot": 0.0}), motion(0.02)
    other = start.to(Conventions(added_mass_coriolis=form))
    scale = 0.5 * SHIP.rho * SHIP.L**2 * SHIP.T
    mx, my = 0.022 * scale, 0.223 * scale
    change = {c: other.forces(m)[c] - start.forces(m)[c] for c in "XYN"}
    munk = form == "outside-with-munk"
    expected = {
        "X": 0.0 if munk else my * m["v"] * m["r"],
        "Y": 0.0 if munk else -mx * m["surge"] * m["r"],
        "N": (my - mx) * m["surge"] * m["v"] if munk else 0.0,
    }
    for component in "XYN":
        size = np.abs(start.forces(m)[component]).max()
        np.testing.assert_allclose(change[component], expected[component], atol=2e-6 * size)


def test_added_mass_needs_the_acceleration_derivative():
    with pytest.raises(ConventionError, match="Xudot"):
        make_set({"Yr": 0.08, "Xvr": 0.002}).to("added-mass-inside")


def test_uncertainty_of_added_mass_enters_the_converted_derivative():
    start = make_set()
    inside = start.to("added-mass-inside")
    i, j = start.names.index("Yr"), start.names.index("Xudot")
    expected = start.covariance[i, i] + start.covariance[j, j] + 2 * start.covariance[i, j]
    assert inside.covariance[inside.names.index("Yr"), inside.names.index("Yr")] == pytest.approx(expected)


def test_rigid_body_inertia_matches_the_equations_of_motion():
    inside = make_set().to(Conventions(rigid_body_inertia="inside"))
    m = 3.27 / (0.5 * 7.0**2 * 0.46)
    assert inside["Yr"] == pytest.approx(0.083 - m)
    assert inside["Yvdot"] == pytest.approx(-0.223 - m)
    assert inside["Nr"] == pytest.approx(-0.049 - m * 0.25 / 7)
    assert inside["Xrr"] == pytest.approx(0.011 + m * 0.25 / 7)


def test_modulus_terms_refuse_a_shift_of_origin():
    with pytest.raises(ConventionError, match="modulus"):
        make_set({"Yv": -0.3, "Yv|v|": -0.9}).to("cog")


def test_surge_terms_refuse_another_velocity_scale():
    with pytest.raises(ConventionError, match="surge velocity"):
        make_set({"Yv": -0.3, "Yvu": -0.02}).to("approach-speed")


def test_modulus_terms_convert_to_drift_angle():
    other = make_set({"Yv": -0.3, "Yv|v|": -0.9}).to("drift-angle")
    assert other["Yb|b|"] == pytest.approx(0.9)


def test_dimensional_needs_a_reference_speed():
    bare = DerivativeSet.from_values("x", SHIP, {"Yv": -0.3}, Conventions())
    with pytest.raises(ConventionError, match="reference speed"):
        bare.to("dimensional")


def test_froude_scaling_of_a_dimensional_set():
    model = make_set().to("dimensional")
    full = model.at_scale(1 / 45.714, rho=1025.0)
    k = 45.714
    assert full.reference_speed == pytest.approx(1.18 * k**0.5)
    ratio = full["Yv"] / model["Yv"]
    assert ratio == pytest.approx(1.025 * k**2.5)  # rho L T U
    assert full["Yvdot"] / model["Yvdot"] == pytest.approx(1.025 * k**3)
    back = full.at_scale(1.0, rho=1000.0)
    np.testing.assert_allclose(back.values, model.values, rtol=1e-12)


def test_unknown_preset_is_named():
    with pytest.raises(ConventionError, match="primeval"):
        preset("primeval", Conventions())


def test_l_t_against_l_squared_factor():
    start = make_set()
    other = start.to("prime")
    np.testing.assert_allclose(other.values, start.values * SHIP.T / SHIP.L, rtol=1e-14)
