"""KCS at four depths: what the printed grids, clearances and percentages say."""

import pytest

from towtank.reproduce.paper_kcs_depths import KEY


@pytest.mark.parametrize(
    ("force", "ratio", "verdict"),
    [("X", -0.036, "not-reproducible"), ("Y", -0.105, "reproduced"), ("N", -0.194, "reproduced")],
)
def test_grid_ratios(find, force, ratio, verdict):
    case = find(KEY, f"R_G of {force}'")
    assert case.computed == pytest.approx(ratio, abs=5e-4)
    assert case.verdict == verdict
    assert find(KEY, f"behaviour of {force}'").computed == "oscillatory"


def test_wrong_percentages_are_shown_as_such(find):
    for quantity, printed, computed in (("tactical diameter", 5.1, 4.61), ("advance", 3.64, 3.37)):
        case = find(KEY, f"difference of the {quantity}")
        assert case.printed == printed
        assert case.computed == pytest.approx(computed, abs=5e-3)
        assert case.verdict == "not-reproducible"


def test_claimed_change_of_the_yaw_moment_is_too_small(find):
    assert find(KEY, "largest change from coarse to medium").verdict == "not-reproducible"


def test_every_particular_scales(shown):
    rows = [case for case in shown[KEY] if case.case == "Table 1, scale 1:75.5"]
    assert len(rows) == 8
    assert {case.verdict for case in rows} == {"reproduced"}


def test_deep_water_is_labelled_by_its_clearance(find):
    case = find(KEY, "h/T of the deep case")
    assert (case.printed, case.expected) == (32.0, 33.0)
    assert case.computed == pytest.approx(32.96, abs=5e-3)


def test_shallow_yaw_runs_are_far_outside_the_usual_range(find):
    assert find(KEY, "r' (recomputed", "h/T 1.2").computed == pytest.approx(1.759, abs=5e-4)
