"""Grid study of DTMB 5512: eight of nine columns, refinement ratios, differences."""

from collections import Counter

import pytest

from towtank.reproduce.dtmb5512_grids import grid_cases

CASES = list(grid_cases("dtmb5512"))


def test_eight_of_nine_columns_to_all_digits():
    table = [case for case in CASES if case.case == "Tables 2 and 3 to Table 4"]
    assert len(table) == 27
    wrong = [case.quantity for case in table if case.verdict != "reproduced"]
    assert wrong == ["R of sway X", "p of sway X", "GCI_fine of sway X"]
    values = {case.quantity: case.computed for case in table}
    assert values["R of sway X"] == pytest.approx(0.357, abs=1e-3)
    assert values["p of sway X"] == pytest.approx(3.06, abs=5e-3)


def test_the_ninth_column_is_a_misprint_of_two_changes():
    table = [case for case in CASES if case.case.startswith("Table 4, sway X")]
    assert [case.verdict for case in table] == ["reproduced"] * 3
    assert "0.00188" in next(case.note for case in CASES if case.quantity == "GCI_fine of sway X")


def test_what_the_real_ratios_do_to_the_result():
    table = {case.quantity: case for case in CASES if case.case.startswith("Table 2 with the ratios")}
    assert {case.verdict for case in table.values()} == {"reproduced"}
    assert [table[f"p of drift {force}"].computed for force in "XYN"] == pytest.approx(
        [4.24, 4.14, 4.10], abs=5e-3
    )
    assert "3.56 with 1.4" in table["GCI, % of the fine grid of drift Y"].note
    assert "0.03147 with 1.4" in table["extrapolated of drift Y"].note


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
