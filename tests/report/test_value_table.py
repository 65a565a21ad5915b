"""Tables of results."""

import math

import pytest

from towtank.core.errors import ReadError
from towtank.report.value_table import numerical_uncertainties, read_values


@pytest.fixture
def written(tmp_path):
    def write(text: str):
        path = tmp_path / "table.csv"
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_values_with_expanded_uncertainty(written):
    table = read_values(written("quantity,value,uncertainty,unit\nX,-7.2,0.3,N\nN,1.5,,N m\n"))
    assert table.kind == "values"
    assert table.file == "table.csv"
    assert len(table.sha256) == 64
    rows = table.frame.set_index("quantity")
    assert rows.loc["X"].tolist() == [-7.2, 0.3, 0.0, 0.0, "N"]
    assert math.isnan(rows.loc["N", "uncertainty"])


def test_standard_uncertainties_are_expanded(written):
    path = written("quantity,value,std,input_uncertainty,covariance\nX,1,0.1,0.05,0.002\n")
    row = read_values(path).frame.iloc[0]
    assert (row["uncertainty"], row["input_uncertainty"], row["covariance"]) == (0.2, 0.05, 0.002)
    assert read_values(path, coverage=3.0).frame["uncertainty"].iloc[0] == pytest.approx(0.3)


def test_indices_of_simulated_manoeuvres(written):
    rows = "turning 35,advance,3.1,L,0.05,3.0,3.2\nturning 35,transfer,1.3,L,,,\n"
    table = read_values(written("manoeuvre,index,value,unit,sd,p05,p95\n" + rows))
    assert table.kind == "indices"
    assert table.frame["quantity"].tolist() == ["turning 35: advance", "turning 35: transfer"]
    assert table.frame["uncertainty"].iloc[0] == pytest.approx(0.1)
    assert math.isnan(table.frame["uncertainty"].iloc[1])


def test_curves_and_derivatives_are_told_apart(written):
    curves = read_values(written("speed,sinkage\n1,0.1\n2,\n"))
    assert curves.kind == "curves"
    assert math.isnan(curves.frame["sinkage"].iloc[1])
    assert read_values(written("name,value,std\nYv,-0.3,0.01\n")).kind == "derivatives"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("quantity,value,uncertainty\nX,1,-0.1\n", "line 2: uncertainty = -0.1 is negative"),
        ("quantity,value\nX,\n", "line 2: the value of 'X' is missing"),
        ("quantity,value\nX,nan\n", "the value of 'X' is missing"),
        ("quantity,value\nX,1\nX,2\n", "line 3: 'X' is given twice"),
        ("quantity,value,uncertainty,std\nX,1,0.1,0.05\n", "columns uncertainty and std"),
        ("quantity,value\n", "the table has no rows"),
        ("speed\n1\n", "the table has the columns speed"),
        ("speed,sinkage\n1,a\n", "line 2: sinkage = 'a' is not a number"),
    ],
)
def test_faults_are_named_with_their_line(written, text, message):
    with pytest.raises(ReadError, match=message):
        read_values(written(text))


UNCERTAINTIES = (
    "quantity,method,class,order,extrapolated,uncertainty,unit\n"
    "X,gci,monotone convergent,2,1.0,0.1,N\nX,eca-hoekstra,monotone convergent,2,1.0,0.2,N\nN,gci,,,,,N m\n"
)


def test_numerical_uncertainties_of_one_method(written):
    found = numerical_uncertainties(written(UNCERTAINTIES), "gci")
    assert found["X"] == 0.1
    assert math.isnan(found["N"])
    assert numerical_uncertainties(written("quantity,uncertainty\nX,0.3\n")) == {"X": 0.3}


def test_several_methods_must_be_chosen_from(written):
    with pytest.raises(ReadError, match="several uncertainties of 'X' -> choose with --method: gci, eca-hoekstra"):
        numerical_uncertainties(written(UNCERTAINTIES))
    with pytest.raises(ReadError, match="no method 'celik' -> it has gci, eca-hoekstra"):
        numerical_uncertainties(written(UNCERTAINTIES), "celik")
    with pytest.raises(ReadError, match="no column 'uncertainty'"):
        numerical_uncertainties(written("quantity,value\nX,1\n"))


def test_units_of_numerical_uncertainties_must_agree(written):
    path = written("quantity,uncertainty,unit\nX,0.3,kN\n")
    with pytest.raises(ReadError, match="line 2: the uncertainty of 'X' is in 'kN', its value in 'N'"):
        numerical_uncertainties(path, units={"X": "N"})
    assert numerical_uncertainties(path, units={"X": ""}) == {"X": 0.3}
