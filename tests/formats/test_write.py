import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.formats.read import read_table
from towtank.formats.write import atomic_path, write_table

NAME = st.from_regex(r"[A-Z][A-Za-z_]{1,8}", fullmatch=True).filter(lambda name: name.lower() not in WORDS)
WORDS = {"nan", "na", "inf", "null", "infinity"}
NUMBER = st.floats(allow_infinity=False) | st.sampled_from([0.0, -0.0, 1.0, -250.0])


@st.composite
def tables(draw):
    names = draw(st.lists(NAME, min_size=2, max_size=5, unique=True))
    rows = draw(st.integers(1, 12))
    columns = {name: draw(st.lists(NUMBER, min_size=rows, max_size=rows)) for name in names}
    # Of columns without any number nobody can say that they hold numbers.
    columns[names[0]] = [float(row) for row in range(rows)]
    return {name: np.array(values) for name, values in columns.items()}


@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    columns=tables(),
    form=st.sampled_from(["\t.", "\t,", ";.", ";,", ",.", "|.", " ."]),
    with_units=st.booleans(),
)
def test_what_is_written_is_read_back(tmp_path, columns, form, with_units):
    path = tmp_path / "run.txt"
    units = dict(zip(columns, ["s", "N", "kN", "N m", "deg"])) if with_units else None
    write_table(path, columns, units, delimiter=form[0], decimal=form[1], header=["Run: 3"])
    table = read_table(path)
    assert list(table.columns) == list(columns)
    for name, values in columns.items():
        np.testing.assert_array_equal(table.columns[name], values)
    assert table.units == (units or dict.fromkeys(columns, ""))
    assert table.metadata == {"Run": 3.0}
    assert table.findings == ()


def test_text_of_the_file(tmp_path):
    path = tmp_path / "run.csv"
    columns = {"t": [0.0, 0.5], "Fx; bow": [1.25, np.nan]}
    write_table(path, columns, {"t": "s"}, delimiter=";", decimal=",", header=["Run: 3", "Tank 2"])
    assert path.read_text() == '# Run: 3\n# Tank 2\nt;"Fx; bow"\ns;-\n0;1,25\n0,5;nan\n'
    assert list(read_table(path).columns) == ["t", "Fx; bow"]


def test_encoding_of_the_header(tmp_path):
    write_table(tmp_path / "run.txt", {"t": [0.0], "psi": [1.0]}, {"t": "s", "psi": "°"}, encoding="latin-1")
    assert b"s\t\xb0\n" in (tmp_path / "run.txt").read_bytes()


@pytest.mark.parametrize(("delimiter", "decimal"), [(",", ","), ("", "."), (";;", "."), (";", ":"), ("\n", ".")])
def test_forms_that_cannot_be_read_back(tmp_path, delimiter, decimal):
    with pytest.raises(TowtankError, match="cannot be told apart or read again"):
        write_table(tmp_path / "run.txt", {"t": [0.0]}, delimiter=delimiter, decimal=decimal)


@pytest.mark.parametrize("columns", [{}, {"t": [0.0, 1.0], "Fx": [1.0]}])
def test_columns_of_unequal_length(tmp_path, columns):
    with pytest.raises(TowtankError, match="needs columns of one length"):
        write_table(tmp_path / "run.txt", columns)
    assert list(tmp_path.iterdir()) == []


def test_atomic_path_replaces_and_keeps_the_ending(tmp_path):
    path = tmp_path / "result.json"
    path.write_text("old")
    with atomic_path(path) as temporary:
        assert temporary.parent == tmp_path
        assert temporary.suffix == ".json"
        temporary.write_text("new")
        assert path.read_text() == "old"
    assert path.read_text() == "new"
    assert os.listdir(tmp_path) == ["result.json"]


@pytest.mark.parametrize("fault", [ValueError, KeyboardInterrupt])
def test_atomic_path_leaves_the_old_file_when_interrupted(tmp_path, fault):
    path = tmp_path / "result.json"
    path.write_text("old")
    with pytest.raises(fault), atomic_path(path) as temporary:  # noqa: PT012
        temporary.write_text("half")
        raise fault
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["result.json"]


def test_atomic_path_needs_a_folder(tmp_path):
    with (
        pytest.raises(TowtankError, match="the folder to write to does not exist"),
        atomic_path(tmp_path / "a" / "b"),
    ):
        pass
    with pytest.raises(TowtankError, match="is a folder"), atomic_path(tmp_path):
        pass
