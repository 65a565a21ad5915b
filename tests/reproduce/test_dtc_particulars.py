"""Grids, friction line and rudder of the Duisburg Test Case."""

import pytest

from towtank.reproduce.dtc_particulars import particular_cases

CASES = {(case.case, case.quantity): case for case in particular_cases("dtc-pmm")}


def test_grid_uncertainty_comes_from_the_printed_bounds():
    assert CASES["Table 3 to Table 4", "eps32"].computed == pytest.approx(-0.03145)
    assert CASES["Table 3 to Table 4", "p_G"].computed == pytest.approx(6.521, abs=1e-3)
    assert CASES["Table 3 to Table 4", "U_G"].computed == pytest.approx(0.0652, abs=1e-4)


def test_uncertainty_of_the_fine_grid_is_an_eighth_of_the_printed_one():
    case = CASES["Table 3, fine grid (independent computation)", "U_G of the fine grid, % of its force"]
    assert case.verdict == "reproduced"
    assert case.computed * 0.5645 / 100 == pytest.approx(0.0081, abs=2e-4)


def test_friction_line_gives_table_8_to_the_digit():
    rows = [case for (where, _), case in CASES.items() if where.startswith("Table 8")]
    assert len(rows) == 8
    assert {case.verdict for case in rows} == {"reproduced"}


def test_share_of_the_error_is_of_the_data():
    assert CASES["text, validation", "|E| in % of D"].verdict == "reproduced-after-correction"


def test_rudder_area_does_not_follow_from_span_and_aspect_ratio():
    case = CASES["Table 13, rudder", "A_R / (L T)"]
    assert case.verdict == "not-reproducible"
    assert case.computed == pytest.approx(0.0183, abs=5e-5)


def test_cut_off_digit_is_a_correction():
    case = CASES["Table 13, rudder", "gammaR"]
    assert (case.printed, case.expected, case.verdict) == (0.33, 0.34, "reproduced-after-correction")
