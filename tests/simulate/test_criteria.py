"""IMO MSC.137(76): limits, verdicts, probabilities."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.simulate.criteria import (
    CRITERIA,
    first_overshoot_limit,
    imo_criteria,
    judged,
    length_over_speed,
    pass_probability,
    second_overshoot_limit,
)

TANKER = Ship("KVLCC2", L=320.0, B=58.0, T=20.8)
SPEED = 15.5 * 1852.0 / 3600.0
RESULTS = {
    "turning +35": {"advance": 2.98, "tactical diameter": 3.00},
    "turning -35": {"advance": 3.00, "tactical diameter": 3.01},
    "initial turning +10": {"initial turning track": 1.9},
    "zigzag +10/10": {"overshoot 1": 4.9, "overshoot 2": 13.2},
    "zigzag -10/10": {"overshoot 1": 7.0, "overshoot 2": 8.5},
    "zigzag +20/20": {"overshoot 1": 10.5},
    "crash stop": {"track reach": 15.5},
}


@pytest.mark.parametrize(
    ("ratio", "first", "second"),
    [(5.0, 10.0, 25.0), (10.0, 10.0, 25.0), (20.0, 15.0, 32.5), (30.0, 20.0, 40.0), (40.1, 20.0, 40.0)],
)
def test_limits_of_the_zigzag(ratio, first, second):
    assert first_overshoot_limit(ratio) == first
    assert second_overshoot_limit(ratio) == second


def test_verdicts_of_the_tanker():
    table = imo_criteria(RESULTS, TANKER, SPEED).set_index("criterion")
    assert table["limit"].tolist() == [4.5, 5.0, 2.5, 20.0, 40.0, 25.0, 15.0]
    assert table["verdict"].tolist() == ["pass"] * 6 + ["fail"]
    assert table.loc["turning: advance", "value"] == 3.00
    assert table.loc["10/10 zig-zag: first overshoot", "value"] == 7.0
    assert table.loc["10/10 zig-zag: second overshoot", "value"] == 13.2
    assert table.loc["stopping: track reach", "margin"] == pytest.approx(-0.5)
    assert table.loc["turning: tactical diameter", "margin_pct"] == pytest.approx(100.0 * 1.99 / 5.0)


def test_notes_say_what_the_standards_presuppose():
    model = TANKER.at_scale(45.714)
    notes = imo_criteria(RESULTS, model, 1.179).attrs["notes"]
    assert notes[0] == "limits of the 10/10 zig-zag for L/V = 40.1 s at full scale"
    assert any("model scale 1:45.714" in note for note in notes)
    small = Ship("ferry", L=60.0, B=12.0, T=4.0, depth=8.0)
    notes = imo_criteria({}, small, 8.0).attrs["notes"]
    assert any("100 m and more" in note for note in notes)
    assert any("h/T = 2.00" in note for note in notes)


def test_length_over_speed_is_that_of_the_full_scale():
    model = TANKER.at_scale(45.714)
    assert length_over_speed(model, SPEED / math.sqrt(45.714)) == pytest.approx(length_over_speed(TANKER, SPEED))
    with pytest.raises(TowtankError, match=r"test speed 0\.0 m/s is not positive"):
        length_over_speed(TANKER, 0.0)


def test_what_was_not_tested_or_not_reached_is_said():
    table = imo_criteria({"turning +35": {"advance": 3.0, "tactical diameter": math.nan}}, TANKER, SPEED)
    verdicts = table.set_index("criterion")["verdict"]
    assert verdicts["turning: advance"] == "pass"
    assert verdicts["turning: tactical diameter"] == "not reached"
    assert verdicts["stopping: track reach"] == "not tested"


def test_only_the_manoeuvre_of_a_criterion_is_judged():
    by_name = {criterion.name: criterion for criterion in CRITERIA}
    assert judged(by_name["turning: advance"], "turning -35")
    assert not judged(by_name["turning: advance"], "turning +20")
    assert not judged(by_name["10/10 zig-zag: first overshoot"], "zigzag +20/20")
    assert not judged(by_name["20/20 zig-zag: first overshoot"], "zigzag +20/10")
    assert not judged(by_name["initial turning"], "initial turning +20")


def test_probability_of_passing_counts_draws_of_both_sides():
    results = {
        "zigzag +10/10": {"overshoot 1": np.array([5.0, 21.0, 19.0, np.nan])},
        "zigzag -10/10": {"overshoot 1": np.array([5.0, 5.0, 20.0, 5.0])},
    }
    assert pass_probability(results, TANKER, SPEED) == {"10/10 zig-zag: first overshoot": 0.5}


def test_verdicts_are_of_one_run():
    with pytest.raises(TowtankError, match="2 values; verdicts are of one run"):
        imo_criteria({"turning +35": {"advance": np.array([3.0, 3.1])}}, TANKER, SPEED)
