"""``towtank simulate``: tables, tracks, figures, page; each bad input ends with one line and writes nothing."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from towtank.datasets import load_set
from towtank.formats import read_table

ENVIRONMENT = """
[current]
speed = 0.1
direction = 90
"""


@pytest.fixture(scope="module")
def fitted(tmp_path_factory) -> Path:
    """KVLCC2's set with a covariance of 2 per cent, as a fit leaves it."""
    from dataclasses import replace

    folder = tmp_path_factory.mktemp("fit")
    known = load_set("kvlcc2")
    replace(known, covariance=np.diag((0.02 * known.values) ** 2)).to_json(folder / "derivatives.json")
    load_set("kvlcc2").to_json(folder / "bare.json")
    return folder


@pytest.fixture(scope="module")
def sailed(tmp_path_factory, fitted) -> Path:
    """Results of two manoeuvres with draws."""
    from towtank.cli.main import main

    out = tmp_path_factory.mktemp("sailed") / "results"
    words = ["simulate", str(fitted), "--ship-from", "kvlcc2", "--speed", "1.18", "--turning", "35"]
    with pytest.raises(SystemExit) as ended:
        main([*words, "--zigzag", "10/10", "--draws", "30", "--seed", "3", "--out", str(out), "--quiet"])
    assert not ended.value.code
    return out


def rows(path: Path) -> list[dict[str, str]]:
    with path.open(encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def test_the_named_ships_are_listed(towtank):
    listed = towtank("simulate", "--list").out
    assert "kvlcc2" in listed
    assert "7 m model at 1.18 m/s" in listed


def test_kvlcc2_is_the_seven_metre_model(towtank, tmp_path):
    out = tmp_path / "out"
    ended = towtank("simulate", "kvlcc2", "--turning", 35, "--zigzag", "20/20", "--out", out)
    assert ended.status == 0, ended.err
    assert "L = 7 m, approach at 1.18 m/s" in ended.out
    found = {(row["manoeuvre"], row["index"]): row for row in rows(out / "indices.csv")}
    assert list(found["turning +35", "advance"]) == ["manoeuvre", "index", "value", "unit", "sd", "p05", "p95"]
    assert abs(float(found["turning +35", "advance"]["value"]) - 3.06) < 0.05
    assert abs(float(found["turning +35", "tactical diameter"]["value"]) - 3.05) < 0.07
    assert found["turning +35", "advance"]["sd"] == ""
    assert found["zigzag +20/20", "overshoot 1"]["unit"] == "deg"
    track = read_table(out / "trajectory_turning_35.csv")
    assert track.units["psi"] == "deg"
    assert track.columns["psi"][-1] == pytest.approx(540.0)
    listed = json.loads((out / "provenance.json").read_text())["files"]
    assert sorted(listed) == sorted(path.name for path in out.iterdir())
    assert {"imo.csv", "report.html", "figure_turning_35.png", "figure_zigzag_20-20.png"} <= set(listed)


def test_without_a_manoeuvre_the_imo_set_is_sailed(towtank):
    ended = towtank("simulate", "kcs")
    for name in ("turning +35", "turning -35", "zigzag -10/10", "zigzag +20/20", "initial turning -10"):
        assert name in ended.out
    assert "20/20 zig-zag: first overshoot" in ended.out


def test_json_has_the_columns_of_the_table(towtank):
    ended = towtank("simulate", "kvlcc2", "--initial-turning", 10, "--json")
    records = json.loads(ended.out)
    assert records[0]["index"] == "initial turning track"
    assert list(records[0]) == ["manoeuvre", "index", "value", "unit", "sd", "p05", "p95"]
    assert records[0]["sd"] is None


def test_draws_give_spread_probability_and_figures(sailed):
    found = {(row["manoeuvre"], row["index"]): row for row in rows(sailed / "indices.csv")}
    advance = {name: float(found["turning +35", "advance"][name]) for name in ("value", "sd", "p05", "p95")}
    assert 0.0 < advance["sd"] < 0.5
    assert advance["p05"] < advance["value"] < advance["p95"]
    imo = {row["criterion"]: row for row in rows(sailed / "imo.csv")}
    assert 0.0 <= float(imo["turning: advance"]["probability"]) <= 1.0
    assert len(rows(sailed / "draws.csv")) == 30
    assert (sailed / "figure_turning_35_fan.png").stat().st_size > 5000
    page = (sailed / "report.html").read_text(encoding="utf-8")
    assert "MSC.137(76)" in page
    assert "30 draws, seed 3" in page
    assert page.count("<svg") == page.count("</svg>") >= 8
    assert "http://" not in page.replace("http://www.w3.org", "")


def test_an_earlier_result_of_its_own_is_replaced(towtank, tmp_path):
    out = tmp_path / "out"
    towtank("simulate", "kvlcc2", "--turning", 20, "--out", out, "--no-report", "--quiet")
    towtank("simulate", "kvlcc2", "--zigzag", "10", "--out", out, "--no-report", "--quiet")
    names = {path.name for path in out.iterdir()}
    assert names == {"indices.csv", "imo.csv", "steering.csv", "trajectory_zigzag_10-10.csv", "provenance.json"}


def test_a_schedule_course_keeping_and_an_environment(towtank, tmp_path):
    (tmp_path / "helm.csv").write_text("t [s],rudder [deg]\n0,0\n5,10\n40,10\n45,-10\n60,-10\n")
    (tmp_path / "sea.toml").write_text(ENVIRONMENT)
    words = ["--schedule", tmp_path / "helm.csv", "--course-keeping", 5, "--environment", tmp_path / "sea.toml"]
    ended = towtank("simulate", "kvlcc2", *words, "--interval", 1, "--out", tmp_path / "out")
    assert ended.status == 0, ended.err
    assert "manoeuvres without indices: course keeping, schedule" in ended.out
    helm = read_table(tmp_path / "out" / "trajectory_schedule.csv").columns
    assert helm["delta"][20] == pytest.approx(10.0)
    assert helm["time"][1] == pytest.approx(1.0)
    course = read_table(tmp_path / "out" / "trajectory_course_keeping.csv").columns
    assert course["psi"][-1] == pytest.approx(5.0, abs=1.0)
    # over the ground the ship goes with the current
    assert course["y"][-1] > 0.08 * course["time"][-1]
    said = json.loads((tmp_path / "out" / "provenance.json").read_text())
    assert said["environment"] == ["current of 0.1 m/s flowing to 90°"]


def test_other_manoeuvres(towtank):
    ended = towtank("simulate", "esso190k", "--crash-stop", "--pull-out", 20, "--williamson")
    for index in ("track reach", "residual yaw rate", "side offset"):
        assert index in ended.out
    spirals = towtank("simulate", "kvlcc2", "--spiral", "--reverse-spiral")
    assert spirals.out.count("loop width") == 2


BAD = {
    "unknown ship": (["kvlcc3"], ("'kvlcc3' is neither", "did you mean kvlcc2")),
    "nothing like a ship": (["zzzz"], ("'zzzz' is neither", "towtank simulate --list")),
    "no ship": ([], ("which ship?", "--list")),
    "missing set": (["nowhere/derivatives.json"], ("nowhere/derivatives.json", "file not found")),
    "malformed zig-zag": (["kvlcc2", "--zigzag", "20-20"], ("'zigzag 20-20' cannot be read", "write e.g.")),
    "half a zig-zag": (["kvlcc2", "--zigzag", "20/"], ("'zigzag 20/'", "write e.g. 'zigzag 20/20'")),
    "a word for an angle": (["kvlcc2", "--turning", "hard"], ("'turning hard'", "write e.g. 'turning 35'")),
    "no rudder": (["kvlcc2", "--turning", "0"], ("turns to neither side", "give an angle")),
    "too much rudder": (["kvlcc2", "--turning", "60"], ("orders 60 deg of rudder", "order less")),
    "twice": (["kvlcc2", "--turning", "35", "--turning", "35"], ("asked for twice", "once")),
    "unknown option": (["kvlcc2", "--zagzig", "20/20"], ("--zagzig", "towtank simulate --help")),
    "negative speed": (["kvlcc2", "--speed", "-1"], ("-1 m/s is not positive", "--speed")),
    "missing schedule": (["kvlcc2", "--schedule", "helm.csv"], ("helm.csv", "give the path")),
    "missing environment": (["kvlcc2", "--environment", "sea.toml"], ("sea.toml", "file not found")),
    "draws of nothing": (["kvlcc2", "--draws", "50"], ("'kvlcc2' has no covariance", "--percent 5")),
    "one draw": (["kvlcc2", "--draws", "1", "--percent", "5"], ("1 draws has no spread", "1000")),
    "per cent of nothing": (["kvlcc2", "--percent", "5"], ("needs draws", "number of draws")),
    "negative per cent": (["kvlcc2", "--draws", "9", "--percent", "-5"], ("-5 per cent", "give e.g. 5")),
    "bad gains": (["kvlcc2", "--course-keeping", "0", "--gains", "1,2"], ("'1,2'", "P,D,I")),
    "bad interval": (["kvlcc2", "--interval", "0"], ("interval", "positive time")),
    "no thrust astern": (["mariner", "--crash-stop"], ("crash stop", "astern")),
    "divergence": (["dtmb5512", "--turning", "35"], ("'dtmb5512'", "diverges after")),
    "set without a propeller": (["dtmb5512-efd"], ("cannot be sailed", "a propeller", "--ship-from")),
    "unknown lender": (["dtmb5512-efd", "--ship-from", "kvlc"], ("no ship 'kvlc'", "kvlcc2")),
}


@pytest.mark.parametrize("bad", BAD)
def test_a_bad_input_is_one_line_and_writes_nothing(bad, towtank, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words, parts = BAD[bad]
    ended = towtank("simulate", *words, "--out", "out")
    assert ended.status == 2, ended.err
    assert ended.out == ""
    assert ended.err.count("\n") == 1
    for part in parts:
        assert part in ended.err, ended.err
    assert list(tmp_path.iterdir()) == []


FILES = {
    "no rudder in the schedule": (
        "--schedule",
        "time [s],x [m]\n0,1\n1,2\n",
        ("no column 'delta'", "'delta [deg]'"),
    ),
    "no unit": ("--schedule", "time [s],delta\n0,1\n1,2\n", ("'delta' has no unit", "delta [deg]")),
    "time goes back": ("--schedule", "time [s],delta [deg]\n0,1\n2,2\n1,3\n", ("row 3", "sort the rows")),
    "a blank": ("--schedule", "time [s],delta [deg]\n0,1\n2,nan\n3,3\n", ("row 2", "fill the row")),
    "not TOML": ("--environment", "[current\n", ("not valid TOML", "mend the syntax")),
    "misspelt section": ("--environment", "[curent]\nspeed = 1\n", ("'curent'", "closest: current")),
    "misspelt key": ("--environment", "[current]\nsped = 1\ndirection = 0\n", ("sped", "closest: speed")),
    "negative height": ("--environment", "[waves]\nheight = -1\ndirection = 0\n", ("'waves.height'", "greater")),
    "no coefficients": (
        "--environment",
        "[wind]\nspeed = 9\ndirection = 0\nfrontal_area = 1\nlateral_area = 2\n",
        ("'wind'", "coefficients once", "give type"),
    ),
    "unknown type of ship": (
        "--environment",
        '[wind]\nspeed = 9\ndirection = 0\nfrontal_area = 1\nlateral_area = 2\ntype = "canoe"\n',
        ("'wind.type'", "canoe", "types are"),
    ),
}


@pytest.mark.parametrize("bad", FILES)
def test_a_bad_file_is_named(bad, towtank, tmp_path):
    option, text, parts = FILES[bad]
    path = tmp_path / "input.txt"
    path.write_text(text)
    ended = towtank("simulate", "kvlcc2", option, path, "--out", tmp_path / "out")
    assert ended.status == 2, ended.err
    assert ended.err.count("\n") == 1
    for part in ("input.txt", *parts):
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


def test_results_of_a_campaign_are_not_overwritten(towtank, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "provenance.json").write_text('{"format": "towtank provenance 1", "files": ["derivatives.json"]}')
    (out / "derivatives.json").write_text("{}")
    ended = towtank("simulate", "kvlcc2", "--turning", 35, "--out", out)
    assert ended.status == 2
    assert "holds results of another kind" in ended.err
    assert (out / "derivatives.json").read_text() == "{}"
