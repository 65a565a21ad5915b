"""Verdicts of single cases."""

import json

import numpy as np
import pytest

from towtank.reproduce import Case, half_digit
from towtank.reproduce.case import agrees

KEYS = ["paper", "case", "quantity", "printed", "computed", "tolerance", "verdict", "note"]


def case(printed, computed, tolerance=0.0, expected=None):
    return Case("paper", "Table 1", "Yv", printed, computed, tolerance, expected, "why")


def test_half_of_the_last_digit():
    assert half_digit(0) == 0.5
    assert half_digit(3) == 0.0005


@pytest.mark.parametrize(
    ("printed", "computed", "tolerance", "expected", "verdict"),
    [
        (0.25, 0.254, 0.005, None, "reproduced"),
        (0.25, 0.256, 0.005, None, "not-reproducible"),
        (-0.4220, -0.04218, 5e-5, -0.0422, "reproduced-after-correction"),
        (-0.4220, -0.05, 5e-5, -0.0422, "not-reproducible"),
        ("L^2", "L T", 0.0, "L T", "reproduced-after-correction"),
        ("stable", "unstable", 0.0, None, "not-reproducible"),
        (1.0, float("nan"), 1.0, None, "not-reproducible"),
    ],
)
def test_verdict(printed, computed, tolerance, expected, verdict):
    assert case(printed, computed, tolerance, expected).verdict == verdict


def test_difference_of_exactly_the_tolerance_agrees_in_spite_of_binary_fractions():
    assert 0.3 - 0.2 != 0.1
    assert agrees(0.3, 0.2, 0.1)
    assert not agrees(0.3, 0.2, 0.0999)


def test_mapping_has_the_keys_of_the_json_and_survives_it():
    mapping = case(1.0, np.float64(1.0)).to_dict()
    assert list(mapping) == KEYS
    assert json.loads(json.dumps(mapping, allow_nan=False)) == {
        "paper": "paper",
        "case": "Table 1",
        "quantity": "Yv",
        "printed": 1.0,
        "computed": 1.0,
        "tolerance": 0.0,
        "verdict": "reproduced",
        "note": "why",
    }
