"""Sections of canals and trenches, blockage and its inverse."""

import pytest

from towtank.core.errors import TowtankError
from towtank.squat.fairway import Fairway, blockage, section_ratio, width_of_influence

# Half bottom width in m and the printed section ratio; banks 1:3 and a midship coefficient of 0.98
SECTIONS = {
    "A": (18.0 / 40, 55.0 / 40, 16.0 / 40, {5.4: 10, 8.4: 15, 11.4: 20, 14.4: 25}),
    "B": (16.5 / 40, 40.0 / 40, 14.5 / 40, {5.4: 14, 8.4: 21, 11.4: 28, 14.4: 35}),
}


@pytest.mark.parametrize("case", SECTIONS)
def test_printed_section_ratios_of_the_trapezoidal_canal(case):
    depth, breadth, draught, printed = SECTIONS[case]
    for half_width, ratio in printed.items():
        canal = Fairway.canal(depth, 2.0 * half_width, slope=3.0)
        assert canal.area is not None
        assert section_ratio(0.98 * breadth * draught, canal.area) == pytest.approx(ratio, rel=0.0145)


def test_blockage_and_section_ratio_are_inverse():
    assert blockage(2.0, 40.0) == 0.05
    assert section_ratio(2.0, 40.0) == 20.0
    with pytest.raises(TowtankError, match="does not fit"):
        blockage(40.0, 2.0)


def test_kinds_and_mean_depth():
    assert Fairway(12.0).kind == "open"
    assert Fairway(12.0).mean_depth == 12.0
    canal = Fairway.canal(10.0, 50.0, 2.0)
    assert (canal.kind, canal.area, canal.top_width) == ("canal", 700.0, 90.0)
    assert canal.mean_depth == pytest.approx(7.7778, abs=1e-4)
    trench = Fairway.trench(10.0, 50.0, 4.0, 2.0)
    assert (trench.kind, trench.area, trench.bank_height) == ("trench", 700.0, 4.0)


def test_width_of_influence_of_the_rescue_cruiser():
    assert width_of_influence(5.99, 0.43) == pytest.approx(86.4, abs=0.05)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"depth": -1.0}, "depth = -1.0 is not a positive"),
        ({"depth": 5.0, "area": 50.0}, "belong together"),
        ({"depth": 5.0, "area": 50.0, "top_width": 10.0, "bank_height": 6.0}, "banks that do not rise"),
        ({"depth": 5.0, "bank_height": 2.0}, "needs its section"),
    ],
)
def test_impossible_fairways(arguments, said):
    with pytest.raises(TowtankError, match=said):
        Fairway(**arguments)


def test_impossible_canal():
    with pytest.raises(TowtankError, match="bank slope"):
        Fairway.canal(5.0, 20.0, -1.0)
