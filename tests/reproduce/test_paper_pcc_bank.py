"""Pure car carrier: refits, bank forces, check helm."""

import pytest

from towtank.reproduce.paper_pcc_bank import KEY


@pytest.mark.parametrize("depth", ["deep water", "h/d = 1.5", "h/d = 1.2"])
def test_refit_of_the_189_conditions_of_a_depth(find, depth):
    case = find(KEY, "largest difference over 25", f"Table 2, {depth}, refit of 189 conditions")
    assert case.computed < 1e-11


@pytest.mark.parametrize("depth", ["h/d = 1.5", "h/d = 1.2"])
def test_refit_along_the_bank(find, depth):
    assert find(KEY, "largest difference over 17", f"Table 5, {depth}, refit").computed < 1e-11


def test_bank_sucks_the_ship_in_and_pushes_its_bow_out(shown):
    forces = [case for case in shown[KEY] if "at zero drift" in case.quantity]
    assert len(forces) == 10
    assert all((case.computed > 0) == case.quantity.startswith("Y'") for case in forces)
    suction = [case.computed for case in forces if case.quantity.startswith("Y'")]
    assert suction == sorted(suction)


def test_suspect_yaw_term_shows_in_the_check_helm(find):
    case = find(KEY, "check helm")
    assert case.verdict == "not-reproducible"
    assert case.computed == pytest.approx(91, abs=0.5)
    assert "33 deg" in case.note


def test_shallow_froude_number_was_rounded_twice(find):
    assert find(KEY, "Froude number", "6 knots").computed == pytest.approx(0.0735, abs=5e-5)
