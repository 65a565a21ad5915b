"""Critical speeds of Roemisch in open water, canals and trenches."""

import numpy as np
import pytest

from towtank.core.ship import Ship
from towtank.core.variables import GRAVITY
from towtank.squat.fairway import Fairway
from towtank.squat.roemisch import roemisch_critical_speed, squat_at
from towtank.squat.squat_formula import KNOT, full_scale_passage

BULK = Ship("bulk", L=216.0, B=32.2, T=12.5, volume=0.83 * 216 * 32.2 * 12.5)


def passage(fairway):
    return full_scale_passage(BULK, fairway, np.array([8.0 * KNOT]))


def test_canal_row_of_the_sample_table_is_that_of_the_open_critical_speed():
    """The table prints 0.330 and 0.216 m there; the canal's own critical speed gives twice as much."""
    canal = passage(Fairway.canal(15.0, 150.0))
    found = squat_at(canal, roemisch_critical_speed(passage(Fairway(15.0))))
    assert (found.bow[0], found.stern[0]) == (pytest.approx(0.330, abs=1e-3), pytest.approx(0.216, abs=1e-3))
    own = squat_at(canal, roemisch_critical_speed(canal))
    assert (own.bow[0], own.stern[0]) == (pytest.approx(0.739, abs=2e-3), pytest.approx(0.483, abs=2e-3))


def test_critical_speeds_in_order():
    open_water = roemisch_critical_speed(passage(Fairway(15.0)))
    trenches = [
        roemisch_critical_speed(passage(Fairway.trench(15.0, 150.0, height, 3.0))) for height in (1e-6, 5, 10, 15)
    ]
    canal = roemisch_critical_speed(passage(Fairway.canal(15.0, 150.0, 3.0)))
    assert trenches[0] == pytest.approx(open_water, rel=1e-6)
    assert trenches[-1] == pytest.approx(canal, rel=1e-12)
    assert sorted(trenches, reverse=True) == trenches
    assert open_water == pytest.approx(0.58 * (1.2 * 216 / 32.2) ** 0.125 * np.sqrt(GRAVITY * 15), rel=1e-12)
