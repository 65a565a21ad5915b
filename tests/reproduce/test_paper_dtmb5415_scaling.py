"""One campaign in two papers."""

import pytest

from towtank.reproduce.paper_dtmb5415_scaling import KEY

AGREE = {"Xvv", "Yv", "Yvvv", "Nv", "Nvvv", "Nrrr"}


def test_drift_derivatives_agree_and_most_others_do_not(shown):
    found = {case.quantity.split()[0]: case for case in shown[KEY]}
    assert len(found) == 15
    assert {name for name, case in found.items() if case.verdict == "reproduced"} == AGREE


def test_scaling_is_length_over_draught(find):
    assert find(KEY, "Yvvv from").computed == pytest.approx(-0.08426 * 142 / 6.15)


def test_sign_of_yr_differs(find):
    case = find(KEY, "Yr from")
    assert case.printed < 0 < case.computed


def test_repeated_number_is_named(find):
    assert "repeat their value of Nv" in find(KEY, "Xvr from").note
    assert find(KEY, "Xvr from").computed == find(KEY, "Nv from").computed
