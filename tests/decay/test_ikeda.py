"""Simplified Ikeda components: the sample table, limits, the influence of speed and scale."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.core.ship import Ship
from towtank.datasets import load_table
from towtank.decay.ikeda import COMPONENTS, LIMITS, IkedaHull, ikeda_damping

TEN = math.radians(10.0)


@pytest.fixture
def hull():
    return IkedaHull(300.0, 50.0, 12.5, 0.65, 0.98, -2.5, 1.25, 60.0, gravity=9.81)


@pytest.mark.parametrize("name", ["friction", "wave", "eddy", "bilge_keel", "total"])
def test_sample_table_to_its_printed_digits(hull, name):
    table = load_table("ikeda-sample").frame
    damping = ikeda_damping(hull, np.radians(table["amplitude"]), table["omega_hat"] * hull.frequency_unit)
    assert [f"{value:.5e}" for value in getattr(damping, name)] == [f"{value:.5e}" for value in table[name]]
    assert damping.within_limits


def test_bilge_keels_of_the_table_go_with_frequency_but_for_one_misprint():
    table = load_table("ikeda-sample", corrected=False).frame
    low, middle = table.query("omega_hat == 0.4"), table.query("omega_hat == 0.6")
    allowed = 0.5e-8 * (1.0 + 0.4 / 0.6)
    differ = np.abs(low["bilge_keel"].to_numpy() - 0.4 / 0.6 * middle["bilge_keel"].to_numpy()) > allowed
    assert low["amplitude"].to_numpy()[differ].tolist() == [15]


def test_speed_zero_is_the_limit_of_slow_speed(hull):
    still = ikeda_damping(hull, TEN, 0.4)
    slow = ikeda_damping(hull, TEN, 0.4, speed=1e-6)
    assert slow.total[0] == pytest.approx(still.total[0], rel=1e-3)
    assert slow.wave[0] == pytest.approx(still.wave[0], rel=1e-3)


def test_speed_adds_lift_and_friction_and_sweeps_eddies_away(hull):
    still, fast = ikeda_damping(hull, TEN, 0.4), ikeda_damping(hull, TEN, 0.4, speed=10.0)
    assert still.lift[0] == 0.0
    assert fast.lift[0] > 0.0
    assert fast.friction[0] == pytest.approx(still.friction[0] * (1.0 + 4.1 * 10.0 / (0.4 * 300.0)))
    swept = (0.04 * 0.4 * 300.0 / 10.0) ** 2
    assert fast.eddy[0] == pytest.approx(still.eddy[0] * swept / (1.0 + swept))


def test_lift_is_proportional_to_speed(hull):
    slow, fast = (ikeda_damping(hull, TEN, 0.4, speed=speed) for speed in (5.0, 10.0))
    assert fast.lift[0] == pytest.approx(2.0 * slow.lift[0])


def test_only_friction_knows_the_scale(hull):
    model = IkedaHull(3.0, 0.5, 0.125, 0.65, 0.98, -0.025, 0.0125, 0.6, gravity=9.81)
    ship = ikeda_damping(hull, TEN, 0.4)
    small = ikeda_damping(model, TEN, 4.0)
    for name in ("wave", "eddy", "bilge_keel"):
        assert getattr(small, name)[0] == pytest.approx(getattr(ship, name)[0], rel=1e-12)
    # Laminar: the square root of the Reynolds number, scale^(3/4).
    assert small.friction[0] / ship.friction[0] == pytest.approx(100.0**0.75, rel=1e-9)


def test_bilge_keels_can_be_left_out(hull):
    bare = IkedaHull(300.0, 50.0, 12.5, 0.65, 0.98, -2.5)
    damping = ikeda_damping(bare, TEN, 0.4)
    assert damping.bilge_keel[0] == 0.0
    assert damping.within_limits


def test_components_add_up_and_the_table_has_them_all(hull):
    damping = ikeda_damping(hull, np.radians([0.0, 5.0, 10.0]), 0.4, speed=3.0)
    frame = damping.to_frame()
    assert frame["B44_hat"].to_numpy() == pytest.approx(frame[list(COMPONENTS)].sum(axis=1).to_numpy())
    assert damping.friction[0] == damping.friction[2] > 0.0
    assert damping.eddy[0] == 0.0


def test_dimensional_damping_and_extinction_rate(hull):
    damping = ikeda_damping(hull, TEN, 0.4)
    unit = 1025.0 * 0.65 * 300.0 * 50.0 * 12.5 * 50.0**2 * math.sqrt(2.0 * 9.81 / 50.0)
    assert damping.dimensional()[0] == pytest.approx(damping.total[0] * unit)
    assert damping.extinction_rate(2e10)[0] == pytest.approx(damping.dimensional()[0] / 4e10)


@pytest.mark.parametrize(
    ("change", "name"),
    [
        ({"CB": 0.45}, "CB"),
        ({"CB": 0.86}, "CB"),
        ({"d": 10.0}, "B/d"),
        ({"OG": 3.0}, "OG/d"),
        ({"CM": 0.995}, "CM"),
        ({"keel_breadth": 4.0}, "bBK/B"),
        ({"keel_length": 10.0}, "lBK/L"),
    ],
)
def test_particulars_outside_the_regressions_are_flagged(hull, change, name):
    from dataclasses import replace

    damping = ikeda_damping(replace(hull, **change), TEN, 0.4)
    assert name in [finding.place for finding in damping.findings]
    low, high = LIMITS[name]
    assert f"{low:g} to {high:g}" in next(f.message for f in damping.findings if f.place == name)
    assert not damping.within_limits


def test_fast_roll_is_flagged(hull):
    damping = ikeda_damping(hull, TEN, np.array([0.4, 1.1]) * hull.frequency_unit)
    assert [finding.place for finding in damping.findings] == ["omega_hat"]


def test_hull_of_a_ship():
    ship = Ship("KVLCC2", 320.0, 58.0, 20.8, volume=312653.0, KG=18.6)
    hull = IkedaHull.of_ship(ship, 0.998)
    assert pytest.approx(2.2) == hull.OG
    assert hull.volume == pytest.approx(312653.0)
    # Tankers have fuller midship sections than the regressions know.
    assert [f.place for f in ikeda_damping(hull, TEN, 0.4).findings] == ["CM"]


@pytest.mark.parametrize(
    ("ship", "word"),
    [(Ship("a", 1.0, 1.0, 1.0, volume=0.5), "KG"), (Ship("a", 1.0, 1.0, 1.0, KG=0.5), "volume")],
)
def test_ship_without_what_is_needed(ship, word):
    with pytest.raises(TowtankError, match=f"{word} is missing"):
        IkedaHull.of_ship(ship, 0.98)


@pytest.mark.parametrize(
    "wrong", [{"CB": 0.0}, {"CM": 1.1}, {"keel_breadth": -1.0}, {"keel_breadth": 1.0, "keel_length": 0.0}]
)
def test_impossible_particulars_are_refused(hull, wrong):
    from dataclasses import replace

    with pytest.raises(TowtankError):
        replace(hull, **wrong)


@pytest.mark.parametrize("arguments", [(-0.1, 0.4, 0.0), (0.1, 0.0, 0.0), (0.1, 0.4, -1.0)])
def test_impossible_motions_are_refused(hull, arguments):
    amplitude, frequency, speed = arguments
    with pytest.raises(TowtankError):
        ikeda_damping(hull, amplitude, frequency, speed=speed)
