"""Tables of the report about findings, choices and files."""

from __future__ import annotations

from towtank.core.findings import Finding
from towtank.pmm import CampaignResult
from towtank.report.provenance_tables import choices_tables, findings_table, inputs_table, setting_text


def test_findings_of_one_rule_stand_together_worst_first() -> None:
    findings = [
        Finding("gaps", "warning", "2 gaps", file="a.txt", cure="look"),
        *(Finding("density", "error", "1000", file=f"{n}.txt", cure="mend", accepted=True) for n in range(5)),
        Finding("note", "info", "seen"),
    ]
    table = findings_table(findings)
    assert [row[0] for row in table.rows] == ["error, accepted", "warning", "info"]
    assert table.rows[0][3] == "0.txt; 1.txt; 2.txt and 2 more"
    assert table.marks == ("weak", "weak", "")
    assert findings_table([Finding("x", "error", "m")]).marks == ("bad",)


def test_choices_are_split_into_set_and_default(pmm_result: CampaignResult) -> None:
    chosen, default = choices_tables(pmm_result.settings)
    set_rows, default_rows = dict(chosen.rows), dict(default.rows)
    assert set_rows["fit.model"] == "mmg"
    assert set_rows["channels.X"] == "column = X, unit = N"
    assert set_rows["fit.shared_bias.gain.Y"] == "0.01"
    assert default_rows["reduction.fraction"] == "0.3, 0.95"
    assert default_rows["inertia.inside"] == "no"
    assert default_rows["conventions.force_sign"] == "on-ship"
    assert not set(set_rows) & set(default_rows)


def test_conventions_that_are_set_are_among_the_set(drift_result: CampaignResult) -> None:
    chosen, default = choices_tables(drift_result.settings)
    assert dict(chosen.rows)["conventions.angle_unit"] == "deg"
    assert "conventions.angle_unit" not in dict(default.rows)


def test_settings_in_words() -> None:
    assert setting_text(True) == "yes"
    assert setting_text(None) == "–"
    assert setting_text({"Y": (None, 0.5)}) == "Y = –, 0.5"


def test_inputs() -> None:
    assert inputs_table({"a.txt": "ab", "kvlcc2": ""}).rows == (("a.txt", "ab"), ("kvlcc2", "not a file"))
