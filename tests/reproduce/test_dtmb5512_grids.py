"""Grid study of DTMB 5512: eight of nine columns, refinement ratios, differences."""

from collections import Counter

import pytest

from towtank.reproduce.dtmb5512_grids import grid_cases

CASES = list(grid_cases("dtmb5512"))


def test_eight_of_nine_columns_to_all_digits():
    table = [case for case in CASES if case.case.endswith("Table 4")]
    assert len(table) == 27
    wrong = [case.quantity for case in table if case.verdict != "reproduced"]
    assert wrong == ["R of sway X", "p of sway X", "GCI_fine of sway X"]
    values = {case.quantity: case.computed for case in table}
    assert values["R of sway X"] == pytest.approx(0.357, abs=1e-3)
    assert values["p of sway X"] == pytest.approx(3.06, abs=5e-3)


def test_real_refinement_ratios():
    ratios = [case for case in CASES if case.case == "Table 2, refinement ratio"]
    assert [case.computed for case in ratios] == pytest.approx([1.230, 1.334], abs=5e-4)
    assert {case.verdict for case in ratios} == {"not-reproducible"}


def test_differences_of_the_drift_row_do_not_follow():
    table = [case for case in CASES if case.case.endswith("Table 5")]
    drift = [case for case in table if "drift" in case.quantity]
    assert [case.computed for case in drift] == pytest.approx([1.30, 2.79, 8.00], abs=5e-3)
    assert {case.verdict for case in drift} == {"not-reproducible"}
    assert Counter(case.verdict for case in table)["reproduced"] == 5
