"""The ship at rest."""

import numpy as np
import pytest

from towtank.core.errors import FitError
from towtank.squat.rtk_antennas import Antenna, AntennaLayout, AntennaRecord
from towtank.squat.static_reference import static_reference
from towtank.squat.tide import TideTable

LAYOUT = AntennaLayout(350.0, 51.0, {"Z": Antenna(0.0)}, pitch="pitch")
TIME = np.arange(0.0, 600.0, 1.0)


def record(speed=0.0, hole=False):
    rng = np.random.default_rng(2)
    keel = 12.0 - 0.001 * TIME + 0.01 * rng.standard_normal(TIME.size)
    if hole:
        keel[50] = np.nan
    trim = np.full(TIME.size, 0.002) + 1e-6 * rng.standard_normal(TIME.size)
    return AntennaRecord(TIME, keel, trim, None, np.full(TIME.size, speed), None, LAYOUT, name="berth.csv")


RISING = TideTable([0.0, 600.0], [2.0, 2.6])


def test_the_tide_leaves_the_draught():
    found = static_reference(record(), RISING, start=0.0, stop=400.0, rho=1005.0)
    assert found.draught == pytest.approx(14.0, abs=4.0 * found.se_draught)
    assert found.se_draught == pytest.approx(0.01 / 20.0, rel=0.5)
    assert (found.trim, found.heel, found.rho) == (pytest.approx(0.002, abs=1e-6), 0.0, 1005.0)
    assert found.notes == ()


def test_a_short_reference_is_said():
    assert "static reference of 60 s" in static_reference(record(), RISING, start=0.0, stop=60.0).notes[0]


@pytest.mark.parametrize(
    ("given", "window", "said"),
    [
        ({}, (700.0, 900.0), "0 samples"),
        ({}, (10.0, 12.0), "3 samples, at least 10"),
        ({"speed": 4.0}, (0.0, 400.0), "the ship makes 4.00 m/s"),
        ({"hole": True}, (0.0, 400.0), "a value is missing"),
    ],
)
def test_what_is_no_reference_is_named(given, window, said):
    with pytest.raises(FitError, match=f"berth.csv, static reference .*{said}"):
        static_reference(record(**given), RISING, start=window[0], stop=window[1])


def test_the_tide_table_must_cover_it():
    with pytest.raises(FitError, match="outside its 0 to 100 s"):
        static_reference(record(), TideTable([0.0, 100.0], [2.0, 2.1]), start=0.0, stop=400.0)
