"""Empirical derivatives against published and measured values."""

from dataclasses import replace

import numpy as np
import pytest

from towtank.core import Ship
from towtank.core.errors import ConventionError, TowtankError
from towtank.pmm.empirical_derivatives import (
    EMPIRICAL_SETS,
    clarke,
    empirical_set,
    kijima,
    shallow_added_mass_factors,
    shallow_sway_factor,
    yoshimura_masumoto,
    zhou_added_mass,
)

KVLCC2 = Ship("KVLCC2", 320.0, 58.0, 20.8, volume=312600.0, xG=11.2, rho=1000.0)
S175 = Ship("S-175", 175.0, 25.4, 9.5, volume=0.572 * 175 * 25.4 * 9.5)
KCS = Ship("KCS", 230.0, 32.2, 10.8, volume=0.651 * 230 * 32.2 * 10.8, xG=-3.404)
DTC = Ship("DTC", 355.0, 51.0, 14.5, volume=0.661 * 355 * 51 * 14.5)


def test_kvlcc2_check_case():
    found = yoshimura_masumoto(KVLCC2)
    assert found["Yv"] == pytest.approx(-0.4098, abs=2e-4)
    assert found["Nv"] == pytest.approx(-0.130, abs=1e-12)
    assert found["Nr"] == pytest.approx(-0.0533, abs=5e-5)
    assert found.conventions.force_scaling == "LT"
    measured = {"Yv": -0.315, "Nv": -0.137, "Nr": -0.049, "Yr": 0.083, "Yvvv": -1.607, "Yvrr": -0.391}
    for name, value in measured.items():
        assert found[name] == pytest.approx(value, rel=0.32), name


def test_clarke_is_prime_and_of_the_size_of_the_others():
    found = clarke(KVLCC2)
    k = np.pi * (20.8 / 320.0) ** 2
    assert found.conventions.force_scaling == "L2"
    assert found["Yv"] == pytest.approx(-k * (1 + 0.4 * KVLCC2.block_coefficient * 58 / 20.8))
    assert found["Nv"] == pytest.approx(-k * (0.5 + 2.4 * 20.8 / 320))
    # Stability index of the formulas: the tanker is unstable on a straight course.
    m = 2 * KVLCC2.volume / KVLCC2.L**3
    assert found["Yv"] * found["Nr"] - found["Nv"] * (found["Yr"] - m) < 0
    outside = found.to("mmg", added_mass_coriolis="outside")
    for name, value in {
        "Yv": -0.315,
        "Yr": 0.083,
        "Nv": -0.137,
        "Nr": -0.049,
        "Yvdot": -0.223,
        "Nrdot": -0.011,
    }.items():
        assert outside[name] == pytest.approx(value, rel=0.25), name


def test_kijima_against_the_printed_regression_of_s175():
    found = kijima(S175)
    printed = {"Yb": 0.28677, "Nb": 0.10857, "Nr": -0.04684, "Yb|b|": 0.90020, "Yr|r|": 0.00338, "Ybrr": 0.95247}
    printed |= {"Nbrr": -0.05697, "Ybbr": -0.3291, "Nb|b|": -0.0877, "Nr|r|": -0.0485, "Nbbr": -0.4687}
    for name, value in printed.items():
        assert found[name] == pytest.approx(value, abs=6e-5), name
    x = S175.block_coefficient * S175.B / S175.L
    m, mx = 2 * x, -found["Xudot"]
    assert found["Yr"] - (m + mx) == pytest.approx(-1.5 * x)
    turned = found.to("mmg")
    assert turned["Yv"] == pytest.approx(-0.28677, abs=1e-5)
    assert turned["Yv|v|"] == pytest.approx(-0.90020, abs=1e-5)


def test_yoshimura_and_masumoto_for_the_dtc():
    found = yoshimura_masumoto(DTC)
    printed = {"Yrrr": -0.0510, "Nr": -0.0374, "Nrrr": -0.0323, "Yvvr": -0.75, "Yvrr": -0.7251, "Nvvr": -0.6132}
    for name, value in printed.items():
        assert found[name] == pytest.approx(value, abs=2e-3), name
    assert found["Yr"] + found["Xudot"] == pytest.approx(0.0566 - 0.0091, abs=5e-4)


def test_signs_that_copies_of_the_formulas_have_wrong():
    assert yoshimura_masumoto(KCS)["Yvvv"] == pytest.approx(-1.7179, rel=0.06)
    assert yoshimura_masumoto(S175)["Yvvv"] == pytest.approx(-2.008, rel=0.15)
    net = yoshimura_masumoto(KCS)["Xvr"] - yoshimura_masumoto(KCS)["Yvdot"]
    assert net == pytest.approx(0.1084, rel=0.15), "Xvr + my of KCS"
    net = yoshimura_masumoto(S175)["Xvr"] - yoshimura_masumoto(S175)["Yvdot"]
    assert net == pytest.approx(-0.0573 + 0.1299, rel=0.10), "Xvr + my of S-175"


def test_added_masses():
    added = zhou_added_mass(KVLCC2)
    assert (added.surge, added.sway, added.yaw) == pytest.approx((0.022, 0.223, 0.011), rel=0.06)
    assert added.terms() == {"Xudot": -added.surge, "Yvdot": -added.sway, "Nrdot": -added.yaw}


def test_shallow_water():
    shallow = replace(S175, depth=1.2 * S175.T)
    factors = shallow_added_mass_factors(shallow)
    assert (factors.surge, factors.sway, factors.yaw) == pytest.approx((5.570, 3.211, 2.886), abs=6e-4)
    assert shallow_added_mass_factors(S175).sway == 1.0
    for ratio, factor in ((1.2, 4.21), (1.5, 2.03), (1.8, 1.53), (3.0, 1.11)):
        assert shallow_sway_factor(replace(KVLCC2, depth=ratio * KVLCC2.T)) == pytest.approx(factor, abs=6e-3)
    assert shallow_sway_factor(KVLCC2) == 1.0
    assert shallow_sway_factor(replace(KVLCC2, depth=1.001 * KVLCC2.T)) == 8.0


@pytest.mark.parametrize("name", EMPIRICAL_SETS)
def test_every_set_converts_both_ways_and_names_its_source(name):
    found = empirical_set(KVLCC2, name)
    assert found.provenance.source
    assert found.ship is KVLCC2
    there = found.to(found.conventions, added_mass_coriolis="inside", force_scaling="L2")
    back = there.to(found.conventions)
    assert set(back.names) == set(found.names)
    assert [back[term] for term in found.names] == pytest.approx(list(found.values), rel=1e-12, abs=1e-15)


def test_mass_serves_where_volume_is_missing():
    by_mass = Ship("KVLCC2", 320.0, 58.0, 20.8, mass=312600.0e3, xG=11.2, rho=1000.0)
    np.testing.assert_allclose(kijima(by_mass).values, kijima(KVLCC2).values)
    with pytest.raises(ConventionError, match="block coefficient"):
        clarke(Ship("bare", 320.0, 58.0, 20.8))


def test_unknown_names():
    with pytest.raises(TowtankError, match="'inoue' is not an empirical set"):
        empirical_set(KVLCC2, "inoue")
