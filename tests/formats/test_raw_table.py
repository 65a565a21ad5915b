import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.raw_table import RawTable, choose_columns, find_column, number_repeats

NAMES = ("Time", "Fx", "Fy", "Mz [N m]")


def test_table_has_length_frame_and_units():
    table = RawTable({"t": np.array([0.0, 1.0]), "Fx": np.array([1, 2])}, {"t": "s"}, path="a.csv", sha256="ab")
    assert len(table) == 2
    assert table.units == {"t": "s", "Fx": ""}
    assert table.columns["Fx"].dtype == np.float64
    assert list(table.frame.columns) == ["t", "Fx"]
    assert table.frame.attrs == {"units": {"t": "s", "Fx": ""}, "path": "a.csv", "sha256": "ab"}
    assert table.file_columns == ("t", "Fx")


def test_columns_are_read_only_and_the_given_array_is_not_touched():
    mine = np.array([1.0, 2.0])
    table = RawTable({"Fx": mine})
    with pytest.raises(ValueError, match="read-only"):
        table.columns["Fx"][0] = 5.0
    mine[0] = 7.0
    assert mine.flags.writeable


def test_unequal_lengths_are_refused():
    with pytest.raises(ReadError, match=r"a.csv: columns differ in length \(t: 2, Fx: 1\)"):
        RawTable({"t": np.zeros(2), "Fx": np.zeros(1)}, path="a.csv")


def test_empty_table_has_length_zero():
    assert len(RawTable({})) == 0


@pytest.mark.parametrize(("wanted", "found"), [("Fx", "Fx"), (1, "Time"), (4, "Mz [N m]")])
def test_column_by_name_or_number(wanted, found):
    assert find_column(wanted, NAMES) == found


def test_column_is_also_found_with_its_unit_in_brackets():
    assert find_column("Mz", NAMES, unit="N m") == "Mz [N m]"


def test_unknown_column_lists_the_closest_and_all():
    with pytest.raises(ReadError) as caught:
        find_column("fX1", NAMES, file="a.csv", place="channel X")
    text = str(caught.value)
    assert text.startswith("a.csv, channel X: there is no column 'fX1' -> closest: Fx")
    assert "the file has Time, Fx, Fy, Mz [N m]" in text


@pytest.mark.parametrize("number", [0, 5, -1])
def test_number_beyond_the_columns(number):
    with pytest.raises(ReadError, match=f"there is no column {number} -> count the columns from 1 to 4"):
        find_column(number, NAMES)


def test_chosen_columns_keep_the_order_asked_for():
    assert choose_columns(["Fy", 1, "Fy"], NAMES) == ["Fy", "Time"]
    assert choose_columns(None, NAMES, ["Fy"]) == ["Time", "Fx", "Mz [N m]"]


def test_text_column_is_refused_when_asked_for():
    with pytest.raises(ReadError, match="column 'Fy' holds text"):
        choose_columns(["Fy"], NAMES, ["Fy"], file="a.csv")


def test_repeated_names_are_numbered_without_a_new_clash():
    unique, repeated = number_repeats(["a", "b", "a", "a_2", "a"])
    assert unique == ("a", "b", "a_3", "a_2", "a_4")
    assert repeated == ("a",)
