"""When the helm was moved."""

import math

import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.simulate.rudder_history import rudder_phases, step_start

TIME = np.arange(0.0, 200.0, 0.5)


def ramp(start: float, rate: float, angle: float) -> np.ndarray:
    """Rudder that goes to `angle` (deg) at `rate` (deg/s) from `start` on, in rad."""
    return np.radians(np.sign(angle) * np.clip(rate * (TIME - start), 0.0, abs(angle)))


@pytest.mark.parametrize("angle", [35.0, -35.0, 10.0])
@pytest.mark.parametrize("start", [20.0, 33.3])
@pytest.mark.parametrize("rate", [2.32, 15.7, 1000.0])
def test_order_of_a_rate_limited_rudder(angle, start, rate):
    found = step_start(TIME, ramp(start, rate, angle))
    assert found == pytest.approx(start, abs=0.01 if rate < 5.0 else 0.5)


def test_noise_before_the_order_is_no_order():
    random = np.random.default_rng(0)
    noise = math.radians(0.5) * random.standard_normal(len(TIME))
    assert step_start(TIME, ramp(50.0, 3.0, 20.0) + noise) == pytest.approx(50.0, abs=1.0)


def test_order_from_an_angle_that_is_not_zero():
    assert step_start(TIME, math.radians(35.0) - ramp(60.0, 2.0, 35.0)) == pytest.approx(60.0, abs=0.01)


def test_first_of_several_steps_is_the_order():
    both = ramp(40.0, 3.0, 10.0) - ramp(90.0, 3.0, 20.0)
    assert step_start(TIME, both) == pytest.approx(40.0, abs=0.01)


def test_rudder_that_does_not_move():
    with pytest.raises(ReadError, match="the rudder does not move"):
        step_start(TIME, np.full_like(TIME, 0.6))
    with pytest.raises(ReadError, match="the propeller rate does not move"):
        step_start(TIME, np.full_like(TIME, 2.0), "propeller rate")


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_phases_of_a_zigzag(side):
    helm = side * (ramp(20.0, 3.0, 10.0) - ramp(60.0, 3.0, 20.0) + ramp(130.0, 3.0, 20.0))
    phases = rudder_phases(TIME, helm)
    assert [phase.side for phase in phases] == [side, -side, side]
    assert [phase.ordered for phase in phases] == pytest.approx([20.0, 60.0, 130.0], abs=0.05)
    assert all(phase.reached > phase.ordered for phase in phases)


def test_neutral_angle_of_a_real_ship_does_not_matter():
    helm = ramp(20.0, 3.0, 10.0) - ramp(60.0, 3.0, 20.0) + math.radians(1.5)
    assert [phase.ordered for phase in rudder_phases(TIME, helm)] == pytest.approx([20.0, 60.0], abs=0.05)
