import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.formats.number_text import is_number, to_number


@pytest.mark.parametrize(
    ("text", "decimal", "value"),
    [
        ("1", ".", 1.0),
        ("-1.5", ".", -1.5),
        ("+.5", ".", 0.5),
        ("1.", ".", 1.0),
        ("1.5E-03", ".", 0.0015),
        ("1.5D+03", ".", 1500.0),
        ("1,5", ",", 1.5),
        ("-0,5e2", ",", -50.0),
        ("\u22121.5", ".", -1.5),
        (" 2.5\u00a0", ".", 2.5),
        ("-inf", ".", -math.inf),
        ("1.#INF", ".", math.inf),
    ],
)
def test_numbers(text, decimal, value):
    assert to_number(text, decimal) == value


@pytest.mark.parametrize("text", ["", "  ", "NaN", "n/a", "-1.#IND", "#N/A"])
def test_missing_values(text):
    assert math.isnan(to_number(text))


@pytest.mark.parametrize(
    ("text", "decimal"),
    [
        ("abc", "."),
        ("1,5", "."),
        ("1.5", ","),
        ("1,", ","),
        ("0x10", "."),
        ("1_000", "."),
        ("1.2.3", "."),
        ("-", "."),
    ],
)
def test_text_is_no_number(text, decimal):
    assert not is_number(text, decimal)
    with pytest.raises(ValueError, match="is not a number"):
        to_number(text, decimal)


@given(st.floats(allow_nan=False))
def test_printed_floats_are_read_back(value):
    assert to_number(repr(value)) == value
    assert to_number(repr(value).replace(".", ","), ",") == value
