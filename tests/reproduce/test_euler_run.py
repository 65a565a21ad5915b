"""Constant Euler steps converge to the compiled integrator."""

import math

import numpy as np
import pytest

from towtank.reproduce.euler_run import euler_run
from towtank.simulate.ships import named_ship


def test_steps_are_constant_and_the_first_sample_is_the_start():
    run = euler_run(named_ship("mariner"), lambda time: 0.0, 5.0, 0.5, "straight")
    np.testing.assert_allclose(run["time"], np.arange(11) * 0.5)
    assert run["u"][0] == 7.7175
    assert run["x"][1] == pytest.approx(0.5 * 7.7175)


def test_error_is_of_first_order():
    vessel = named_ship("mariner")
    ends = [euler_run(vessel, lambda time: math.radians(15.0), 60.0, step)["psi"][-1] for step in (0.4, 0.2, 0.1)]
    assert (ends[0] - ends[1]) / (ends[1] - ends[2]) == pytest.approx(2.0, abs=0.1)
