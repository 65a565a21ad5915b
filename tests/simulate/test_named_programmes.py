"""Programmes by name."""

from __future__ import annotations

import pytest

from towtank.core.errors import SimulationError
from towtank.simulate.named_programmes import IMO_SET, named_programme


@pytest.mark.parametrize(
    ("name", "programme"),
    [
        ("turning 35", "turning +35"),
        ("Turning -20", "turning -20"),
        ("turning circle +35 deg", "turning +35"),
        ("turning", "turning +35"),
        ("zigzag 20/10", "zigzag +20/10"),
        ("zig-zag -10", "zigzag -10/10"),
        ("initial turning -10", "initial turning -10"),
        ("pull-out 15", "pull-out +15"),
        ("spiral", "spiral"),
        ("reverse spiral", "reverse spiral"),
        ("crash stop", "crash stop"),
        ("williamson 35", "williamson +35"),
    ],
)
def test_a_name_gives_its_programme(name, programme):
    assert named_programme(name, 6.0).name == programme


def test_the_imo_set_has_both_sides():
    names = [named_programme(name, 1.0).name for name in IMO_SET]
    assert len(set(names)) == 8
    assert sum("-" in name.partition(" ")[2] for name in names) == 4


def test_yaw_rates_of_the_reverse_spiral_follow_the_size_of_the_ship():
    small, large = (named_programme("reverse spiral", tick).phases for tick in (1.0, 10.0))
    assert small[0].target == pytest.approx(10.0 * large[0].target)
    assert 10.0 * small[0].gains[0] == pytest.approx(large[0].gains[0])


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("turrning 35", "did you mean turning"),
        ("sideways", "begin the name with"),
        ("zigzag 20-20", "write e.g. 'zigzag 20/20'"),
        ("zigzag", "needs its rudder angle"),
        ("turning hard", "write e.g. 'turning 35'"),
        ("turning 35/10", "has no second angle"),
        ("spiral 25", "has no angle"),
        ("initial turning 10/20", "ends at a heading change of 10 deg"),
        ("turning 0", "turns to neither side"),
    ],
)
def test_what_cannot_be_read_is_said(name, said):
    with pytest.raises(SimulationError) as caught:
        named_programme(name, 1.0)
    assert said in str(caught.value)
