"""``towtank squat`` and ``towtank demo squat``: what they write, what they print, and what they refuse."""

from __future__ import annotations

import json
import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.squat.virtual_squat import demo_squat
from towtank.squat.virtual_voyage import virtual_voyage

BENCHMARK = Path(__file__).resolve().parents[3] / "shared" / "data" / "squat_dtc_mashcon2019"
SQUAT = ["run", "quantity", "mean", "se", "n_eff", "window_start", "window_end", "unit"]
SCORES = ["case", "quantity", "n", "Q", "BS", "bias", "rms", "max_abs", "unit"]
PLAN = demo_squat()
SHORT = replace(PLAN, rest=1.0, ramp=1.0, run=13.0, settling=0.5)

SHIP = """
[ship]
name = "container ship"
L = 230.0
B = 32.2
T = 10.8
volume = 52030.0
[hull]
propellers = 2
[restoring]
waterplane_area = 6500.0
flotation = -8.0
longitudinal_GM = 280.0
"""


@pytest.fixture(scope="module")
def made_runs(tmp_path_factory) -> Path:
    """Folder of two runs of one speed and one of another, in mm with units in the headings."""
    folder = tmp_path_factory.mktemp("runs")
    for number, speed in enumerate((0.5, 0.5, 0.8)):
        PLAN.make(speed, number).to_csv(folder / f"run{number}.csv", index=False)
    return folder


@pytest.fixture
def runs(made_runs, tmp_path) -> list[Path]:
    """The runs, copied for a test that may spoil them."""
    return [Path(shutil.copy(file, tmp_path)) for file in sorted(made_runs.iterdir())]


@pytest.fixture
def ship(tmp_path) -> Path:
    path = tmp_path / "ship.toml"
    path.write_text(SHIP)
    return path


def test_runs_to_results(towtank, runs, ship, tmp_path):
    out = tmp_path / "out"
    options = ("--ship", ship, "--scale", 80, "--depth", 0.2025, "--no-report", "--out", out)
    ended = towtank("squat", "reduce", *runs, *options)
    assert (ended.status, ended.err) == (0, "")
    names = ["provenance.json", "squat.csv", "squat.json", "squat_curve.csv", "squat_fits.csv"]
    names += ["squat_formulas.csv", "squat_full_scale.csv", "squat_repeats.csv"]
    assert sorted(path.name for path in out.iterdir()) == names
    table = pd.read_csv(out / "squat.csv")
    assert list(table.columns) == SQUAT
    means = table.set_index(["run", "quantity"])["mean"]
    bow, stern = PLAN.sinkage(np.array([0.5, 0.8]))
    assert means["run2", "sinkage_bow"] == pytest.approx(bow[1], abs=2e-4)
    assert means["run2", "sinkage_stern"] == pytest.approx(stern[1], abs=2e-4)
    assert "repeats-pooled" in ended.out
    assert "channels: time = time" not in ended.out  # a default is not repeated
    assert "bow = bow, stern = stern" in ended.out
    assert json.loads((out / "provenance.json").read_text())["inputs"][str(runs[0])]
    repeats = pd.read_csv(out / "squat_repeats.csv")
    assert repeats["n"].unique().tolist() == [2]


def test_window_channels_and_places(towtank, runs, tmp_path):
    out = tmp_path / "out"
    ended = towtank(
        "squat", "reduce", runs[2], "--channels", "time=time, bow=bow, -1.4375=stern [mm]", "--length", 2.875,
        "--window", "30:50", "--place", "quarter=0.71875", "--no-report", "--out", out,
    )  # fmt: skip
    assert (ended.status, ended.err) == (0, "")
    table = pd.read_csv(out / "squat.csv").set_index("quantity")
    assert table.loc["trim", ["window_start", "window_end"]].tolist() == [30.0, 50.0]
    quarter = 0.75 * table.loc["sinkage_bow", "mean"] + 0.25 * table.loc["sinkage_stern", "mean"]
    assert table.loc["sinkage_quarter", "mean"] == pytest.approx(quarter)
    assert "no-curve" in ended.out
    assert not (out / "squat_curve.csv").exists()


def test_heave_and_trim_need_the_sense_of_the_trim(towtank, runs, tmp_path):
    frame = pd.read_csv(runs[2])
    middle, slope = frame.pop("bow [mm]"), frame.pop("stern [mm]")
    frame["heave [mm]"], frame["trim [mm/m]"] = 0.5 * (middle + slope), (slope - middle) / 2.875
    frame.to_csv(runs[2], index=False)
    ended = towtank("squat", "reduce", runs[2], "--length", 2.875)
    assert ended.status == 2
    assert "which way 'trim' is positive is not declared" in ended.err
    assert "--trim-positive" in ended.err
    ended = towtank("squat", "reduce", runs[2], "--length", 2.875, "--trim-positive", "bow-up", "--json")
    assert ended.status == 0
    means = {row["quantity"]: row["mean"] for row in json.loads(ended.out)["squat"]}
    assert means["sinkage_bow"] > means["sinkage_stern"] > 0.0


def test_repeats_steps_speed_and_filter(towtank, runs, tmp_path):
    options = ("--length", 2.875, "--channels", "bow=bow, stern=stern", "--json")
    ended = towtank("squat", "reduce", *runs[:2], *options, "--repeats", "--filter", "butterworth", "--cutoff", 2)
    data = json.loads(ended.out)
    assert data["repeats"][0]["condition"] == "repeats"
    ended = towtank("squat", "reduce", runs[0], *options, "--speed", 0.5)
    data = json.loads(ended.out)
    assert {"quantity": "speed", "mean": 0.5}.items() <= data["squat"][-1].items()
    channels = ("--length", 2.875, "--channels", "bow=bow, stern=stern, speed=speed", "--json")
    ended = towtank("squat", "reduce", runs[0], *channels, "--steps", 20)
    assert json.loads(ended.out)["runs"][0]["windows"] == ["between the given times"]


def test_campaign_file(towtank, runs, ship, tmp_path):
    text = '[squat]\nname = "both"\nscale = 80\n' + SHIP.partition("[hull]")[0]
    text += '[fairway]\ndepth = 0.2025\nwidth = 4\n[channels]\nbow = "bow"\nstern = "stern"\nspeed = "speed"\n'
    text += "".join(f'[[records]]\nfile = "{path.name}"\n' for path in runs) + '[correction]\nname = "kreitner"\n'
    (tmp_path / "campaign.toml").write_text(text)
    ended = towtank("squat", "reduce", tmp_path / "campaign.toml", "--no-report", "--out", tmp_path / "out")
    assert (ended.status, ended.err) == (0, "")
    moved = pd.read_csv(tmp_path / "out" / "squat_corrected.csv")
    assert (moved["speed [m/s]"] > pd.read_csv(tmp_path / "out" / "squat_curve.csv")["speed [m/s]"]).all()


def spoilt(kind: str, path: Path) -> None:
    """Write a record with a fault."""
    frame = SHORT.make(0.5, 1)
    if kind == "missing":
        return
    if kind == "binary":
        path.write_bytes(bytes(range(256)) * 30)
        return
    if kind == "empty":
        path.write_bytes(b"")
        return
    if kind == "NaN":
        frame.loc[100:104, "bow [mm]"] = np.nan
    elif kind == "all NaN":
        frame["bow [mm]"] = np.nan
    elif kind == "gap":
        frame = frame.drop(index=range(100, 150))
    elif kind == "two samples":
        frame = frame.iloc[:2]
    elif kind == "constant":
        frame["stern [mm]"] = 2.0
    elif kind == "metres":
        frame = frame.rename(columns={"bow [mm]": "bow [m]"})
    elif kind == "force":
        frame = frame.rename(columns={"bow [mm]": "bow [kg]"})
    elif kind == "unit":
        frame = frame.rename(columns={"bow [mm]": "bow [mmm]"})
    elif kind == "backwards":
        frame.loc[50, "time [s]"] = 0.01
    frame.to_csv(path, index=False)
    if kind == "text":
        path.write_text(path.read_text().replace("\n0.1,", "\n0.1,fail", 1))


WIDE = ("--length", "2.875")
BAD: dict[str, tuple[tuple[object, ...], tuple[str, ...]]] = {
    "missing": (WIDE, ("run.csv: file not found", "check the path")),
    "binary": (WIDE, ("run.csv", "binary")),
    "empty": (WIDE, ("run.csv", "the file is empty")),
    "NaN": (WIDE, ("run.csv, channel bow", "[missing-values] 5 of", "choose a window without them")),
    "all NaN": (WIDE, ("run.csv", "bow", "not one value is a number")),
    "gap": (WIDE, ("run.csv, channel time", "[gap] 1 gap(s)", "--accept gap")),
    "two samples": (WIDE, ("run.csv, channel time", "[too-short] 2 samples", "give the whole record")),
    "constant": (WIDE, ("run.csv, channel stern", "[constant-channel] every value is 2", "check the sensor")),
    "metres": (WIDE, ("run.csv, channel bow", "[sinkage-too-large]", "mm for m")),
    "force": (WIDE, ("run.csv, channel bow", "kg")),
    "unit": (WIDE, ("unit 'mmm' is unknown", "mm")),
    "backwards": (WIDE, ("run.csv, channel time", "[time-not-increasing]", "cut or sort")),
    "text": (WIDE, ("run.csv", "fail")),
    "unknown column": (
        (*WIDE, "--channels", "bow=bough, stern=stern"),
        ("run.csv", "no channel 'bough'", "the file has time, speed, bow, stern"),
    ),
    "unknown role": ((*WIDE, "--channels", "beam=bow"), ("'beam' is no role", "roles are time, speed, bow")),
    "no role": ((*WIDE, "--channels", "bow"), ("'bow' is not role=column", "for example")),
    "role twice": ((*WIDE, "--channels", "bow=bow, bow=stern"), ("'bow' is given twice",)),
    "no length": ((), ("length of the ship is not known", "--length")),
    "negative depth": ((*WIDE, "--depth=-0.3"), ("a water depth of -0.3 m is impossible", "positive")),
    "unknown ship": (("--ship", "kcss"), ("no ship 'kcss'", "kcs")),
    "missing ship": (("--ship", "nil.toml"), ("nil.toml: file not found", "TOML file with [ship]")),
    "unknown window": ((*WIDE, "--window", "middle"), ("--window: 'middle' is not understood", "30-95%")),
    "empty window": ((*WIDE, "--window", "95-30%"), ("the window 0.95 to 0.3 is empty", "begin < end")),
    "window outside": ((*WIDE, "--window", "500:600"), ("run.csv", "0 samples", "widen the window")),
    "gauge without place": (
        (*WIDE, "--channels", "bow=bow, stern=stern, wave=speed", "--waves", "--window", "5:12"),
        ("where the gauge 'speed' is", "--wave-x"),
    ),
    "place without gauge": (
        (*WIDE, "--wave-x", 2.0, "--waves", "--window", "5:12"),
        ("a place without a wave gauge", "--channels wave=..."),
    ),
    "waves without times": ((*WIDE, "--waves"), ("run.csv", "finds no regular waves", "in s")),
    "steps too long": (
        (*WIDE, "--channels", "bow=bow, stern=stern, speed=speed", "--steps", 500),
        ("run.csv", "the speed stays nowhere for 500 s"),
    ),
    "speed twice": ((*WIDE, "--speed", 0.5), ("run.csv, speed", "given and recorded", "leave one")),
    "unknown filter": ((*WIDE, "--filter", "fir"), ("'fir' is no filter", "butterworth")),
    "unknown correction": ((*WIDE, "--correct", "kreinter"), ("'kreinter' is no correction", "kreitner")),
    "place": ((*WIDE, "--place", "quarter"), ("'quarter' is not name=x", "quarter=1.0")),
}


@pytest.mark.parametrize("kind", BAD)
def test_one_line_and_nothing_written(kind, towtank, tmp_path):
    options, parts = BAD[kind]
    file = tmp_path / "run.csv"
    spoilt(kind, file)
    before = sorted(path.name for path in tmp_path.iterdir())
    ended = towtank("squat", "reduce", file, *options, "--out", tmp_path / "out")
    assert (ended.status, ended.out) == (2, ""), ended.err
    assert ended.err.startswith("towtank: ")
    assert ended.err.count("\n") == 1
    assert " -> " in ended.err
    for part in parts:
        assert part in ended.err, ended.err
    assert sorted(path.name for path in tmp_path.iterdir()) == before


def test_scores(towtank, tmp_path):
    (tmp_path / "A.csv").write_text("speed,bow,trim\n1,1,0.1\n2,2,0.2\n3,3,0.3\n")
    (tmp_path / "B.csv").write_text("speed,bow,trim\n1,1.1,0.1\n3,2.7,0.3\n")
    out = tmp_path / "out"
    files = ("--efd", tmp_path / "A.csv", "--cfd", tmp_path / "B.csv")
    ended = towtank("squat", "score", *files, "--no-report", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    table = pd.read_csv(out / "scores.csv")
    assert list(table.columns) == SCORES
    bow = table.set_index("quantity").loc["bow"]
    errors = np.array([0.1, -0.1, -0.3])
    assert bow["Q"] == pytest.approx(np.sqrt(np.mean((errors / [1, 2, 3]) ** 2)))
    assert (bow["n"], bow["BS"]) == (3, 1)
    assert (bow["bias"], bow["rms"], bow["max_abs"]) == pytest.approx((-0.1, np.sqrt(0.11 / 3), 0.3))
    assert sorted(path.name for path in out.iterdir()) == [
        "errors.csv", "provenance.json", "score_details.csv", "scores.csv", "scores.json", "totals.csv",
    ]  # fmt: skip
    assert "errors are S - D" in ended.out
    assert "BS sums the signs of D - S" in ended.out


def test_many_codes_at_full_scale(towtank, tmp_path):
    (tmp_path / "A.csv").write_text("V,bow [mm],trim [deg]\n1,1,0.1\n2,2,0.2\n")
    (tmp_path / "B.csv").write_text("V,bow [mm],trim [deg]\n1,1.1,0.1\n2,2.2,0.2\n")
    (tmp_path / "C.csv").write_text("V,bow,trim\n1,1.5,0.1\n2,2.5,0.2\n")
    files = ("--efd", tmp_path / "A.csv", "--cfd", tmp_path / "B.csv", "--cfd", tmp_path / "C.csv")
    refused = towtank("squat", "score", *files, "--by", "V")
    assert refused.status == 2
    assert "C.csv, column bow: 'bow' has no unit here and is in mm in A.csv" in refused.err
    units = ("--unit", "bow=mm", "--unit", "trim=deg")
    written = ("--no-report", "--out", tmp_path / "out")
    ended = towtank("squat", "score", *files, "--by", "V", *units, "--scale", 50, *written)
    assert (ended.status, ended.err) == (0, "")
    ranking = pd.read_csv(tmp_path / "out" / "ranking.csv").set_index(["quantity", "rank"])["code"]
    assert ranking["bow", 1] == "B"
    details = pd.read_csv(tmp_path / "out" / "score_details.csv").set_index(["code", "quantity"])
    assert details.loc[("C", "bow"), "bias_full_scale"] == pytest.approx(0.025)
    assert details.loc[("C", "bow"), "unit_full_scale"] == "m"
    data = json.loads(towtank("squat", "score", *files, "--by", "V", *units, "--json").out)
    assert data["codes"] == {"B": str(tmp_path / "B.csv"), "C": str(tmp_path / "C.csv")}


def test_near_zero_has_no_relative_score(towtank, tmp_path):
    (tmp_path / "A.csv").write_text("speed,trim\n1,0.001\n2,0.2\n")
    (tmp_path / "B.csv").write_text("speed,trim\n1,0.1\n2,0.22\n")
    files = ("--efd", tmp_path / "A.csv", "--cfd", tmp_path / "B.csv", "--near-zero", "trim=0.01")
    ended = towtank("squat", "score", *files, "--json")
    (row,) = json.loads(ended.out)["details"]
    assert (row["n"], row["Q"]) == (1, pytest.approx(0.1))
    assert "near zero" in row["note"]


SCORE_FAULTS: dict[str, tuple[str, tuple[object, ...], tuple[str, ...]]] = {
    "missing": ("", (), ("B.csv: file not found", "check the path")),
    "binary": ("\x00\x01\x02" * 50, (), ("B.csv", "binary")),
    "by": ("V,bow\n1,1\n2,2\n", (), ("B.csv: there is no column 'speed'", "--by: V, bow")),
    "all NaN": ("speed,bow\n1,\n2,\n", (), ("B.csv, column bow", "not one value is a number")),
    "outside": ("speed,bow\n11,1\n12,2\n", (), ("B.csv", "reaches no measured speed", "nothing is extrapolated")),
    "unshared": ("speed,stern\n1,1\n2,2\n", (), ("B.csv", "share no quantity", "name the columns alike")),
    "unit": ("speed,bow [N]\n1,1\n2,2\n", (), ("'bow' has no unit here and is in N in B.csv",)),
    "option": ("speed,bow\n1,1\n2,2\n", ("--unit", "bow"), ("--unit: 'bow' is not column=value",)),
    "zero": ("speed,bow\n1,1\n2,2\n", ("--near-zero", "bow=x"), ("--near-zero: 'x' is no number",)),
    "scale": ("speed,bow\n1,1\n2,2\n", ("--scale", "-2"), ("a scale of -2 is impossible",)),
}


@pytest.mark.parametrize("kind", SCORE_FAULTS)
def test_score_refuses_in_one_line(kind, towtank, tmp_path):
    text, options, parts = SCORE_FAULTS[kind]
    (tmp_path / "A.csv").write_text("speed,bow\n1,1\n2,2\n")
    if text:
        (tmp_path / "B.csv").write_text(text)
    ended = towtank(
        "squat", "score", "--efd", tmp_path / "A.csv", "--cfd", tmp_path / "B.csv", *options,
        "--out", tmp_path / "out",
    )  # fmt: skip
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1), ended.err
    for part in (*parts, " -> "):
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


def test_prediction_in_knots_and_metres_a_second(towtank, tmp_path):
    out = tmp_path / "out"
    ended = towtank("squat", "predict", "kcs", "--depth", 16, "--speed", "6:16:1", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == [
        "predict.csv", "predict.json", "provenance.json", "report.html", "spread.csv",
    ]  # fmt: skip
    assert "speed [kn]             6        7" in ended.out
    assert "(in brackets: outside the limits of the formula" in ended.out
    table = pd.read_csv(out / "predict.csv")
    assert table["full-scale speed [kn]"].max() == pytest.approx(16.0)
    first = table[(table["formula"] == "barrass-3") & np.isclose(table["full-scale speed [kn]"], 10.0)].iloc[0]
    assert first["maximum [m]"] == pytest.approx(0.65, abs=5e-3)
    assert table.loc[table["formula"] == "yoshimura", "flag"].str.contains("L/B").all()
    metres = towtank(
        "squat", "predict", "kcs", "--depth", 16, "--speed", "5.144444", "--speed-unit", "m/s", "--json"
    )
    rows = {row["formula"]: row["maximum [m]"] for row in json.loads(metres.out)["prediction"]}
    assert rows["barrass-3"] == pytest.approx(first["maximum [m]"], rel=1e-6)


def test_prediction_of_a_model_a_canal_and_a_file(towtank, ship):
    text = SHIP.replace('name = "container ship"', 'name = "container ship"\nscale = 1.0')
    ship.write_text(text)
    ended = towtank("squat", "predict", ship, "--depth", 16.2, "--speed", "8,10", "--json")
    data = json.loads(ended.out)
    assert {row["formula"] for row in data["prediction"]} >= {"icorels", "icorels-restored"}
    canal = towtank("squat", "predict", ship, "--depth", 16.2, "--speed", "8:16:4", "--width", 100, "--slope", 3)
    assert "Schijf limit" in canal.out
    assert "warning [above-schijf]" in canal.out
    trench = towtank("squat", "predict", ship, "--depth", 16.2, "--speed", "8", "--width", 200, "--bank-height", 5)
    assert "trench of" in trench.out
    model = towtank(
        "squat", "predict", "dtc", "--model", "--depth", 0.174, "--speed", "0.3", "--speed-unit", "m/s", "--json"
    )
    data = json.loads(model.out)
    assert data["ship"]["scale"] == 100.0
    assert data["prediction"][0]["full-scale speed [kn]"] == pytest.approx(3.0 * 3600 / 1852)


PREDICT_FAULTS: dict[str, tuple[tuple[object, ...], tuple[str, ...]]] = {
    "negative depth": (("kcs", "--depth=-3", "--speed", "6:8"), ("a water depth of -3 m is impossible",)),
    "aground": (("kcs", "--depth", 9, "--speed", "6:8"), ("not more than the draught 10.8 m", "give more depth")),
    "critical": (("kcs", "--depth", 16, "--speed", "6:30:1"), ("not below the critical 12.526 m/s (24.35 kn)",)),
    "m/s for knots": (
        ("kcs", "--depth", 16, "--speed", "6:16:1", "--speed-unit", "m/s"),
        ("16.000 m/s is not below the critical",),
    ),
    "unit": (
        ("kcs", "--depth", 16, "--speed", "6", "--speed-unit", "mph"),
        ("'mph' is no unit of speed", "kn or m/s"),
    ),
    "speeds": (("kcs", "--depth", 16, "--speed", "six"), ("--speed: 'six' is not understood", "6:16:1")),
    "zero": (("kcs", "--depth", 16, "--speed", "0:8"), ("a speed that is not positive",)),
    "NaN": (("kcs", "--depth", 16, "--speed", "nan"), ("a speed that is not positive",)),
    "step": (("kcs", "--depth", 16, "--speed", "6:8:0.0001"), ("20001 speeds", "larger step")),
    "ship": (("kcss", "--depth", 16, "--speed", "6"), ("no ship 'kcss'", "kcs")),
    "file": (("nil.toml", "--depth", 16, "--speed", "6"), ("nil.toml: file not found",)),
    "banks": (("kcs", "--depth", 16, "--speed", "6", "--slope", 3), ("banks without a bottom width", "--width")),
    "narrow": (("kcs", "--depth", 16, "--speed", "6", "--width", 10), ("does not fit",)),
}


@pytest.mark.parametrize("kind", PREDICT_FAULTS)
def test_predict_refuses_in_one_line(kind, towtank, tmp_path):
    words, parts = PREDICT_FAULTS[kind]
    ended = towtank("squat", "predict", *words, "--out", tmp_path / "out")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1), ended.err
    for part in parts:
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        (("L = 230.0\n", ""), ("ship.toml, [ship]", "'L' is missing")),
        (("volume = 52030.0\n", ""), ("ship.toml", "no displaced volume", "volume in m3")),
        (("propellers = 2", "propellers = 3"), ("ship.toml, key 'hull.propellers'", "1 or 2")),
        (("flotation", "floatation"), ("key 'restoring.floatation'", "closest: flotation")),
        (("[ship]", "[hull2]"), ("ship.toml", "there is no section [ship]")),
    ],
)
def test_ship_files_with_faults(change, parts, towtank, ship):
    assert change[0] in SHIP
    ship.write_text(SHIP.replace(*change))
    ended = towtank("squat", "predict", ship, "--depth", 16.2, "--speed", "8")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1), ended.err
    for part in parts:
        assert part in ended.err, ended.err


MODEL = """speed [m/s],sinkage_bow [mm],sinkage_stern [mm],trim [mm/m]
0.6,3.1,2.0,0.38
0.8,6.0,4.1,0.66
1.0,11.0,7.8,1.11
"""
AT_SEA = """speed [kn],bow [m],stern [m],trim [deg]
8,0.13,0.09,0.025
10,0.22,0.16,0.036
12,0.40,0.28,0.06
14,,0.5,0.1
"""
WATER = ("--scale", 40, "--depth", 18, "--draught", 14.5)


def test_scale(towtank, tmp_path):
    (tmp_path / "model.csv").write_text(MODEL)
    (tmp_path / "ship.csv").write_text(AT_SEA)
    files = (tmp_path / "model.csv", tmp_path / "ship.csv")
    out = tmp_path / "out"
    ended = towtank("squat", "scale", *files, *WATER, "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert sorted(path.name for path in out.iterdir()) == [
        "provenance.json", "scaling.json", "scaling_clearance.csv", "scaling_errors.csv",
    ]  # fmt: skip
    table = pd.read_csv(out / "scaling_errors.csv").set_index(["quantity", "speed"]).sort_index()
    # 10 kn are 0.8134 m/s at 1:40, between the model's second and third speed
    at = 10 * 1852 / 3600
    scaled = 40e-3 * (6.0 + 5.0 * (at / np.sqrt(40) - 0.8) / 0.2)
    row = table.loc["sinkage_bow"].iloc[1]
    assert (row["model"], row["error"]) == pytest.approx((scaled, 0.22 - scaled))
    assert row["error_as_printed"] == -row["error"]
    assert table.loc["trim"]["ship"].iloc[0] == pytest.approx(np.tan(np.radians(0.025)))
    clearance = pd.read_csv(out / "scaling_clearance.csv")
    assert clearance["ship"].tolist() == pytest.approx([3.5 - 0.13, 3.5 - 0.22, 3.5 - 0.40])
    assert "[missing-values] 1 row(s)" in ended.out
    assert "error: ship less model by Froude's law" in ended.out
    data = json.loads(towtank("squat", "scale", *files, *WATER, "--json").out)
    assert (data["scale"], len(data["errors"])) == (40.0, 9)


SCALE_FAULTS: dict[str, tuple[str, tuple[object, ...], tuple[str, ...]]] = {
    "missing": ("", WATER, ("ship.csv: file not found",)),
    "no depth": (AT_SEA, ("--scale", 40, "--draught", 14.5), ("model.csv", "the water depth is not known")),
    "scale": (AT_SEA, ("--scale", 0.5, "--draught", 14.5), ("1:0.5 is not smaller than its ship", "40 for 1:40")),
    "draught": (AT_SEA, (*WATER[:4], "--draught=-14.5"), ("--draught: -14.5 m is impossible",)),
    "aground": (AT_SEA, (*WATER[:4], "--draught", 20), ("model.csv", "leaves no clearance")),
    "beyond": (
        "speed [kn],bow [m]\n2,0.1\n3,0.2\n",
        WATER,
        ("where the ship has no speed", "nothing is extrapolated"),
    ),
    "force": ("speed [kn],bow [N]\n8,0.1\n9,0.2\n", WATER, ("ship.csv, channel bow", "a force")),
    "no speed": ("V,bow\n8,0.1\n9,0.2\n", WATER, ("ship.csv", "no channel 'speed'")),
    "nothing": ("speed,heave\n8,0.1\n9,0.2\n", WATER, ("ship.csv", "no sinkage and no trim")),
    "one row": ("speed,bow\n8,0.1\n9,\n", WATER, ("ship.csv: 1 whole row(s) make no curve",)),
    "unshared": ("speed [kn],cog [m]\n8,0.1\n9,0.2\n", WATER, ("share no sinkage and no trim",)),
}


@pytest.mark.parametrize("kind", SCALE_FAULTS)
def test_scale_refuses_in_one_line(kind, towtank, tmp_path):
    text, words, parts = SCALE_FAULTS[kind]
    (tmp_path / "model.csv").write_text(MODEL)
    if text:
        (tmp_path / "ship.csv").write_text(text)
    ended = towtank(
        "squat", "scale", tmp_path / "model.csv", tmp_path / "ship.csv", *words, "--out", tmp_path / "out"
    )
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1), ended.err
    for part in (*parts, " -> "):
        assert part in ended.err, ended.err
    assert not (tmp_path / "out").exists()


def test_results_of_another_kind_are_kept(towtank, runs, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    (out / "provenance.json").write_text('{"format": "towtank damping provenance 1", "files": []}')
    for words in (
        ("reduce", runs[0], "--length", 2.875),
        ("predict", "kcs", "--depth", 16, "--speed", "8"),
        ("score", "--efd", runs[0], "--cfd", runs[1], "--by", "time"),
        ("scale", runs[0], runs[1], "--scale", 40, "--draught", 14.5),
    ):
        ended = towtank("squat", *words, "--out", out)
        assert ended.status == 2
        assert "results of another kind" in ended.err
    assert [path.name for path in out.iterdir()] == ["provenance.json"]


def test_voyage(towtank, tmp_path):
    file = virtual_voyage(step=2.0).write_folder(tmp_path / "voyage")
    out = tmp_path / "out"
    ended = towtank("squat", "voyage", file, "--no-report", "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert "largest steady sinkage, longitudinal" in ended.out
    assert sorted(path.name for path in out.iterdir()) == [
        "provenance.json", "sensor_budget.csv", "voyage.csv", "voyage.json", "voyage_summary.csv",
    ]  # fmt: skip
    data = json.loads(towtank("squat", "voyage", file, "--json").out)
    assert data["virtual"] is True
    refused = towtank("squat", "reduce", file)
    assert (refused.status, "towtank squat voyage" in refused.err) == (2, True)
    file.write_text(file.read_text().replace('file = "voyage.csv"', 'file = "nil.csv"'))
    ended = towtank("squat", "voyage", file, "--out", tmp_path / "other")
    assert (ended.status, ended.out, ended.err.count("\n")) == (2, "", 1)
    assert "nil.csv: file not found" in ended.err
    assert not (tmp_path / "other").exists()


def test_help_has_an_example_each(towtank):
    for command in ("reduce", "score", "predict", "scale", "voyage"):
        ended = towtank("squat", command, "--help")
        assert ended.status == 0
        assert f"towtank squat {command}" in " ".join(ended.out.replace("│", " ").split())
        if command == "predict":
            assert "knots" in ended.out


def test_demo_shows_the_truth(towtank, tmp_path):
    ended = towtank("demo", "squat", "--out", tmp_path / "demo")
    assert (ended.status, ended.err) == (0, "")
    assert "made by the program, not measured" in ended.out
    folder = tmp_path / "demo" / "virtual-squat"
    assert "Virtual data." in (folder / "results" / "report.html").read_text()
    assert "virtual-panel" in (folder / "scores" / "report.html").read_text()
    fits = pd.read_csv(folder / "results" / "squat_fits.csv")
    bow = fits[(fits["quantity"] == "sinkage_bow") & (fits["model"] == "depth-froude")].iloc[0]
    assert abs(bow["value"] - PLAN.bow) < 3.0 * bow["std"]
    scores = pd.read_csv(folder / "scores" / "scores.csv")
    assert list(scores.columns) == SCORES
    assert scores["case"].unique().tolist() == ["virtual-rans", "virtual-panel", "virtual-strip"]
    (line,) = [line.split() for line in ended.out.splitlines() if line.startswith("bow [mm]  ")]
    assert line[2] == "19"


@pytest.mark.skipif(not BENCHMARK.exists(), reason="the open measurements are not here")
def test_measured_runs_of_the_benchmark(towtank, tmp_path):
    options = ("--ship", "dtc", "--scale", 89.11, "--depth", 0.326)
    channels = ("--channels", "speed=u, bow=z_VF, stern=z_VA, extra=X")
    out = tmp_path / "out"
    written = ("--no-report", "--out", out)
    ended = towtank("squat", "reduce", BENCHMARK / "C1.dat", BENCHMARK / "C2.dat", *channels, *options, *written)
    assert (ended.status, ended.err) == (0, "")
    means = pd.read_csv(out / "squat.csv").set_index(["run", "quantity"])["mean"]
    for run, bow, stern in (("C1", 0.88e-3, 0.58e-3), ("C2", 8.34e-3, 5.01e-3)):
        assert means[run, "sinkage_bow"] == pytest.approx(bow, rel=0.02)
        assert means[run, "sinkage_stern"] == pytest.approx(stern, rel=0.02)
    for rule in ("units-row", "moment-named-as-angle", "not-utf8"):
        assert f"[{rule}]" in ended.out
    ended = towtank(
        "squat", "reduce", BENCHMARK / "CW3.dat", *channels, *options, "--waves", "--window", "63.5:79.2", "--json"
    )
    (heave,) = [row for row in json.loads(ended.out)["waves"] if row["quantity"] == "sinkage_midship"]
    assert heave["mean"] == pytest.approx(7.06e-3, rel=0.03)
    assert heave["amplitude_1"] == pytest.approx(5.55e-3, rel=0.01)
    assert heave["omega"] == pytest.approx(7.05, abs=0.01)


@pytest.mark.skipif(not BENCHMARK.exists(), reason="the open measurements are not here")
def test_measured_responses_of_the_benchmark(towtank, tmp_path):
    """133 and 22 degrees are printed for bow and stern, about the wave at the centre of gravity."""
    words = ("--channels", "speed=u, bow=z_VF, stern=z_VA, wave=WG4", "--wave-x", 4.03, "--ship", "dtc")
    words += ("--scale", 89.11, "--depth", 0.326, "--waves", "--window", "63.5:79.2", "--no-report")
    ended = towtank("squat", "reduce", BENCHMARK / "CW3.dat", *words, "--out", tmp_path / "out")
    assert (ended.status, ended.err) == (0, "")
    assert "response in waves" in ended.out
    table = pd.read_csv(tmp_path / "out" / "squat_rao.csv").set_index("quantity")
    for end, phase in (("bow", 133.0), ("stern", 22.0)):
        assert np.degrees(table.loc[f"sinkage_{end}", "phase"]) == pytest.approx(phase, abs=1.0)
    assert table.loc["trim", "wave_length"] == pytest.approx(2.19, abs=0.01)
    means = pd.read_csv(tmp_path / "out" / "squat.csv")
    assert "WG4" not in set(means["quantity"])  # the gauge is no squat
