"""``towtank cfd read``, ``towtank cfd settle`` and ``towtank demo cfd``: what they write, print and refuse."""

from __future__ import annotations

import json
import os
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.cfd import shipped_sweep
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
        histories=Histories(duration=30.0),
        motions=motions,
    )


@pytest.fixture(scope="module")
def drift(tmp_path_factory) -> Path:
    motions = tuple((beta, 0.0) for beta in (-4.0, 0.0, 4.0, 8.0, 12.0))
    histories = Histories(duration=30.0)
    return write_virtual_sweep(tmp_path_factory.mktemp("drift"), histories=histories, motions=motions)


@pytest.fixture(scope="module")
def small_drift(tmp_path_factory) -> Path:
    motions = tuple((beta, 0.0) for beta in (0.0, 8.0, 12.0))
    histories = Histories(duration=20.0)
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
def test_study_that_cannot_be_made_leaves_nothing(towtank, small_drift, tmp_path, words, cause):
    ended = towtank("cfd", "study", small_drift, *KNOWN, *words, "--out", tmp_path / "study")
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


def test_demo_shows_truth_inside_and_order(towtank, tmp_path, monkeypatch):
    # Fewer motions of the shipped sweep, which tests/cfd/test_grid_study.py runs whole.
    motions = tuple((beta, 0.0) for beta in (-4.0, 0.0, 4.0, 8.0, 12.0))
    fewer = partial(shipped_sweep.run_virtual_sweep, histories=Histories(duration=30.0), motions=motions)
    monkeypatch.setattr(shipped_sweep, "run_virtual_sweep", fewer)
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
    assert f"{len(table)} of {len(table)}" in page


def periodic(folder: Path) -> Path:
    """A case in waves: forces, a motion, a gauge, residuals."""
    wave = 2.0 * np.pi / 4.0
    openfoam(folder, text(10.0 + (3.0 + 2.0 * np.exp(-TIME / 3.0)) * np.cos(wave * TIME) + 1e-3 * X))
    place = folder / "postProcessing"
    for name, content in {
        "hull/0/sixDoFRigidBodyState.dat": "# Motion State\n# Angle Units: degrees\n# Time centreOfMass rotation\n"
        + "".join(f"{t:.1f} (0 0 {0.1 * np.cos(wave * t):.6g}) (0 {np.sin(wave * t):.6g} 0)\n" for t in TIME),
        "waves/0/surfaceElevation.dat": "Time gauge_0 gauge_1\n-1 0 1\n-2 0 0\n-3 0 0\n"
        + "".join(f"{t:.1f} {0.02 * np.cos(wave * t):.6g} {0.02 * np.sin(wave * t):.6g}\n" for t in TIME),
        "probes/0/p": "# Probe 0 (0 0 1)\n# Time 0\n" + "".join(f"{t:.1f} {np.cos(wave * t):.6g}\n" for t in TIME),
        "solver/0/residuals.dat": "# Residuals\n# Time Ux p\n"
        + "".join(f"{t:.1f} {1e-3 * np.exp(-t / 30):.6g} 1e-4\n" for t in TIME),
    }.items():
        file = place / name
        file.parent.mkdir(parents=True)
        file.write_text(content)
    return folder


def test_periodic_case_cycle_by_cycle(towtank, tmp_path):
    case, out = periodic(tmp_path / "wave"), tmp_path / "out"
    ended = towtank("cfd", "settle", case, "--out", out)
    assert (ended.status, ended.err) == (0, "")
    cycles = pd.read_csv(out / "cycles.csv")
    of_x = cycles[cycles["load"] == "X"]
    assert len(of_x) == 10
    assert not of_x["kept"].iloc[0]
    assert of_x["kept"].iloc[-1]
    np.testing.assert_allclose(of_x["amplitude 1"].iloc[-3:], 3.0, atol=0.01)
    assert set(cycles["load"]) >= {"X", "Y", "X_pressure", "X_viscous"}
    settled = pd.read_csv(out / "settled.csv").set_index("load")
    assert settled.loc["X", "cycles_dropped"] == (~of_x["kept"]).sum()
    # Parts of a periodic load have whole cycles too, and add up.
    parts = settled.loc[["X_pressure", "X_viscous"]]
    assert parts["mean"].sum() == pytest.approx(settled.loc["X", "mean"], abs=1e-4)
    assert parts["amplitude"].sum() == pytest.approx(settled.loc["X", "amplitude"], abs=1e-4)
    page = (out / "report.html").read_text()
    assert "X of wave: each cycle" in page
    assert "X of wave: mean cycle" in page


def test_histories_that_are_no_forces_are_read_and_settled(towtank, tmp_path):
    case, out = periodic(tmp_path / "wave"), tmp_path / "out"
    ended = towtank("cfd", "read", case, "--history", "all", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    overview = pd.read_csv(out / "histories.csv").set_index("history")
    assert dict(overview["kind"]) == {
        "forces": "forces",
        "hull": "motion",
        "probes/p": "probes",
        "solver": "residuals",
        "waves": "surface",
    }
    assert overview.loc["probes/p", "points"] == "p_0 (0 0 1)"
    motion = pd.read_csv(out / overview.loc["hull", "file"])
    np.testing.assert_allclose(motion["rotation_y [deg]"], np.sin(np.pi / 2.0 * TIME), atol=1e-5)
    gauges = towtank("cfd", "settle", case, "--history", "surface", "--out", tmp_path / "gauges")
    assert (gauges.status, gauges.err) == (0, "")
    settled = pd.read_csv(tmp_path / "gauges" / "settled.csv").set_index("load")
    assert list(settled["verdict"]) == ["periodic", "periodic"]
    assert settled.loc["gauge_1", "amplitude"] == pytest.approx(0.02, rel=1e-3)
    assert settled.loc["gauge_0", "unit"] == "m"
    assert not (tmp_path / "gauges" / "points.csv").exists()
    drifting = towtank("cfd", "settle", case, "--history", "solver")
    assert drifting.status == 2
    assert "Ux of case 'wave': still drifting" in drifting.err


def test_histories_that_are_not_there(towtank, tmp_path):
    case = periodic(tmp_path / "wave")
    for words in (("read",), ("settle",)):
        ended = towtank("cfd", *words, case, "--history", "rudder", "--out", tmp_path / "out")
        assert ended.status == 2
        assert "there is no history 'rudder' -> the case has forces (forces), hull (motion)" in ended.err
    assert not (tmp_path / "out").exists()


def test_case_run_again_over_a_stale_folder_is_a_finding(towtank, tmp_path):
    case = openfoam(tmp_path / "case", text(X))
    stale = case / "postProcessing" / "forces" / "20" / "force.dat"
    stale.parent.mkdir()
    stale.write_text(text(3.0 * X[:100], TIME[:100] + 20.0))
    os.utime(stale, (1.7e9, 1.7e9))
    ended = towtank("cfd", "settle", case, "--json")
    told = json.loads(ended.out)
    assert [item["rule"] for item in told["findings"]] == ["run-order"]
    assert "folder 20 is left from a run before" in told["findings"][0]["message"]
    assert told["settled"][0]["mean"] == pytest.approx(-10.0, abs=0.05)
    assert "warning [run-order]" in towtank("cfd", "settle", case).out


def test_a_folder_of_one_monitor_a_file(towtank, tmp_path):
    folder = tmp_path / "beta_4_U_1"
    folder.mkdir()
    for name, unit, factor in (("Force X", "kN", 1.0), ("Force Y", "N", 2.0), ("Moment Z", "N-m", 3.0)):
        rows = "".join(f"{t:.1f},{factor * x:.6f}\n" for t, x in zip(TIME, X))
        heading = f'"Physical Time: Physical Time (s)","{name} Monitor: {name} ({unit})"\n'
        (folder / f"{name}.csv").write_text(heading + rows)
    ended = towtank("cfd", "settle", folder, "--json")
    assert (ended.status, ended.err) == (0, "")
    rows = {row["load"]: row for row in json.loads(ended.out)["settled"]}
    assert rows["X"]["mean"] == pytest.approx(-10000.0, rel=0.005)
    assert rows["Y"]["mean"] == pytest.approx(20.0, rel=0.005)
    assert rows["N"]["mean"] == pytest.approx(-30.0, rel=0.005)
    assert "Fx_total from Force X of Force X.csv" in towtank("cfd", "read", folder).out
