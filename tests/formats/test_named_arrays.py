import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.named_arrays import NamedArray, as_entry, as_texts, assemble
from towtank.formats.source_file import SourceFile

SOURCE = SourceFile("run.bin", b"", "ab")


def test_vectors_matrices_and_single_numbers():
    table = assemble(
        [
            NamedArray("t", np.arange(4), units=["s"]),
            NamedArray("F", np.arange(8).reshape(4, 2), ["Fx", "Fy"], ["N", "kN"]),
            NamedArray("wave", np.arange(8).reshape(2, 4)),
            NamedArray("speed", np.array([[1.5]])),
        ],
        SOURCE,
    )
    assert list(table.columns) == ["t", "Fx", "Fy", "wave_1", "wave_2"]
    assert table.columns["Fy"].tolist() == [1.0, 3.0, 5.0, 7.0]
    assert table.columns["wave_2"].tolist() == [4.0, 5.0, 6.0, 7.0]
    assert table.units["Fy"] == "kN"
    assert table.metadata == {"speed": 1.5}
    assert (table.path, table.sha256) == ("run.bin", "ab")


def test_names_tell_which_dimension_holds_the_channels():
    wide = assemble([NamedArray("d", np.arange(6).reshape(3, 2), ["a", "b", "c"])], SOURCE)
    assert wide.columns["c"].tolist() == [4.0, 5.0]


def test_other_lengths_are_left_out_with_a_finding():
    arrays = [NamedArray(name, np.zeros(5)) for name in "abc"] + [
        NamedArray("calibration", np.zeros(7)),
        NamedArray("spectrum", np.zeros(5, dtype=complex)),
        NamedArray("film", np.zeros((2, 2, 2))),
    ]
    table = assemble(arrays, SOURCE)
    assert list(table.columns) == ["a", "b", "c"]
    assert [finding.rule for finding in table.findings] == ["left-out"]
    for name in ("calibration (7 values)", "spectrum", "film"):
        assert name in table.findings[0].message


def test_wanted_columns_decide_the_length():
    arrays = [NamedArray("a", np.zeros(5)), NamedArray("b", np.zeros(5)), NamedArray("c", np.ones(7))]
    assert len(assemble(arrays, SOURCE, wanted=["c"])) == 7
    with pytest.raises(ReadError, match=r"columns differ in length \(a: 5, c: 7\)"):
        assemble(arrays, SOURCE, wanted=["a", "c"])


def test_single_numbers_alone_are_a_table_of_one_row():
    table = assemble([NamedArray("a", np.array(1.0)), NamedArray("b", np.array(2))], SOURCE)
    assert len(table) == 1
    assert table.metadata == {}


def test_repeated_names():
    table = assemble([NamedArray("a", np.zeros(2)), NamedArray("a", np.ones(2))], SOURCE)
    assert list(table.columns) == ["a", "a_2"]
    assert [finding.rule for finding in table.findings] == ["duplicate-columns"]


@pytest.mark.parametrize(
    ("arrays", "fault"),
    [
        ([], "there are no arrays of numbers"),
        ([NamedArray("a", np.array(["x", "y"]))], "there are no arrays of numbers"),
        ([NamedArray("a", np.zeros(0))], "the arrays are empty"),
    ],
)
def test_nothing_to_read(arrays, fault):
    with pytest.raises(ReadError, match=f"run.bin: {fault}"):
        assemble(arrays, SOURCE)


def test_texts_and_entries():
    assert as_texts(np.array(["a ", "b"], dtype=object)) == ["a", "b"]
    assert as_texts([b"N", "m"]) == ["N", "m"]
    assert as_texts(np.array([1.0, 2.0])) == []
    assert as_entry(np.array(["a", "b"])) == "a, b"
    assert as_entry(np.float32(1.5)) == 1.5
    assert as_entry(np.array([[2]])) == 2.0
    assert as_entry(np.zeros(3)) is None
