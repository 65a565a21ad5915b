"""Drafts of campaign files: what a folder of run files tells, and a campaign that runs once it is completed."""

from __future__ import annotations

import math
import tomllib

import numpy as np
import pandas as pd
import pytest

from towtank.core.errors import CampaignError
from towtank.formats.write import write_table
from towtank.pmm.campaign import Campaign
from towtank.pmm.campaign_draft import draft_campaign
from towtank.pmm.campaign_file import load_campaign_file
from towtank.pmm.run_types import Run
from towtank.pmm.virtual_campaign import synthesize

ANGLES = (-8.0, -4.0, 0.0, 4.0, 8.0)


@pytest.fixture
def runs(tmp_path):
    """A folder of two run files with the columns of a usual recorder."""
    folder = tmp_path / 'tank "A" runs'
    folder.mkdir()
    columns = {
        "Time": "s",
        "Fx": "N",
        "Fy": "N",
        "Mz": "Nm",
        "yaw angle": "deg",
        "Carriage Speed": "m/s",
        "spare": "",
    }
    for number in (2, 10):
        write_table(folder / f"run, {number}.txt", {name: np.arange(20.0) for name in columns}, columns)
    return folder


def test_draft_maps_usual_names_and_lists_every_file(runs):
    said = draft_campaign(runs, runs / "campaign.toml")
    data = tomllib.loads((runs / "campaign.toml").read_text(encoding="utf-8"))
    assert data["channels"] == {
        "time": {"column": "Time", "unit": "s"},
        "X": {"column": "Fx", "unit": "N"},
        "Y": {"column": "Fy", "unit": "N"},
        "N": {"column": "Mz", "unit": "Nm"},
        "psi": {"column": "yaw angle", "unit": "deg"},
        "speed": {"column": "Carriage Speed", "unit": "m/s"},
    }
    assert data["campaign"]["name"] == 'tank "A" runs'
    assert math.isnan(data["ship"]["L"])
    matrix = pd.read_csv(runs / "matrix.csv", comment="#")
    assert set(matrix["file"]) == {"run, 2.txt", "run, 10.txt"}
    assert {"type", "speed", "drift_angle", "frequency_hz", "sway_amplitude"} <= set(matrix.columns)
    assert "2 files" in said
    assert "spare" in (runs / "campaign.toml").read_text()
    assert "next: complete [ship]" in said


def test_a_force_is_told_from_a_coordinate_by_its_case(tmp_path):
    columns = {name: np.arange(9.0) for name in ("t", "X", "Y", "N", "x", "y", "psi", "u", "v", "r")}
    write_table(tmp_path / "run.csv", columns, delimiter=",")
    draft_campaign(tmp_path, tmp_path / "campaign.toml")
    channels = tomllib.loads((tmp_path / "campaign.toml").read_text())["channels"]
    assert {name: one["column"] for name, one in channels.items()} == {
        "time": "t", **{name: name for name in ("X", "Y", "N", "x", "y", "psi", "u", "v", "r")}
    }  # fmt: skip
    assert {one["unit"] for one in channels.values()} == {"SI"}
    assert "the file names no unit: check" in (tmp_path / "campaign.toml").read_text()


@pytest.mark.parametrize("fmt", ["text", "csv", "simman"])
def test_a_completed_draft_runs(tmp_path, hull, fmt):
    tests = [Run(f"drift {b:g}", "static_drift", 1.4, drift_angle=math.radians(b)) for b in ANGLES]
    made = synthesize(hull, tests, tmp_path / "made", name="made", fmt=fmt).parent
    target = tmp_path / "campaign.toml"
    draft_campaign(made / "runs", target)
    with pytest.raises(CampaignError, match="L = nan is not positive"):
        load_campaign_file(target)
    text = target.read_text()
    for key in "LBT":
        text = text.replace(f"{key} = nan", f"{key} = {getattr(hull.ship, key)}")
    target.write_text(text)
    with pytest.raises(CampaignError, match=r"matrix\.csv, row 2, run '.*': the run has no type"):
        Campaign.load(target).run()
    matrix = pd.read_csv(tmp_path / "matrix.csv", comment="#").sort_values("file")
    assert matrix["file"].str.startswith("made/runs/").all()
    matrix = matrix.assign(type="static_drift", speed=1.4, drift_angle=ANGLES)
    matrix.to_csv(tmp_path / "matrix.csv", index=False)
    derivatives = Campaign.load(target).run(accept_rules=["scale-label"]).derivatives
    assert abs(derivatives["Yv"] - hull["Yv"]) < 1e-9


def test_existing_files_are_kept_unless_told(runs):
    target = runs / "campaign.toml"
    (runs / "matrix.csv").write_text("mine")
    with pytest.raises(
        CampaignError, match=r"matrix\.csv: the file exists -> choose another --out or add --force"
    ):
        draft_campaign(runs, target)
    assert not target.exists()
    draft_campaign(runs, target, replace=True)
    assert (runs / "matrix.csv").read_text() != "mine"


def test_files_that_cannot_be_read_are_named(runs):
    (runs / "a broken.csv").write_bytes(b"\x00\x01\x02" * 50)
    said = draft_campaign(runs, runs / "campaign.toml")
    assert "not readable: " in said
    assert "a broken.csv" in said


def test_folders_without_runs(tmp_path):
    with pytest.raises(CampaignError, match="this is not a folder"):
        draft_campaign(tmp_path / "none", tmp_path / "campaign.toml")
    with pytest.raises(CampaignError, match="no run file could be read"):
        draft_campaign(tmp_path, tmp_path / "campaign.toml")
    (tmp_path / "empty.txt").touch()
    with pytest.raises(CampaignError, match=r"no run file could be read \(.*empty\.txt: the file is empty"):
        draft_campaign(tmp_path, tmp_path / "campaign.toml")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty.txt"]
