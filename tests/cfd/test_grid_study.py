from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from towtank.cfd.grid_study import GridStudy, grid_study, load_truth, relative_spacings, write_grid_campaign
from towtank.core.errors import CampaignError
from towtank.pmm import Campaign

MAIN = ["R0", "Xvr", "Xrr", "Yv", "Yr", "Yvrr", "Nv", "Nr", "Nvvr"]
"""Derivatives that the motions of the sweep show well."""


def test_the_known_truth_lies_inside(study: GridStudy):
    table = study.table()
    assert len(table) == 17
    assert table["truth inside"].all()
    # The interval is no barn door: it is a few times the error it must cover.
    error = (table["value"] - table["truth"]).abs()
    assert (table["U95"] / error).median() < 4.0


def test_the_known_order_is_found(study: GridStudy):
    table = study.table().set_index("name")
    np.testing.assert_allclose(table.loc[MAIN, "order"].astype(float), 2.0, atol=0.25)
    assert (table.loc[MAIN, "class"] == "monotone convergent").all()
    extrapolated = table.loc[MAIN, "extrapolated"].astype(float)
    fine = (table.loc[MAIN, "value"] - table.loc[MAIN, "truth"]).abs()
    assert ((extrapolated - table.loc[MAIN, "truth"]).abs() < 0.5 * fine).all()


def test_spacings_follow_from_the_cells(study: GridStudy):
    np.testing.assert_allclose(study.spacings, [1.0, 2**0.5, 2.0], rtol=1e-4)
    assert study.grids == ("1", "2", "3")
    assert not [item for item in study.findings if item.rule == "refinement-ratio"]
    assert all(item.verdict == "settled" for item in study.settled)


def test_combined_covariance_holds_both_parts(study: GridStudy):
    fit = np.diag(study.sets[0].covariance)
    both = np.diag(study.derivatives.covariance)
    numerical = study.uncertainty.table["u_num"].to_numpy(float)
    np.testing.assert_allclose(both, fit + numerical**2, rtol=1e-9)


def test_comparison_with_the_experiment(study: GridStudy):
    assert study.validation is not None
    assert len(study.validation) == 17
    assert (study.validation["verdict"] == "validated").sum() >= 14


def test_each_grid_is_a_campaign_that_runs_again(study: GridStudy):
    again = Campaign.load(study.campaigns[1]).run(compare=False).derivatives
    np.testing.assert_allclose(again.values, study.sets[1].values, rtol=1e-12)
    assert "virtual = true" in study.campaigns[1].read_text()


def test_wrong_assumed_ratio_is_told(study: GridStudy, tmp_path):
    other = grid_study(study.settled, study.derivatives.ship, tmp_path, assumed_ratio=1.25)
    assert [item.rule for item in other.findings if item.rule == "refinement-ratio"]
    assert other.validation is None
    assert "truth" not in other.table().columns


def test_a_motion_missing_on_a_grid_is_refused(study: GridStudy, tmp_path):
    lacking = [item for item in study.settled if item.case.name != "beta_16_r_0_U_0.76_grid2"]
    with pytest.raises(CampaignError, match=r"grid '2' has no case of beta 16 deg, r' 0"):
        grid_study(lacking, study.derivatives.ship, tmp_path)


def test_grids_without_cells_or_alone_are_refused(study: GridStudy):
    unknown = [replace(item, case=replace(item.case, cells=float("nan"))) for item in study.settled]
    with pytest.raises(CampaignError, match="number of cells of grid"):
        relative_spacings(unknown)
    assert relative_spacings(unknown, {"1": 0.5, "2": 0.75, "3": 1.0}) == {"1": 1.0, "2": 1.5, "3": 2.0}
    with pytest.raises(CampaignError, match="has no spacing"):
        relative_spacings(unknown, {"1": 0.5})
    with pytest.raises(CampaignError, match="1 grid"):
        relative_spacings([item for item in study.settled if item.case.grid == "1"])


def test_a_case_without_speed_cannot_be_scaled(study: GridStudy, tmp_path):
    nameless = [replace(study.settled[0], case=replace(study.settled[0].case, speed=float("nan")))]
    with pytest.raises(CampaignError, match="speed of case"):
        write_grid_campaign(nameless, study.derivatives.ship, tmp_path, name="no speed")


def test_a_real_sweep_has_no_truth(tmp_path):
    assert load_truth(tmp_path) is None
