"""Test matrices and file groups of a campaign as runs in SI, radians and home signs."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from towtank.core.conventions import HOME, Conventions
from towtank.core.errors import CampaignError
from towtank.pmm.campaign_file import RunGroup
from towtank.pmm.run_matrix import expand_runs

DEGREES = Conventions(angle_unit="deg")


@pytest.fixture
def expanded(tmp_path):
    """Runs of groups; the named files are made empty, `matrix` is written to matrix.csv."""

    def expand(*groups: dict[str, Any], files=(), matrix: str | None = None, conventions: Conventions = DEGREES):
        for name in files:
            path = tmp_path / name
            path.parent.mkdir(exist_ok=True, parents=True)
            path.touch()
        if matrix is not None:
            (tmp_path / "matrix.csv").write_text(matrix, encoding="utf-8")
        made = [RunGroup.model_validate(group) for group in groups]
        return expand_runs(made, tmp_path, conventions, tmp_path / "campaign.toml")

    return expand


def test_one_value_a_file_in_the_natural_order_of_the_names(expanded):
    group = {"files": "run*.txt", "type": "static_drift", "speed": 1.5, "drift_angle": [2.0, 4.0, 10.0]}
    runs = expanded(group, files=["run2.txt", "run10.txt", "run1.txt"])
    assert [run.name for run in runs] == ["run1", "run2", "run10"]
    assert [round(math.degrees(run.drift_angle), 9) for run in runs] == [2.0, 4.0, 10.0]
    assert {run.speed for run in runs} == {1.5}
    assert runs[0].file.name == "run1.txt"


def test_several_patterns_name_each_file_once(expanded):
    group = {"files": ["b*.txt", "*.txt"], "type": "static_drift", "speed": 1.0, "drift_angle": 0.0}
    assert [run.name for run in expanded(group, files=["a.txt", "b.txt"])] == ["b", "a"]


def test_parameters_from_file_names(expanded):
    group = {
        "files": "*.dat",
        "type": "pure_yaw",
        "speed": 1.5,
        "sway_amplitude": 0.3,
        "pattern": r"f(?P<frequency_hz>[\d.]+)_d(?P<drift_angle>-?\d+)",
    }
    (run,) = expanded(group, files=["f0.25_d-5.dat"])
    assert run.frequency == pytest.approx(2 * math.pi * 0.25)
    assert run.drift_angle == pytest.approx(math.radians(-5))


def test_matrix_with_its_own_types_aliases_and_defaults_of_the_group(expanded):
    matrix = """# a remark
name; file; type; beta; delta; r; period; sway_amplitude; U
drift; a.txt; ; 4; ; ; ; ; 1.2
rudder; b.txt; static_rudder; ; -10; ; ; ;
circle; c.txt; steady_yaw; ; ; 0.2; ; ;
sway; d.txt; pure_sway; ; ; ; 8.0; 0.2;
"""
    runs = expanded(
        {"matrix": "matrix.csv", "type": "static_drift", "speed": 1.5, "tare": "zero.txt", "series": "first"},
        files=["a.txt", "b.txt", "c.txt", "d.txt"],
        matrix=matrix,
    )
    drift, rudder, circle, sway = runs
    assert (drift.kind, drift.speed, drift.drift_angle) == ("static_drift", 1.2, pytest.approx(math.radians(4)))
    assert (rudder.kind, rudder.speed, rudder.rudder_angle) == (
        "static_rudder",
        1.5,
        pytest.approx(-0.1745, abs=1e-4),
    )
    assert (circle.yaw_rate, circle.drift_angle) == (0.2, 0.0)
    assert (sway.frequency, sway.sway_amplitude) == (pytest.approx(2 * math.pi / 8), 0.2)
    assert {run.tare for run in runs} == {"zero.txt"}
    assert {run.series for run in runs} == {"first"}


@pytest.mark.parametrize(
    ("change", "sign"),
    [
        ({"drift_sign": "+v"}, {"drift_angle": -1}),
        ({"rudder_sign": "port"}, {"rudder_angle": -1}),
        ({"axes": "forward-port-up"}, {"drift_angle": -1, "yaw_rate": -1, "sway_amplitude": -1}),
        ({"axes": "forward-port-up", "drift_sign": "+v"}, {"yaw_rate": -1, "sway_amplitude": -1}),
    ],
)
def test_signs_and_units_of_the_conventions(expanded, change, sign):
    group = {"files": "a.txt", "type": "drift_rudder", "speed": 1.0, "drift_angle": 0.1, "rudder_angle": 0.2}
    group |= {"yaw_rate": 0.3, "sway_amplitude": 0.4}
    (run,) = expanded(group, files=["a.txt"], conventions=HOME.but(**change))
    expected = {"drift_angle": 0.1, "rudder_angle": 0.2, "yaw_rate": 0.3, "sway_amplitude": 0.4}
    for key, value in expected.items():
        assert getattr(run, key) == pytest.approx(sign.get(key, 1) * value), key


def test_equal_names_are_told_apart_by_folder(expanded):
    group = {"files": ["deep/a.txt", "shallow/a.txt"], "type": "static_drift", "speed": 1.0, "drift_angle": 0.0}
    runs = expanded(group, files=["deep/a.txt", "shallow/a.txt"])
    assert [run.name for run in runs] == ["deep/a.txt", "shallow/a.txt"]


def test_files_outside_the_folder_of_the_campaign(expanded, tmp_path):
    elsewhere = tmp_path.parent / f"{tmp_path.name}-elsewhere"
    elsewhere.mkdir()
    (elsewhere / "a.txt").touch()
    group = {"type": "static_drift", "speed": 1.0, "drift_angle": 0.0}
    matrix = f"file,type\na.txt,static_drift\n{(elsewhere / 'a.txt').as_posix()},static_drift\n"
    runs = expanded({**group, "matrix": "matrix.csv"}, files=["a.txt"], matrix=matrix)
    assert [run.name for run in runs] == ["a.txt", f"../{elsewhere.name}/a.txt"]
    assert all(run.file.is_file() for run in runs)


GROUP = {"files": "*.txt", "type": "static_drift", "speed": 1.5, "drift_angle": 4.0}
MISTAKES: dict[str, tuple[dict[str, Any], str | None, tuple[str, ...]]] = {
    "no such file": ({**GROUP, "files": "q*.txt"}, None, ("runs[1].files", "no file matches 'q*.txt'", "look in")),
    "no files": ({"type": "static_drift"}, None, ("runs[1]", "neither files nor matrix", "give one")),
    "files and matrix": ({**GROUP, "matrix": "m.csv"}, None, ("runs[1]", "both given", "give one")),
    "no type": ({**GROUP, "type": None}, None, ("runs[1], run 'a'", "has no type", "add type")),
    "unknown type": ({**GROUP, "type": "zigzag"}, None, ("run 'a'", "'zigzag' is not a run type", "static_drift")),
    "unknown parameter": ({**GROUP, "speeed": 1.0}, None, ("run 'a'", "'speeed' is not a parameter", "speed")),
    "missing parameter": (
        {"files": "*.txt", "type": "static_drift", "speed": 1.5},
        None,
        ("run 'a'", "a static_drift run needs 'drift_angle'", "add it"),
    ),
    "missing frequency": (
        {"files": "*.txt", "type": "pure_sway", "speed": 1.5, "sway_amplitude": 0.1},
        None,
        ("run 'a'", "needs 'frequency'"),
    ),
    "no period": (
        {"files": "*.txt", "type": "pure_sway", "speed": 1.5, "sway_amplitude": 0.1, "period": 0.0},
        None,
        ("run 'a'", "needs a frequency", "rad/s"),
    ),
    "no amplitude": (
        {"files": "*.txt", "type": "pure_sway", "speed": 1.5, "sway_amplitude": 0.0, "frequency": 1.0},
        None,
        ("run 'a'", "needs an amplitude"),
    ),
    "no speed": ({**GROUP, "speed": 0.0}, None, ("run 'a'", "speed 0.0 m/s is not positive")),
    "text": ({**GROUP, "speed": "fast"}, None, ("speed = 'fast' is not a number", "one number a run")),
    "infinite": ({**GROUP, "speed": math.inf}, None, ("speed = inf is not finite",)),
    "too many values": ({**GROUP, "speed": [1.0, 2.0]}, None, ("runs[1].speed", "2 values for 1 files")),
    "bad pattern": ({**GROUP, "pattern": "(?P<x"}, None, ("runs[1].pattern", "not a regular expression")),
    "pattern that misses": ({**GROUP, "pattern": "z+"}, None, ("runs[1].pattern", "does not match 'a.txt'")),
    "no matrix": ({"matrix": "none.csv"}, None, ("'none.csv' cannot be read", "No such file", "name a table")),
    "empty matrix": ({"matrix": "matrix.csv"}, "", ("'matrix.csv' is not a table", "CSV")),
    "matrix of names only": (
        {"matrix": "matrix.csv"},
        "file,type\n",
        ("'matrix.csv' has no rows", "one row a run"),
    ),
    "matrix without files": ({"matrix": "matrix.csv"}, "type,speed\nx,1\n", ("no column 'file'", "type, speed")),
    "missing run file": (
        {"matrix": "matrix.csv"},
        "file,type,speed,drift_angle\na.txt,static_drift,1,0\nb.txt,static_drift,1,0\n",
        ("matrix.csv, row 3", "run file 'b.txt' not found", "mend the name"),
    ),
    "one name for two runs": (
        {"matrix": "matrix.csv"},
        "name,type,speed,drift_angle\nsame,static_drift,1,0\nsame,static_drift,1,2\n",
        ("two runs are called 'same'", "name each run once"),
    ),
    "text in the matrix": (
        {"matrix": "matrix.csv"},
        "file,type,speed,drift_angle\na.txt,static_drift,1;5,0\n",
        ("matrix.csv, row 2", "speed = '1;5' is not a number"),
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_names_campaign_place_cause_and_cure(mistake, expanded, tmp_path):
    group, matrix, parts = MISTAKES[mistake]
    with pytest.raises(CampaignError) as caught:
        expanded(group, files=["a.txt"], matrix=matrix)
    line = str(caught.value)
    assert line.startswith(str(Path(tmp_path) / "campaign.toml"))
    assert " -> " in line
    for part in parts:
        assert part in line, line
