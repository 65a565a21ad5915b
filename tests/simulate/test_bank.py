"""A pure car carrier along a bank: equilibrium, characteristic polynomial, stability."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from towtank.core.errors import ConventionError
from towtank.datasets import load_extras, load_set, load_table
from towtank.simulate.autopilot import Autopilot
from towtank.simulate.bank import (
    ShipNearBank,
    bank_equilibrium,
    bank_stability,
    characteristic_coefficients,
    helm_limit,
)


def ship_at(depth):
    extras = load_extras(f"pcc-hd{depth}")
    return ShipNearBank.from_sets(
        load_set(f"pcc-hd{depth}"),
        load_set(f"pcc-bank-hd{depth}"),
        yaw_inertia=extras["inertia"]["Iz_plus_Jz"],
        **extras["rudder"],
    )


DEPTHS = {1.5: ship_at(1.5), 1.2: ship_at(1.2)}


def test_ship_is_that_of_the_tables():
    ship = DEPTHS[1.5]
    assert ship.m == pytest.approx(0.19572, abs=5e-6)
    assert ship.xG == pytest.approx(-0.014056, abs=5e-7)
    assert ship.m + ship.mx == pytest.approx(0.232)
    assert ship.m + ship.my == pytest.approx(0.413)
    assert ship.Yr == pytest.approx(0.017)


@pytest.mark.parametrize("row", load_table("pcc-course-stability").frame.to_dict("records"))
def test_table_of_100_d5(row):
    pilot = Autopilot(row["gain"], row["gain"])
    found = bank_stability(DEPTHS[row["depth_ratio"]], row["eta"], pilot)
    hundredfold = 100 * found.D5
    assert hundredfold == pytest.approx(row["D5_100"], rel=1e-4, abs=5e-6)
    assert found.stable == (row["D5_100"] > 0)


def test_coefficients_and_roots_without_autopilot():
    middle = bank_stability(DEPTHS[1.5], 0.27).coefficients
    assert middle == pytest.approx([0.010829, 0.06397, 0.06140, 0.00380, 0.05432], abs=5e-6)
    shallow = bank_stability(DEPTHS[1.2], 0.27)
    assert shallow.coefficients == pytest.approx([0.015953, 0.14128, 0.25441, 0.17418, 0.92426], abs=5e-6)
    assert shallow.roots[0] == pytest.approx(0.3899 + 1.6288j, abs=1e-4)
    assert sorted(shallow.roots.real)[:2] == pytest.approx([-6.416, -3.219], abs=5e-4)
    held = bank_stability(DEPTHS[1.2], 0.27, Autopilot(4.0, 4.0))
    assert held.roots[0] == pytest.approx(-0.1168 + 1.4300j, abs=1e-4)
    assert sorted(held.roots.real)[:2] == pytest.approx([-8.340, -3.658], abs=5e-4)


def test_d1_changes_sign():
    place = brentq(lambda eta: characteristic_coefficients(DEPTHS[1.5], eta)[3], 0.09, 0.27)
    assert place == pytest.approx(0.181, abs=5e-4)


def test_printed_d2_contradicts_the_text():
    pilot = Autopilot(4.0, 4.0)
    printed = bank_stability(DEPTHS[1.2], 0.36, pilot, form="printed")
    hundredfold = 100 * printed.D5
    assert hundredfold == pytest.approx(-0.637, abs=5e-4)
    assert not printed.stable
    assert bank_stability(DEPTHS[1.2], 0.36, pilot).stable


@pytest.mark.parametrize("depth", [1.5, 1.2])
@given(eta=st.floats(0.0, 0.4), g1=st.floats(-2.0, 8.0), g2=st.floats(-2.0, 8.0))
@settings(max_examples=40, deadline=None)
def test_polynomial_is_the_determinant_of_the_equations(depth, eta, g1, g2):
    ship = DEPTHS[depth]
    (yv, nv), (ye, ne) = ship.sway_slopes(eta), ship.bank_slopes(eta)
    moment, sway = ship.m * ship.xG, ship.m + ship.my
    turn = ship.yaw_inertia + moment * ship.xG
    found = characteristic_coefficients(ship, eta, Autopilot(g1, g2))
    for s in (0.3 + 0.2j, -1.1, 2.0j, 1.7, -0.4 - 1.0j):
        # equations 17 and 18 in (eta, psi) with delta = -(G1 + G2 s) psi
        rudder = -(g1 + g2 * s)
        by_yaw = ship.Yr + ship.my
        matrix = np.array(
            [
                [sway * s**2 - yv * s - ye, moment * s**2 - by_yaw * s + yv - ship.Yd * rudder],
                [moment * s**2 - nv * s - ne, turn * s**2 - (ship.Nr - moment) * s + nv - ship.Nd * rudder],
            ]
        )
        assert np.polyval(found, s) == pytest.approx(np.linalg.det(matrix), rel=1e-9, abs=1e-10)


@pytest.mark.parametrize("depth", [1.5, 1.2])
@given(eta=st.floats(0.0, 0.36), g1=st.floats(0.0, 8.0), g2=st.floats(0.0, 8.0))
@settings(max_examples=60, deadline=None)
def test_verdict_is_that_of_the_roots(depth, eta, g1, g2):
    found = bank_stability(DEPTHS[depth], eta, Autopilot(g1, g2))
    if abs(found.roots[0].real) > 1e-7:
        assert found.stable == bool(found.roots[0].real < 0)
        assert found.stable == bool(np.all(found.coefficients > 0) and found.D5 > 0)


@pytest.mark.parametrize("eta", [0.0, 0.1, 0.3])
def test_equilibrium_balances_the_forces(eta):
    ship = DEPTHS[1.2]
    found = bank_equilibrium(ship, eta)
    for force, by_rudder in (("Y", ship.Yd), ("N", ship.Nd)):
        slope, by_both, straight, cubed = (
            getattr(ship, force + name) for name in ("v", "vetaeta", "eta", "etaetaeta")
        )
        total = (slope + by_both * eta**2) * found.sway + straight * eta + cubed * eta**3 + by_rudder * found.helm
        assert total == pytest.approx(0.0, abs=1e-15)
    assert found.heading == -found.sway


def test_check_helm_of_the_digest():
    ship = DEPTHS[1.5]
    for eta, printed, corrected in ((0.09, 4.02, 3.60), (0.27, 27.0, 15.8)):
        assert math.degrees(bank_equilibrium(ship, eta, form="printed").helm) == pytest.approx(printed, abs=0.05)
        assert math.degrees(bank_equilibrium(ship, eta).helm) == pytest.approx(corrected, abs=0.05)


def test_where_the_helm_reaches_its_limit():
    limit = math.radians(35)
    assert helm_limit(DEPTHS[1.2], limit, form="printed") == pytest.approx(0.131, abs=5e-4)
    place = helm_limit(DEPTHS[1.2], limit)
    assert place == pytest.approx(0.176, abs=5e-4)
    assert abs(bank_equilibrium(DEPTHS[1.2], place).helm) == pytest.approx(limit)
    assert math.isnan(helm_limit(DEPTHS[1.5], limit, farthest=0.3))
    assert helm_limit(DEPTHS[1.5], 0.0) == 0.0


def test_integral_gain_is_refused():
    with pytest.raises(ConventionError, match="no integral gain"):
        bank_stability(DEPTHS[1.5], 0.1, Autopilot(1.0, 1.0, 0.1))


def test_missing_terms_are_named():
    drift, bank = load_set("pcc-hd1.5"), load_set("pcc-bank-hd1.5")
    less = bank.subset([name for name in bank.names if name != "Neta"])
    with pytest.raises(ConventionError, match="has no Neta"):
        ShipNearBank.from_sets(drift, less, Yd=-0.05, Nd=0.025, yaw_inertia=0.03)
    with pytest.raises(ConventionError, match="has no Xudot"):
        ShipNearBank.from_sets(load_set("pcc-deep"), bank, Yd=-0.05, Nd=0.025, yaw_inertia=0.03)
