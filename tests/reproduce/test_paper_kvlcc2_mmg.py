"""KVLCC2: Kim's system-based column, independent runs, the wake without drift."""

from towtank.reproduce.paper_kvlcc2_mmg import DEGREES, KEY, LENGTHS


def test_system_based_column_of_kim(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("Kim")]
    assert len(cases) == 8
    assert all(case.verdict == "reproduced" for case in cases)
    for case in cases:
        assert case.tolerance == (LENGTHS if case.quantity.endswith(", L") else DEGREES)


def test_independent_runs_agree_better_than_the_tolerance(shown):
    turns = [case for case in shown[KEY] if case.case.startswith("independent") and "turn with" in case.case]
    zigzags = [case for case in shown[KEY] if case.case.startswith("independent") and "zig-zag" in case.case]
    assert (len(turns), len(zigzags)) == (18, 16)
    assert max(abs(case.computed - case.printed) for case in turns) < 0.012
    assert max(abs(case.computed - case.printed) for case in zigzags) < 0.1


def test_wake_without_drift_is_that_of_straight_motion(find):
    assert find(KEY, "self-propulsion rate").verdict == "reproduced"
