import h5py
import numpy as np
import openpyxl
import pytest
import xlwt
from nptdms import ChannelObject, TdmsWriter
from scipy.io import savemat

from towtank.core.errors import ReadError
from towtank.formats.read import FORMATS, read_table
from towtank.formats.simman import SIMMAN_UNITS

T = np.array([0.0, 0.5, 1.0])


def text(path):
    path.write_text("t;Fx\n0;1\n0.5;2\n1;3\n")


def xlsx(path):
    book = openpyxl.Workbook()
    for row in (["t", "Fx"], [0, 1], [0.5, 2], [1, 3]):
        book.active.append(row)
    with open(path, "wb") as file:
        book.save(file)


def xls(path):
    book = xlwt.Workbook()
    sheet = book.add_sheet("a")
    for r, row in enumerate((["t", "Fx"], [0, 1], [0.5, 2], [1, 3])):
        for c, cell in enumerate(row):
            sheet.write(r, c, cell)
    with open(path, "wb") as file:
        book.save(file)


def mat(path):
    with open(path, "wb") as file:
        savemat(file, {"t": T, "Fx": [1, 2, 3]})


def mat4(path):
    with open(path, "wb") as file:
        savemat(file, {"t": T, "Fx": np.array([1.0, 2, 3])}, format="4")


def hdf5(path):
    with h5py.File(path, "w") as file:
        file["t"], file["Fx"] = T, [1, 2, 3]


def tdms(path):
    with TdmsWriter(str(path)) as writer:
        writer.write_segment([ChannelObject("g", "t", T), ChannelObject("g", "Fx", np.array([1, 2, 3]))])


@pytest.mark.parametrize(
    ("write", "ending"),
    [(text, "csv"), (xlsx, "xlsx"), (xls, "xls"), (mat, "mat"), (mat4, "mat"), (hdf5, "h5"), (tdms, "tdms")],
)
def test_every_format_by_its_ending(tmp_path, write, ending):
    path = tmp_path / f"run.{ending}"
    write(path)
    table = read_table(path)
    assert sorted(table.columns) == ["Fx", "t"]
    np.testing.assert_array_equal(table.columns["t"], T)


@pytest.mark.parametrize("write", [text, xlsx, xls, mat, hdf5, tdms])
def test_every_format_by_its_bytes(tmp_path, write):
    path = tmp_path / "run.001"
    write(path)
    assert read_table(path, columns=["Fx"]).columns["Fx"].tolist() == [1.0, 2.0, 3.0]


def test_text_that_is_called_a_workbook(tmp_path):
    text(tmp_path / "run.xls")
    assert len(read_table(tmp_path / "run.xls")) == 3


def test_simman_by_name(tmp_path):
    path = tmp_path / "run.dat"
    path.write_text("\t".join(SIMMAN_UNITS) + "\n" + "\t".join("1" * 13) + "\n")
    assert read_table(path).units["Time"] == ""
    assert read_table(path, format="simman").units == SIMMAN_UNITS


def test_forced_format(tmp_path):
    text(tmp_path / "run.csv")
    with pytest.raises(ReadError, match="is no readable HDF5 file"):
        read_table(tmp_path / "run.csv", format="hdf5")


def test_unknown_format(tmp_path):
    with pytest.raises(ReadError, match=f"format 'word' is unknown -> use auto or one of {', '.join(FORMATS)}"):
        read_table(tmp_path / "run.csv", format="word")


def test_missing_file(tmp_path):
    with pytest.raises(ReadError, match=r"run.csv: file not found -> check the path"):
        read_table(tmp_path / "run.csv")


def test_binary_of_an_unknown_kind(tmp_path):
    (tmp_path / "run.d7d").write_bytes(bytes(range(256)) * 4)
    with pytest.raises(ReadError, match=r"run.d7d: is a binary file of an unknown kind -> export the run as text"):
        read_table(tmp_path / "run.d7d")


def test_dialect_is_passed_on(tmp_path):
    text(tmp_path / "a.csv")
    first = read_table(tmp_path / "a.csv")
    assert read_table(tmp_path / "a.csv", dialect=first.dialect).dialect is first.dialect
