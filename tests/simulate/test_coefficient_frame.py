"""Reading tables of force coefficients."""

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import ReadError
from towtank.simulate.coefficient_frame import coefficient_columns, coefficient_frame, read_from


def test_comments_and_spaces_do_not_matter(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("# wind tunnel, 2019\nangle [deg], CX, CY\n0, -0.6, 0\n180, 0.5, 0\n")
    frame = coefficient_frame(path)
    assert list(frame.columns) == ["angle [deg]", "CX", "CY"]
    angles, columns = coefficient_columns(frame, "angle [deg]", ("CX",), ("CK",))
    assert angles.tolist() == [0, 180]
    assert columns["CX"].tolist() == [-0.6, 0.5]
    assert np.array_equal(columns["CK"], [0.0, 0.0])


def test_empty_file_is_named(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("")
    with pytest.raises(ReadError, match=r"table\.csv: not a table of coefficients"):
        coefficient_frame(path)


def test_faults_of_the_table_name_its_file(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("a,b\n1,2\n")
    with pytest.raises(ReadError, match=r"table\.csv: the table has no column 'angle'"), read_from(path) as frame:
        coefficient_columns(frame, "angle", ("a",))


def test_missing_column_lists_what_there_is():
    with pytest.raises(ReadError, match=r"no column 'CN'.*this one has a, CX"):
        coefficient_columns(pd.DataFrame({"a": [0], "CX": [1]}), "a", ("CX", "CN"))
