"""The folder of results: what is in it, that it is complete or not there, and that old results give way."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.core.errors import ReadError, TowtankError
from towtank.pmm import CampaignResult
from towtank.report import read_set, write_results
from towtank.report.outputs import group_names

COLUMNS = ["name", "value", "std", "lower95", "upper95", "scaling"]


def test_every_file_of_a_campaign_is_there(pmm_result: CampaignResult, tmp_path: Path) -> None:
    written = write_results(pmm_result, tmp_path / "deep" / "results", report=False)
    names = [path.name for path in written]
    assert names == [
        "derivatives.csv",
        "derivatives.json",
        "harmonics.csv",
        "runs.csv",
        "findings.csv",
        "three-ways.csv",
        "candidates.csv",
        "range.csv",
        "provenance.json",
    ]
    assert sorted(path.name for path in (tmp_path / "deep" / "results").iterdir()) == sorted(names)
    assert [path.name for path in (tmp_path / "deep").iterdir()] == ["results"]


def test_derivatives_csv_holds_every_digit(pmm_result: CampaignResult, tmp_path: Path) -> None:
    write_results(pmm_result, tmp_path, report=False)
    frame = pd.read_csv(tmp_path / "derivatives.csv")
    assert list(frame.columns) == COLUMNS
    derivatives = pmm_result.derivatives
    assert frame["name"].tolist() == list(derivatives.names)
    np.testing.assert_array_equal(frame["value"], derivatives.values)
    np.testing.assert_array_equal(frame["std"], derivatives.bse)
    assert set(frame["scaling"]) == {"LT"}


def test_derivatives_json_is_the_set(pmm_result: CampaignResult, tmp_path: Path) -> None:
    write_results(pmm_result, tmp_path, report=False)
    again = DerivativeSet.from_json(tmp_path / "derivatives.json")
    assert again.to_dict() == pmm_result.derivatives.to_dict()


def test_several_groups_get_a_column_and_files_of_their_own(depths_result: CampaignResult, tmp_path: Path) -> None:
    names = [path.name for path in write_results(depths_result, tmp_path, report=False)]
    assert names[1:4] == ["derivatives.json", "derivatives-ht-1.5.json", "derivatives-ht-2.json"]
    frame = pd.read_csv(tmp_path / "derivatives.csv")
    assert list(frame.columns) == [*COLUMNS, "group"]
    assert frame["group"].unique().tolist() == ["h/T 1.5", "h/T 2"]
    together = json.loads((tmp_path / "derivatives.json").read_text(encoding="utf-8"))
    assert together["format"] == "towtank derivative sets 1"
    assert list(together["sets"]) == ["h/T 1.5", "h/T 2"]
    one = DerivativeSet.from_json(tmp_path / "derivatives-ht-1.5.json")
    assert one.to_dict() == together["sets"]["h/T 1.5"]
    assert set(pd.read_csv(tmp_path / "three-ways.csv")["group"]) == {"h/T 1.5", "h/T 2"}
    with pytest.raises(ReadError, match=r"h/T 1\.5"):
        read_set(tmp_path / "derivatives.json")


def test_provenance_names_files_choices_and_versions(pmm_result: CampaignResult, tmp_path: Path) -> None:
    write_results(pmm_result, tmp_path, report=False)
    data = json.loads((tmp_path / "provenance.json").read_text(encoding="utf-8"))
    assert data["campaign"]["virtual"] is True
    assert "towtank" in data["versions"]
    history = data["groups"][0]["provenance"]
    assert len(history["inputs"]["campaign.toml"]) == 64
    assert history["choices"]["fit"]["candidates"] == ["modulus"]


def test_a_failure_leaves_the_old_result(
    drift_result: CampaignResult, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "results"
    write_results(drift_result, out, report=False)
    before = {path.name: path.read_bytes() for path in out.iterdir()}

    def fail(self: CampaignResult) -> pd.DataFrame:
        raise KeyboardInterrupt

    monkeypatch.setattr(CampaignResult, "findings_frame", fail)
    with pytest.raises(KeyboardInterrupt):
        write_results(drift_result, out, report=False)
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before
    with pytest.raises(KeyboardInterrupt):
        write_results(drift_result, tmp_path / "new", report=False)
    assert [path.name for path in tmp_path.iterdir()] == ["results"]


def test_files_that_the_new_result_lacks_go_and_those_of_others_stay(
    depths_result: CampaignResult, drift_result: CampaignResult, tmp_path: Path
) -> None:
    write_results(depths_result, tmp_path, report=False)
    (tmp_path / "derivatives-mine.json").write_text("{}", encoding="utf-8")
    write_results(drift_result, tmp_path, report=False)
    names = {path.name for path in tmp_path.iterdir()}
    assert "derivatives-ht-1.5.json" not in names
    assert {"derivatives-mine.json", "derivatives.json"} <= names


def test_a_file_in_the_way_is_refused(drift_result: CampaignResult, tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("mine", encoding="utf-8")
    with pytest.raises(TowtankError, match="this is a file"):
        write_results(drift_result, tmp_path / "taken")
    with pytest.raises(TowtankError, match="cannot be written to"):
        write_results(drift_result, tmp_path / "taken" / "below")
    assert (tmp_path / "taken").read_text(encoding="utf-8") == "mine"


def test_the_report_follows_the_campaign_file_and_progress_is_told(
    drift_result: CampaignResult, tmp_path: Path
) -> None:
    seen: list[tuple[str, int, int]] = []

    def progress(*step: Any) -> None:
        seen.append(step)

    names = [path.name for path in write_results(drift_result, tmp_path, progress=progress)]
    assert "report.html" in names
    files = seen[0][2]
    assert seen[0] == ("writing", 0, files)
    assert seen[-1] == ("writing", files, files)


def test_group_names_stay_apart() -> None:
    assert group_names(["h/T 1.2, Fn 0.1", "deep water", "???", "!!!"]) == {
        "h/T 1.2, Fn 0.1": "ht-1.2-fn-0.1",
        "deep water": "deep-water",
        "???": "all",
        "!!!": "all-4",
    }
