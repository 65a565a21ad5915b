"""Refinement studies from tables of either form, and what is wrong with bad ones."""

import math

import pytest

from towtank.core.errors import ReadError
from towtank.report.grid_table import read_grid_table

WIDE = """grid;cells;X [N];N
coarse;1360061;-0.01811;0.01120
fine;6009588;-0.01742;0.01431
medium;2533357;-0.01765;0.01325
"""

LONG = """quantity,unit,h,value,iterative
X,N,1,10.1,0.01
X,N,1.5,10.2,0.02
X,N,2,10.4,0.03
Y,N,1,3.1,
Y,N,2,3.4,
Y,N,1.5,3.2,
"""


@pytest.fixture
def written(tmp_path):
    def write(text):
        path = tmp_path / "grids.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_a_row_a_grid(written):
    table = read_grid_table(written(WIDE), assumed_ratio=1.4)
    assert [(one.quantity, one.unit) for one in table.studies] == [("X", "N"), ("N", "")]
    part = table.studies[0].grid
    assert part.values.tolist() == [-0.01811, -0.01742, -0.01765]
    assert part.spacings == pytest.approx([1.64095, 1.0, 1.33367], abs=1e-4)
    assert table.studies[0].time_step is None
    assert {one.rule for one in table.findings} == {"refinement-ratio", "small-refinement"}
    assert {one.file for one in table.findings} == {"grids.csv"}
    assert len(table.sha256) == 64


def test_a_row_a_value(written):
    first, second = read_grid_table(written(LONG)).studies
    assert first.iterative == 0.01
    assert math.isnan(second.iterative)
    assert second.grid.spacings.tolist() == [1.0, 2.0, 1.5]


def test_only_what_is_asked_for(written):
    path = written(WIDE)
    assert [one.quantity for one in read_grid_table(path, quantities=["N"]).studies] == ["N"]
    with pytest.raises(ReadError, match="no quantity 'Xx'"):
        read_grid_table(path, quantities=["Xx"])


def test_grids_at_one_time_step_and_time_steps_on_one_grid(written):
    text = (
        "h,dt,X,X_iterative\n1,1,10.1,0.02\n2,1,10.2,0.1\n4,1,10.6,0.1\n2,2,10.3,0.1\n2,4,10.7,0.1\n8,4,11.5,0.1\n"
    )
    table = read_grid_table(written(text))
    (study,) = table.studies
    assert study.grid.values.tolist() == [10.1, 10.2, 10.6]
    assert study.time_step.values.tolist() == [10.2, 10.3, 10.7]
    assert study.iterative == 0.02
    assert [one.rule for one in table.findings] == ["unused-rows"]


def test_time_steps_alone(written):
    (study,) = read_grid_table(written("time_step,X\n0.01,1\n0.02,1.1\n0.04,1.4\n")).studies
    assert study.grid is None
    assert study.time_step.spacings.tolist() == [0.01, 0.02, 0.04]


def test_curves_over_a_column(written):
    text = "h,beta,Y\n1,2,0.1\n1,4,0.2\n2,2,0.11\n2,4,0.22\n4,2,0.15\n4,4,0.3\n"
    (study,) = read_grid_table(written(text), over="beta").studies
    assert study.grid.points.tolist() == [2.0, 4.0, 2.0, 4.0, 2.0, 4.0]


def test_phases_need_a_unit(written):
    (study,) = read_grid_table(written("h,heave_phase [deg]\n1,1\n2,2\n4,4\n")).studies
    assert study.unit == "deg"
    with pytest.raises(ReadError, match="phase without a unit"):
        read_grid_table(written("h,heave_phase\n1,1\n2,2\n4,4\n"))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("X,Y\n1,2\n", "no column says how fine"),
        ("cells,h,X\n8,1,1\n", "cells and h both"),
        ("cells\n8\n1\n", "no quantity"),
        ("cells,X\n8,1\n-1,2\n", "line 3: cells is -1"),
        ("cells,X\n8,1\n,2\n", "line 3: cells is nan"),
        ("cells,X\n8,1\nmany,2\n", "line 3: cells = 'many' is not a number"),
        ("cells,X\n8,1\n1,two\n", "line 3: X = 'two' is not a number"),
        ("cells,X\n64,1\n8,\n1,3\n", "X has no value in data row 2"),
        ("cells,X\n64,1\n8,nan\n1,3\n", "X has no value in data row 2"),
        ("h,quantity,value,colour\n1,X,2,red\n", "unknown column 'colour'"),
        ("h,quantity,value\n1,,2\n", "line 2: the quantity has no name"),
        ("h,quantity,value,unit\n1,X,2,N\n2,X,3,kN\n", "line 3: X is in 'kN' here"),
        ("h,dt,X\n1,1,2\n", "X is on one grid"),
        ("h,X,X_iterative\n1,2,-0.1\n2,2.1,0\n", "iterative uncertainty is negative"),
        ("h,X\n1,2,3\n", "line 2: 3 cells for 2 columns"),
        ("", "empty"),
    ],
)
def test_bad_tables_are_named(written, text, words):
    with pytest.raises(ReadError, match=words) as error:
        read_grid_table(written(text))
    assert "grids.csv" in str(error.value)
    assert error.value.cure


def test_missing_file_and_curve_column_are_named(written, tmp_path):
    with pytest.raises(ReadError, match="not found"):
        read_grid_table(tmp_path / "none.csv")
    with pytest.raises(ReadError, match="no column 'beta'"):
        read_grid_table(written(WIDE), over="beta")
