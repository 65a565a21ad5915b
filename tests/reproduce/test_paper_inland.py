"""Inland ship: forward values, three stages, stability, drift sign."""

import pytest

from towtank.reproduce.paper_inland import KEY


def test_sixteen_conditions_of_forward_values(shown):
    cases = [case for case in shown[KEY] if "forward value" in case.quantity]
    assert len(cases) == 2 * 16
    assert {(case.verdict, case.tolerance) for case in cases} == {("reproduced", 0.5e-5)}
    assert all("recomputed reference" in case.quantity for case in cases)


@pytest.mark.parametrize("water", ["deep water", "h/T = 1.4"])
def test_three_stages_recover_all_twelve_coefficients(shown, water):
    cases = [case for case in shown[KEY] if case.case == f"Table 4, {water}, three stages"]
    assert len(cases) == 12 + 1
    assert all(case.computed == pytest.approx(case.printed, abs=1e-12) for case in cases)


def test_bare_hull_is_unstable_in_both_waters(find):
    assert find(KEY, "C'", "deep water, bare hull").computed == pytest.approx(-0.0093, abs=5e-5)
    assert find(KEY, "C'", "h/T = 1.4, bare hull").computed == pytest.approx(-0.0164, abs=5e-5)


def test_terms_odd_in_the_drift_angle_turn_their_sign(find):
    case = find(KEY, "coefficients that turn their sign", "deep water")
    assert case.computed.split() == ["Yb", "Yb|b|", "Ybrr", "Nb", "Nb|b|", "Nbrr"]


def test_block_coefficient_contradicts_the_displacement(find):
    assert find(KEY, "block coefficient").verdict == "not-reproducible"
