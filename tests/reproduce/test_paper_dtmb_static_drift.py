"""Static drift of DTMB 5512 in CFD: errors and the area that forces are scaled by."""

import pytest

from towtank.reproduce.paper_dtmb_static_drift import KEY


@pytest.mark.parametrize(("force", "error"), [("X", -1.479), ("Y", -8.775), ("N", -8.424)])
def test_errors_carry_their_sign(find, force, error):
    assert find(KEY, f"(S - D)/D of {force}").computed == pytest.approx(error, abs=5e-4)


def test_only_the_lateral_area_gives_a_plausible_force(find):
    case = find(KEY, "reference area")
    assert (case.printed, case.computed, case.verdict) == ("L^2", "L T", "reproduced-after-correction")
    assert "637 N" in case.note
    assert "27.6 N" in case.note


def test_sway_motion_reaches_ten_degrees(find):
    assert find(KEY, "largest drift angle").computed == pytest.approx(10.03, abs=5e-3)


def test_draught_of_the_other_papers_gives_the_block_coefficient(find):
    case = find(KEY, "block coefficient")
    assert case.verdict == "reproduced-after-correction"
    assert "0.520" in case.note
