"""Digits, signs and names as they are printed."""

from __future__ import annotations

import math

import pytest

from towtank.core.terms import Term
from towtank.report.typography import (
    FIGURE_SPACE,
    POINT_SPACE,
    aligned,
    derivative_name,
    fixed,
    printed_formula,
    signed,
    significant,
)


def test_points_of_a_column_stand_in_line() -> None:
    cells = aligned(["−1.25", "30", "0.1", "–", "> 999"])
    assert cells == [
        "−1.25",
        "30" + POINT_SPACE + FIGURE_SPACE * 2,
        "0.1" + FIGURE_SPACE,
        "–",
        "> 999",
    ]
    assert aligned(["1", "20"]) == ["1", "20"]


@pytest.mark.parametrize(
    ("value", "places", "text"),
    [(-1.25, 1, "−1.2"), (-0.004, 2, "0.00"), (math.nan, 2, "–"), (-math.inf, 2, "−∞"), (3.0, 0, "3")],
)
def test_fixed(value: float, places: int, text: str) -> None:
    assert fixed(value, places) == text


@pytest.mark.parametrize(
    ("value", "text"),
    [(0.0, "0"), (1234.5, "1234"), (0.012345, "0.0123"), (-6.93e-5, "−6.93·10⁻⁵"), (2.5e7, "2.50·10⁷")],
)
def test_significant(value: float, text: str) -> None:
    assert significant(value) == text


def test_signed_numbers_carry_their_sign() -> None:
    assert [signed(x, 1) for x in (1.26, -1.26, 0.01, math.nan)] == ["+1.3", "−1.3", "0.0", "–"]


@pytest.mark.parametrize(
    ("name", "html"),
    [
        ("Yvvr", '<i class="term">Y</i><sub>vvr</sub>'),
        ("Nr|r|", '<i class="term">N</i><sub>r|r|</sub>'),
        ("Xudot", '<i class="term">X</i><sub>u̇</sub>'),
        ("Kvphi", '<i class="term">K</i><sub>vφ</sub>'),
        ("R0", '<i class="term">R</i><sub>0</sub>'),
        ("X0", '<i class="term">X</i><sub>0</sub>'),
    ],
)
def test_derivative_names(name: str, html: str) -> None:
    assert derivative_name(Term.parse(name)) == html


def test_formulas_in_print() -> None:
    assert printed_formula("0.5 rho L^2 T U^2, v' = v/U") == "½ ρ L² T U², v′ = v/U"
