"""Pure car carrier: check helm and course stability along the bank."""

from collections import Counter

import pytest

from towtank.core.errors import DatasetError
from towtank.reproduce.paper_pcc_stability import KEY, ship_near_bank


def test_thirty_values_of_d5(shown):
    cases = [case for case in shown[KEY] if case.quantity.startswith("100 D5 (")]
    assert len(cases) == 30
    assert {case.verdict for case in cases} == {"reproduced"}


def test_every_statement_of_the_text_is_confirmed(shown):
    said = [case for case in shown[KEY] if case.quantity.endswith("text") and isinstance(case.printed, str)]
    assert len(said) == 11
    assert {case.verdict for case in said} == {"reproduced"}


def test_printed_d2_is_corrected(find):
    case = find(KEY, "100 D5", "equation 23")
    assert case.verdict == "reproduced-after-correction"
    assert case.printed == -0.637


def test_sign_change_of_d1(find):
    assert find(KEY, "eta/L where D1").computed == pytest.approx(0.181, abs=5e-4)


def test_only_the_suspect_yaw_term_fails(shown, find):
    assert Counter(case.verdict for case in shown[KEY])["not-reproducible"] == 1
    case = find(KEY, "reaches 35 deg")
    assert case.verdict == "not-reproducible"
    assert "0.28 L" in case.note


def test_other_depths_are_named():
    with pytest.raises(DatasetError, match=r"no bank tests at h/d = 2"):
        ship_near_bank(2.0)
