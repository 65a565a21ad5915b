"""``towtank cfd read``, ``towtank cfd settle`` and ``towtank demo cfd``: what they write, print and refuse."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.cfd.settled_loads import SETTLED_COLUMNS
from towtank.cfd.virtual_sweep import GridErrorLaw, Histories, write_virtual_sweep

TIME = 0.1 * np.arange(1, 401)
X = 10.0 + 0.1 * np.random.default_rng(0).standard_normal(400)
PARTS = ("total", "pressure", "viscous")
KNOWN = ("--density", "1000", "--midship", "3.5,0,0")


def text(x: np.ndarray, time: np.ndarray = TIME, parts: tuple[str, ...] = PARTS) -> str:
    share = {"total": 1.0, "pressure": 0.8, "viscous": 0.2}
    forces = np.column_stack([x, 0.2 * x, 3.0 * x])
    table = np.column_stack([time, *(share[part] * forces for part in parts)])
    names = "\t".join(f"{part}_{axis}" for part in parts for axis in "xyz")
    rows = "\n".join("\t".join(f"{value:.7g}" for value in row) for row in table)
    return f"# Force\n# CofR                : (0 0 0)\n#\n# Time\t{names}\n{rows}\n"


def openfoam(folder: Path, content: str | bytes) -> Path:
    place = folder / "postProcessing" / "forces" / "0"
    place.mkdir(parents=True)
    if isinstance(content, bytes):
        (place / "force.dat").write_bytes(content)
    else:
        (place / "force.dat").write_text(content)
    return folder


@pytest.fixture(scope="module")
def sweep(tmp_path_factory) -> Path:
    motions = ((0.0, 0.0), (8.0, 0.0), (-4.0, 0.2))
    return write_virtual_sweep(
        tmp_path_factory.mktemp("sweep"),
        law=GridErrorLaw(grids=2),
        histories=Histories(duration=40.0),
        motions=motions,
    )


@pytest.fixture(scope="module")
def drift(tmp_path_factory) -> Path:
    motions = tuple((beta, 0.0) for beta in (-4.0, 0.0, 4.0, 8.0, 12.0))
    histories = Histories(duration=30.0)
    return write_virtual_sweep(tmp_path_factory.mktemp("drift"), histories=histories, motions=motions)


STUDY = ("--ship", "kvlcc2", "--cells", "1=8000000,2=2828427,3=1000000")


def test_study_of_three_grids_beside_a_published_set(towtank, drift, tmp_path):
    out = tmp_path / "study"
    ended = towtank("cfd", "study", drift, *KNOWN, *STUDY, "--efd", "kvlcc2", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert "against KVLCC2, MMG standard set" in ended.out
    table = pd.read_csv(out / "grid_derivatives.csv").set_index("name")
    assert table.loc["Yv", "order"] == pytest.approx(2.0, abs=0.3)
    assert table["truth inside"].mean() >= 0.8
    again = towtank("run", tmp_path / "study-fits" / "grid_2" / "campaign.toml", "--out", tmp_path / "again", "-q")
    assert again.status == 0
    fitted = pd.read_csv(tmp_path / "again" / "derivatives.csv").set_index("name")
    assert fitted.loc["Yv", "value"] == pytest.approx(table.loc["Yv", "grid 2"])


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (("--ship", "kvlcc2"), "number of cells of grid '1' is not known"),
        (("--ship", "raft"), "raft"),
        ((*STUDY, "--efd", "nobody"), "neither a file nor a published set"),
        ((*STUDY, "--model", "polynomial"), "polynomial"),
        ((*STUDY, "--method", "guess"), "no method 'guess'"),
    ],
)
def test_study_that_cannot_be_made_leaves_nothing(towtank, drift, tmp_path, words, cause):
    ended = towtank("cfd", "study", drift, *KNOWN, *words, "--out", tmp_path / "study")
    assert ended.status == 2
    assert ended.err.count("\n") == 1
    assert cause in ended.err
    assert list(tmp_path.iterdir()) == []


def test_study_stops_at_a_case_that_has_not_settled(towtank, tmp_path):
    for grid in (1, 2):
        openfoam(tmp_path / "cases" / f"beta_4_U_1_grid{grid}", text(X + 6.0 * np.exp(-TIME / 30.0)))
    words = ("--ship", "kvlcc2", "--cells", "1=2000,2=1000", "--out", tmp_path / "study")
    ended = towtank("cfd", "study", tmp_path / "cases", *words)
    assert ended.status == 2
    assert "still drifting" in ended.err
    assert not (tmp_path / "study").exists()


def test_read_writes_campaign_and_loads(towtank, sweep, tmp_path):
    out = tmp_path / "loads"
    ended = towtank("cfd", "read", sweep, *KNOWN, "--cells", "1=8000000,2=2828427", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == ["campaign.csv", "loads.csv", "provenance.json"]
    campaign = pd.read_csv(out / "campaign.csv")
    assert len(campaign) == 6
    assert set(campaign["drift angle [deg]"]) == {0.0, 8.0, -4.0}
    assert set(campaign["cells"]) == {8000000, 2828427}
    assert campaign.set_index("case").loc["beta_8_r_0_U_0.76_grid1", "restarts"] >= 1
    loads = pd.read_csv(out / "loads.csv")
    straight = loads[loads["case"] == "beta_0_r_0_U_0.76_grid1"].tail(50)
    assert straight["X [N]"].mean() == pytest.approx(-20.5, rel=0.03)
    np.testing.assert_allclose(
        straight["X [N]"], straight["X_pressure [N]"] + straight["X_viscous [N]"], rtol=1e-5
    )
    assert "restarted at" in ended.out
    provenance = json.loads((out / "provenance.json").read_text())
    assert provenance["choices"]["density"] == 1000.0
    assert any("midship" in step for step in provenance["cases"]["beta_0_r_0_U_0.76_grid1"]["steps"])


def test_read_as_json(towtank, sweep):
    ended = towtank("cfd", "read", sweep / "beta_0_r_0_U_0.76_grid1", "--json")
    told = json.loads(ended.out)
    assert told["cases"][0]["case"] == "beta_0_r_0_U_0.76_grid1"
    assert told["cases"][0]["diverged at"] is None


def test_settle_writes_means_points_and_a_page(towtank, sweep, tmp_path):
    out = tmp_path / "settled"
    ended = towtank("cfd", "settle", sweep, *KNOWN, "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert "6 case(s): 6 settled" in ended.out
    assert sorted(path.name for path in out.iterdir()) == [
        "points.csv",
        "provenance.json",
        "report.html",
        "settled.csv",
    ]
    settled = pd.read_csv(out / "settled.csv")
    assert tuple(settled.columns[: len(SETTLED_COLUMNS)]) == SETTLED_COLUMNS
    assert {"drift angle [deg]", "grid"} <= set(settled.columns)
    assert set(pd.read_csv(out / "points.csv").columns) >= {"beta", "rprime", "speed", "X", "Y", "N", "N_sd"}
    page = (out / "report.html").read_text()
    assert "Virtual data" in page
    assert page.count("<svg") == 18


def test_settle_as_json_and_without_a_page(towtank, tmp_path):
    case = openfoam(tmp_path / "case", text(X))
    ended = towtank("cfd", "settle", case, "--json")
    rows = {row["load"]: row for row in json.loads(ended.out)["settled"]}
    assert rows["X"]["verdict"] == "settled"
    assert rows["X"]["mean"] == pytest.approx(-10.0, abs=0.05)
    assert rows["X"]["period"] is None
    assert towtank("cfd", "settle", case, "--no-report", "--out", tmp_path / "out").status == 0
    assert not (tmp_path / "out" / "report.html").exists()


def test_drifting_case_ends_with_status_2_and_a_whole_result(towtank, tmp_path):
    case, out = openfoam(tmp_path / "slow", text(X + 6.0 * np.exp(-TIME / 30.0))), tmp_path / "out"
    ended = towtank("cfd", "settle", case, "--out", out)
    assert ended.status == 2
    assert ended.err.count("\n") == 1
    assert "still drifting" in ended.err
    assert "--waive slow" in ended.err
    assert (
        "would still change by" in (out / "settled.csv").read_text()
        or "without a bend" in (out / "settled.csv").read_text()
    )
    assert not (out / "points.csv").exists()
    waived = towtank("cfd", "settle", case, "--waive", "slow", "--out", out)
    assert (waived.status, waived.err) == (0, "")
    assert "(accepted) [still-drifting]" in waived.out
    assert (out / "points.csv").exists()


def test_diverged_and_short_cases_are_named_verdicts(towtank, tmp_path):
    blown = X.copy()
    blown[300:] = np.nan
    openfoam(tmp_path / "sweep" / "beta_4_grid1", text(blown))
    openfoam(tmp_path / "sweep" / "beta_8_grid1", text(X[:20], TIME[:20]))
    ended = towtank("cfd", "settle", tmp_path / "sweep")
    assert ended.status == 2
    assert "1 diverged, 1 too short" in ended.out
    assert "diverged from 30.1 on" in ended.err
    assert "and 1 more cases" in ended.err


def test_truncated_last_line_and_missing_parts_are_read(towtank, tmp_path):
    openfoam(tmp_path / "a" / "beta_4_grid1", text(X)[:-20])
    openfoam(tmp_path / "a" / "beta_8_grid1", text(X, parts=("total",)))
    ended = towtank("cfd", "settle", tmp_path / "a", "--out", tmp_path / "out")
    assert (ended.status, ended.err) == (0, "")
    read = towtank("cfd", "read", tmp_path / "a")
    assert "viscous" in read.out
    assert "cut" in read.out or "last line" in read.out


def test_monitor_file_with_named_columns(towtank, tmp_path):
    file = tmp_path / "monitors.csv"
    rows = "\n".join(f"{t:.1f},{x:.6f},1.5,2.0" for t, x in zip(TIME, X))
    file.write_text(f'"Time (s)","Drag (N)","Side (N)","Yaw (N-m)"\n{rows}\n')
    words = ("--column", "Fx_total=Drag", "--column", "Fy_total=Side", "--column", "Mz_total=Yaw")
    ended = towtank("cfd", "settle", file, *words, "--json")
    rows = {row["load"]: row for row in json.loads(ended.out)["settled"]}
    assert (rows["Y"]["mean"], rows["N"]["mean"]) == (1.5, -2.0)
    bare = towtank("cfd", "settle", file)
    assert bare.status == 2
    assert "--column Fx_total=Drag" in bare.err


@pytest.mark.parametrize(
    ("content", "cause"),
    [
        (bytes(range(256)) * 20, "binary"),
        (b"", "empty"),
        ("this is a letter,\nand no table;\nnot at all\n", "holds no histories"),
        ("# Time total_x\n", "holds no histories"),
    ],
)
def test_files_that_are_no_history(towtank, tmp_path, content, cause):
    case = openfoam(tmp_path / "case", content)
    for command in ("read", "settle"):
        ended = towtank("cfd", command, case, "--out", tmp_path / "out")
        assert ended.status == 2
        assert ended.err.count("\n") == 1
        assert cause in ended.err
        assert "->" in ended.err
        assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (("nowhere",), "no such file or folder"),
        (("case", "--axes", "x-left"), "solver axes 'x-left'"),
        (("case", "--midship", "1,2"), "--midship '1,2' is not a point"),
        (("case", "--moment-point", "a,b,c"), "--moment-point 'a,b,c' is not a point"),
        (("case", "--density", "-1"), "not positive"),
        (("case", "--cells", "1"), "is not GRID=NUMBER"),
        (("case", "--cells", "1=5"), "grid '1', which no case has"),
        (("case", "--pattern", "{colour}"), "unknown parameter 'colour'"),
        (("case", "--table", "nowhere.csv"), "cannot be read"),
        (("case", "--object", "drag"), "there is no object 'drag'"),
        (("case", "--column", "Fx_total"), "is not LOAD=COLUMN"),
        (("case", "--waive", "other"), "no case 'other' to waive"),
        (("case", "--omega", "0"), "not positive"),
        (("case", "--start", "39.9"), "behind the cut"),
    ],
)
def test_bad_options(towtank, tmp_path, monkeypatch, words, cause):
    monkeypatch.chdir(tmp_path)
    openfoam(tmp_path / "case", text(X))
    ended = towtank("cfd", "settle", *words, "--out", "out")
    assert ended.status == 2
    assert ended.err.count("\n") == 1
    assert cause in ended.err
    assert not (tmp_path / "out").exists()


def test_double_cases_stop_before_anything_is_written(towtank, tmp_path):
    for name in ("beta_4_grid1", "beta_4.0_grid1"):
        openfoam(tmp_path / "sweep" / name, text(X))
    for command in ("read", "settle"):
        ended = towtank("cfd", command, tmp_path / "sweep", "--out", tmp_path / "out")
        assert ended.status == 2
        assert "double-case" in ended.err
    assert not (tmp_path / "out").exists()


def test_results_of_another_kind_are_not_overwritten(towtank, tmp_path):
    case, out = openfoam(tmp_path / "case", text(X)), tmp_path / "out"
    assert towtank("cfd", "read", case, "--out", out, "-q").status == 0
    ended = towtank("cfd", "settle", case, "--out", out)
    assert ended.status == 2
    assert "another kind" in ended.err


def test_demo_shows_truth_inside_and_order(towtank, tmp_path):
    ended = towtank("demo", "cfd", "--out", tmp_path)
    assert (ended.status, ended.err) == (0, "")
    results = tmp_path / "virtual-cfd-sweep" / "results"
    assert sorted(path.name for path in results.iterdir()) == [
        "comparison.csv",
        "derivatives.csv",
        "derivatives.json",
        "grid_derivatives.csv",
        "provenance.json",
        "report.html",
        "settled.csv",
        "uncertainty.csv",
        "validation.csv",
    ]
    table = pd.read_csv(results / "grid_derivatives.csv")
    assert table["truth inside"].all()
    assert table.set_index("name").loc["Yv", "order"] == pytest.approx(2.0, abs=0.2)
    uncertainty = pd.read_csv(results / "uncertainty.csv")
    wanted = ["quantity", "method", "class", "order", "extrapolated", "uncertainty", "unit"]
    assert list(uncertainty.columns[:7]) == wanted
    assert "virtual computations" in ended.out
    page = (results / "report.html").read_text()
    assert "Virtual data" in page
    assert "17 of 17" in page
