"""The compiled parser gives the nearest double, or refuses."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from towtank.formats.plain_numbers import parse_plain
from towtank.formats.read import read_table

NUMBER = st.one_of(
    st.from_regex(r"[-+]?[0-9]{1,8}\.[0-9]{0,7}", fullmatch=True),
    st.from_regex(r"[-+]?\.?[0-9]{1,15}", fullmatch=True),
    st.from_regex(r"[-+]?[0-9]\.[0-9]{1,14}[eE][-+]?[0-7]", fullmatch=True),
)


def one(text: str) -> float | None:
    columns = parse_plain(text.encode(), ";", ".", 1, [0])
    return None if columns is None else float(columns[0][0])


@settings(deadline=None)  # the first call compiles
@given(NUMBER)
@example("-0")
@example("000000.000001")
@example("123456789012345")
@example("1e22")
@example("1.5e-20")
def test_plain_numbers_are_the_nearest_double(text):
    found = one(text)
    assert found is not None
    assert np.float64(found).tobytes() == np.float64(float(text)).tobytes()


@pytest.mark.parametrize(
    "text",
    ["", " 1", "1 ", "nan", "1234567890123456", "1.234567890123456789", "1e", "1e23", "1e-23", "1e99999", "--1",
     "1.2.3", "0x1", "1,5", "1d5", '"1"', "."],
)  # fmt: skip
def test_what_is_not_plain_is_refused(text):
    assert one(text) is None


def test_columns_and_decimal_comma():
    found = parse_plain(b"1,5\t2\t-3,25\r\n4\t5\t6", "\t", ",", 3, [2, 0])
    assert [column.tolist() for column in found] == [[-3.25, 6.0], [1.5, 4.0]]


@pytest.mark.parametrize(
    "body", [b"1;2\n3", b"1;2;3\n4;5;6", b"1;2\n\n3;4", b"1;2\n3;4;", b"1;2\n3;", b"1;2\n3;4\nend of data"]
)
def test_ragged_rows_are_refused(body):
    assert parse_plain(body, ";", ".", 2, [0, 1]) is None


def test_a_separator_behind_every_row():
    found = parse_plain(b"1;2;\n3;4;", ";", ".", 2, [1], trailing=1)
    assert found[0].tolist() == [2.0, 4.0]
    assert parse_plain(b"1;2;\n3;4", ";", ".", 2, [1], trailing=1) is None


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        ("t,X\ns,N\n0,1.5\n1,2.5\n2,3.5\n", set()),
        ("t,X\ns,N\n0,1.5\n1,\n2,3.5\n", set()),
        ("t,X\ns,N\n0,1.5\n1,2.5\n2", {"ragged-last-line"}),
        ("t,X\ns,N\n0,1.5\n\n1,2.5\n", {"blank-rows"}),
        ("t,X\ns,N\n0,1.23456789012345678\n1,2.5\n", set()),
    ],
)
def test_a_file_reads_the_same_compiled_or_not(tmp_path, text, rules):
    path = tmp_path / "run.csv"
    path.write_text(text)
    plain, compiled = read_table(path), read_table(path, compiled=True)
    assert plain.columns.keys() == compiled.columns.keys()
    for name, values in plain.columns.items():
        np.testing.assert_array_equal(values, compiled.columns[name])
    assert plain.findings == compiled.findings
    assert {finding.rule for finding in plain.findings} == rules
