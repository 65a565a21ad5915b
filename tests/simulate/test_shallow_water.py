"""Depth corrections against the published shallow sets and the recomputed multipliers."""

import math
from dataclasses import replace

import numpy as np
import pytest

from towtank.core.errors import ConventionError, TowtankError
from towtank.core.ship import Ship
from towtank.datasets import load_set
from towtank.simulate.shallow_water import (
    amin_hasegawa_multipliers,
    ankudinov_factors,
    ankudinov_in_shallow_water,
    ankudinov_multipliers,
    kijima_nakiri_in_shallow_water,
    kijima_nakiri_multipliers,
    li_wu_multipliers,
)

KVLCC2 = load_set("kvlcc2-full").ship
DEPTHS = (1.2, 1.5, 1.8, 3.0)


def column(function, name, **more):
    return [function(KVLCC2, depth, **more)[name] for depth in DEPTHS]


@pytest.mark.parametrize(
    ("name", "form", "expected"),
    [
        ("gv", "corrected", (3.34, 1.74, 1.35, 1.08)),
        ("fyv", "printed", (3.76, 1.85, 1.39, 1.08)),
        ("fnv", "corrected", (4.47, 2.13, 1.56, 1.14)),
        ("gnr", "corrected", (2.95, 1.61, 1.28, 1.06)),
    ],
)
def test_ankudinov_of_kvlcc2(name, form, expected):
    assert column(ankudinov_factors, name, form=form) == pytest.approx(expected, abs=0.0051)


@pytest.mark.parametrize(
    ("function", "name", "expected"),
    [
        # recomputed with rounded particulars: one unit of the last digit
        (kijima_nakiri_multipliers, "Yv", (4.21, 2.03, 1.53, 1.11)),
        (kijima_nakiri_multipliers, "Nv", (4.75, 2.20, 1.62, 1.14)),
        (kijima_nakiri_multipliers, "Nr", (1.95, 1.21, 1.03, 0.93)),
        (li_wu_multipliers, "Xudot", (5.75, 2.44, 1.78, 1.24)),
        (li_wu_multipliers, "Yvdot", (3.26, 2.06, 1.72, 1.34)),
        (li_wu_multipliers, "Nrdot", (2.91, 1.90, 1.61, 1.29)),
    ],
)
def test_multipliers_of_kvlcc2(function, name, expected):
    assert column(function, name) == pytest.approx(expected, abs=0.0125)


def test_cubic_sway_goes_with_the_linear_yaw_moment():
    for depth in DEPTHS:
        found = ankudinov_factors(KVLCC2, depth)
        assert found["fyv"] == pytest.approx(1.5 * found["fnv"] - 0.5)


def test_li_wu_of_s175():
    deep, shallow = load_set("s175-regression"), load_set("s175-regression-shallow")
    found = li_wu_multipliers(deep.ship, 1.2)
    for name in ("Xudot", "Yvdot", "Nrdot"):
        assert found[name] * deep[name] == pytest.approx(shallow[name], abs=5e-6)


def test_published_shallow_set_of_kvlcc2():
    deep, printed = load_set("kvlcc2-empirical"), load_set("kvlcc2-shallow-empirical")
    found = ankudinov_in_shallow_water(deep, printed.ship.depth)
    assert found.ship.depth_ratio == pytest.approx(1.2)
    for name in printed.names:
        if name == "Nr":
            # the paper's own factor gives twice what it prints
            assert found[name] == pytest.approx(-0.00596, abs=1e-5)
            continue
        multiplier = found.diagnostics["depth multipliers"][name]
        assert found[name] == pytest.approx(printed[name], abs=5e-5 + abs(multiplier) * 5e-6)
    wrong = ankudinov_in_shallow_water(deep, printed.ship.depth, form="printed")
    assert abs(wrong["Yvvv"] - printed["Yvvv"]) > 0.1


@pytest.mark.parametrize(
    "function", [ankudinov_multipliers, kijima_nakiri_multipliers, li_wu_multipliers, amin_hasegawa_multipliers]
)
@pytest.mark.parametrize("depth", [1e6, math.inf])
def test_deep_water_needs_no_correction(function, depth):
    for name, value in function(KVLCC2, depth).values.items():
        # the thrust deduction keeps a quarter of a percent in its source
        assert value == pytest.approx(1.0, abs=3e-3 if name == "1-t" else 1e-4)


def test_propulsion_of_kvlcc2():
    found = amin_hasegawa_multipliers(load_set("kvlcc2-empirical").ship, 1.2)
    assert found["w"] == pytest.approx(1.3783, abs=5e-5)
    assert found["1-t"] == pytest.approx(1.05295, abs=5e-6)
    assert found["gammaR"] == pytest.approx(1.294, abs=5e-4)


def test_wide_ships_have_another_branch_that_joins():
    narrow = Ship("box", 200.0, 40.0 - 1e-9, 10.0, volume=60000.0)
    wide = replace(narrow, B=40.0 + 1e-6)
    assert ankudinov_factors(narrow, 1.5)["fnv"] == pytest.approx(ankudinov_factors(wide, 1.5)["fnv"], rel=2e-3)


def test_doubts_are_told():
    assert ankudinov_factors(KVLCC2, 1.3).doubts == ()
    assert "shallower than the 1.2" in ankudinov_factors(KVLCC2, 1.15).doubts[0]
    fine = Ship("fine", 200.0, 20.0, 8.0, volume=0.45 * 200 * 20 * 8)
    doubts = kijima_nakiri_multipliers(fine, 1.2).doubts
    assert any("change the sign" in doubt for doubt in doubts)


def test_terms_without_a_multiplier_are_told():
    found = kijima_nakiri_in_shallow_water(load_set("kvlcc2"), 0.455 * 1.5)
    doubts = " ".join(found.provenance.choices["depth doubts"])
    assert "unchanged, for want of a multiplier: R0, Xvv" in doubts
    assert found["R0"] == 0.022
    assert found["Yv"] == pytest.approx(-0.315 * kijima_nakiri_multipliers(KVLCC2, 1.5)["Yv"], rel=5e-3)


def test_choice_of_the_added_masses():
    deep = load_set("kvlcc2")
    ours = ankudinov_in_shallow_water(deep, 0.455 * 1.5)
    theirs = ankudinov_in_shallow_water(deep, 0.455 * 1.5, added_mass="li-wu")
    assert ours["Xudot"] == deep["Xudot"]
    assert theirs["Xudot"] < 2 * deep["Xudot"]
    assert ours["Yvdot"] != theirs["Yvdot"]
    assert ours["Yv"] == theirs["Yv"]


def test_drift_angle_sets_and_covariances_are_carried_along():
    deep = load_set("kvlcc2")
    deep = replace(deep, covariance=np.diag((0.1 * deep.values) ** 2))
    found = ankudinov_in_shallow_water(deep, 0.455 * 1.5)
    assert np.diag(found.covariance) == pytest.approx((0.1 * found.values) ** 2)
    by_angle = ankudinov_in_shallow_water(deep.subset(["Yv", "Nv"]).to("drift-angle"), 0.455 * 1.5)
    assert by_angle["Yb"] == pytest.approx(-found["Yv"])


def test_mass_of_the_ship_stays():
    deep = load_set("kvlcc2").subset(["Yv", "Yr", "Nv", "Nr", "Xudot", "Yvdot", "Nrdot"])
    plain = ankudinov_in_shallow_water(deep, 0.455 * 1.5)
    inside = ankudinov_in_shallow_water(deep.to(deep.conventions, rigid_body_inertia="inside"), 0.455 * 1.5)
    back = inside.to(plain.conventions)
    assert [back[name] for name in plain.names] == pytest.approx(list(plain.values), rel=1e-9)


def test_what_cannot_be():
    deep = load_set("kvlcc2")
    with pytest.raises(TowtankError, match="no water under the keel"):
        ankudinov_factors(KVLCC2, 1.0)
    with pytest.raises(ConventionError, match="block coefficient"):
        ankudinov_factors(Ship("box", 100.0, 20.0, 5.0), 1.5)
    with pytest.raises(ConventionError, match="start from a deep-water set"):
        ankudinov_in_shallow_water(ankudinov_in_shallow_water(deep, 1.0), 0.7)
