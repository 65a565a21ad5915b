"""Sample calculations of Celik et al."""

from towtank.reproduce.paper_celik_gci import cases

CASES = {(case.case, case.quantity): case for case in cases()}


def test_third_example_is_oscillatory_and_says_what_was_done():
    where = "Table 1, axial velocity at another point"
    assert CASES[where, "class"].computed == "oscillatory"
    assert CASES[where, "class"].verdict == "reproduced"
    assert "monotone formula" in CASES[where, "GCI21, %"].note


def test_one_percentage_is_of_another_base():
    wrong = [case for case in CASES.values() if case.verdict != "reproduced"]
    assert [(case.printed, round(case.computed, 3)) for case in wrong] == [(0.9, 0.847)]
