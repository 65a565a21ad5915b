import h5py
import numpy as np
import pytest
from scipy.io import savemat

from towtank.core.errors import ReadError
from towtank.formats.matlab import read_matlab

T = np.linspace(0, 1, 6)


def save_v73(path, tree):
    """Write a file of version 7.3 as MATLAB does: transposed arrays, texts as codes, cells as references."""
    with h5py.File(path, "w", userblock_size=512) as file:

        def put(parent, name, value):
            if isinstance(value, dict):
                group = parent.create_group(name)
                group.attrs["MATLAB_class"] = np.bytes_("struct")
                letters = np.empty(len(value), dtype=object)
                letters[:] = [np.array([bytes([code]) for code in key.encode()], dtype="S1") for key in value]
                group.attrs.create("MATLAB_fields", letters, dtype=h5py.vlen_dtype(np.dtype("S1")))
                for key, one in value.items():
                    put(group, key, one)
            elif isinstance(value, str):
                codes = np.array([[ord(c)] for c in value], dtype="u2")
                parent.create_dataset(name, data=codes).attrs["MATLAB_class"] = np.bytes_("char")
            elif isinstance(value, list):
                references = []
                for count, one in enumerate(value):
                    put(file.require_group("#refs#"), f"{name}{count}", one)
                    references.append(file["#refs#"][f"{name}{count}"].ref)
                cells = np.array(references, dtype=h5py.ref_dtype)[:, None]
                parent.create_dataset(name, data=cells, dtype=h5py.ref_dtype).attrs["MATLAB_class"] = np.bytes_(
                    "cell"
                )
            else:
                array = np.atleast_2d(np.asarray(value, dtype=float))
                parent.create_dataset(name, data=array.T).attrs["MATLAB_class"] = np.bytes_("double")

        for key, one in tree.items():
            put(file, key, one)
    with open(path, "r+b") as file:
        file.write(
            b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Wed May  1 2019".ljust(124) + b"\x00\x02IM"
        )


def save_v5(path, tree):
    def plain(value):
        if isinstance(value, dict):
            return {key: plain(one) for key, one in value.items()}
        return np.array(value, dtype=object) if isinstance(value, list) else value

    savemat(path, plain(tree))


@pytest.fixture(params=["v5", "v7.3"])
def save(request, tmp_path):
    def write(**tree):
        path = tmp_path / "run.mat"
        (save_v5 if request.param == "v5" else save_v73)(path, tree)
        return path

    return write


def test_row_and_column_vectors(save):
    table = read_matlab(save(t=T[:, None], Fx=T[None, :] * 2, speed=1.5, ship="KVLCC2"))
    np.testing.assert_array_equal(table.columns["t"], T)
    np.testing.assert_array_equal(table.columns["Fx"], 2 * T)
    assert table.metadata == {"speed": 1.5, "ship": "KVLCC2"}


def test_nested_struct_and_units_struct(save):
    run = {
        "t": T,
        "balance": {"Fx": 2 * T, "Mz": 3 * T},
        "units": {"t": "s", "balance": {"Fx": "kN", "Mz": "N m"}},
    }
    path = save(run=run, name="drift")
    table = read_matlab(path)
    assert list(table.columns) == ["run.t", "run.balance.Fx", "run.balance.Mz"]
    assert table.units == {"run.t": "s", "run.balance.Fx": "kN", "run.balance.Mz": "N m"}
    assert table.metadata == {"name": "drift"}
    inner = read_matlab(path, "run.balance")
    assert list(inner.columns) == ["Fx", "Mz"]


def test_matrix_with_names_and_units(save):
    data = np.column_stack([T, 2 * T, 3 * T])
    table = read_matlab(save(data=data, names=["t", "Fx", "Fy"], units=["s", "N", "kN"]))
    np.testing.assert_array_equal(table.columns["Fy"], 3 * T)
    assert table.units == {"t": "s", "Fx": "N", "Fy": "kN"}


def test_matrix_without_names(save):
    table = read_matlab(save(data=np.column_stack([T, 2 * T])))
    assert list(table.columns) == ["data_1", "data_2"]


def test_vectors_take_listed_units_by_name_only(save):
    table = read_matlab(save(run={"t": T, "Fx": 2 * T, "names": ["Fx", "t"], "units": ["N", "s"]}))
    assert table.units == {"run.t": "s", "run.Fx": "N"}
    assert read_matlab(save(run={"t": T, "Fx": 2 * T, "units": ["s", "N"]})).units == {"run.t": "", "run.Fx": ""}


def test_one_unit_for_a_struct_of_one_channel(save):
    table = read_matlab(save(time={"values": T, "unit": "s"}, Fx={"values": T, "unit": "N"}))
    assert table.units == {"time.values": "s", "Fx.values": "N"}


def test_chosen_columns(save):
    assert list(read_matlab(save(t=T, Fx=T, Fy=T), columns=["Fy", "t"]).columns) == ["Fy", "t"]


def test_unknown_struct(save):
    with pytest.raises(ReadError, match=r"run.mat: there is no struct 'test' -> the structs are run"):
        read_matlab(save(run={"t": T}), "test")


def test_text_only(save):
    with pytest.raises(ReadError, match="there are no arrays of numbers"):
        read_matlab(save(ship="KVLCC2"))


@pytest.mark.parametrize("head", [b"MATLAB 5.0 MAT-file", b"MATLAB 7.3 MAT-file"])
def test_damaged_file(tmp_path, head):
    path = tmp_path / "run.mat"
    path.write_bytes(head.ljust(124) + b"\x00\x01IM" + b"\x0e\x00\x00\x00\xff\xff\x00\x00 broken")
    with pytest.raises(ReadError, match=r"run.mat: is no readable MATLAB"):
        read_matlab(path)


def test_matlab_objects_are_named_as_such(tmp_path):
    path = tmp_path / "run.mat"
    save_v73(path, {"name": "a table"})
    with h5py.File(path, "r+") as file:
        file.create_group("#subsystem#")
    with pytest.raises(ReadError, match=r"holds MATLAB objects .* -> save them as a struct"):
        read_matlab(path)
