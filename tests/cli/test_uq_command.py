"""``towtank uq``."""

from __future__ import annotations

import json

import pandas as pd
import pytest

RUNS = """case,wave_height,wave_period,heave,pitch,X
Case1,61.305,1.377,0.1765,0.0432,-6.8951
Case2,62.204,1.374,0.1761,0.0438,-7.0056
Case3,63.584,1.389,0.1907,0.0422,-6.8918
Case4,62.380,1.395,0.1898,0.0400,-6.8447
Case5,62.880,1.369,0.1729,0.0445,-7.1009
Case6,61.752,1.380,0.1799,0.0427,-6.8869
"""
INPUTS = ("--input", "wave_height=normal(62.35, 0.64)", "-i", "wave_period=normal(1.38, 0.01)")


@pytest.fixture
def runs(tmp_path):
    path = tmp_path / "runs.csv"
    path.write_text(RUNS, encoding="utf-8")
    return path


def test_runs_of_the_paper(towtank, runs, tmp_path):
    efd = tmp_path / "efd.csv"
    efd.write_text("quantity,value\nheave,0.1775\npitch,0.0450\nX,-7.2670\n", encoding="utf-8")
    out = tmp_path / "uq"
    ended = towtank("uq", runs, *INPUTS, "--efd", efd, "--out", out)
    assert ended.status == 0
    assert "order 1: 3 coefficients from 6 runs (oversampling 2)" in ended.out
    table = pd.read_csv(out / "statistics.csv").set_index(["output", "method"])
    assert table.loc[("X", "Monte Carlo"), "sd"] == pytest.approx(0.0879, abs=5e-5)
    assert table.loc[("pitch", "polynomial chaos"), "mean"] == pytest.approx(0.0428417, abs=1e-7)
    assert "4.796" in ended.out
    shares = pd.read_csv(out / "sobol.csv").set_index(["output", "input"])
    assert shares.loc[("heave", "wave_period"), "first"] == pytest.approx(0.962, abs=1e-3)
    assert (out / "report.html").exists()


def test_json_and_chosen_outputs(towtank, runs):
    data = json.loads(towtank("uq", runs, *INPUTS, "--output", "X", "--json").out)
    assert {row["output"] for row in data["statistics"]} == {"X"}
    assert data["distributions"]["wave_period"] == "normal(1.38, 0.01)"


def test_a_plan_is_a_latin_hypercube(towtank, tmp_path):
    path = tmp_path / "plan.csv"
    ended = towtank("uq", *INPUTS, "--plan", 12, "--seed", 4, "--out", path)
    assert ended.out == f"12 runs -> {path}; add their outputs as columns. Enough for order 2.\n"
    plan = pd.read_csv(path)
    assert plan.columns.tolist() == ["run", "wave_height", "wave_period"]
    assert len(plan) == 12
    assert towtank("uq", *INPUTS, "--plan", 3).out.count("\n") == 4


@pytest.mark.parametrize(
    ("more", "said"),
    [
        (("--order", 3), "6 samples are too few for order 3 in 2 input(s): 10 coefficients -> lower the order"),
        (("--output", "sway"), "the table has no column 'sway'"),
        (("--input", "wave_height=normal(1, 2)"), "the input wave_height is given twice"),
        (("--input", "depth=normal(1, 2)"), "the table has no column 'depth'"),
        (("--plan", 6), "--plan with a table of runs"),
    ],
)
def test_what_cannot_be_analysed_is_named(towtank, runs, more, said):
    ended = towtank("uq", runs, *INPUTS, *more)
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert said in ended.err


def test_a_run_that_failed_is_named(towtank, runs):
    runs.write_text(RUNS.replace("0.1907", "nan"), encoding="utf-8")
    ended = towtank("uq", runs, *INPUTS)
    assert ended.status == 2
    assert "heave of sample 3 is no number -> drop the run that failed" in ended.err


def test_nothing_to_do_is_named(towtank, runs):
    assert "no uncertain input is given" in towtank("uq", runs).err
    assert "no table of runs is given" in towtank("uq", *INPUTS).err
    efd = runs.with_name("efd.csv")
    efd.write_text("speed,X\n1,2\n")
    assert "need columns quantity,value" in towtank("uq", runs, *INPUTS, "--efd", efd).err
