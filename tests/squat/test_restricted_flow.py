"""Channel flow: Schijf's speeds, Kreitner's root and its absence, Raven's walls."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from towtank.core.errors import TowtankError
from towtank.core.variables import GRAVITY
from towtank.squat.restricted_flow import (
    critical_depth_froude,
    equivalent_speed,
    kreitner,
    level_drop,
    raven_overspeed,
    wall_sinkage,
)
from towtank.squat.squat_formula import KNOT

FROUDE = (0.2, 0.3, 0.4, 0.5, 0.559, 0.6, 0.65, 0.7)
GAMMA = {
    # blockage: (critical depth Froude number, gamma at each FROUDE; None where there is no root)
    0.0200: (0.8286, (1.0213, 1.0225, 1.0246, 1.0278, 1.0306, 1.0332, 1.0375, 1.0437)),
    0.0386: (0.7630, (1.0420, 1.0446, 1.0489, 1.0559, 1.0623, 1.0685, 1.0792, 1.0970)),
    0.0646: (0.6950, (1.0725, 1.0774, 1.0856, 1.0999, 1.1138, 1.1284, 1.1587, None)),
    0.1000: (0.6228, (1.1173, 1.1262, 1.1420, 1.1719, 1.2066, 1.2567, None, None)),
}


def test_schijf_of_the_confined_inland_hull():
    lower, upper = critical_depth_froude(0.18 * 0.075 / (1.50 * 0.103))
    assert lower == pytest.approx(0.647, abs=5e-4)
    assert upper == pytest.approx(1.368, abs=5e-4)


@pytest.mark.parametrize("blockage", GAMMA)
def test_gamma_table_to_its_digits(blockage):
    critical, gammas = GAMMA[blockage]
    found = kreitner(blockage, FROUDE)
    assert found.critical == pytest.approx(critical, abs=5.1e-5)
    for value, printed in zip(found.gamma, gammas, strict=True):
        assert math.isnan(value) if printed is None else value == pytest.approx(printed, abs=5.1e-5)
    assert list(found.subcritical) == [item is not None for item in gammas]


def test_series_60():
    # L/B 7.5, B/T 2.5, midship coefficient 0.977, tank 1.31 L wide, h/T 1.54
    blockage = 0.977 / (1.31 * 7.5 * 1.54)
    assert blockage == pytest.approx(0.06457, abs=5e-6)
    assert kreitner(blockage, 0.559).gamma[0] == pytest.approx(1.1138, abs=5e-5)


def test_ferry_near_its_critical_speed():
    knots = np.array([15.0, 16.8, 17.0]) * KNOT / math.sqrt(GRAVITY * 13.1)
    found = kreitner(0.0386, knots)
    assert list(found.subcritical) == [True, True, False]
    assert found.critical * math.sqrt(GRAVITY * 13.1) / KNOT == pytest.approx(16.81, abs=0.005)


def test_no_answer_of_another_kind_beyond_the_upper_critical_speed():
    assert np.isnan(kreitner(0.0874, [0.7, 1.0, 1.368, 1.5, 3.0]).gamma).all()


@given(st.floats(0.0, 0.5), st.floats(0.0, 0.999))
def test_root_satisfies_continuity_and_is_the_smallest(blockage, share):
    froude = share * critical_depth_froude(blockage)[0]
    gamma = kreitner(blockage, froude).gamma[0]

    def continuity(value):
        return value * (1.0 - blockage + 0.5 * froude**2 * (1.0 - value**2))

    assert continuity(gamma) == pytest.approx(1.0, rel=1e-9)
    assert gamma >= 1.0 - 1e-9
    between = np.linspace(0.0, gamma, 50)[:-1]
    assert (continuity(between) < 1.0 + 1e-12).all()


@given(st.floats(0.01, 0.3), st.floats(0.01, 0.99))
def test_raven_with_no_wide_water_flow_is_kreitner(blockage, share):
    froude = share * critical_depth_froude(blockage)[0]
    walls = raven_overspeed(blockage, froude, gamma=1.0, outflow=blockage)
    np.testing.assert_allclose(1.0 + walls, kreitner(blockage, froude).gamma, rtol=1e-9)


def test_raven_root_satisfies_his_equation():
    blockage, froude, gamma, outflow = 0.0646, 0.5, 1.03, 0.03
    d = raven_overspeed(blockage, froude, gamma, outflow)[0]
    left = d * (1 - blockage + 0.5 * froude**2 * (1 - 3 * gamma**2 - 3 * gamma * d - d**2))
    assert left == pytest.approx(outflow, rel=1e-12)
    assert 0 < d < kreitner(blockage, froude).gamma[0] - 1
    assert np.isnan(raven_overspeed(blockage, 0.9, gamma, outflow)).all()


def test_walls_sink_the_ship_and_hold_it_back():
    depth, froude, along, d = 0.4, 0.5, 1.05, 0.02
    expected = 0.5 * froude**2 * depth * (2 * along * d + d**2)
    assert wall_sinkage(depth, froude, along, d)[0] == pytest.approx(expected, rel=1e-12)
    assert equivalent_speed([2.1], along, d)[0] == pytest.approx(2.1 * 1.07 / 1.05)


@pytest.mark.parametrize(
    ("depth", "speed", "section", "gamma", "drop"),
    [
        (0.326, 0.327, 0.326, 1.043, 0.48),
        (0.326, 0.872, 0.326, 1.057, 4.55),
        (0.1956, 0.327, 0.1956, 1.077, 0.87),
    ],
)
def test_tank_of_the_dtc(depth, speed, section, gamma, drop):
    froude = speed / math.sqrt(GRAVITY * depth)
    found = kreitner(0.98 * 0.572 * 0.163 / (7.0 * section), froude).gamma
    assert found[0] == pytest.approx(gamma, abs=1e-3)
    assert 1000 * level_drop(depth, froude, found)[0] == pytest.approx(drop, abs=0.02)


@pytest.mark.parametrize(("blockage", "froude"), [(15.0, 0.5), (-0.1, 0.5), (0.1, -0.5), (0.1, math.nan)])
def test_wrong_input_is_a_named_error(blockage, froude):
    with pytest.raises(TowtankError, match=r"blockage|Froude"):
        kreitner(blockage, froude)
