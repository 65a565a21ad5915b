"""MELLUM sea trials: derived table, percentages of the text, current."""

import pytest

from towtank.reproduce.paper_mellum import KEY, change, drifting_circle, speed_loss


def test_every_percentage_of_the_text(shown):
    rows = [case for case in shown[KEY] if case.case.startswith("text")]
    assert len(rows) == 17
    assert {case.verdict for case in rows} == {"reproduced"}


def test_derived_table(shown):
    rows = [case for case in shown[KEY] if "recomputed reference" in case.quantity]
    assert len(rows) == 66
    assert {case.verdict for case in rows} == {"reproduced"}


def test_water_deepens_during_the_turn(find):
    approach = find(KEY, "h/T in the approach", "h/T = 1.5, 70 %")
    turn = find(KEY, "h/T in the turn", "h/T = 1.5, 70 %")
    assert (approach.computed, turn.computed) == pytest.approx((1.490, 1.667), abs=1e-3)


@pytest.mark.parametrize("current", [0.12, 0.5, 0.9])
def test_current_and_radius_are_found(find, current):
    case = f"{current:g} m/s (synthetic)"
    assert find(KEY, "current in m/s", case).computed == pytest.approx(current, abs=1e-4)
    assert find(KEY, "radius in m", case).computed == pytest.approx(74.0, abs=1e-2)


def test_drifting_circle_drifts():
    track = drifting_circle(74.0, 3.4, 0.5, turns=1.0, noise=0.0)
    drift = 0.5 * track["time"][-1]
    assert track["y"][-1] == pytest.approx(drift * 3**0.5 / 2.0, abs=0.1)


def test_changes_in_per_cent():
    assert change(114.0, 100.0) == pytest.approx(14.0)
    assert speed_loss(12.0, 6.0) == 50.0
