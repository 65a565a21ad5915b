"""Every three-grid method: published numbers, what it does with triplets that it is not defined for."""

import math

import pytest

from towtank.verify import GridTriplet
from towtank.verify.triplet_uncertainty import (
    correction_factor,
    correction_factor_uncertainty,
    data_range,
    factor_of_safety,
    gci_celik,
    gci_oberkampf_roy,
    gci_roache,
    gci_two_grids,
    safety_of_order_ratio,
)

ROOT = math.sqrt(2.0)
A = GridTriplet(1.0100, 1.0205, 1.0412, ROOT, ROOT)
B = GridTriplet(0.0161, 0.0163, 0.0166, 1.5, 1.5)
OSCILLATING = GridTriplet(1.0, 1.1, 0.7)
MONOTONE_DIVERGENT = GridTriplet(1.0, 1.3, 1.4)
SWINGING_APART = GridTriplet(1.0, 1.3, 1.1)
EQUAL = GridTriplet(1.0, 1.0, 1.4)


@pytest.mark.parametrize(
    ("triplet", "cf", "corrected", "fs", "gci"),
    [
        (A, 0.01197441, 0.00110206, 0.01748484, 0.01351103),
        (B, 8.8e-4, 2.4e-4, 8.1e-4, 5.0e-4),
    ],
)
def test_triplets_a_and_b(triplet, cf, corrected, fs, gci):
    assert correction_factor(triplet).uncertainty == pytest.approx(cf, abs=5e-9)
    assert correction_factor(triplet, corrected=True).uncertainty == pytest.approx(corrected, abs=5e-9)
    assert factor_of_safety(triplet).uncertainty == pytest.approx(fs, abs=5e-9)
    assert gci_celik(triplet).uncertainty == pytest.approx(gci, abs=5e-9)
    assert gci_roache(triplet).uncertainty == pytest.approx(gci, abs=5e-9)


def test_order_of_triplet_b():
    assert B.order == pytest.approx(1.0, abs=1e-9)
    assert B.correction_factor() == pytest.approx(0.4, abs=1e-9)
    assert B.error == pytest.approx(4e-4, abs=1e-12)


@pytest.mark.parametrize(
    ("values", "r21", "r32", "percent"),
    [
        ((6.063, 5.972, 5.863), 1.5, 4.0 / 3.0, 2.175),
        ((10.7880, 10.7250, 10.6050), 2.0, math.sqrt(4500 / 980), 1.067),
        ((6.0042, 5.9624, 6.0909), 2.0, math.sqrt(4500 / 980), 0.472),
    ],
)
def test_indices_of_celik_et_al(values, r21, r32, percent):
    found = gci_celik(GridTriplet(*values, r21, r32))
    assert 100 * found.uncertainty / values[0] == pytest.approx(percent, abs=5e-4)
    assert ("oscillatory" in found.note) == (found.behaviour == "oscillatory convergent")


def test_nasa_indices():
    grids = GridTriplet(0.97050, 0.96854, 0.96178)
    assert 100 * gci_roache(grids).uncertainty / grids.fine == pytest.approx(0.103083, abs=5e-7)
    assert 125 * abs(grids.medium_error) / grids.medium == pytest.approx(0.356249, abs=5e-7)


@pytest.mark.parametrize(
    ("order_ratio", "factor"), [(0.0, 2.45), (0.5, 2.025), (1.0, 1.6), (1.5, 9.8), (2.0, 18.0)]
)
def test_factor_of_safety_is_continuous_at_the_formal_order(order_ratio, factor):
    assert safety_of_order_ratio(order_ratio) == pytest.approx(factor)
    assert safety_of_order_ratio(1.0 + 1e-9) == pytest.approx(1.6, abs=1e-6)


def test_branches_of_the_correction_factor():
    assert correction_factor_uncertainty(-2.0, 1.0) == pytest.approx(2.2)
    assert correction_factor_uncertainty(2.0, 1.5) == pytest.approx(4.0)
    assert correction_factor_uncertainty(2.0, 1.0, corrected=True) == pytest.approx(0.2)
    assert correction_factor_uncertainty(2.0, 1.5, corrected=True) == pytest.approx(1.0)
    assert correction_factor_uncertainty(2.0, 1.5, version=2001) == pytest.approx(4.0)
    assert correction_factor_uncertainty(2.0, 1.0, version=2001) == pytest.approx(2.0)
    assert correction_factor_uncertainty(2.0, 1.1, corrected=True, version=2001) == pytest.approx(0.2)
    # both forms of 2004 meet their neighbours at the ends of the branches
    assert correction_factor_uncertainty(1.0, 1.25, corrected=True) == pytest.approx(0.25)
    assert correction_factor_uncertainty(1.0, 1.2499999, corrected=True) == pytest.approx(0.25, abs=1e-6)
    assert correction_factor_uncertainty(1.0, 1.1249999) == pytest.approx(1.25, abs=1e-6)


def test_corrected_value_is_the_fine_value_less_the_corrected_error():
    found = correction_factor(B, corrected=True)
    assert found.extrapolated == pytest.approx(0.0161 - 0.4 * 4e-4)
    assert correction_factor(B, version=2001).method == "correction factor 2001"


def test_limited_order_of_oberkampf_and_roy():
    near = gci_oberkampf_roy(A)
    assert near.order == 2.0
    assert near.uncertainty == pytest.approx(1.25 * 0.0105)
    fast = gci_oberkampf_roy(GridTriplet(1.0, 1.1, 2.7))
    assert fast.order == 2.0
    assert fast.uncertainty == pytest.approx(3.0 * 0.1 / 3.0)
    slow = gci_oberkampf_roy(GridTriplet(1.0, 1.1, 1.21))
    assert slow.order == 0.5
    assert slow.uncertainty == pytest.approx(0.3 / (math.sqrt(2.0) - 1.0))


@pytest.mark.parametrize("method", [gci_roache, gci_oberkampf_roy])
def test_monotone_indices_refuse_oscillation(method):
    found = method(OSCILLATING)
    assert math.isnan(found.uncertainty)
    assert found.behaviour == "oscillatory convergent"
    assert "monotone convergence" in found.note


@pytest.mark.parametrize("method", [correction_factor, factor_of_safety])
def test_oscillation_takes_half_the_range_in_the_methods_of_ittc(method):
    found = method(OSCILLATING)
    assert found.uncertainty == pytest.approx(0.2)
    assert math.isnan(found.order)
    assert "half the range" in found.note
    assert math.isnan(correction_factor(OSCILLATING, corrected=True).uncertainty)


@pytest.mark.parametrize("triplet", [MONOTONE_DIVERGENT, SWINGING_APART, EQUAL])
@pytest.mark.parametrize("method", [gci_celik, gci_roache, gci_oberkampf_roy, correction_factor, factor_of_safety])
def test_no_method_extrapolates_what_does_not_converge(method, triplet):
    found = method(triplet)
    assert math.isnan(found.uncertainty)
    assert math.isnan(found.extrapolated)
    assert found.note
    assert not found.order > 0.0


def test_range_of_the_data():
    assert data_range([1.0, 1.1, 0.7], "oscillatory convergent").uncertainty == pytest.approx(0.2)
    assert data_range([1.0, 1.1, 0.7], "oscillatory convergent").extrapolated == pytest.approx(0.9)
    assert data_range([1.0, 1.3, 1.4], "monotone divergent").uncertainty == pytest.approx(1.2)
    assert data_range([1.0, 1.0, 1.4], "equal solutions").uncertainty == pytest.approx(0.2)
    assert math.isnan(data_range([1.0, 1.1, 1.3], "monotone convergent").uncertainty)
    assert "three grids" in data_range([1.0, 1.1], "too few grids").note


def test_two_grids_take_the_formal_order_and_a_factor_of_three():
    found = gci_two_grids(1.0, 1.3, 2.0)
    assert found.uncertainty == pytest.approx(0.3)
    assert found.extrapolated == pytest.approx(0.9)
    assert found.behaviour == "too few grids"


def test_orders_to_be_doubted_say_so():
    assert "below 0.5" in gci_celik(GridTriplet(1.0, 1.1, 1.21)).note
    assert "above 3" in gci_celik(GridTriplet(1.0, 1.01, 2.0)).note
    assert factor_of_safety(A).standard_uncertainty == pytest.approx(0.5 * 0.01748484, abs=5e-9)
