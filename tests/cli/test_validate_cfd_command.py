"""``towtank validate-cfd``."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from towtank.datasets import load_set

SIMULATION = "quantity,value,uncertainty,unit\nX,-6.944,0.25,N\nheave,0.194,0.004,\ntrim,-1.05,,mm/m\n"
DATA = "quantity,value,uncertainty,unit\nX,-7.267,0.3,N\nheave,0.1778,0.005,\ntrim,-0.835,0.1,mm/m\n"


@pytest.fixture
def written(tmp_path):
    def write(name: str, text: str):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def tables(written):
    return "--cfd", written("S.csv", SIMULATION), "--efd", written("D.csv", DATA)


def test_verdicts_table_and_report(towtank, tables, tmp_path):
    out = tmp_path / "out"
    ended = towtank("validate-cfd", *tables, "--required", 6, "--out", out)
    assert ended.status == 0
    assert "X: validated at level U_V = 0.3905 N (5.37 % of D); within the required 0.436 N" in ended.out
    assert "heave: not validated" in ended.out
    assert "not judged, U_SN is unknown: trim" in ended.out
    assert "3 quantities: 1 validated, 1 not validated, 1 not judged" in ended.out
    table = pd.read_csv(out / "validation.csv")
    assert table["(S-D)/D [%]"].iloc[0] == pytest.approx(-4.4448, abs=1e-3)
    assert set(json.loads((out / "provenance.json").read_text())["inputs"]) == {"S: S.csv", "D: D.csv"}
    assert "<svg" in (out / "report.html").read_text(encoding="utf-8")


def test_json_is_plain_data(towtank, tables):
    data = json.loads(towtank("validate-cfd", *tables, "--json").out)
    assert [row["verdict"] for row in data["quantities"]] == ["validated", "not validated", "not judged"]
    assert data["quantities"][2]["U_V"] is None


def test_numerical_uncertainties_come_from_the_grid_study(towtank, tables, written):
    grids = written("uncertainty.csv", "quantity,method,uncertainty\ntrim,gci,0.3\ntrim,roache,0.1\n")
    ended = towtank("validate-cfd", *tables, "--numerical", grids, "--method", "gci", "--json")
    row = json.loads(ended.out)["quantities"][2]
    assert (row["verdict"], row["U_SN"]) == ("validated", 0.3)


def test_the_folder_of_a_grid_study_is_taken(towtank, tables, written, tmp_path):
    grid = written("grids.csv", "cells,trim\n18000,-1.05\n8000,-1.02\n4500,-0.98\n")
    assert towtank("gci", grid, "--dim", 2, "--out", tmp_path / "gci", "--no-report").status == 0
    out = tmp_path / "v"
    ended = towtank("validate-cfd", *tables, "--numerical", tmp_path / "gci", "--json", "--out", out)
    row = json.loads(ended.out)["quantities"][2]
    assert row["U_SN"] > 0.0
    assert row["verdict"] != "not judged"
    assert "U_SN: chosen_uncertainty.csv" in json.loads((out / "provenance.json").read_text())["inputs"]
    other = written("other.csv", "quantity,uncertainty\nsway,0.1\n")
    assert "belong to no quantity" in towtank("validate-cfd", *tables, "--numerical", other).err


def test_derivative_sets_are_converted_and_judged_together(towtank, tmp_path):
    measured = load_set("dtmb5512-efd")
    rng = np.random.default_rng(3)
    sd = 0.02 * np.abs(measured.values)
    first, second = tmp_path / "efd.json", tmp_path / "cfd.json"
    covariance = np.diag(sd**2)
    replace(measured, covariance=covariance).to_json(first)
    moved = measured.values + 0.5 * sd * rng.standard_normal(len(sd))
    replace(measured, values=moved, covariance=covariance).to("prime").to_json(second)
    ended = towtank("validate-cfd", "--cfd", second, "--efd", first)
    assert ended.status == 0
    assert f"{len(measured)} quantities: {len(measured)} validated" in ended.out
    assert "all together, correlations counted: chi squared" in ended.out
    assert "U_SN is the whole covariance" in ended.out


def test_simulated_indices_have_the_spread_of_their_inputs(towtank, written):
    simulated = "manoeuvre,index,value,unit,sd,p05,p95\nturning 35,advance,3.3,L,0.08,3.1,3.5\n"
    measured = "manoeuvre,index,value,unit,uncertainty\nturning 35,advance,3.1,L,0.1\n"
    ended = towtank(
        "validate-cfd",
        "--cfd",
        written("indices.csv", simulated),
        "--efd",
        written("trial.csv", measured),
        "--json",
    )
    (row,) = json.loads(ended.out)["quantities"]
    assert row["quantity"] == "turning 35: advance"
    assert (row["U_SN"], row["U_input"]) == (0.0, 0.16)
    assert row["verdict"] == "not validated"
    assert "integrator's own error counts as 0" in json.loads(ended.out)["remarks"][0]


def test_a_folder_of_simulated_manoeuvres_is_taken(towtank, written, tmp_path):
    folder = tmp_path / "sailed"
    folder.mkdir()
    (folder / "indices.csv").write_text("manoeuvre,index,value,unit,sd\nturning 35,advance,3.1,L,0.1\n")
    measured = written("trial.csv", "manoeuvre,index,value,unit,sd\nturning 35,advance,3.1,L,0.1\n")
    ended = towtank("validate-cfd", "--cfd", folder, "--efd", measured)
    assert "1 quantities: 1 validated" in ended.out


@pytest.mark.parametrize(
    ("simulation", "data", "more", "said"),
    [
        ("quantity,value,uncertainty\nX,1,-0.1\n", DATA, (), "S.csv, line 2: uncertainty = -0.1 is negative"),
        ("quantity,value\nX,nan\n", DATA, (), "S.csv, line 2: the value of 'X' is missing"),
        ("quantity,value,unit\nX,1,kN\n", DATA, (), "quantity X: simulation in 'kN', data in 'N'"),
        ("quantity,value\nN,1\n", DATA, (), "share no quantity: N against X, heave, trim"),
        ("speed,sinkage\n1,0.1\n", DATA, (), "score curves with towtank compare"),
        ("name,value,scaling\nYv,-0.3,LT\n", DATA, (), "cannot be validated with a table of values"),
        (SIMULATION, DATA, ("--coverage", 0), "coverage factor 0 is not positive"),
        (SIMULATION, DATA, ("--required", -1), "--required -1 is not positive"),
        (SIMULATION, DATA, ("--method", "gci"), "--method without --numerical"),
    ],
)
def test_bad_inputs_are_named_in_one_line(towtank, written, simulation, data, more, said):
    ended = towtank("validate-cfd", "--cfd", written("S.csv", simulation), "--efd", written("D.csv", data), *more)
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert said in ended.err


def test_a_missing_file_is_named(towtank, tables):
    ended = towtank("validate-cfd", "--cfd", "none.csv", *tables[2:])
    assert ended.status == 2
    assert "none.csv: file not found" in ended.err


def test_quiet_prints_nothing(towtank, tables, tmp_path):
    ended = towtank("validate-cfd", *tables, "--quiet", "--no-report", "--out", tmp_path / "v")
    assert ended == (0, "", "")
    assert not (tmp_path / "v" / "report.html").exists()
