"""KCS: self-propulsion rate, turns, zig-zags."""

import pytest

from towtank.reproduce.paper_kcs_mmg import KEY


def test_self_propulsion_rate(find):
    assert find(KEY, "propeller rate").computed == pytest.approx(115.5, abs=0.05)


def test_turns_and_zigzags(shown):
    others = [case for case in shown[KEY] if case.case.startswith("independent")]
    assert len(others) == 12 + 8
    assert all(case.verdict == "reproduced" for case in others)
    turns = [case for case in others if "turn with" in case.case]
    assert max(abs(case.computed / case.printed - 1.0) for case in turns) < 0.005


def test_the_screw_turns_the_ship_better_to_port(find):
    starboard, port = (find(KEY, "tactical diameter", f"turn with {angle} deg") for angle in ("35", "-35"))
    assert port.computed < starboard.computed - 0.2
