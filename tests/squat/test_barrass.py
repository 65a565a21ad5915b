"""Which end Barrass' third formula sinks, and how narrow water is capped."""

import numpy as np
import pytest

from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.prediction import predict
from towtank.squat.squat_formula import KNOT


def ends(block, channel=None):
    ship = Ship("hull", L=200.0, B=30.0, T=10.0, volume=block * 60000.0)
    found = predict(ship, 12.0, [8 * KNOT], channel=channel)
    return found.of("barrass-3", "bow")[0], found.of("barrass-3", "stern")[0]


def test_full_ships_go_down_by_the_bow_and_fine_ones_by_the_stern():
    bow, stern = ends(0.8)
    assert stern / bow == pytest.approx(1 - 40 * 0.1**2)
    bow, stern = ends(0.6)
    assert bow / stern == pytest.approx(1 - 40 * 0.1**2)
    bow, stern = ends(0.7)
    assert bow == pytest.approx(stern, rel=1e-9)


@pytest.mark.parametrize(("width", "factor"), [(70.0, 2.0), (150.0, 5.74 * (300 / 1800) ** 0.76), (400.0, 1.0)])
def test_blockage_factor_between_one_and_two(width, factor):
    bow, _ = ends(0.8, Fairway.canal(12.0, width))
    assert bow == pytest.approx(factor * 0.8 * 0.64, rel=1e-9)


def test_second_formula_goes_with_knots_to_2_08():
    ship = Ship("hull", L=200.0, B=30.0, T=10.0, volume=48000.0)
    values = predict(ship, 12.0, np.array([5.0, 10.0]) * KNOT).of("barrass-2", "maximum")
    assert values[1] / values[0] == pytest.approx(2**2.08)
