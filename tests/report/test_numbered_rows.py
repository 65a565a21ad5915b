"""Small tables with line numbers."""

import pytest

from towtank.core.errors import ReadError
from towtank.report.numbered_rows import cell_number, numbered_rows


def test_comments_blank_lines_and_separators(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("\ufeff# source = tank\n\nname; value\nYv; -0.3\n# later\nNv; -0.1\n", encoding="utf-8")
    table = numbered_rows(path, "name,value")
    assert table.names == ("name", "value")
    assert table.rows == ((4, {"name": "Yv", "value": "-0.3"}), (6, {"name": "Nv", "value": "-0.1"}))
    assert table.comments == ((1, "source = tank"), (5, "later"))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "the table is empty -> give columns name,value"),
        (b"# only a heading\n", "the table is empty"),
        (b"a,b\n1,2,3\n", "line 2: 3 cells for 2 columns"),
        (b"a,b\n\xff\xfe1,2\n", "not readable as text"),
    ],
)
def test_what_is_no_table_is_named(tmp_path, content, message):
    path = tmp_path / "t.csv"
    path.write_bytes(content)
    with pytest.raises(ReadError, match=message):
        numbered_rows(path, "name,value")


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(ReadError, match=r"none.csv: file not found -> give a table with name,value"):
        numbered_rows(tmp_path / "none.csv", "name,value")


def test_numbers_and_what_is_none(tmp_path):
    assert cell_number("-1.5e-3", "value", tmp_path, "line 2") == -1.5e-3
    with pytest.raises(ReadError, match="line 2: value = '1,5' is not a number -> write decimals with a point"):
        cell_number("1,5", "value", tmp_path, "line 2")
    with pytest.raises(ReadError, match="value = 'x' is not a number -> mend the cell"):
        cell_number("x", "value", tmp_path, "line 2")
