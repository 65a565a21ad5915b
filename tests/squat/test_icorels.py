"""ICORELS and Huuska: the DTC in shallow water, the coefficient by fullness, trenches between open water and canal."""

from itertools import pairwise

import numpy as np
import pytest

from towtank.core.ship import Ship
from towtank.squat.fairway import Fairway
from towtank.squat.icorels import block_dependent_coefficient, huuska_channel_factor
from towtank.squat.prediction import predict
from towtank.squat.squat_formula import full_scale_passage

DTC = Ship("DTC", L=355.0, B=51.0, T=14.5, volume=171800.0).at_scale(89.11)


@pytest.mark.parametrize(
    ("speed", "depth", "printed", "decimals"),
    [(0.327, 0.326, 0.8845, 4), (0.872, 0.326, 7.083, 3), (0.327, 0.1956, 1.491, 3)],
)
def test_dtc_bow_squat_in_millimetres_of_the_model(speed, depth, printed, decimals):
    bow = 1000 * predict(DTC, depth, [speed]).of("icorels", "bow")[0]
    # the reference was computed with g = 9.81: 0.04 %
    assert bow == pytest.approx(printed, abs=5e-4 * printed + 0.5 * 10.0**-decimals)


def test_coefficient_by_fullness():
    assert [block_dependent_coefficient(value) for value in (0.69, 0.7, 0.79, 0.8)] == [1.7, 2.0, 2.0, 2.4]


def test_trench_lies_between_open_water_and_canal():
    ship = Ship("bulk", L=216.0, B=32.2, T=12.5, volume=72161.0)

    def factor(fairway):
        return huuska_channel_factor(full_scale_passage(ship, fairway, np.array([4.0])))

    canal = factor(Fairway.canal(15.0, 150.0))
    trenches = [factor(Fairway.trench(15.0, 150.0, height)) for height in (4.0, 7.0, 10.0, 15.0)]
    assert factor(Fairway(15.0)) == 1.0
    assert canal == pytest.approx(7.45 * 0.98 * 32.2 * 12.5 / 2250 + 0.76, rel=1e-12)
    assert all(1.0 <= low < high for low, high in pairwise(trenches))
    assert trenches[-1] < canal
    # bank to the surface: the polynomial of the highest banks at this blockage is 2.0287
    assert trenches[-1] == pytest.approx(7.45 * 0.17535 / 2.0293 + 0.76, rel=1e-3)
