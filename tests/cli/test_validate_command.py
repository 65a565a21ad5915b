"""``towtank validate``: errors, z-scores and coverage of a measured manoeuvre; bad inputs."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from towtank.simulate.manoeuvres import turning, zigzag
from towtank.simulate.sailing import sail
from towtank.simulate.ships import named_ship

CURRENT = (0.05, -0.03)
"""Along the initial course and to starboard, m/s."""


@pytest.fixture(scope="module")
def trials(tmp_path_factory) -> Path:
    """A turn and a zig-zag of a KVLCC2 whose Nr is 10 per cent larger: with an approach, on another course."""
    folder = tmp_path_factory.mktemp("trials")
    ship = named_ship("kvlcc2")
    hull = ship.hull.with_values(Nr=1.1 * ship.hull["Nr"])
    for name, programme in (("turn", turning(35.0, 720.0)), ("zigzag", zigzag(10.0))):
        one = sail(ship.with_hull(hull), programme, interval=0.25)
        before = np.arange(0.0, 10.0, 0.25)
        still = np.zeros(len(before))
        time = np.concatenate([before, 10.0 + one["time"]])
        x = np.concatenate([1.18 * (before - 10.0), one["x"]])
        y, psi = np.concatenate([still, one["y"]]), np.concatenate([still, one["psi"]])
        course = np.radians(30.0)
        table = {
            "time [s]": time,
            "x [m]": x * np.cos(course) - y * np.sin(course),
            "y [m]": x * np.sin(course) + y * np.cos(course),
            "psi [deg]": np.degrees(psi) + 30.0,
            "u [m/s]": np.concatenate([still + 1.18, one["u"]]),
            "v [m/s]": np.concatenate([still, one["v"]]),
            "r [deg/s]": np.degrees(np.concatenate([still, one["r"]])),
            "delta [deg]": np.degrees(np.concatenate([still, one["delta"]])),
        }
        pd.DataFrame(table).to_csv(folder / f"{name}.csv", index=False)
        table["x [m]"] = table["x [m]"] + CURRENT[0] * time
        table["y [m]"] = table["y [m]"] + CURRENT[1] * time
        pd.DataFrame(table).to_csv(folder / f"{name}_in_current.csv", index=False)
    return folder


def rows(path: Path, key: str) -> dict[str, dict[str, str]]:
    with path.open(encoding="utf-8") as stream:
        return {row[key]: row for row in csv.DictReader(stream)}


def test_a_zigzag_is_scored_against_its_band(towtank, trials, tmp_path):
    words = ["--manoeuvre", "zigzag 10/10", "--draws", 40, "--percent", 5, "--seed", 2, "--out", tmp_path / "out"]
    ended = towtank("validate", trials / "zigzag.csv", "--set", "kvlcc2", *words)
    assert ended.status == 0, ended.err
    found = rows(tmp_path / "out" / "validation.csv", "index")
    one = {name: float(found["overshoot 1"][name]) for name in ("measured", "simulated", "error", "sd", "z")}
    # more yaw damping checks the yaw earlier
    assert one["measured"] < one["simulated"] == pytest.approx(5.0, abs=0.1)
    assert one["error"] == pytest.approx(one["simulated"] - one["measured"])
    assert one["z"] == pytest.approx(one["error"] / one["sd"])
    assert found["overshoot 1"]["covered"] in ("True", "False")
    channels = rows(tmp_path / "out" / "channels.csv", "channel")
    assert 20.0 < float(channels["psi"]["coverage_pct"]) <= 100.0
    assert float(channels["psi"]["correlation"]) > 0.9
    assert "indices inside" in ended.out
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {"figure_track.png", "figure_psi.png", "figure_r.png", "provenance.json"} <= names


def test_the_course_and_the_time_of_the_order_do_not_matter(towtank, trials, tmp_path):
    towtank(
        "validate", trials / "turn.csv", "--set", "kvlcc2", "-m", "turning", "--rudder", 35, "-o", tmp_path / "a"
    )
    found = rows(tmp_path / "a" / "validation.csv", "index")
    ship = named_ship("kvlcc2")
    assert float(found["advance"]["simulated"]) == pytest.approx(3.078, abs=0.002)
    assert float(found["advance"]["measured"]) * ship.ship.L > 0.0
    assert float(found["tactical diameter"]["measured"]) == pytest.approx(
        expected(ship.with_hull(ship.hull.with_values(Nr=1.1 * ship.hull["Nr"]))), abs=0.02
    )


def expected(vessel) -> float:
    from towtank.simulate.manoeuvre_indices import indices

    return float(indices(sail(vessel, turning(35.0))).set_index("index").loc["tactical diameter", "value"])


def test_a_current_is_removed(towtank, trials, tmp_path):
    words = ["--set", "kvlcc2", "--manoeuvre", "turning 35"]
    towtank("validate", trials / "turn.csv", *words, "--out", tmp_path / "still", "--quiet")
    towtank("validate", trials / "turn_in_current.csv", *words, "--out", tmp_path / "drifting")
    ended = towtank(
        "validate", trials / "turn_in_current.csv", *words, "--remove-current", "--out", tmp_path / "c"
    )
    said = re.search(r"current removed: ([\d.]+) m/s", ended.out)
    assert said is not None
    assert float(said[1]) == pytest.approx(np.hypot(*CURRENT), abs=0.004)
    still, drifting, removed = (
        float(rows(tmp_path / name / "validation.csv", "index")["tactical diameter"]["measured"])
        for name in ("still", "drifting", "c")
    )
    assert abs(drifting - still) > 0.05
    assert removed == pytest.approx(still, abs=0.02)


def test_the_rudder_of_the_trial_is_sailed_again(towtank, trials):
    ended = towtank("validate", trials / "zigzag.csv", "--set", "kvlcc2", "--schedule")
    assert ended.status == 0, ended.err
    assert "psi" in ended.out
    assert "overshoot" not in ended.out
    named = towtank("validate", trials / "zigzag.csv", "--set", "kvlcc2", "--schedule", "-m", "zigzag 10/10")
    assert "overshoot 1" in named.out


BAD = {
    "missing trial": (["nowhere.csv", "-m", "turning 35"], ("nowhere.csv", "not found")),
    "unknown ship": (["TURN", "-s", "kvlcc3", "-m", "turning 35"], ("'kvlcc3'", "did you mean")),
    "what was sailed": (["TURN"], ("what was sailed is not known", "name the manoeuvre")),
    "unknown manoeuvre": (["TURN", "-m", "turrning 35"], ("names no known manoeuvre", "did you mean turning")),
    "rudder of nothing": (["TURN", "--rudder", "35"], ("--rudder without --manoeuvre", "--manoeuvre turning")),
    "another side": (["TURN", "-m", "turning -35"], ("goes to starboard first", "to port")),
    "no covariance": (["TURN", "-m", "turning 35", "--draws", "9"], ("no covariance", "--percent 5")),
    "no steady turn": (["ZIGZAG", "-m", "zigzag 10/10", "--remove-current"], ("steady", "->")),
    "outside the record": (["TURN", "-m", "turning 35", "--execute", "9999"], ("outside the record", "inside")),
    "negative speed": (["TURN", "-m", "turning 35", "--speed", "-2"], ("not positive", "--speed")),
}


@pytest.mark.parametrize("bad", BAD)
def test_a_bad_input_is_one_line_and_writes_nothing(bad, towtank, trials, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words, parts = BAD[bad]
    places = {"TURN": trials / "turn.csv", "ZIGZAG": trials / "zigzag.csv"}
    given = [places.get(word, word) for word in words]
    ship = [] if "-s" in given else ["--set", "kvlcc2"]
    ended = towtank("validate", *given, *ship, "--out", "out")
    assert ended.status == 2, ended.err
    assert ended.out == ""
    assert ended.err.count("\n") == 1
    for part in parts:
        assert part in ended.err, ended.err
    assert list(tmp_path.iterdir()) == []
