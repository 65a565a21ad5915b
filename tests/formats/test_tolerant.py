import pytest

from towtank.core.errors import ReadError
from towtank.formats.dialect import Dialect
from towtank.formats.tolerant import LineFaults, parse_patiently

DIALECT = Dialect(";", names=("t", "Fx"), comment="#", first_data_row=2)


def test_faults_are_counted_from_the_first_line_of_the_file():
    columns, faults = parse_patiently(b"0;1\n\n# pause\n1;2\n2", DIALECT, ["Fx"], "a.txt")
    assert [column.tolist() for column in columns] == [[1.0, 2.0]]
    assert faults == LineFaults(blank=[4], comments=[(5, "# pause")], cut=7)
    assert [(one.rule, one.place, one.severity) for one in faults.findings("a.txt")] == [
        ("ragged-last-line", "line 7", "warning"),
        ("blank-rows", "line 4", "warning"),
        ("comment-in-data", "line 5", "warning"),
    ]


def test_no_faults_no_findings():
    assert LineFaults().findings("a.txt") == []


def test_a_single_ragged_line_is_an_error():
    with pytest.raises(ReadError, match=r"a.txt, line 3: the line has 1 values where 2 columns are expected"):
        parse_patiently(b"0\n", DIALECT, ["Fx"], "a.txt")


def test_cut_number_in_the_middle_is_an_error():
    with pytest.raises(ReadError, match=r"line 3, column Fx: '1.5E' is not a number"):
        parse_patiently(b"0;1.5E\n1;2\n", DIALECT, ["Fx"], "a.txt")


def test_text_in_the_last_line_is_an_error():
    with pytest.raises(ReadError, match=r"line 4, column Fx: 'end' is not a number"):
        parse_patiently(b"0;1.5\n1;end\n", DIALECT, ["Fx"], "a.txt")


def test_only_blank_lines_are_an_error():
    with pytest.raises(ReadError, match=r"a.txt: there are no data rows"):
        parse_patiently(b"\n;\n", DIALECT, ["Fx"], "a.txt")
