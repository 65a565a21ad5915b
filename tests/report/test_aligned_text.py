"""Tables for a terminal."""

from __future__ import annotations

import pandas as pd

from towtank.report.aligned_text import aligned_text


def test_columns_are_aligned_and_empty_ones_left_out():
    frame = pd.DataFrame(
        {"index": ["advance", "z"], "value": [3.0782, -61.93], "n": [1, 20], "sd": [float("nan")] * 2}
    )
    lines = aligned_text(frame, ["index", "value", "n", "sd"]).splitlines()
    assert lines == ["index     value   n", "advance   3.078   1", "z        -61.93  20"]


def test_small_and_missing_numbers():
    frame = pd.DataFrame({"a": [1.234e-7, float("nan"), 0.0, 123456.0]})
    assert [line.strip() for line in aligned_text(frame, ["a"]).splitlines()] == [
        "a",
        "1.234e-07",
        "",
        "0",
        "123456",
    ]
