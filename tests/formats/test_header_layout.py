import pytest

from towtank.core.errors import ReadError
from towtank.formats.header_layout import lay_out
from towtank.formats.number_text import is_number

DATA = [["0", "1", "2"], ["1", "3", "4"], ["2", "5", "6"]]


def layout(*heads, bulk=DATA, comments=()):
    rows = [list(row) for row in heads] + bulk
    marked = [index in comments for index in range(len(rows))]
    return lay_out(rows, marked, bulk, 3, is_number, file="run.csv")


def rules(found):
    return [finding.rule for finding in found.findings]


def test_names_alone():
    found = layout(["t", "Fx", "Fy"])
    assert (found.first_data, found.names_row, found.units_row, found.headings) == (1, 0, None, 1)
    assert found.names == ("t", "Fx", "Fy")
    assert found.units == ("", "", "")
    assert found.findings == ()


def test_names_and_units():
    found = layout(["t", "Fx", "Fy"], ["s", "N", "[N]"])
    assert (found.first_data, found.names_row, found.units_row, found.headings) == (2, 0, 1, 2)
    assert found.units == ("s", "N", "N")


def test_units_in_the_names():
    found = layout(["t [s]", "Fx (kN)", "Force (bow)"])
    assert found.names == ("t", "Fx", "Force (bow)")
    assert found.units == ("s", "kN", "")


def test_four_heading_rows_with_numbers_above_and_a_remark_below():
    found = layout(["1", "2", "3"], ["t", "Fx", "Fy"], ["s", "N", "N"], ["clock", "U9B", "U9B"])
    assert (found.first_data, found.names_row, found.units_row, found.headings) == (4, 1, 2, 3)
    assert found.names == ("t", "Fx", "Fy")


def test_units_above_the_names():
    found = layout(["s", "N", "N"], ["t", "Fx", "Fy"])
    assert (found.names_row, found.units_row, found.headings) == (1, 0, 2)


def test_names_that_are_also_units_stay_names():
    found = layout(["s", "N", "m"])
    assert found.names == ("s", "N", "m")
    assert found.units_row is None


def test_names_are_nearest_to_the_data():
    found = layout(["Tank", "Model", "Day"], [], ["t", "Fx", "Fy"])
    assert found.names == ("t", "Fx", "Fy")


def test_description_below_the_names_is_not_taken_for_them():
    found = layout(["t", "Fx", "Fy"], ["time", "force", "force"])
    assert found.names == ("t", "Fx", "Fy")


def test_names_may_be_numbers_when_a_heading_in_a_column_of_numbers_says_so():
    found = layout(["speed", "-0.92", "0"], ["[m/s]", "zf", "zf"])
    assert found.names == ("speed", "-0.92", "0")
    assert found.units == ("m/s", "", "")
    assert found.first_data == 2


def test_fewer_units_than_columns_are_a_finding():
    found = layout(["t", "Fx", "Fy"], ["s", "N"])
    assert found.units == ("s", "N", "")
    assert rules(found) == ["units-fewer-than-columns"]
    assert "2 entries for 3 columns" in found.findings[0].message


def test_fewer_names_than_columns_are_a_finding():
    found = layout(["t", "Fx"])
    assert found.names == ("t", "Fx", "column_3")
    assert rules(found) == ["names-fewer-than-columns"]


def test_no_names_at_all():
    found = layout()
    assert found.names == ("column_1", "column_2", "column_3")
    assert (found.names_row, found.headings, found.first_data) == (None, 0, 0)


def test_more_names_than_columns_are_an_error():
    with pytest.raises(ReadError, match=r"run.csv, row 1: the header names 4 columns but the rows have 3 values"):
        layout(["t", "Fx", "Fy", "Mz"])


def test_repeated_names_are_a_finding():
    found = layout(["t", "Fx", "Fx"])
    assert found.names == ("t", "Fx", "Fx_2")
    assert rules(found) == ["duplicate-columns"]


def test_text_column_is_a_finding():
    bulk = [["0", "1", "ok"], ["1", "3", "ok"]]
    found = layout(["t", "Fx", "state"], bulk=bulk)
    assert found.text_columns == (2,)
    assert rules(found) == ["text-column"]


def test_commented_names_count_but_not_a_commented_sentence():
    found = layout(["made", "by", "the", "lab"], ["t", "Fx", "Fy"], comments=(0, 1))
    assert found.names == ("t", "Fx", "Fy")
    found = layout(["made", "by"], comments=(0,))
    assert found.names_row is None


def test_comments_above_the_names_may_have_as_many_words():
    remark = ["run", "number", "three"]
    assert layout(remark, ["t", "Fx", "Fy"], comments=(0,)).names == ("t", "Fx", "Fy")
    assert layout(["t", "Fx", "Fy"], remark, comments=(1,)).names == ("t", "Fx", "Fy")


def test_row_with_a_fault_under_the_names_is_data():
    bulk = [["0", "abc", "2"], *DATA]
    assert layout(["t", "Fx", "Fy"], bulk=bulk).first_data == 1
    ragged = [["0", "1"], *DATA]
    rows = [["t", "Fx", "Fy"], *ragged]
    assert lay_out(rows, [False] * len(rows), DATA, 3, is_number).first_data == 1


def test_header_without_data_is_an_error():
    with pytest.raises(ReadError, match=r"run.csv: there are no data rows"):
        lay_out([["t", "Fx"], ["s", "N"]], [False] * 2, [["s", "N"]], 2, is_number, file="run.csv")
