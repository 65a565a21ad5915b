"""All methods side by side, the default among them, the combination."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.verify import (
    METHODS,
    UNCERTAINTY_COLUMNS,
    combined_uncertainty,
    numerical_uncertainty,
    uncertainty_table,
)

THREE = [1.0, 1.5, 2.0]


def test_every_method_is_there_by_name():
    found = numerical_uncertainty([6.063, 5.972, 5.863], THREE, quantity="X", unit="N")
    table = uncertainty_table(found.estimates)
    assert list(table.columns) == [*UNCERTAINTY_COLUMNS, "note"]
    assert list(table["method"]) == list(METHODS)
    assert set(table["quantity"]) == {"X"}
    assert set(table["unit"]) == {"N"}
    assert "four grids" in found["Eca-Hoekstra"].note
    assert math.isnan(found["Eca-Hoekstra"].uncertainty)


@pytest.mark.parametrize(
    ("values", "spacings", "behaviour", "method"),
    [
        ([1.0, 1.1, 1.3], THREE, "monotone convergent", "factor of safety"),
        ([1.0, 1.1, 1.18], THREE, "monotone convergent", "GCI Oberkampf-Roy"),
        ([1.0, 1.1, 0.9], THREE, "oscillatory convergent", "data range"),
        ([1.0, 1.3, 1.35], THREE, "monotone divergent", "data range"),
        ([1.0, 1.3, 1.1], THREE, "oscillatory divergent", "data range"),
        ([1.0, 1.0, 1.0], THREE, "equal solutions", "data range"),
        ([1.0, 1.3], [1, 2], "too few grids", "GCI Roache"),
        ([1.0102, 1.0231, 1.0405, 1.0629, 1.0885], [1, 1.5, 2, 2.5, 3], "monotone convergent", "Eca-Hoekstra"),
        ([1.010, 1.018, 1.012, 1.022, 1.015], [1, 1.5, 2, 2.5, 3], "oscillatory convergent", "Eca-Hoekstra"),
        ([2.0, 2.0, 2.0, 2.0], [1, 2, 3, 4], "equal solutions", "data range"),
    ],
)
def test_default_method_of_each_class(values, spacings, behaviour, method):
    found = numerical_uncertainty(values, spacings)
    assert found.behaviour == behaviour
    assert found.preferred.method == method
    assert math.isfinite(found.preferred.uncertainty)
    assert {one.behaviour for one in found.estimates} >= {behaviour}


def test_a_method_without_a_value_gives_way_and_says_so():
    found = numerical_uncertainty([1.0, 1.1, 0.9], THREE)
    assert found.by("GCI Celik").method == "GCI Celik"
    other = found.by("Eca-Hoekstra")
    assert other.method == "data range"
    assert "'Eca-Hoekstra' has no value here" in other.note


def test_three_grid_methods_take_the_three_finest_of_many():
    values, h = [1.0102, 1.0231, 1.0405, 1.0629], [1, 1.5, 2, 2.5]
    many = numerical_uncertainty(values, h)
    three = numerical_uncertainty(values[:3], h[:3])
    assert many["GCI Celik"].uncertainty == pytest.approx(three["GCI Celik"].uncertainty)
    assert many["GCI Celik"].note.startswith("of the three finest grids")


@settings(deadline=None, max_examples=40)
@given(st.permutations(range(5)), st.floats(0.6, 1.9), st.floats(0.01, 100.0))
def test_neither_order_nor_unit_of_the_grids_matters(order, p, scale):
    h = np.array([1.0, 1.3, 1.7, 2.3, 3.0])
    values = 2.0 + 0.1 * h**p
    found = numerical_uncertainty(scale * values[list(order)], 5.0 * h[list(order)])
    straight = numerical_uncertainty(values, h)
    for one, other in zip(found.estimates, straight.estimates, strict=True):
        assert one.behaviour == other.behaviour
        assert one.uncertainty == pytest.approx(scale * other.uncertainty, rel=1e-5, nan_ok=True)
    assert found.preferred.uncertainty == pytest.approx(1.25 * 0.1 * scale, rel=1e-4)


def test_zero_fine_value_has_an_absolute_uncertainty():
    found = numerical_uncertainty([0.0, 0.1, 0.3], [1, 2, 4])
    assert found.preferred.uncertainty > 0.0
    assert math.isnan(found.triplet.relative_change)


def test_parts_add_in_squares():
    assert combined_uncertainty(grid=3.0, time_step=4.0) == 5.0
    assert combined_uncertainty(1.0, 2.0, 2.0, 4.0) == 5.0
    assert math.isnan(combined_uncertainty(grid=math.nan, time_step=1.0))
    with pytest.raises(TowtankError, match="negative"):
        combined_uncertainty(grid=-1.0)


@pytest.mark.parametrize(
    ("values", "spacings", "words"),
    [
        ([1.0], [1.0], r"1 grid\(s\)"),
        ([], [], r"0 grid\(s\)"),
        ([1.0, 2.0], [1.0], "2 values on 1 grids"),
        ([1.0, math.nan, 2.0], [1, 2, 3], "grid 2 has no value"),
        ([1.0, math.inf, 2.0], [1, 2, 3], "grid 2 has no value"),
        ([1.0, 1.1, 1.2], [1, 2, 2], "same spacing"),
        ([1.0, 1.1, 1.2], [1, 2, 0], "spacing 0"),
    ],
)
def test_bad_input_is_named(values, spacings, words):
    with pytest.raises(TowtankError, match=words):
        numerical_uncertainty(values, spacings, quantity="X")


def test_unknown_method_and_formal_order_are_named():
    found = numerical_uncertainty([1.0, 1.1, 1.3], THREE)
    with pytest.raises(TowtankError, match="no method 'gci'"):
        found.by("gci")
    with pytest.raises(TowtankError, match="formal order 0"):
        numerical_uncertainty([1.0, 1.1, 1.3], THREE, formal_order=0.0)
