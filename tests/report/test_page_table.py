"""Tables of the page."""

from __future__ import annotations

from towtank.report.page_table import Column, make_table
from towtank.report.typography import FIGURE_SPACE


def test_number_columns_are_aligned_and_text_is_left_alone() -> None:
    table = make_table([Column("a"), Column("b", "number")], [("1.5", "1.5"), ("x", "2.25")], marks=["", "weak"])
    assert table.rows == (("1.5", "1.5" + FIGURE_SPACE), ("x", "2.25"))
    assert [mark for mark, _ in table.marked_rows] == ["", "weak"]


def test_a_table_without_rows() -> None:
    assert make_table([Column("a", "number")], []).rows == ()
