"""Duisburg Test Case: the numbers that the gallery must show."""

import pytest

from towtank.reproduce.paper_dtc_pmm import KEY


def column(shown, case):
    return {item.quantity: item for item in shown[KEY] if item.case == case}


def test_measured_drift_points_give_the_printed_derivatives_within_one_per_cent(shown):
    fit = column(shown, "Table 5 EFD to Table 7")
    assert list(fit) == ["R0", "Xvv", "Xvvvv", "Yv", "Yvvv", "Nv", "Nvvv"]
    for name, case in fit.items():
        assert case.tolerance <= (0.02 if name[0] in "XR" else 0.01) * abs(case.printed)
        assert case.computed == pytest.approx(case.printed, rel=0.02 if name[0] in "XR" else 0.01)


def test_computed_drift_points_of_both_scales(shown):
    large = column(shown, "Table 5 CFD to Table 7")
    present = column(shown, "Table 6 CFD to Table 7")
    assert large["Yvvv"].computed == pytest.approx(-1.2144, abs=1e-4)
    assert present["Xvv"].computed == pytest.approx(0.0399, abs=1e-4)
    assert present["Xvvvv"].computed == pytest.approx(0.269, abs=1e-3)
    assert present["Nvvv"].computed == pytest.approx(-0.124, abs=1e-3)


def test_weakly_determined_coefficients_say_so(shown):
    present = column(shown, "Table 6 CFD to Table 7")
    assert "rounding of the points" in present["Xvvvv"].note
    assert present["Yv"].note == ""


def test_pure_yaw_relations_are_four_thirds_and_two(find):
    assert find(KEY, "Yrrr, 4/3").computed == pytest.approx(-0.0805 * 4 / 3)
    assert find(KEY, "Nrrr, 4/3").computed == pytest.approx(-0.0408 * 4 / 3)
    assert find(KEY, "Xrr, twice").computed == pytest.approx(-0.0070)


def test_mass_in_the_sway_force_is_shown_as_an_error(find):
    case = find(KEY, "Yr, the linear")
    assert case.verdict == "not-reproducible"
    assert "hold no mass" in case.note
    assert find(KEY, "mx' that equation 7").computed == pytest.approx(0.0095, abs=5e-5)


@pytest.mark.parametrize("case", ["equation 9", "equations 1 and 8", "virtual programme"])
def test_closed_loops_return_what_went_in(find, case):
    assert find(KEY, "largest difference", case).computed < 1e-12


def test_programme_of_table_2_has_nine_yaw_runs(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Table 2")]
    assert len(cases) == 18
    assert {case.verdict for case in cases} == {"reproduced"}
