"""Tanker: depth series within one per cent and monotone."""

from towtank.reproduce.paper_esso import KEY


def test_turns_and_zigzags_within_one_per_cent(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("independent")]
    assert len(cases) == 21 + 16
    assert all(case.verdict == "reproduced" for case in cases)
    turns = [case for case in cases if case.quantity.endswith(", m")]
    assert max(abs(case.computed / case.printed - 1.0) for case in turns) < 0.002


def test_series_is_monotone(shown):
    cases = [case for case in shown[KEY] if case.case == "deep to h/T = 1.2"]
    assert len(cases) == 5
    assert {case.computed for case in cases} == {"at every step"}
