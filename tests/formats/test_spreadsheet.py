import datetime

import numpy as np
import openpyxl
import pytest
import xlwt

from towtank.core.errors import ReadError
from towtank.formats.spreadsheet import read_spreadsheet


def save(path, sheets):
    if path.suffix == ".xls":
        book = xlwt.Workbook()
        for name, rows in sheets.items():
            sheet = book.add_sheet(name)
            for r, row in enumerate(rows):
                for c, cell in enumerate(row):
                    if cell is not None:
                        sheet.write(r, c, cell)
        book.save(str(path))
    else:
        book = openpyxl.Workbook()
        book.remove(book.active)
        for name, rows in sheets.items():
            sheet = book.create_sheet(name)
            for row in rows:
                sheet.append(row)
        book.save(path)
    return path


RUN = [
    ["Run", 12, None],
    ["Lab: tank 2", None, None],
    [None, None, None],
    ["t", "Fx", "Mz [N m]"],
    ["s", "kN", None],
    [0, 1.5, -2],
    [0.5, None, -3.25],
    [1, 2.5, 4],
]


def rules(table):
    return [finding.rule for finding in table.findings]


@pytest.mark.parametrize("ending", [".xls", ".xlsx"])
def test_names_units_values_and_metadata(tmp_path, ending):
    table = read_spreadsheet(save(tmp_path / f"run{ending}", {"data": RUN}))
    np.testing.assert_array_equal(table.columns["t"], [0, 0.5, 1])
    np.testing.assert_array_equal(table.columns["Fx"], [1.5, np.nan, 2.5])
    assert table.units == {"t": "s", "Fx": "kN", "Mz": "N m"}
    assert table.metadata == {"Run": 12.0, "Lab": "tank 2", "sheet": "data"}
    assert table.header[3] == "t\tFx\tMz [N m]"


@pytest.mark.parametrize("ending", [".xls", ".xlsx"])
def test_first_sheet_with_a_table_is_read_and_said(tmp_path, ending):
    path = save(tmp_path / f"run{ending}", {"notes": [["only words"]], "run 1": RUN, "run 2": RUN})
    table = read_spreadsheet(path)
    assert table.metadata["sheet"] == "run 1"
    assert "first-sheet" in rules(table)
    named = read_spreadsheet(path, "run 2", columns=["Fx"])
    assert list(named.columns) == ["Fx"]
    assert "first-sheet" not in rules(named)


def test_unknown_sheet(tmp_path):
    path = save(tmp_path / "run.xlsx", {"a": RUN, "b": RUN})
    with pytest.raises(ReadError, match=r"run.xlsx: there is no sheet 'c' -> the sheets are a, b"):
        read_spreadsheet(path, "c")


def test_margin_columns_and_blank_rows(tmp_path):
    rows = [[None, None], [None, "t", "Fx"], [None, 0, 1], [None, None, None], [None, 1, 2]]
    table = read_spreadsheet(save(tmp_path / "run.xlsx", {"a": rows}))
    assert list(table.columns) == ["t", "Fx"]
    assert table.columns["Fx"].tolist() == [1.0, 2.0]
    assert rules(table) == ["blank-rows"]
    assert table.findings[0].place == "line 4"


def test_text_in_a_number_cell_is_named(tmp_path):
    rows = [["t", "Fx"], [0, 1], [1, "broken"], [2, 3], [3, 4]]
    with pytest.raises(ReadError, match=r"run.xlsx, sheet 'a', column Fx, row 3: 'broken' is not a number"):
        read_spreadsheet(save(tmp_path / "run.xlsx", {"a": rows}))


def test_numbers_stored_as_text(tmp_path):
    rows = [["t", "Fx"], [0, "1,5"], [1, "2.5"]]
    table = read_spreadsheet(save(tmp_path / "run.xlsx", {"a": rows}))
    assert table.columns["Fx"].tolist() == [1.5, 2.5]
    assert rules(table) == ["numbers-as-text"]


def test_text_and_date_columns_are_left_out(tmp_path):
    day = datetime.datetime(2019, 5, 1, 12, 0)
    rows = [["t", "Fx", "when", "state"], [0, 1, day, "ok"], [1, 2, day, "ok"]]
    table = read_spreadsheet(save(tmp_path / "run.xlsx", {"a": rows}))
    assert list(table.columns) == ["t", "Fx"]
    assert rules(table) == ["text-column"]


@pytest.mark.parametrize("rows", [[["t", "Fx"]], [["only words"]], []])
def test_sheet_without_a_table(tmp_path, rows):
    with pytest.raises(ReadError, match=r"run.xlsx, sheet 'a'"):
        read_spreadsheet(save(tmp_path / "run.xlsx", {"a": rows}))


def test_no_sheet_with_a_table(tmp_path):
    with pytest.raises(ReadError, match="none of the sheets a, b holds a table"):
        read_spreadsheet(save(tmp_path / "run.xlsx", {"a": [["x"]], "b": [["y"]]}))


def test_damaged_workbook(tmp_path):
    (tmp_path / "run.xlsx").write_bytes(b"PK\x03\x04 and nothing more")
    with pytest.raises(ReadError, match=r"run.xlsx: is no readable workbook"):
        read_spreadsheet(tmp_path / "run.xlsx")
