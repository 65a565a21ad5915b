"""``towtank compare``."""

from __future__ import annotations

import pandas as pd
import pytest


@pytest.fixture
def written(tmp_path):
    def write(name: str, text: str):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def test_two_sets_and_their_table(towtank, tmp_path):
    out = tmp_path / "comparison.csv"
    ended = towtank("compare", "dtmb5512-efd", "dtmb5512-cfd", "--out", out)
    assert ended.status == 0
    assert "BS =" in ended.out
    assert "rank" not in ended.out
    table = pd.read_csv(out)
    assert {"name", "A", "B", "B-A", "z", "verdict"} <= set(table)


def test_several_sets_are_ranked(towtank, tmp_path):
    out = tmp_path / "comparison.csv"
    ended = towtank("compare", "dtc-drift-efd", "dtc-drift-cfd", "dtc-drift-cfd-63", "--out", out)
    assert ended.status == 0
    ranked = ended.out[ended.out.index("rank") :].splitlines()
    assert "1:63.65" in ranked[1]
    assert "1:100" in ranked[2]
    assert pd.read_csv(out)["set"].nunique() == 2


def test_tables_of_values_and_indices(towtank, written):
    a = written("a.csv", "quantity,value,uncertainty,unit\nturning 35: advance,3.1,0.1,L\n")
    b = written("indices.csv", "manoeuvre,index,value,unit,sd,p05,p95\nturning 35,advance,3.3,L,0.08,3.1,3.5\n")
    c = written("c.csv", "quantity,value\nturning 35: advance,3.0\n")
    ended = towtank("compare", a, b, c)
    assert ended.status == 0
    line = next(row for row in ended.out.splitlines() if row.startswith("turning 35: advance"))
    assert line.split()[-5:] == ["0.2000", "6.452", "-6.452", "6.452", "2.120"]
    assert ended.out.splitlines()[-2].split()[:2] == ["1", "c.csv"]


def test_curves_over_a_column(towtank, written, tmp_path):
    a = written("a.csv", "beta,Y,N\n0,0,0\n5,2,1\n10,4,2\n")
    b = written("b.csv", "beta,Y,N\n0,0,0\n10,4.4,2\n")
    ended = towtank("compare", a, b, "--by", "beta", "--out", tmp_path / "scores.csv")
    assert ended.status == 0
    scores = pd.read_csv(tmp_path / "scores.csv").set_index("quantity")
    assert scores.loc["Y", "Q"] == pytest.approx(0.1)
    assert scores.loc["N", "Q"] == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("kvlcc2", "nothing"), "'nothing' is neither a file nor a published set -> did you mean"),
        (("kvlcc2", "VALUES"), "A is a derivative set, a B is not"),
        (("VALUES", "kvlcc2"), "A and B are not of one kind"),
        (("VALUES", "CURVES"), "A and B are not of one kind"),
        (("CURVES", "OTHER"), "the measurement has no column 'speed'"),
        (("VALUES", "VALUES", "VALUES"), "two tables have the same name"),
    ],
)
def test_what_cannot_be_compared_is_named(towtank, written, words, said):
    files = {
        "VALUES": written("values.csv", "quantity,value\nX,1\n"),
        "CURVES": written("curves.csv", "beta,Y\n0,1\n1,2\n"),
        "OTHER": written("other.csv", "beta,Y\n0,1\n1,2\n"),
    }
    ended = towtank("compare", *(files.get(word, word) for word in words))
    assert (ended.status, ended.err.count("\n")) == (2, 1)
    assert said in ended.err
