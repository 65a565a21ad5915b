"""``towtank synthesize`` and ``towtank plan``."""

from __future__ import annotations

import tomllib

import pandas as pd
import pytest

SHORT = ("--sampling-rate", 5, "--duration", 10)
MATRIX = """name,type,speed,drift_angle,frequency,sway_amplitude
tow,static_drift,1.2,0,,
drift 6,static_drift,1.2,6,,
drift -10,static_drift,1.2,-10,,
sway,pure_sway,1.2,,0.8,0.2
"""


@pytest.fixture
def matrix(tmp_path):
    path = tmp_path / "matrix.csv"
    path.write_text(MATRIX)
    return path


def test_synthesize_with_every_habit_and_noise(towtank, tmp_path, matrix):
    out = tmp_path / "virtual"
    ended = towtank(
        "synthesize", "dtmb5512-efd", "--matrix", matrix, "--out", out, *SHORT,
        "--white", 0.01, "--ar1", 0.02, "--rho", 0.8, "--drift", 0.01, "--offset", 0.005, "--quantum", 0.0001,
        "--gain-bias", 0.01, "--seed", 7, "--inertia", "--mount", 4, "--origin", 0.2, "--port-up", "--by-ship",
        "--drift-sign", "+v", "--format", "csv",
    )  # fmt: skip
    assert ended.status == 0, ended.err
    assert ended.out.startswith(f"4 virtual runs -> {out / 'campaign.toml'}")
    data = tomllib.loads((out / "campaign.toml").read_text())
    assert data["campaign"]["virtual"] is True
    for said in ("white 0.01", "ar1 0.02", "rho 0.8", "gain_bias 0.01", "seed 7"):
        assert said in data["campaign"]["notes"]
    assert data["conventions"] == {
        "axes": "forward-port-up",
        "drift_sign": "+v",
        "angle_unit": "deg",
        "force_sign": "by-ship",
    }
    assert data["inertia"]["mass"] == pytest.approx(data["ship"]["mass"] + 4)
    assert data["reduction"]["moment_x"] == 0.2
    assert sorted(path.suffix for path in (out / "runs").iterdir()) == [".csv"] * 4
    # drift 6 deg by atan(v/u) with v to port is what the matrix says again
    table = pd.read_csv(out / "matrix.csv").set_index("name")
    assert table.loc["drift 6", "drift_angle"] == pytest.approx(6.0)


def test_synthesize_keeps_what_is_there(towtank, tmp_path, matrix):
    out = tmp_path / "virtual"
    words = ("synthesize", "dtmb5512-efd", "--matrix", matrix, "--out", out, *SHORT)
    assert towtank(*words).status == 0
    again = towtank(*words)
    assert (again.status, again.out) == (2, "")
    assert f"{out}: the folder is not empty" in again.err
    assert towtank(*words, "--overwrite").status == 0
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "thesis.doc").write_text("")
    refused = towtank("synthesize", "dtmb5512-efd", "--matrix", matrix, "--out", mine, "--overwrite")
    assert refused.status == 2
    assert [path.name for path in mine.iterdir()] == ["thesis.doc"]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--matrix", "generl"), "'generl' is neither a file nor a standard test matrix -> standard ones are"),
        (("--format", "pdf"), "'pdf' is not a format of run files -> use one of text, csv, simman"),
        (("--rho", 1.5), "rho = 1.5 never forgets"),
        (("--drift-sign", "left"), "drift_sign = 'left' is not a choice"),
        (("--ar1", -1), "--ar1"),
    ],
)
def test_synthesize_refuses_what_makes_no_sense(towtank, tmp_path, words, said):
    ended = towtank("synthesize", "kvlcc2", "--out", tmp_path / "virtual", *words)
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert said in ended.err
    assert list(tmp_path.iterdir()) == []


def test_a_set_without_mass_has_no_inertia_to_put_in(towtank, tmp_path):
    ended = towtank("synthesize", "kcs-waves-calm", "--inertia", "--matrix", "cmt", "--out", tmp_path / "virtual")
    assert ended.status == 2
    assert "is not known -> leave --inertia out" in ended.err


def test_plan_says_what_is_expected_and_what_is_next(towtank, tmp_path):
    out = tmp_path / "expected.csv"
    ended = towtank(
        "plan",
        "kvlcc2",
        "--ar1",
        0.02,
        "--for",
        "Nv",
        "--within",
        0.02,
        "--best",
        3,
        "--criterion",
        "A",
        "--out",
        out,
    )
    assert ended.status == 0, ended.err
    assert "Nv: the programme gives" in ended.out
    assert "best next runs (A-optimality for Nv):" in ended.out
    assert f"written: {out}" in ended.out
    table = pd.read_csv(out).set_index("name")
    assert table.loc["Nv", "std"] > 0
    assert len(ended.out[ended.out.index("best next runs") :].splitlines()) == 1 + 1 + 3 + 1


def test_plan_with_candidates_of_its_own_and_without_advice(towtank, matrix):
    ended = towtank("plan", "kvlcc2", "--candidates", matrix)
    assert ended.status == 0
    assert "drift -10" in ended.out
    assert "best next" not in towtank("plan", "kvlcc2", "--best", 0).out


@pytest.mark.parametrize(
    ("words", "said"),
    [(("--criterion", "E"), "'E' is not a criterion -> use D or A"), (("--for", "Nvq"), "Nvq")],
)
def test_plan_refuses_what_makes_no_sense(towtank, words, said):
    ended = towtank("plan", "kvlcc2", *words)
    assert ended.status == 2
    assert ended.err.count("\n") == 1
    assert said in ended.err
