"""``towtank run``, ``audit`` and ``init``: what they write and print, option by option."""

from __future__ import annotations

import json
from pathlib import Path

import pandas as pd
import pytest

from towtank.core.derivative_set import DerivativeSet

FILES = {
    "derivatives.csv",
    "derivatives.json",
    "harmonics.csv",
    "runs.csv",
    "findings.csv",
    "three-ways.csv",
    "provenance.json",
    "report.html",
}


def spoil(campaign: Path, old: str, new: str) -> None:
    text = campaign.read_text()
    assert old in text
    campaign.write_text(text.replace(old, new))


def test_run_writes_every_table(towtank, campaign, tmp_path):
    out = tmp_path / "results"
    ended = towtank("run", campaign, "--out", out)
    assert (ended.status, ended.err) == (0, "")
    assert {path.name for path in out.iterdir()} == FILES
    table = pd.read_csv(out / "derivatives.csv")
    assert list(table) == ["name", "value", "std", "lower95", "upper95", "scaling"]
    assert (table["lower95"] < table["value"]).all()
    assert (table["value"] < table["upper95"]).all()
    assert set(table["scaling"]) == {"LT"}
    derivatives = DerivativeSet.from_json(out / "derivatives.json")
    assert derivatives.values.tolist() == table["value"].tolist()
    assert DerivativeSet.from_json(derivatives.to_json()).to_json() == derivatives.to_json()
    runs = pd.read_csv(out / "runs.csv")
    assert len(runs) == 10
    assert {"run", "type", "window", "quality", "findings"} <= set(runs)
    harmonics = pd.read_csv(out / "harmonics.csv")
    assert len(harmonics) == 3 * (7 + 3 * 4)
    provenance = json.loads((out / "provenance.json").read_text())
    inputs = provenance["groups"][0]["provenance"]["inputs"]
    assert {"campaign.toml", "matrix.csv", "runs/zero.txt", "runs/01_drift_-12_deg.txt"} <= set(inputs)
    assert set(provenance["files"]) == FILES
    assert "ten runs" in (out / "report.html").read_text(encoding="utf-8")
    assert f"10 runs -> {out}/" in ended.out


def test_a_second_run_replaces_the_first_and_leaves_other_files(towtank, campaign, tmp_path):
    out = tmp_path / "results"
    towtank("run", campaign, "--out", out)
    (out / "my notes.txt").write_text("mine")
    spoil(campaign, '"Yvvv", ', "")
    assert towtank("run", campaign, "--out", out, "--no-report").status == 0
    assert "Yvvv" not in pd.read_csv(out / "derivatives.csv")["name"].tolist()
    # The report of the first run would belie the new tables; what towtank did not write stays.
    left = {path.name for path in out.iterdir()}
    assert left == FILES - {"report.html", "three-ways.csv"} | {"my notes.txt"}
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]


def test_quiet_prints_nothing(towtank, campaign, tmp_path):
    ended = towtank("run", campaign, "-o", tmp_path / "results", "--quiet", "--no-report")
    assert ended == (0, "", "")
    assert (tmp_path / "results" / "derivatives.csv").is_file()


def test_the_campaign_file_may_leave_the_report_out(towtank, campaign, tmp_path):
    campaign.write_text(campaign.read_text() + "\n[output]\nreport = false\n")
    assert towtank("run", campaign, "--out", tmp_path / "results").status == 0
    assert not (tmp_path / "results" / "report.html").exists()


def test_numbers_do_not_depend_on_the_workers(towtank, campaign, tmp_path):
    for workers in (1, 3):
        towtank("run", campaign, "--out", tmp_path / str(workers), "--workers", workers, "--no-report")
    one, three = ((tmp_path / name / "derivatives.csv").read_text() for name in "13")
    assert one == three
    ended = towtank("run", campaign, "--workers", 0)
    assert ended.status == 2
    assert "--workers" in ended.err


def test_accepted_findings_are_printed_and_recorded(towtank, campaign, tmp_path):
    spoil(campaign, "mass = 86.0", "mass = 86.0\nvolume = 0.0839")
    warned = towtank("run", campaign, "--out", tmp_path / "a", "--no-report")
    assert "warning [density] mass over volume is 1025" in warned.out
    waived = towtank("run", campaign, "--out", tmp_path / "b", "--no-report", "--accept", "density")
    assert "warning (accepted) [density]" in waived.out
    findings = pd.read_csv(tmp_path / "b" / "findings.csv")
    assert findings[["rule", "accepted"]].values.tolist() == [["density", True]]
    choices = json.loads((tmp_path / "b" / "provenance.json").read_text())["groups"][0]["provenance"]["choices"]
    assert choices["accepted rules"] == ["density"]


def test_an_accepted_error_lets_the_campaign_run(towtank, campaign, tmp_path):
    spoil(campaign, 'column = "speed", unit = "m/s"', 'column = "speed", unit = "m/s", gain = 1.1')
    stopped = towtank("run", campaign, "--out", tmp_path / "results", "--no-report")
    assert stopped.status == 0
    assert "warning [speed-mismatch]" in stopped.out
    assert "and 9 more" in stopped.out
    spoil(campaign, "gain = 1.1", "gain = 1.5")
    assert towtank("run", campaign, "--out", tmp_path / "results").status == 2
    assert towtank("run", campaign, "--out", tmp_path / "results", "--accept", "speed-mismatch").status == 0


# -- audit ---------------------------------------------------------------------------------------------------


def test_audit_of_a_clean_campaign(towtank, campaign):
    assert towtank("audit", campaign) == (0, f"{campaign}: no finding\n", "")


def test_audit_prints_all_findings_and_fails_for_errors(towtank, campaign):
    spoil(campaign, 'column = "psi", unit = "deg"', 'column = "psi", unit = "rad"')
    spoil(campaign, 'column = "Y", unit = "N"', 'column = "Y", unit = "N", sign = -1')
    ended = towtank("audit", campaign)
    assert ended.status == 2
    lines = ended.out.splitlines()
    assert len([line for line in lines if line.startswith("error [angle-in-degrees]")]) > 5
    assert all(" -> " in line and str(campaign.parent) in line for line in lines)
    waived = towtank("audit", campaign, "--accept", "angle-in-degrees")
    # The runs whose angles are accepted are reduced, and what only shows across runs is seen.
    assert "error (accepted) [angle-in-degrees]" in waived.out
    assert "error [force-sign]" in waived.out
    assert waived.status == 2
    both = towtank("audit", campaign, "--accept", "angle-in-degrees", "--accept", "force-sign")
    assert both.status == 0


def test_audit_without_a_campaign_lists_the_rules(towtank):
    ended = towtank("audit")
    assert ended == towtank("audit", "--list")
    assert ended.status == 0
    assert len(ended.out.splitlines()) > 40


def test_audit_writes_nothing(towtank, campaign):
    before = sorted(path.name for path in campaign.parent.rglob("*"))
    towtank("audit", campaign)
    assert sorted(path.name for path in campaign.parent.rglob("*")) == before


# -- init ----------------------------------------------------------------------------------------------------


def test_init_drafts_a_campaign_beside_the_runs(towtank, campaign):
    runs = campaign.parent / "runs"
    ended = towtank("init", runs)
    assert ended.status == 0
    assert f"written: {runs / 'campaign.toml'} and {runs / 'matrix.csv'}" in ended.out
    assert (runs / "campaign.toml").is_file()
    again = towtank("init", runs)
    assert (again.status, again.out) == (2, "")
    assert "campaign.toml: the file exists -> choose another --out or add --force" in again.err
    assert towtank("init", runs, "--force").status == 0


def test_init_elsewhere(towtank, campaign, tmp_path):
    ended = towtank("init", campaign.parent / "runs", "--out", tmp_path / "draft.toml")
    assert ended.status == 0
    files = pd.read_csv(tmp_path / "matrix.csv", comment="#")["file"]
    assert files[0] == "campaign/runs/01_drift_-12_deg.txt"
    lost = towtank("init", campaign.parent / "runs", "--out", tmp_path / "none" / "draft.toml")
    assert lost.status == 2
    assert "the folder to write to does not exist" in lost.err


# -- several sets --------------------------------------------------------------------------------------------


@pytest.fixture
def two_speeds(towtank, campaign, tmp_path) -> Path:
    """Results of a campaign whose runs fall into two groups."""
    matrix = campaign.parent / "matrix.csv"
    frame = pd.read_csv(matrix)
    steady = frame[frame["type"] == "static_drift"]
    slow = steady.assign(name="slow " + steady["name"], speed=1.2)
    pd.concat([steady, slow]).to_csv(matrix, index=False)
    content = campaign.read_text()
    fit = content[content.index("[fit]") : content.index("[[runs]]")]
    wanted = '[fit]\nmodel = "mmg-drift"\ngroup_by = ["speed"]\n\n'
    # The slow runs are the fast ones under another speed: good enough for two sets.
    content = content.replace(fit, wanted).replace('speed = { column = "speed", unit = "m/s" }\n', "")
    campaign.write_text(content)
    out = tmp_path / "results"
    ended = towtank("run", campaign, "--out", out, "--accept", "speed-mismatch", "--accept", "amplitude-mismatch")
    assert ended.status == 0, ended.err
    return out


def test_groups_have_files_of_their_own(two_speeds, towtank):
    table = pd.read_csv(two_speeds / "derivatives.csv")
    assert list(table) == ["name", "value", "std", "lower95", "upper95", "scaling", "group"]
    assert set(table["group"]) == {"Fn 0.219", "Fn 0.274"}
    names = {path.name for path in two_speeds.glob("derivatives-*.json")}
    assert names == {"derivatives-fn-0.219.json", "derivatives-fn-0.274.json"}
    assert towtank("show", two_speeds / "derivatives-fn-0.219.json").status == 0
    ended = towtank("show", two_speeds)
    assert ended.status == 2
    assert "the file holds 2 derivative sets: Fn 0.219, Fn 0.274 -> give the file of one group" in ended.err
