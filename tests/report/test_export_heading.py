"""What every export says about itself."""

from __future__ import annotations

import math

import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.core.terms import Term
from towtank.datasets import load_set
from towtank.report.export_heading import heading, no_place, number


def test_heading_tells_conventions_source_and_conversion(hull: DerivativeSet) -> None:
    lines = heading(hull.to("prime"), hull, "a simulator")
    assert lines[0].startswith("hull: hydrodynamic derivatives for a simulator, written by towtank")
    assert "Converted: force_scaling LT -> L2" in lines
    assert "  sway variable: sway velocity v' = v/U" in lines
    assert "Uncertainty: not given by the source" in lines
    assert all("\n" not in line for line in lines)


def test_heading_passes_misprints_on() -> None:
    derivatives = load_set("s175")
    told = [line for line in heading(derivatives, derivatives, "x") if line.startswith("Misprint")]
    assert len(told) == len(derivatives.provenance.misprints) > 0


@pytest.mark.parametrize(("value", "text"), [(2.0, "2.0"), (-0.0, "0.0"), (1e-9, "1e-09"), (math.pi, "3.1415927")])
def test_numbers_are_floats_in_any_language(value: float, text: str) -> None:
    assert number(value) == text


def test_terms_of_a_conversion_are_told_apart() -> None:
    assert "the conversion to its conventions makes it" in str(no_place(Term.parse("Xvvvr"), "m", is_own=False))
    assert "conversion" not in str(no_place(Term.parse("Xvvvr"), "m"))
