"""The compiled parser of solver logs gives the nearest double of every number, or hands the line back."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from towtank.formats.decimal_rows import COMPLETE, FAULT, FULL, character_kinds, first_cells, parse_rows

DOUBLE = st.floats(allow_nan=False, allow_infinity=False).filter(lambda x: x == 0 or 1e-250 < abs(x) < 1e250)
NUMBER = st.one_of(
    DOUBLE.map(repr),
    DOUBLE.map("{:.18e}".format),
    DOUBLE.map("{:.6e}".format),
    st.from_regex(r"[-+]?[0-9]{1,9}\.[0-9]{0,10}", fullmatch=True),
    st.from_regex(r"[-+]?\.[0-9]{1,19}", fullmatch=True),
    st.from_regex(r"[-+]?0\.0{1,30}[0-9]{1,17}", fullmatch=True),
    st.from_regex(r"[-+]?[0-9]{1,19}[eE][-+]?[0-9]{1,2}", fullmatch=True),
)


def parse(text: str, columns: int, delimiter: str = " ", wanted=None, capacity: int = 99):
    places = np.arange(columns) if wanted is None else np.array(wanted)
    result = np.full((int(places.max()) + 1, capacity), -99.0)
    data = np.frombuffer(text.encode(), dtype=np.uint8)
    row, at, reason = parse_rows(
        data, 0, character_kinds(delimiter), delimiter != " ", ord("#"), places, result, 0
    )
    return result[:, :row], at, reason


@settings(deadline=None)  # the first call compiles
@given(NUMBER)
@example("-0")
@example("9007199254740993")  # half-way between two doubles: to the even one
@example("9007199254740995")
@example("1.7976931348623157e+250")
@example("2.2250738585072014e-250")
@example("9999999999999999999")
@example("0.000000000000000000000000000000000000123")
@example("6.02214076e+23")
def test_numbers_are_the_nearest_double(text):
    found, _, reason = parse(text + "\n", 1)
    assert reason == COMPLETE
    assert found[0].tobytes() == np.float64(float(text)).tobytes()


@pytest.mark.parametrize(
    "text", ["12345678901234567890", "1e300", "1e-300", "1e", "1.2.3", "--1", "x", "0x1", "1,5"]
)
def test_what_it_does_not_cover_is_handed_back(text):
    found, at, reason = parse(f"1\n{text}\n", 1)
    assert (reason, at, found.tolist()) == (FAULT, 2, [[1.0]])


@pytest.mark.parametrize("word", ["nan", "-nan", "NaN", "inf", "Infinity", "1.#QNAN", "1.#INF", "nan(ind)"])
def test_a_printed_nan_is_an_infinity(word):
    if "(" in word:
        # Parentheses separate: what stands in them would be a further cell.
        assert parse(f"{word}\n", 1)[2] == FAULT
    else:
        assert np.isinf(parse(f"{word}\n", 1)[0]).all()


@pytest.mark.parametrize("word", ["N/A", "n/a", "NA", "null", "-"])
def test_a_missing_value_is_nan(word):
    assert np.isnan(parse(f"1 {word}\n", 2)[0][1]).all()


def test_the_sign_of_infinity_is_kept():
    assert parse("-inf inf\n", 2)[0].ravel().tolist() == [-np.inf, np.inf]


def test_groups_blanks_and_tabs_separate():
    found, _, reason = parse("# a comment\n0.5\t((1 2 3) ( -4e0\t5. 6))\r\n\n   0.75 ((1 2 3) (4 5 6) ) \n", 7)
    assert reason == COMPLETE
    assert found.T.tolist() == [[0.5, 1, 2, 3, -4, 5, 6], [0.75, 1, 2, 3, 4, 5, 6]]


def test_delimited_cells_may_be_empty_or_quoted():
    found, _, reason = parse('1,,"3",\n 4 , 5 ,6\n7,8,\n', 3, ",")
    assert reason == COMPLETE
    assert np.array_equal(found.T, [[1, np.nan, 3], [4, 5, 6], [7, 8, np.nan]], equal_nan=True)


def test_columns_are_passed_over_whatever_they_hold():
    found, _, reason = parse("1 GAMG 2.5 true\n2 PBiCG 3.5 false\n", 4, wanted=[0, -1, 1, -1])
    assert reason == COMPLETE
    assert found.tolist() == [[1.0, 2.0], [2.5, 3.5]]


@pytest.mark.parametrize(
    ("text", "delimiter"), [("1 2\n3\n", " "), ("1 2\n3 4 5\n", " "), ("1,2\n3\n", ","), ("1,2\n3,4,5\n", ",")]
)
def test_rows_of_another_width_are_handed_back(text, delimiter):
    _, at, reason = parse(text, 2, delimiter)
    assert (at, reason) == (4, FAULT)


def test_it_stops_when_there_is_no_room():
    found, at, reason = parse("1\n2\n3\n", 1, capacity=2)
    assert (found.tolist(), at, reason) == ([[1.0, 2.0]], 4, FULL)


@pytest.mark.parametrize(
    ("text", "delimiter", "cells", "starts"),
    [
        ("0.5 ((1 2))\n# no\n\n  (0.75 3\n", " ", "0.5\n0.75\n", [0, 18]),
        ('1,2\n,3\n"4",5\n', ",", "1\n-\n4\n", [0, 4, 7]),
        ("x y\n", " ", "x\n", [0]),
    ],
)
def test_first_cells(text, delimiter, cells, starts):
    data = np.frombuffer(text.encode(), dtype=np.uint8)
    found, begins = first_cells(data, character_kinds(delimiter), ord("#"))
    assert found.tobytes().decode() == cells
    assert begins.tolist() == starts
