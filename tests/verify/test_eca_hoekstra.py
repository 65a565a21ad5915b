"""Least squares of Eca and Hoekstra: test vectors of every branch, laws."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.verify import eca_hoekstra

H = np.array([1.0, 1.5, 2.0, 2.5, 3.0])


@pytest.mark.parametrize("p", [1.5, 2.0])
def test_exact_laws(p):
    found = eca_hoekstra(1.0 + 0.01 * H**p, H)
    assert found.observed_order == pytest.approx(p, abs=1e-9)
    assert found.fit.form == "h^p"
    assert found.fit.phi0 == pytest.approx(1.0, abs=1e-12)
    assert found.safety == 1.25
    assert found.uncertainty[0] == pytest.approx(0.0125, abs=1e-10)
    assert found.behaviour == "monotone convergent"


def test_third_order_is_replaced_by_the_second():
    found = eca_hoekstra(1.0 + 0.001 * H**3, H)
    assert found.observed_order == pytest.approx(3.0, abs=1e-9)
    assert found.fit.form == "h^2"
    assert found.fit.phi0 == pytest.approx(0.996912, abs=5e-7)
    assert found.safety == 3.0
    assert found.uncertainty[0] == pytest.approx(0.011831, abs=5e-7)


def test_noisy_data():
    found = eca_hoekstra([1.0102, 1.0231, 1.0405, 1.0629, 1.0885], H)
    assert found.observed_order == pytest.approx(1.88437, abs=5e-6)
    assert found.fit.phi0 == pytest.approx(0.998827, abs=5e-7)
    assert found.fit.sigma == pytest.approx(2.602e-4, abs=5e-8)
    assert found.safety == 1.25
    assert found.uncertainty[0] == pytest.approx(0.014467, abs=5e-7)


def test_scattered_data_take_the_branch_of_sigma_above_the_range():
    found = eca_hoekstra([1.010, 1.018, 1.012, 1.022, 1.015], H)
    assert math.isnan(found.observed_order)
    assert found.fit.form == "h"
    assert found.fit.phi0 == pytest.approx(1.008250, abs=5e-7)
    assert found.fit.sigma == pytest.approx(0.004578, abs=5e-7)
    assert found.data_range == pytest.approx(0.003)
    assert found.scattered
    assert found.uncertainty[0] == pytest.approx(0.045687, abs=5e-7)
    assert found.behaviour == "oscillatory convergent"
    assert "scatter rules" in found.estimate.note


def test_half_order_boundary_and_slow_laws():
    usual = eca_hoekstra(1.0 + 0.01 * H**0.6, H)
    assert usual.fit.form == "h^p"
    slow = eca_hoekstra(1.0 + 0.01 * H**0.3, H)
    assert slow.observed_order == pytest.approx(0.3, abs=1e-8)
    assert slow.fit.form == "h + h^2"
    assert slow.safety == 3.0


def test_order_just_above_two_keeps_the_small_factor():
    found = eca_hoekstra(1.0 + 0.01 * H**2.05, H)
    assert found.fit.form == "h^2"
    assert found.observed_order == pytest.approx(2.05, abs=1e-8)
    assert found.safety == 1.25


def test_two_powers_are_never_tried_for_fast_convergence():
    assert eca_hoekstra(1.0 + 0.01 * H - 0.004 * H**2 + 0.002 * H**4, H).fit.form != "h + h^2"


def test_weights_favour_fine_grids():
    phi = 1.0 + 0.01 * H**1.2
    phi[-1] += 0.01
    found = eca_hoekstra(phi, H)
    assert found.fit.weighted
    assert found.uncertainty.shape == (5,)
    assert np.all(found.uncertainty > 0.0)


@settings(deadline=None, max_examples=60)
@given(st.floats(0.55, 1.95), st.floats(-5.0, 5.0), st.sampled_from([-1.0, 1.0]), st.floats(0.01, 100.0))
def test_unit_and_zero_do_not_matter(p, shift, sign, scale):
    phi = sign * 0.3 * H**p
    found = eca_hoekstra(scale * phi + shift, 7.0 * H)
    assert found.observed_order == pytest.approx(p, rel=1e-5)
    assert found.fit.phi0 == pytest.approx(shift, abs=1e-4 * scale)
    assert found.uncertainty[0] == pytest.approx(1.25 * 0.3 * scale, rel=1e-4)


@settings(deadline=None, max_examples=60)
@given(st.permutations(range(5)))
def test_grids_may_come_in_any_order(order):
    phi = np.array([1.0102, 1.0231, 1.0405, 1.0629, 1.0885])
    found = eca_hoekstra(phi[list(order)], H[list(order)])
    assert found.values.tolist() == phi.tolist()
    assert found.uncertainty[0] == pytest.approx(0.014467, abs=5e-7)


@pytest.mark.parametrize(
    ("values", "behaviour"),
    [
        ([1.0, 1.1, 1.3, 1.6, 2.0], "monotone convergent"),
        # a logarithm of the spacing and less: no positive order fits
        ((1.0 - H**-0.8).tolist(), "monotone divergent"),
        ([1.0, 1.4, 0.8, 1.1, 1.0], "oscillatory divergent"),
    ],
)
def test_classes(values, behaviour):
    assert eca_hoekstra(values, H).behaviour == behaviour


@pytest.mark.parametrize(
    ("values", "spacings", "words"),
    [
        ([1.0, 1.1, 1.3], [1, 2, 3], "too few"),
        ([1.0, 1.1, np.nan, 1.3], [1, 2, 3, 4], "grid 3 has no value"),
        ([1.0, 1.1, 1.2, 1.3], [1, 2, 3, 3], "same spacing"),
        ([1.0, 1.1, 1.2], [1, 2, 3, 4], "3 values on 4 grids"),
        ([1.0, 1.0, 1.0, 1.0], [1, 2, 3, 4], "same number"),
    ],
)
def test_bad_input_is_named(values, spacings, words):
    with pytest.raises(TowtankError, match=words):
        eca_hoekstra(values, spacings)
