"""``towtank gci``: what it prints and writes, and what it refuses."""

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.datasets import load_set
from towtank.verify import METHODS, UNCERTAINTY_COLUMNS

CELIK = ("--phi", "6.063,5.972,5.863", "--cells", "18000,8000,4500", "--dim", "2")

DTMB = """cells,X,Y,N
1360061,-0.01811,0.02815,0.01120
2533357,-0.01765,0.02977,0.01325
6009588,-0.01742,0.03060,0.01431
"""


@pytest.fixture
def grids(tmp_path):
    path = tmp_path / "grids.csv"
    path.write_text(DTMB, encoding="utf-8")
    return path


def test_first_example_of_celik_et_al(towtank):
    ended = towtank("gci", *CELIK, "--json")
    assert ended.status == 0
    (found,) = json.loads(ended.out)["quantities"]
    assert found["class"] == "monotone convergent"
    assert found["order"] == pytest.approx(1.5340, abs=5e-5)
    assert found["extrapolated"] == pytest.approx(6.16850, abs=5e-6)
    assert found["gci_percent"] == pytest.approx(2.175, abs=5e-4)


def test_oscillatory_example_is_called_so(towtank):
    ended = towtank("gci", "--phi", "6.0042,5.9624,6.0909", "--cells", "18000,4500,980", "--dim", "2")
    assert "oscillatory convergent" in ended.out
    assert "monotone formula" in ended.out
    assert "-> data range" in ended.out


@pytest.mark.parametrize(
    ("options", "behaviour"),
    [
        (("--phi", "1,1.3,1.35", "--ratio", "2"), "monotone divergent"),
        (("--phi", "1,1.3,1.1", "--ratio", "2"), "oscillatory divergent"),
        (("--phi", "1,1,1", "--ratio", "2"), "equal solutions"),
        (("--phi", "1,1.3", "--ratio", "2"), "too few grids"),
        (("--phi", "0,0.1,0.3", "--spacing", "1,2,4"), "monotone convergent"),
        (("--phi", "5.863,6.063,5.972", "--cells", "4500,18000,8000"), "monotone convergent"),
    ],
)
def test_every_class_is_a_named_result(towtank, options, behaviour):
    ended = towtank("gci", *options, "--json")
    assert ended.status == 0
    assert json.loads(ended.out)["quantities"][0]["class"] == behaviour


def test_table_to_folder_with_the_ratios_of_the_cells(towtank, grids, tmp_path):
    out = tmp_path / "out"
    ended = towtank("gci", grids, "--assumed", "1.4", "--method", "GCI Celik", "--out", out)
    assert ended.status == 0
    assert "[refinement-ratio] r32 is 1.23, not the assumed 1.4" in ended.out
    table = pd.read_csv(out / "uncertainty.csv")
    assert list(table.columns) == list(UNCERTAINTY_COLUMNS)
    assert set(table["method"]) == set(METHODS)
    chosen = pd.read_csv(out / "chosen_uncertainty.csv").set_index("quantity")
    assert chosen["order"].to_numpy() == pytest.approx([4.24, 4.14, 4.10], abs=5e-3)
    assert chosen.loc["N", "uncertainty"] / 0.01431 == pytest.approx(0.0410, abs=5e-5)
    assert "Y: monotone convergent" in (out / "report.html").read_text(encoding="utf-8")


def test_one_quantity_and_no_report(towtank, grids, tmp_path):
    towtank("gci", grids, "--only", "Y", "--out", tmp_path / "out", "--no-report", "--quiet")
    assert set(pd.read_csv(tmp_path / "out" / "uncertainty.csv")["quantity"]) == {"Y"}
    assert not (tmp_path / "out" / "report.html").exists()


def test_curve_over_a_column(towtank, tmp_path):
    path = tmp_path / "curve.csv"
    rows = [f"{h},{beta},{0.01 * beta * (1 + 0.1 * h**2)}" for h in (1, 2, 4) for beta in (2, 4, 6)]
    path.write_text("\n".join(["h,beta,Y", *rows]), encoding="utf-8")
    ended = towtank("gci", path, "--over", "beta")
    assert "Y at 4: monotone convergent" in ended.out
    assert "pooled change: monotone convergent, order 2" in ended.out


@pytest.fixture
def sets(tmp_path):
    """Derivatives of second order on three grids with a fit of 1 per cent."""
    finest = load_set("dtmb5512-sway-efd")
    for name, h in (("fine", 1.0), ("medium", 1.4), ("coarse", 1.96)):
        one = replace(
            finest,
            name=name,
            values=finest.values * (1.0 + 0.02 * h**2),
            covariance=np.diag((0.005 * finest.values) ** 2),
        )
        one.to_json(tmp_path / f"{name}.json")
    return [word for name in ("coarse", "fine", "medium") for word in ("--set", tmp_path / f"{name}.json")]


def test_derivatives_of_three_grids(towtank, sets, tmp_path):
    out = tmp_path / "out"
    ended = towtank("gci", *sets, "--spacing", "1.96,1,1.4", "--out", out)
    assert ended.status == 0
    assert "Yvdot" in ended.out
    table = pd.read_csv(out / "derivative_uncertainty.csv").set_index("name")
    assert table.loc["Yv", "order"] == pytest.approx(2.0)
    assert table.loc["Yv", "U_num"] == pytest.approx(1.6 * 0.02 * 0.3)
    combined = DerivativeSet.from_json(out / "derivatives.json")
    assert combined.bse["Yv"] == pytest.approx(np.hypot(0.5 * 1.6 * 0.02 * 0.3, 0.005 * 0.3))
    assert 'id="derivatives"' in (out / "report.html").read_text(encoding="utf-8")
    data = json.loads((out / "uncertainty.json").read_text(encoding="utf-8"))
    assert [row["name"] for row in data["derivatives"]] == list(combined.names)


def test_sets_of_other_conventions_are_refused(towtank, sets, tmp_path):
    other = load_set("dtmb5512-sway-efd")
    replace(other, conventions=other.conventions.but(force_scaling="L2")).to_json(tmp_path / "medium.json")
    ended = towtank("gci", *sets, "--spacing", "1.96,1,1.4")
    assert ended.status == 2
    assert "force_scaling" in ended.err
    assert towtank("gci", *sets).status == 2


def test_quiet_prints_nothing(towtank):
    assert towtank("gci", *CELIK, "--quiet").out == ""


def test_help_has_an_example(towtank):
    assert "towtank gci --phi 6.063,5.972,5.863" in " ".join(towtank("gci", "--help").out.split())


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ((), "give either a table, --phi or --set"),
        (("grids.csv", "--phi", "1,2,3"), "give either a table, --phi or --set"),
        (("none.csv",), "file not found"),
        (("none.csv", "--cells", "1,2"), "--cells beside a table"),
        (("--phi", "1"), "none of --cells"),
        (("--phi", "1,2,3", "--cells", "8,4,2", "--ratio", "2"), "--cells and --ratio"),
        (("--phi", "1", "--ratio", "2"), "1 grid(s)"),
        (("--phi", "1,2,3", "--cells", "8,4"), "3 values on 2 grids"),
        (("--phi", "1,2,3", "--cells", "8,4,4"), "same spacing"),
        (("--phi", "1,2,3", "--cells", "8,4,0"), "0 cells"),
        (("--phi", "1,nan,3", "--ratio", "2"), "grid 2 has no value"),
        (("--phi", "1;2;3", "--ratio", "2"), "no list of numbers"),
        (("--phi", "1,2,3", "--ratio", "1"), "does not exceed 1"),
        (("--phi", "1,2,3", "--ratio", "2", "--assumed", "1"), "--assumed 1"),
        (("--phi", "1,2,3", "--ratio", "2", "--order", "0"), "formal order 0"),
        (("--phi", "1,2,3", "--ratio", "2", "--method", "gci"), "no method 'gci'"),
        (("--phi", "1,2,3", "--cells", "8,4,2", "--dim", "4"), "4 dimensions"),
    ],
)
def test_bad_input_is_named_in_one_line(towtank, options, words):
    ended = towtank("gci", *options)
    assert ended.status == 2
    assert words in ended.err
    assert "->" in ended.err
    assert len(ended.err.strip().splitlines()) == 1


def test_errors_of_a_table_name_the_file(towtank, tmp_path):
    path = tmp_path / "twice.csv"
    path.write_text("h,X\n1,1\n1,2\n2,3\n", encoding="utf-8")
    ended = towtank("gci", path)
    assert ended.status == 2
    assert "twice.csv" in ended.err
    assert "same spacing" in ended.err
