"""S-175: circles of the paper within the stated tolerances, misprints out of reach."""

import pytest

from towtank.reproduce.paper_s175 import KEY


def test_circles_with_derivatives_of_model_tests(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("turning circle, model tests") and case.tolerance]
    assert len(cases) == 6
    assert all(case.verdict == "reproduced" for case in cases)


def test_circles_with_regressions(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("turning circle, regressions") and case.tolerance]
    assert len(cases) == 6
    failed = [case for case in cases if case.verdict != "reproduced"]
    # the transfer to port misses 6 % by a tenth of that
    assert [(case.case, case.quantity[:8]) for case in failed] == [
        ("turning circle, regressions, port", "transfer")
    ]
    assert abs(failed[0].computed / failed[0].printed - 1.0) < 0.075


@pytest.mark.parametrize("misprint", ["N'rrr = -0.4220", "Y'v|v| = +0.90020"])
def test_misprints_are_out_of_reach(find, misprint):
    case = find(KEY, misprint)
    assert case.computed == "out of reach"
    assert case.verdict == "reproduced"


def test_shallow_circles_are_wider_than_the_paper_has_them(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("turning circle at h/d")]
    assert len(cases) == 6
    assert all(case.verdict == "not-reproducible" for case in cases)
    assert all(case.computed > case.printed + 50.0 for case in cases)
