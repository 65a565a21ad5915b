"""Tables of the report about runs."""

from __future__ import annotations

from dataclasses import replace

import pytest

from towtank.core.findings import Finding
from towtank.pmm import CampaignResult
from towtank.report import run_tables
from towtank.report.run_tables import diagnostics_table, harmonics_table, remarks, runs_table


def test_runs_show_what_varies(pmm_result: CampaignResult, depths_result: CampaignResult) -> None:
    table = runs_table(pmm_result)
    titles = [column.title for column in table.columns]
    assert "β [deg]" in titles
    assert "y amplitude [m]" in titles
    assert "δ [deg]" not in titles
    assert "h/T" not in titles
    assert len(table.rows) == len(pmm_result.runs)
    assert [row[1] for row in table.rows] == [run.name for run in pmm_result.runs]
    assert "h/T" in [column.title for column in runs_table(depths_result).columns]


def test_runs_with_findings_are_marked(drift_result: CampaignResult) -> None:
    finding = Finding("density", "warning", "1000 is fresh water")
    runs = (replace(drift_result.runs[0], findings=(finding,)), *drift_result.runs[1:])
    table = runs_table(replace(drift_result, runs=runs))
    assert table.marks[0] == "weak"
    assert table.rows[0][-2:] == ("with warnings", "density")


def test_harmonics_beside_their_fit(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    table = harmonics_table(fit)
    oscillating = [run for run in fit.runs if run.order]
    assert len(table.rows) == len(oscillating) * 3 * 4
    rows = {(row[0], row[1], row[2]): row for row in table.rows}
    _, _, _, measured, sd, fitted, *_ = rows["sway 0.5", "Y", "1"]
    a, b = (float(text.replace("−", "-").strip("\u2007\u2008")) for text in (measured, fitted))
    assert a == pytest.approx(b, rel=0.02)
    assert float(sd.strip("\u2007\u2008")) > 0
    assert rows["sway 0.5", "Y", "0"][6] == "–"


def test_long_tables_are_cut_and_say_so(pmm_result: CampaignResult, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(run_tables, "MOST_ROWS", 10)
    table = runs_table(pmm_result)
    assert len(table.rows) == 10
    assert "of 18 runs; all are in runs.csv" in table.caption
    harmonics = harmonics_table(pmm_result.fits[0])
    assert len(harmonics.rows) <= 10
    assert "harmonics.csv" in harmonics.caption


def test_diagnostics_and_remarks(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    table = diagnostics_table(fit)
    assert [column.title for column in table.columns] == ["diagnostic", "X", "Y", "N"]
    rows = {row[0]: row[1:] for row in table.rows}
    assert float(rows["R²"][1].strip("\u2007\u2008")) > 0.999
    said = [sentence for _, _, sentence in remarks(fit)]
    assert any(sentence.startswith("highest leverage: ") for sentence in said)
    assert any("gain of Y" in sentence for sentence in said)


def test_inseparable_terms_and_outlying_runs_need_attention(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    facts = dict(fit.derivatives.diagnostics)
    facts["Y"] = {**facts["Y"], "inseparable": [["Yv", "Yvvv"]], "outlying runs": ["drift +4"]}
    spoiled = replace(fit, derivatives=replace(fit.derivatives, diagnostics=facts))
    weak = [(subject, sentence) for mark, subject, sentence in remarks(spoiled) if mark == "weak"]
    assert weak == [("Y", "the runs cannot tell Yv, Yvvv apart"), ("Y", "outlying runs: drift +4")]
