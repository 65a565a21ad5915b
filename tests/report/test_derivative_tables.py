"""Tables of the report about derivatives."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from towtank.core.derivative_set import DerivativeSet
from towtank.pmm import CampaignResult
from towtank.pmm.campaign_file import SharedBias
from towtank.report.derivative_tables import (
    candidates_table,
    conventions_table,
    derivative_table,
    range_table,
    three_ways_table,
    units_text,
    validity_table,
)
from towtank.report.typography import FIGURE_SPACE, MINUS, POINT_SPACE


def plain(cell: str) -> str:
    return cell.replace(FIGURE_SPACE, "").replace(POINT_SPACE, "").replace(MINUS, "-")


def test_derivatives_with_interval_and_share_of_bias(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    written = pmm_result.written(fit)
    table = derivative_table(fit, written, pmm_result.settings.fit.shared_bias)
    titles = [column.title for column in table.columns]
    assert titles[1:5] == ["value", "std", "of it shared", "lower 95 %"]
    assert len(table.rows) == len(written)
    row = table.rows[written.names.index("Yv")]
    assert float(plain(row[1])) == pytest.approx(written["Yv"], abs=1e-4)
    # a gain of 1 % that all runs share is 1 % of every derivative of Y
    assert float(plain(row[3])) == pytest.approx(0.01 * abs(written["Yv"]), rel=0.05)
    assert float(plain(row[3])) <= float(plain(row[2]))
    assert "½ ρ L T U²" in table.caption


def test_without_shared_bias_there_is_no_such_column(drift_result: CampaignResult) -> None:
    fit = drift_result.fits[0]
    table = derivative_table(fit, drift_result.written(fit), SharedBias())
    assert [column.title for column in table.columns] == [
        "derivative", "value", "std", "lower 95 %", "upper 95 %", "± 95 % [%]", "VIF",
    ]  # fmt: skip
    marks = dict(zip(drift_result.derivatives.names, table.marks, strict=True))
    assert marks["R0"] == ""
    assert marks["Yv"] == "weak"  # four points leave an interval that holds zero


def test_shares_follow_the_conventions_of_the_output(pmm_result: CampaignResult) -> None:
    fit = pmm_result.fits[0]
    bias = pmm_result.settings.fit.shared_bias
    prime = fit.derivatives.to("prime")
    table = derivative_table(fit, prime, bias)
    row = table.rows[prime.names.index("Yv")]
    assert float(plain(row[3])) == pytest.approx(0.01 * abs(prime["Yv"]), rel=0.1)


def test_conventions_and_validity_in_words(pmm_result: CampaignResult) -> None:
    written = pmm_result.derivatives
    rows = {row[0]: row[1:] for row in conventions_table(written).rows}
    assert rows["force scaling"][0].startswith("½ ρ L T U²")
    assert rows["added mass Coriolis"] == ("the derivatives hold them (Yr - mx′, Xvr + my′)", "inside")
    validity = {row[0]: row for row in validity_table(written).rows}
    assert {"Fn", "v′", "r′", "ṙ′"} <= set(validity)
    assert float(plain(validity["v′"][2])) == pytest.approx(math.sin(math.radians(16)), rel=0.1)


def test_angles_are_given_in_degrees(hull: DerivativeSet) -> None:
    rows = validity_table(replace(hull, validity={"beta": (-0.1, 0.2)})).rows
    assert rows[0][0] == "β"
    assert (plain(rows[0][1]), rows[0][3]) == ("-5.73", "deg")


def test_three_ways(pmm_result: CampaignResult) -> None:
    ways = pmm_result.comparison("three ways")
    assert ways is not None
    table = three_ways_table(ways, pmm_result.derivatives)
    assert len(table.rows) == len(pmm_result.derivatives)
    row = table.rows[pmm_result.derivatives.names.index("Yvdot")]
    assert row[5] == "3"
    assert "pure sway" in row[-1]


def test_candidates_and_ranges(pmm_result: CampaignResult) -> None:
    candidates, ranges = pmm_result.comparison("candidates"), pmm_result.comparison("range")
    assert candidates is not None
    assert ranges is not None
    table = candidates_table(candidates)
    assert {row[1] for row in table.rows} == {"as fitted", "modulus"}
    assert table.marks.count("first") == 3
    table = range_table(ranges, pmm_result.derivatives)
    assert [column.title for column in table.columns] == [
        "derivative",
        "all",
        "|v′| ≤ 0.25",
        "Δ/std",
        "|r′| ≤ 0.25",
        "Δ/std",
    ]
    assert "all: 18" in table.caption


def test_units_of_other_scalings(hull: DerivativeSet) -> None:
    assert units_text(hull.to("prime")).startswith("forces / (½ ρ L² U²)")
