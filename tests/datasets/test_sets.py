"""Published derivative sets load, convert, and agree with each other where they should."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core import HOME, Conventions
from towtank.core.errors import ConventionError, DatasetError
from towtank.core.scales import mass_coefficient, yaw_inertia_coefficient
from towtank.datasets import catalogue, list_sets, load_extras, load_set
from towtank.datasets.catalogue import index

KEYS = list(index("set"))

NO_ADDED_MASS = {
    # the added-mass Coriolis terms are inside and no added masses are printed to take them out
    "dtc-empirical", "dtmb5415", "dtmb5512-cfd", "dtmb5512-coupling-efd", "dtmb5512-efd", "dtmb5512-yaw-cfd",
    "dtmb5512-yaw-efd", "ferry", "fsb", "inland-deep", "inland-shallow", "kvlcc2-empirical",
    "kvlcc2-shallow-cfd", "kvlcc2-shallow-empirical", "onrt", "pcc-deep",
}  # fmt: skip
SURGE_TERMS = {"dtmb5512-steering-efd", "esso-190k", "mariner", "s175"}
"""Sets whose terms in the surge velocity cannot go to another velocity scale exactly."""


def home_of(one):
    return HOME.but(scale=one.conventions.scale)


@pytest.mark.parametrize("key", KEYS)
def test_every_set_goes_home_and_back_or_says_why_not(key):
    one = load_set(key)
    if key in NO_ADDED_MASS | SURGE_TERMS:
        reason = "surge velocity" if key in SURGE_TERMS else "needs [XY](u|v)dot"
        with pytest.raises(ConventionError, match=reason):
            one.to(home_of(one))
        return
    back = one.to(home_of(one)).to(one.conventions)
    assert set(back.names) == set(one.names)
    values = [back[name] for name in one.names]
    np.testing.assert_allclose(values, one.values, rtol=1e-10, atol=1e-12 * np.abs(one.values).max())


@pytest.mark.parametrize("key", KEYS)
def test_scales_and_signs_of_every_set_convert_exactly(key):
    one = load_set(key)
    changes = {"force_scaling": "LT", "rudder_sign": "starboard", "drift_sign": "-v", "axes": "forward-port-up"}
    back = one.to(one.conventions.but(**changes)).to(one.conventions)
    assert back.names == one.names
    np.testing.assert_allclose(back.values, one.values, rtol=1e-12)


@pytest.mark.parametrize("key", KEYS)
def test_every_set_tells_its_source_and_its_terms_are_those_of_a_symmetric_hull(key):
    one = load_set(key)
    assert one.provenance.source.split(", ")[0]
    assert np.isfinite(one.values).all()
    asymmetric = {term.name for term in one.terms if not term.symmetric_hull}
    # single-screw bias of the Mariner, propeller side force of the tanker, starboard bank
    allowed = {"Y0", "Y0u", "Y0uu", "N0", "N0u", "N0uu", "YT", "NT"}
    if "bank" in key:
        allowed |= {name for name in one.names if "eta" in name}
    elif key.startswith("pcc"):
        assert asymmetric == set()
    assert asymmetric <= allowed


def test_list_has_a_line_for_each():
    frame = list_sets().set_index("key")
    assert frame.index.tolist() == KEYS
    assert frame.loc["kvlcc2", "conventions"] == "home"
    assert frame.loc["kcs-waves-calm", "conventions"] == "force scaling L2"
    assert frame.loc["kvlcc2", "terms"] == 20


def test_unknown_set_names_the_nearest():
    with pytest.raises(DatasetError, match="did you mean s175"):
        load_set("s-175")


def test_full_terms_and_particulars_of_kvlcc2():
    one = load_set("kvlcc2")
    assert one.conventions == HOME
    assert (one["Xvvvv"], one["Yvdot"], one["Xudot"], one["Nrdot"]) == (0.771, -0.223, -0.022, -0.011)
    full = load_set("kvlcc2-full")
    assert full.names == one.names
    assert full.values.tolist() == one.values.tolist()
    assert mass_coefficient(full.ship) == pytest.approx(mass_coefficient(one.ship), rel=2e-3)
    assert full.ship.froude_number(full.reference_speed) == pytest.approx(0.142, abs=5e-4)
    assert full.provenance.history == (f"{', '.join(one.names)} from the set 'kvlcc2'",)


def test_extras_of_a_merged_set_are_those_of_its_parts_with_its_own_on_top():
    model, full = load_extras("kvlcc2"), load_extras("kvlcc2-full")
    assert (model["propeller"]["D"], full["propeller"]["D"]) == (0.216, 9.86)
    assert full["rudder"]["aH"] == model["rudder"]["aH"] == 0.312
    assert load_extras("kcs-waves-calm") == {}
    full["propeller"]["D"] = 0.0
    assert load_extras("kvlcc2-full")["propeller"]["D"] == 9.86


# -- misprints ---------------------------------------------------------------------------------------------------


def test_s175_of_son_and_nomoto_is_that_of_the_s175_paper_but_for_one_misprint():
    # The later paper makes the derivatives non-dimensional with its own draught, 9.5 m for 8.5 m.
    other = load_set("s175", corrected=False)
    converted = replace(load_set("s175-son-nomoto"), ship=other.ship).to("lt")
    wrong = {name for name in other.names if abs(converted[name] - other[name]) > 1.1e-4}
    assert len(other) == 19
    assert wrong == {"Nrrr"}
    assert converted["Nrrr"] == pytest.approx(-0.0422, abs=5e-5)
    assert other["Nrrr"] == -0.4220
    assert load_set("s175")["Nrrr"] == -0.0422


def test_misprints_are_told_both_ways():
    assert load_set("s175").provenance.misprints[0].startswith("Nrrr: -0.0422 used for the printed -0.422: ")
    printed = load_set("s175", corrected=False).provenance
    assert printed.misprints[0].startswith("Nrrr: -0.422 as printed, -0.0422 is right: ")
    assert printed.choices["corrected"] is False


def test_modulus_terms_of_the_s175_regressions():
    for key, sway in (("s175-regression", 0.90020), ("s175-regression-shallow", 3.91669)):
        assert load_set(key)["Yv|v|"] == -sway
        assert load_set(key, corrected=False)["Yv|v|"] == sway
    deep, shallow = load_set("s175-regression"), load_set("s175-regression-shallow")
    # the depth multiplier of Yv|v| is that of Nv|v| too
    assert shallow["Nv|v|"] / deep["Nv|v|"] == pytest.approx(shallow["Yv|v|"] / deep["Yv|v|"], rel=1e-3)


def test_doubtful_numbers_are_kept_and_told():
    one = load_set("pcc-bank-hd1.2")
    assert one["Netaetaeta"] == -1.923
    assert one.provenance.misprints[0].startswith("Netaetaeta: -1.923 as printed is doubtful, -0.1923 is likely: ")


def test_merged_set_tells_the_misprints_of_the_terms_it_took():
    yaw, merged = load_set("dtmb5512-yaw-efd"), load_set("dtmb5512-efd")
    assert set(yaw.provenance.misprints) < set(merged.provenance.misprints)
    assert any(text.startswith("Nvrr") for text in merged.provenance.misprints)
    assert not any(text.startswith("Yvdot") for text in merged.provenance.misprints)
    notes = merged.provenance.choices["notes"]
    assert sum("root mean square" in note for note in notes) == 2
    assert any("hold for small u only" in note for note in notes)


# -- one paper against another -----------------------------------------------------------------------------------


def test_rounded_kvlcc2_column_against_the_mmg_standard_set():
    rounded = load_set("kvlcc2-cmt-rounded")
    unrounded = load_set("kvlcc2-full").to("prime")
    wrong = {name for name in rounded.names if abs(rounded[name] - unrounded[name]) > 5.1e-4}
    # twelve of sixteen agree to the three printed decimals; three are off by one or two units, Xvvvv by three
    assert wrong == {"Xvvvv", "Yvvv", "Yrrr", "Yvvr"}
    assert all(abs(rounded[name] - unrounded[name]) < 3.1e-3 for name in wrong)


def test_dtmb_5415_against_the_measured_dtmb_5512():
    big = load_set("dtmb5415").to("lt")
    drift, yaw = load_set("dtmb5512-drift-fn0.280-efd"), load_set("dtmb5512-yaw-efd")
    coupling = load_set("dtmb5512-coupling-efd")
    for name in ("Xvv", "Yv", "Nv", "Yvvv", "Nvvv"):
        assert big[name] == pytest.approx(drift[name], abs=1.2e-4)
    assert big["Nrrr"] == pytest.approx(yaw["Nrrr"], abs=1.2e-4)
    # the disagreements of the two papers, as numbers
    assert big["Nr"] / yaw["Nr"] == pytest.approx(1.014, abs=1e-3)
    assert big["Xrr"] / yaw["Xrr"] == pytest.approx(0.974, abs=1e-3)
    assert big["Yr"] == pytest.approx(0.0933, abs=1e-4)
    assert yaw["Yr"] < 0
    assert yaw["Yrrr"] / big["Yrrr"] == pytest.approx(10.0, rel=0.01)
    assert big["Xvr"] == big["Nv"]
    assert coupling["Xvr"] > 0
    assert coupling["Yvvr"] / big["Yvvr"] == pytest.approx(0.907, abs=1e-3)
    assert coupling["Nvvr"] / big["Nvvr"] == pytest.approx(1.262, abs=1e-3)


def test_linear_sway_derivatives_of_kcs_in_mmg_scaling():
    calm = load_set("kcs-waves-calm").to("mmg")
    assert calm["Yv"] == pytest.approx(-0.190, abs=5e-4)
    assert calm["Nv"] == pytest.approx(-0.108, abs=5e-4)


def test_kcs_added_masses_come_out_of_the_yaw_terms():
    one = load_set("kcs")
    unit = 0.5 * 230.0**2 * 10.8
    assert -one["Xudot"] == pytest.approx(1790.85 / unit)
    assert -one["Yvdot"] == pytest.approx(44324.18 / unit)
    assert -one["Nrdot"] == pytest.approx(140067300 / (unit * 230.0**2))
    home = one.to(home_of(one))
    assert home["Yr"] == pytest.approx(0.0398 + 1790.85 / unit)
    # (Xbr - my') printed: Xvr = -Xbr = 0.1084 - my'
    assert home["Xvr"] == pytest.approx(0.1084 - 44324.18 / unit)
    assert home["Yv"] == pytest.approx(-0.2252)


def test_added_masses_printed_with_the_ship():
    one = load_set("pcc-hd1.5")
    m = mass_coefficient(one.ship)
    assert m == pytest.approx(0.19572, abs=1e-5)
    assert one["Xudot"] == pytest.approx(m - 0.232)
    assert one["Yvdot"] == pytest.approx(m - 0.413)
    outside = one.to("added-mass-outside")
    assert outside["Yr"] == pytest.approx(0.017 + 0.232 - m)
    assert outside["Xvr"] == pytest.approx(0.365 - (0.413 - m))


def test_mass_of_dtmb_5512():
    ship = load_set("dtmb5512-efd").ship
    assert mass_coefficient(ship) == pytest.approx(0.13613, abs=1e-5)
    assert yaw_inertia_coefficient(ship) == pytest.approx(0.008518, abs=1e-6)


def test_merged_sets_of_dtmb_5512_repeat_the_surge_force_they_were_given():
    measured, computed = load_set("dtmb5512-efd"), load_set("dtmb5512-cfd")
    for one, beta, force in ((measured, 10.0, -0.01961), (computed, 6.0, -0.01765)):
        v = math.sin(math.radians(beta))
        assert -one["R0"] + one["Xvv"] * v**2 == pytest.approx(force, abs=5e-5)
        assert any("R0 = " in step and "computed, not printed" in step for step in one.provenance.history)
    assert (measured["Yv"], measured["Xrr"], measured["Nvvr"]) == (-0.3000, -0.0282, -0.5512)
    assert len(measured) == len(computed) == 22


def test_complete_dtc_set_is_drift_and_yaw():
    one = load_set("dtc")
    assert len(one) == len(load_set("dtc-drift-cfd")) + len(load_set("dtc-yaw-cfd"))
    assert one["Nvvr"] == -0.768
    m = mass_coefficient(one.ship)
    assert m == pytest.approx(0.18986, abs=1e-5)
    # the doubtful terms are those that carry the ship's mass
    assert one["Yr"] - m == pytest.approx(0.0262, abs=1e-4)
    assert one["Xvr"] + m == pytest.approx(-0.0257, abs=1e-4)


def test_inland_ship_in_the_ittc_sign_of_drift():
    one = load_set("inland-deep")
    ittc = one.to("drift-angle")
    for term in one.terms:
        odd = sum(factor.power for factor in term.factors if factor.variable == "beta") % 2
        assert ittc[term.name] == (-one[term.name] if odd else one[term.name])
    assert mass_coefficient(one.ship) == pytest.approx(0.1810, abs=1e-4)


# -- force against the equations of the source -------------------------------------------------------------------

RNG = np.random.default_rng(3)
MOTION = {
    "surge": RNG.uniform(6.0, 8.0, 20), "v": RNG.uniform(-1.5, 1.5, 20), "r": RNG.uniform(-0.01, 0.01, 20),
    "udot": RNG.uniform(-0.01, 0.01, 20), "vdot": RNG.uniform(-0.01, 0.01, 20),
    "rdot": RNG.uniform(-1e-4, 1e-4, 20), "delta": RNG.uniform(-0.6, 0.6, 20), "phi": RNG.uniform(-0.2, 0.2, 20),
    "p": RNG.uniform(-0.02, 0.02, 20), "pdot": RNG.uniform(-1e-3, 1e-3, 20), "c": RNG.uniform(5.0, 9.0, 20),
    "thrust": np.zeros(20), "depth": RNG.uniform(0.0, 1.0, 20),
}  # fmt: skip


def test_tanker_forces_are_those_of_its_equations():
    # accelerations per unit mass, van Berlekom and Goddard 1972; rudder positive to port, beta = atan(v/u)
    one = load_set("esso-190k")
    m = MOTION
    u, v, r, c, z = m["surge"], m["v"], m["r"], m["c"], m["depth"]
    d, beta, length = -m["delta"], np.arctan(v / u), one.ship.L
    cc, bb = np.abs(c) * c, np.abs(beta) * beta
    surge = (
        -0.0377 * u**2 + length * 2.02 * v * r + 0.3 * v**2 - 0.093 * cc * d**2 + 0.152 * cc * beta * d
        - 0.0061 * u**2 * z + length * 0.387 * v * r * z + 0.0125 * v**2 * z**2
    ) / length - (1.05 + 0.05 * z) * m["udot"]  # fmt: skip
    sway = (
        -1.205 * u * v - 2.4 * np.abs(v) * v + 0.208 * cc * d - length * 0.752 * u * r
        - 2.16 * cc * bb * np.abs(d) + length * 0.182 * u * r * z
        - 1.5 * np.abs(v) * v * z - 0.191 * cc * bb * np.abs(d) * z
    ) / length - (2.02 + 0.387 * z) * m["vdot"]  # fmt: skip
    yaw = (
        -0.451 * u * v - length * 0.3 * np.abs(v) * r - 0.098 * cc * d - length * 0.231 * u * r
        + 0.688 * cc * bb * np.abs(d) - length * 0.047 * u * r * z
        - 0.241 * u * v * z - length * 0.12 * np.abs(v) * r * z + 0.344 * cc * bb * np.abs(d) * z
    ) - (0.1232 + 0.0045 * z) * length**2 * m["rdot"]  # fmt: skip
    forces = one.forces(MOTION)
    mass = one.ship.displacement_mass
    for component, expected in (("X", surge), ("Y", sway), ("N", yaw)):
        np.testing.assert_allclose(forces[component], mass * expected, rtol=1e-9, atol=1e-6 * mass)


def test_mariner_equation_of_motion():
    # sway: (m' - Yvdot') vdot' + (m' xG' - Yrdot') rdot' = Y'(u, v, r, delta); yaw and surge likewise
    one = load_set("mariner")
    u0, length = 7.7175, one.ship.L
    speed = np.hypot(MOTION["surge"], MOTION["v"])
    u, v, r = (MOTION["surge"] - u0) / speed, MOTION["v"] / speed, MOTION["r"] * length / speed
    d = -MOTION["delta"]
    udot, vdot = MOTION["udot"] * length / speed**2, MOTION["vdot"] * length / speed**2
    rdot = MOTION["rdot"] * (length / speed) ** 2
    sway = 1e-5 * (
        -1160 * v - 499 * r - 8078 * v**3 + 15356 * v**2 * r - 1160 * v * u - 499 * r * u + 278 * d
        - 90 * d**3 + 556 * u * d + 278 * u**2 * d - 4 * v * d**2 + 1190 * v**2 * d - 4 - 8 * u - 4 * u**2
        - (798 + 748) * vdot - (798 * -0.023 + 9.354) * rdot
    )  # fmt: skip
    yaw = 1e-5 * (
        -264 * v - 166 * r + 1636 * v**3 - 5483 * v**2 * r - 264 * v * u - 166 * r * u - 139 * d
        + 45 * d**3 - 278 * u * d - 139 * u**2 * d + 13 * v * d**2 - 489 * v**2 * d + 3 + 6 * u + 3 * u**2
        - (798 * -0.023 - 4.646) * vdot - (39.2 + 43.8) * rdot
    )  # fmt: skip
    surge = 1e-5 * (
        -184 * u - 110 * u**2 - 215 * u**3 - 899 * v**2 + 18 * r**2 + 798 * r * v - 95 * d**2 - 190 * u * d**2
        + 93 * v * d + 93 * u * v * d - (798 + 42) * udot
    )  # fmt: skip
    forces = one.forces(MOTION)
    unit = 0.5 * one.ship.rho * length**2 * speed**2
    for component, expected, lever in (("X", surge, 1.0), ("Y", sway, 1.0), ("N", yaw, length)):
        largest = np.abs(expected * unit * lever).max()
        np.testing.assert_allclose(forces[component], expected * unit * lever, rtol=2e-6, atol=2e-6 * largest)


def test_mass_of_the_mariner_is_the_printed_one():
    one = load_set("mariner")
    to_l2 = one.ship.T / one.ship.L
    assert mass_coefficient(one.ship) * to_l2 == pytest.approx(798e-5, rel=1e-6)
    assert yaw_inertia_coefficient(one.ship) * to_l2 == pytest.approx(39.2e-5, rel=1e-6)


def test_roll_and_surge_forces_of_the_s175():
    one = load_set("s175-son-nomoto")
    length = one.ship.L
    speed = np.hypot(MOTION["surge"], MOTION["v"])
    u, v = MOTION["surge"] / speed, MOTION["v"] / speed
    r, p, phi = MOTION["r"] * length / speed, MOTION["p"] * length / speed, MOTION["phi"]
    vdot = MOTION["vdot"] * length / speed**2
    udot, pdot = MOTION["udot"] * length / speed**2, MOTION["pdot"] * (length / speed) ** 2
    surge = -0.0004226 * u**2 - 0.00311 * v * r - 0.00386 * v**2 + 0.0002 * r**2 - 0.0002 * phi**2
    roll = (
        0.0003026 * v - 0.000063 * r - 0.0000075 * p - 0.000021 * phi + 0.002843 * v**3 - 0.0000462 * r**3
        - 0.000588 * v**2 * r + 0.0010565 * v * r**2 - 0.0012012 * v**2 * phi - 0.0000793 * v * phi**2
        - 0.000243 * r**2 * phi + 0.00003569 * r * phi**2
    )  # fmt: skip
    # the mass matrix of the source has -my' ly' between sway and roll
    roll = roll - 0.0000034 * pdot + 0.007049 * 0.0313 * vdot
    unit = 0.5 * one.ship.rho * length**2 * speed**2
    forces = one.forces(MOTION)
    np.testing.assert_allclose(forces["X"], (surge - 0.000238 * udot) * unit, rtol=1e-9)
    np.testing.assert_allclose(forces["K"], roll * unit * length, rtol=1e-6, atol=1.0)
    assert one.ship.displacement_mass / (0.5 * one.ship.rho * length**3) == pytest.approx(0.00792, abs=1e-6)


# -- files that are wrong ----------------------------------------------------------------------------------------

BLOCK = """[source]
title = "a"
[ship.s]
name = "s"
L = 3.0
B = 0.4
T = 0.1
[[set]]
key = "t"
name = "t"
ship = "s"
place = "Table 1"
"""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("values = { Yw = 1.0 }", "t: malformed set: 'Yw': 'w' is not a variable"),
        ("value = { Yv = 1.0 }", "unknown key 'value'"),
        ("values = { Yv = 'a' }", "malformed set: could not convert"),
        ("conventions = { force_scaling = 'L3' }", "malformed set: conventions.force_scaling = 'L3'"),
        ("values = { Yv = 1.0 }\nadded_mass = { form = 'total', mx = 1.0 }", "added_mass.form = 'total'"),
        (
            "[[set]]\nkey = 'u'\nname = 'u'\nship = 's'\nplace = ''\nconventions = { force_scaling = 'L2' }\n"
            "combine = { t = 'all' }",
            "'t' has other conventions",
        ),
    ],
)
def test_malformed_sets_are_refused(tmp_path, monkeypatch, text, said):
    text = BLOCK + text.replace("'", '"')
    (tmp_path / "paper.toml").write_text(text)
    monkeypatch.setattr(catalogue, "FOLDER", tmp_path)
    catalogue.index.cache_clear()
    try:
        with pytest.raises(DatasetError, match=said):
            load_set("u" if 'key = "u"' in text else "t")
    finally:
        catalogue.index.cache_clear()


def test_conventions_of_the_paper_hold_for_its_sets():
    assert load_set("dtmb5512-sway-efd").conventions == Conventions(
        origin="cog", velocity_scale="approach", added_mass_coriolis="inside", rudder_sign="port"
    )
    assert load_set("kvlcc2-cmt-rounded").conventions.added_mass_coriolis == "outside"
