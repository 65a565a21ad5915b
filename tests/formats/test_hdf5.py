import h5py
import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.hdf5 import read_hdf5

T = np.linspace(0, 1, 5)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "run.h5"


def test_vectors_with_units_and_attributes(path):
    with h5py.File(path, "w") as file:
        file.attrs["facility"] = "tank 2"
        file["t"] = T
        file["Fx"] = (2 * T).astype("f4")
        file["t"].attrs["units"] = "s"
        file["Fx"].attrs["unit"] = np.bytes_("kN")
        file["speed"] = 1.5
        file["remark"] = "calm"
    table = read_hdf5(path)
    assert table.units == {"Fx": "kN", "t": "s"}
    assert table.metadata == {"facility": "tank 2", "speed": 1.5, "remark": "calm"}
    np.testing.assert_array_equal(table.columns["t"], T)


def test_only_group_is_found(path):
    with h5py.File(path, "w") as file:
        file["measured/run 1/t"] = T
        file["measured/run 1"].attrs["U"] = 1.2
    table = read_hdf5(path)
    assert list(table.columns) == ["t"]
    assert table.metadata == {"U": 1.2}


def test_several_groups_must_be_named(path):
    with h5py.File(path, "w") as file:
        file["a/t"] = T
        file["b/t"] = 2 * T
    with pytest.raises(ReadError, match=r"there are 2 groups with arrays -> name one of /a, /b"):
        read_hdf5(path)
    assert read_hdf5(path, "b").columns["t"][-1] == 2.0
    with pytest.raises(ReadError, match=r"there is no group 'c' -> the groups with arrays are /a, /b"):
        read_hdf5(path, "c")


def test_compound_dataset(path):
    rows = np.zeros(5, dtype=[("t", "f8"), ("Fx", "f4")])
    rows["t"] = T
    with h5py.File(path, "w") as file:
        file["table"] = rows
        file["table"].attrs["units"] = ["s", "N"]
    table = read_hdf5(path)
    assert table.units == {"t": "s", "Fx": "N"}
    np.testing.assert_array_equal(table.columns["t"], T)
    assert list(read_hdf5(path, "table", columns=["Fx"]).columns) == ["Fx"]


def test_matrix_with_named_columns(path):
    with h5py.File(path, "w") as file:
        file["run/data"] = np.column_stack([T, 2 * T])
        file["run/data"].attrs["columns"] = ["t", "Fx"]
        file["run/data"].attrs["units"] = ["s", "N"]
    table = read_hdf5(path)
    np.testing.assert_array_equal(table.columns["Fx"], 2 * T)
    assert table.units == {"t": "s", "Fx": "N"}


def test_no_arrays(path):
    with h5py.File(path, "w") as file:
        file["remark"] = "calm"
    with pytest.raises(ReadError, match=r"run.h5: there are no arrays of numbers"):
        read_hdf5(path)


def test_damaged_file(path):
    path.write_bytes(b"\x89HDF\r\n\x1a\n broken")
    with pytest.raises(ReadError, match=r"run.h5: is no readable HDF5 file"):
        read_hdf5(path)
