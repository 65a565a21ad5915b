"""Grid and time-step tables of DTC: twelve rows inside their rounding."""

import pytest

from towtank.reproduce.paper_dtc_gci import cases

CASES = list(cases())


def test_twelve_rows_inside_their_rounding():
    rows = {case.case for case in CASES if case.quantity == "convergence"}
    assert len(rows) == 12
    assert {case.verdict for case in CASES} == {"reproduced"}


def test_index_of_the_resistance_coefficient():
    case = next(case for case in CASES if case.case.endswith("grid calm, Ct") and case.quantity == "GCI, %")
    assert case.computed == pytest.approx(2.478, abs=5e-4)
    assert case.tolerance < 0.1


def test_pitch_says_only_that_it_is_inside():
    pitch = [case for case in CASES if "pitch" in case.case and "GCI" in case.quantity]
    assert len(pitch) == 2
    assert all(case.printed == "inside" and "any number" in case.note for case in pitch)
