"""What a virtual laboratory is, and what it refuses to be."""

from __future__ import annotations

import numpy as np
import pytest

from towtank.core.conventions import HOME
from towtank.core.errors import CampaignError
from towtank.core.ship import Ship
from towtank.pmm.laboratory import Laboratory
from towtank.pmm.run_types import Run

SHIP = Ship("hull", L=4.0, B=0.6, T=0.2, xG=-0.1)
SWAY = Run("sway", "pure_sway", 1.0, frequency=2.0, sway_amplitude=0.1)
TOW = Run("tow", "static_drift", 1.0)


def test_points_follow_the_origin_unless_they_are_given():
    assert Laboratory().moment_point(SHIP) == 0.0
    cog = Laboratory(conventions=HOME.but(origin="cog"))
    assert (cog.moment_point(SHIP), cog.path_point(SHIP)) == (pytest.approx(-0.1), pytest.approx(-0.1))
    forward = Laboratory(conventions=HOME.but(origin=0.25), moment_x=0.3)
    assert (forward.moment_point(SHIP), forward.path_point(SHIP)) == (0.3, 1.0)


def test_records_have_the_length_that_was_asked_for():
    laboratory = Laboratory(sampling_rate=10.0, duration=20.0, cycles=4, rest=2.0, ramp=3.0, startup_cycles=2)
    assert len(laboratory.times(TOW)) == 300
    assert len(laboratory.times()) == 200
    oscillating = laboratory.times(SWAY)
    assert np.diff(oscillating) == pytest.approx(np.full(len(oscillating) - 1, 0.1))
    # the sample after the last would begin cycle 7
    assert oscillating[-1] < 6 * SWAY.period <= oscillating[-1] + 0.1


@pytest.mark.parametrize(
    ("values", "place"),
    [
        ({"sampling_rate": 0.0}, "laboratory.sampling_rate"),
        ({"duration": -1.0}, "laboratory.duration"),
        ({"cycles": 0}, "laboratory.cycles"),
        ({"ramp": -1.0}, "laboratory.ramp"),
        ({"rest": 2.0}, "laboratory.ramp"),
    ],
)
def test_what_cannot_be_run_is_refused_by_name(values, place):
    with pytest.raises(CampaignError) as caught:
        Laboratory(**values)
    assert caught.value.place == place
