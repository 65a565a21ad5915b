from __future__ import annotations

import math

import pytest

from towtank.cfd.case_sweep import find_cases
from towtank.core.errors import CampaignError


def folders(root, *names):
    for name in names:
        (root / name / "postProcessing" / "forces" / "0").mkdir(parents=True)
    return root


def test_parameters_from_names(tmp_path):
    folders(tmp_path, "beta_-4_grid2", "beta_8_r_0.3_U_1.25_gridfine", "drift_12_dt_0.01_mesh3")
    sweep = find_cases([tmp_path])
    found = {case.name: case for case in sweep.cases}
    first = found["beta_-4_grid2"]
    assert (first.drift_angle, first.yaw_rate, first.grid) == (-4.0, 0.0, "2")
    assert math.isnan(first.speed)
    second = found["beta_8_r_0.3_U_1.25_gridfine"]
    assert (second.drift_angle, second.yaw_rate, second.speed, second.grid) == (8.0, 0.3, 1.25, "fine")
    third = found["drift_12_dt_0.01_mesh3"]
    assert (third.drift_angle, third.time_step, third.grid) == (12.0, 0.01, "3")
    assert sweep.grids == ("2", "3", "fine")


def test_pattern_of_names(tmp_path):
    folders(tmp_path, "m04p5_coarse", "12p0_coarse")
    sweep = find_cases([tmp_path], pattern="{drift_angle}_{grid}")
    assert {(case.drift_angle, case.grid) for case in sweep.cases} == {(-4.5, "coarse"), (12.0, "coarse")}


def test_table_instead_of_names(tmp_path):
    folders(tmp_path, "a", "b")
    table = tmp_path / "matrix.csv"
    table.write_text("case,beta,U,grid,cells\na,4,1.2,1,8000000\nb,4,1.2,2,2828000\n")
    sweep = find_cases([tmp_path / "a", tmp_path / "b"], table=table)
    assert [(case.drift_angle, case.speed, case.grid, case.cells) for case in sweep.cases] == [
        (4.0, 1.2, "1", 8e6),
        (4.0, 1.2, "2", 2828000.0),
    ]
    assert list(sweep.to_frame()["cells"]) == [8e6, 2828000.0]


def test_cells_by_grid(tmp_path):
    folders(tmp_path, "beta_4_grid1", "beta_4_grid2")
    sweep = find_cases([tmp_path], cells={"1": 8e6, "2": 1e6})
    assert [case.cells for case in sweep.cases] == [8e6, 1e6]
    with pytest.raises(CampaignError, match="grid '3', which no case has"):
        find_cases([tmp_path], cells={"3": 1.0})


def test_missing_and_double_cases_are_findings(tmp_path):
    folders(tmp_path, "beta_4_grid1", "beta_4.0_grid1", "beta_4_grid2", "beta_8_grid2")
    findings = find_cases([tmp_path]).findings
    assert {(item.rule, item.severity) for item in findings} == {
        ("double-case", "error"),
        ("missing-case", "warning"),
    }
    missing = next(item for item in findings if item.rule == "missing-case")
    assert "beta 8 deg" in missing.message
    assert "grid '1'" in missing.message


def test_complete_sweep_has_no_findings(tmp_path):
    folders(tmp_path, "beta_4_grid1", "beta_4_grid2", "beta_8_grid1", "beta_8_grid2")
    assert find_cases([tmp_path]).findings == ()


def test_names_without_parameters_are_told(tmp_path):
    folders(tmp_path, "one", "two")
    assert [item.rule for item in find_cases([tmp_path]).findings] == ["case-name"]


def test_one_case_and_folders_of_monitors(tmp_path):
    folders(tmp_path, "beta_4")
    assert [case.name for case in find_cases([tmp_path / "beta_4"]).cases] == ["beta_4"]
    for name in ("beta_1", "beta_2"):
        (tmp_path / "star" / name).mkdir(parents=True)
        (tmp_path / "star" / name / "drag.csv").write_text("Time,Drag\n0,1\n")
    assert [case.drift_angle for case in find_cases([tmp_path / "star"]).cases] == [1.0, 2.0]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"pattern": "beta_{foo}"}, "unknown parameter 'foo'"),
        ({"pattern": "beta_4"}, "names no parameter"),
        ({"pattern": "{beta}_{drift}"}, "twice"),
        ({"pattern": "b{beta}_{grid}"}, "does not fit the pattern"),
    ],
)
def test_patterns_that_do_not_fit(tmp_path, options, message):
    folders(tmp_path, "beta_4_grid1")
    with pytest.raises(CampaignError, match=message):
        find_cases([tmp_path], **options)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("name,beta\na,4\n", "no column 'case'"),
        ("case,colour\na,4\n", "no parameter"),
        ("case,beta\na,4\na,5\n", "twice"),
        ("case,beta\nc,4\n", "no case 'c'"),
        ("case,beta\na,4\n", "'b' is not in the table"),
        ("case,beta\na,four\nb,2\n", "not a number"),
    ],
)
def test_tables_that_do_not_fit(tmp_path, text, message):
    folders(tmp_path / "cases", "a", "b")
    table = tmp_path / "matrix.csv"
    table.write_text(text)
    with pytest.raises(CampaignError, match=message):
        find_cases([tmp_path / "cases"], table=table)


def test_nothing_there(tmp_path):
    with pytest.raises(CampaignError, match="no such file"):
        find_cases([tmp_path / "nowhere"])
    with pytest.raises(CampaignError, match="no case in it"):
        find_cases([tmp_path])
