"""Three grids: published orders, laws of the order, classes of convergence."""

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.verify import GridTriplet, spacings_from_cells

ratios = st.floats(1.1, 4.0)
orders = st.floats(0.3, 5.0)
signs = st.sampled_from([-1.0, 1.0])


def power_law(phi0, alpha, p, r21, r32):
    return GridTriplet(*(phi0 + alpha * h**p for h in (1.0, r21, r21 * r32)), r21, r32)


@settings(deadline=None, max_examples=60)
@given(st.floats(-5.0, 5.0), signs, orders, ratios, ratios)
def test_power_laws_give_their_order_and_limit(phi0, sign, p, r21, r32):
    grids = power_law(phi0, sign * 0.1, p, r21, r32)
    assert grids.behaviour == "monotone convergent"
    assert grids.order == pytest.approx(p, rel=1e-6)
    assert grids.extrapolated == pytest.approx(phi0, abs=1e-6)
    assert grids.error == pytest.approx(sign * 0.1, rel=1e-5)
    assert grids.medium_error == pytest.approx(sign * 0.1 * r21**p, rel=1e-5)


@settings(deadline=None, max_examples=60)
@given(st.floats(-0.9, 0.9), signs, st.floats(0.3, 3.0), ratios, ratios)
def test_alternating_laws_give_their_order(phi0, sign, p, r21, r32):
    """(-1)^i h^p is what Celik's sign term describes."""
    values = [phi0 + sign * (-1.0) ** i * h**p for i, h in enumerate((1.0, r21, r21 * r32))]
    grids = GridTriplet(*values, r21, r32)
    assert grids.behaviour == "oscillatory convergent"
    assert grids.order == pytest.approx(p, rel=1e-6)


@settings(deadline=None, max_examples=60)
@given(orders, ratios, ratios)
def test_a_singular_law_diverges_with_its_negative_order(p, r21, r32):
    grids = power_law(1.0, 1.0, -p, r21, r32)
    assume(abs(grids.eps32) > 1e-9)
    assert grids.behaviour == "monotone divergent"
    assert grids.order == pytest.approx(-p, rel=1e-5)
    assert math.isnan(grids.error)
    assert math.isnan(grids.extrapolated)


@settings(deadline=None, max_examples=60)
@given(st.floats(0.01, 100.0), st.floats(-10.0, 10.0), orders, ratios, ratios)
def test_order_does_not_change_with_unit_and_zero(scale, shift, p, r21, r32):
    grids = power_law(0.0, 1.0, p, r21, r32)
    moved = GridTriplet(*(scale * value + shift for value in (grids.fine, grids.medium, grids.coarse)), r21, r32)
    assert moved.order == pytest.approx(grids.order, rel=1e-6)
    assert moved.error == pytest.approx(scale * grids.error, rel=1e-5)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 2, 0), (2, 0, 1)])
def test_order_of_the_grids_is_that_of_their_spacings(order):
    values, spacings = (6.063, 5.972, 5.863), (1.0, 1.5, 2.0)
    grids = GridTriplet.from_spacings([values[i] for i in order], [spacings[i] for i in order])
    assert (grids.fine, grids.medium, grids.coarse) == values
    assert (grids.r21, grids.r32) == pytest.approx((1.5, 4.0 / 3.0))


@pytest.mark.parametrize(
    ("values", "cells", "behaviour", "p", "extrapolated", "e_a", "e_ext"),
    [
        ((6.063, 5.972, 5.863), (18000, 8000, 4500), "monotone convergent", 1.5340, 6.16850, 1.501, 1.710),
        ((10.7880, 10.7250, 10.6050), (18000, 4500, 980), "monotone convergent", 0.7519, 10.88010, 0.584, 0.847),
        ((6.0042, 5.9624, 6.0909), (18000, 4500, 980), "oscillatory convergent", 1.5077, 6.02687, 0.696, 0.376),
    ],
)
def test_examples_of_celik_et_al(values, cells, behaviour, p, extrapolated, e_a, e_ext):
    grids = GridTriplet.from_spacings(values, spacings_from_cells(cells, 2))
    assert grids.behaviour == behaviour
    assert grids.order == pytest.approx(p, abs=5e-5)
    assert grids.extrapolated == pytest.approx(extrapolated, abs=5e-6)
    assert 100 * grids.relative_change == pytest.approx(e_a, abs=5e-4)
    assert 100 * grids.relative_extrapolation == pytest.approx(e_ext, abs=5e-4)


def test_root_is_the_fixed_point_of_celik():
    grids = GridTriplet(10.7880, 10.7250, 10.6050, 2.0, 2.1429)
    p = 0.0
    for _ in range(200):
        q = math.log((grids.r21**p - 1) / (grids.r32**p - 1)) if p else 0.0
        p = abs(math.log(abs(grids.eps32 / grids.eps21)) + q) / math.log(grids.r21)
    assert grids.order == pytest.approx(p, rel=1e-10)


def test_nasa_example():
    grids = GridTriplet(0.97050, 0.96854, 0.96178)
    assert grids.order == pytest.approx(1.786170, abs=5e-7)
    assert grids.extrapolated == pytest.approx(0.971300, abs=5e-7)
    assert grids.asymptotic_ratio == pytest.approx(1.0020, abs=5e-5)


def test_triplet_a():
    root = math.sqrt(2.0)
    grids = GridTriplet(1.0100, 1.0205, 1.0412, root, root)
    assert grids.ratio == pytest.approx(0.507246, abs=5e-7)
    assert grids.order == pytest.approx(1.958483, abs=5e-7)
    assert grids.error == pytest.approx(0.01080882, abs=5e-9)
    assert grids.correction_factor() == pytest.approx(0.971429, abs=5e-7)
    assert grids.extrapolated == pytest.approx(0.99919118, abs=5e-9)


@pytest.mark.parametrize(
    ("values", "behaviour"),
    [
        ((1.0, 1.1, 1.3), "monotone convergent"),
        ((1.0, 1.1, 0.7), "oscillatory convergent"),
        ((1.0, 1.3, 1.4), "monotone divergent"),
        ((1.0, 1.3, 1.1), "oscillatory divergent"),
        ((1.0, 1.0, 1.4), "equal solutions"),
        ((1.0, 1.4, 1.4), "equal solutions"),
        ((1.0, 1.0, 1.0), "equal solutions"),
        ((0.0, 0.0, 0.0), "equal solutions"),
    ],
)
def test_classes(values, behaviour):
    assert GridTriplet(*values).behaviour == behaviour


def test_equal_ratios_of_changes_diverge_slowly_where_the_coarse_ratio_is_smaller():
    """R = 0.95 with r21 = 1.2 and r32 = 1.5: a law of positive order would change more between the coarse grids."""
    values = (1.0, 1.0 + 0.95, 1.0 + 0.95 + 1.0)
    assert GridTriplet(*values, 1.5, 1.2).behaviour == "monotone convergent"
    assert GridTriplet(*values, 1.2, 1.5).behaviour == "monotone divergent"
    assert GridTriplet(*values, 1.2, 1.5).order < 0.0


def test_equal_solutions_have_no_order():
    grids = GridTriplet(1.0, 1.0, 1.4)
    assert math.isnan(grids.order)
    assert math.isnan(grids.correction_factor())
    assert grids.extrapolated == 1.0


def test_zero_reference_has_no_relative_error():
    grids = GridTriplet(0.0, 0.1, 0.3)
    assert math.isnan(grids.relative_change)
    assert math.isnan(grids.asymptotic_ratio)
    assert grids.relative_extrapolation == pytest.approx(1.0)
    assert math.isnan(GridTriplet(1.0, 2.0, 4.0).relative_extrapolation)


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: GridTriplet(1.0, math.nan, 2.0), "medium grid has no value"),
        (lambda: GridTriplet(1.0, 1.1, 1.3, 0.5), "does not exceed 1"),
        (lambda: GridTriplet.from_spacings([1.0, 2.0], [1.0, 2.0]), "no triplet"),
        (lambda: GridTriplet.from_spacings([1.0, 2.0, 3.0], [1.0, 2.0, 2.0]), "same spacing"),
    ],
)
def test_bad_input_is_named(call, words):
    with pytest.raises(TowtankError, match=words):
        call()
