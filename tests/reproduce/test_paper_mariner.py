"""Mariner: the seven numbers of the handbook, interpolated turns and zig-zags."""

import pytest

from towtank.reproduce.paper_mariner import KEY


def test_seven_numbers_of_the_handbook_digit_by_digit(shown):
    cases = [case for case in shown[KEY] if case.case.startswith("handbook")]
    assert [round(case.computed) for case in cases] == [769, 711, 1315, 947, 534, 943, 1311]
    assert all(case.verdict == "reproduced" for case in cases)


def test_advance_differs_between_port_and_starboard_by_the_drift_of_the_approach(find):
    port, starboard = (find(KEY, "advance", f"turn with {angle} deg") for angle in ("-15", "15"))
    assert port.computed == pytest.approx(942.4, abs=0.05)
    assert starboard.computed == pytest.approx(640.5, abs=0.05)


def test_every_turn_and_zigzag_is_reproduced(shown):
    others = [case for case in shown[KEY] if case.case.startswith("independent")]
    assert len(others) == 20 + 11
    assert all(case.verdict == "reproduced" for case in others)
