"""Damping against speed: series of groups, one amplitude that all held, Froude numbers."""

import math

import numpy as np
import pytest

from towtank.core.ship import Ship
from towtank.decay.against_speed import against_speed, common_amplitude, speed_series
from towtank.decay.decay_analysis import analyse_decays
from towtank.decay.decay_campaign import checked_campaign

SPEEDS = (1.0, 0.0, 2.0)


@pytest.fixture(scope="module")
def groups(make_decay):
    entries = [{"file": f"{speed:g}.csv", "speed": speed} for speed in SPEEDS]
    fit = {"methods": ["integration"], "restoring": "linear"}
    campaign = checked_campaign({"decay": {"name": "a"}, "records": entries, "fit": fit}, "c.toml")
    ship = Ship("hull", 100.0, 16.0, 6.0)
    records = [
        make_decay((0.02 + 0.01 * speed, 0.2, 0.0, 0.36, 0.0, 0.0), speed=speed, noise=0.05, duration=100.0)
        for speed in SPEEDS
    ]
    return analyse_decays(campaign, [type(one)(**vars(one) | {"ship": ship}) for one in records]).groups


def test_coefficients_by_rising_speed(groups):
    frame = against_speed(groups)
    linear = frame[frame["name"] == "b1"]
    assert list(linear["speed [m/s]"]) == [0.0, 1.0, 2.0]
    assert ((linear["lower95"] < linear["value"]) & (linear["value"] < linear["upper95"])).all()
    np.testing.assert_allclose(linear["value"], [0.02, 0.03, 0.04], rtol=0.05)
    np.testing.assert_allclose(linear["Fn [-]"], np.array([0.0, 1.0, 2.0]) / math.sqrt(9.80665 * 100.0))


def test_equivalent_damping_stands_at_one_amplitude(groups):
    frame = against_speed(groups)
    (members,) = speed_series(groups)
    amplitude = common_amplitude(members)
    own = frame[frame["name"] == "alpha_e"]
    np.testing.assert_allclose(own["at"], math.degrees(amplitude))
    true = [0.5 * (0.02 + 0.01 * u) + 4.0 / (3.0 * math.pi) * 0.6 * amplitude * 0.2 for u in (0.0, 1.0, 2.0)]
    np.testing.assert_allclose(own["value"], true, rtol=0.02)
    zeta = frame[frame["name"] == "zeta"]
    np.testing.assert_allclose(zeta["value"].to_numpy(), own["value"].to_numpy() / 0.6, rtol=0.01)


def test_one_speed_is_no_series(groups):
    assert speed_series(groups[:1]) == []
    assert against_speed(groups[:1]).empty
