"""DTMB 5512: errors, forward check, chain rule, sinusoid formulas."""

import pytest

from towtank.reproduce.paper_dtmb5512 import KEY


def by_quantity(shown, start):
    return {item.quantity: item for item in shown[KEY] if item.case.startswith(start)}


def test_all_fifteen_errors_of_oblique_towing(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Tables 12 and 14")]
    assert len(cases) == 15
    assert {(case.verdict, case.tolerance) for case in cases} == {("reproduced", 0.005)}


def test_yaw_moment_of_the_grid_study_does_not_belong_to_the_derivatives(find):
    moment, force = find(KEY, "N' from the fit"), find(KEY, "Y' from the fit")
    assert moment.verdict == "not-reproducible"
    assert moment.computed / moment.printed == pytest.approx(1.29, abs=0.005)
    assert force.verdict == "reproduced"
    assert force.computed == pytest.approx(0.02994, abs=5e-6)


def test_chain_rule_needs_the_factors_of_the_series(find):
    cubic, square = find(KEY, "Yvvv from derivatives"), find(KEY, "Xvv from derivatives")
    # d3Y/dbeta3 = Yv - 6 Yvvv at zero drift
    assert f"{6 * -1.7584 + 0.2672:.3f}" in cubic.note
    assert {cubic.verdict, square.verdict} == {"reproduced-after-correction"}


def test_sinusoid_formulas_bias_pure_yaw(shown):
    formulas = by_quantity(shown, "Table 17, sinusoid formulas")
    assert formulas["Yr by equation 30"].printed == -0.0482
    assert formulas["Yr by equation 30"].computed == pytest.approx(-0.0199, abs=5e-5)
    assert formulas["Yrrr by equation 30"].computed == pytest.approx(-0.458, abs=5e-4)
    assert formulas["Yrdot by equation 30"].computed == pytest.approx(-0.00991, abs=5e-6)


def test_exact_kinematics_recover_pure_yaw(shown):
    exact = by_quantity(shown, "Table 17, exact kinematics")
    assert len(exact) == 4
    assert all(case.computed == pytest.approx(case.printed, abs=1e-12) for case in exact.values())


@pytest.mark.parametrize("source", ["CFD", "EFD"])
def test_fourier_relations_recover_pure_sway(shown, source):
    loop = by_quantity(shown, f"Table 16 {source}, closed loop")
    assert all(case.computed == pytest.approx(case.printed, abs=1e-12) for case in loop.values())


def test_mass_stands_in_for_the_added_mass(find):
    case = find(KEY, "Yvdot (CFD) against -m'")
    assert case.computed == pytest.approx(-0.13613, abs=5e-6)
    assert "suspicious" in case.note
