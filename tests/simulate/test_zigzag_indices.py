"""Indices of a zig-zag from exact events."""

import math

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.simulate.zigzag_indices import zigzag_indices


def run(rows, side=1.0):
    """Events at headings of 10, 14, -10, -15, 10 and 16 degrees, times 30 s apart."""
    degree = math.radians(side)
    return rows(
        execute_1={"time": 5.0, "psi": 0.0, "u": 4.0, "v": 3.0},
        execute_2={"time": 35.0, "psi": 10.0 * degree},
        extreme_1={"time": 50.0, "psi": 14.0 * degree},
        return_1={"time": 80.0, "psi": 0.0},
        execute_3={"time": 95.0, "psi": -10.0 * degree},
        extreme_2={"time": 112.0, "psi": -15.0 * degree},
        execute_4={"time": 160.0, "psi": 10.0 * degree},
        extreme_3={"time": 178.0, "psi": 16.0 * degree},
        end={"time": 200.0, "psi": 15.0 * degree},
    )


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_all_indices(rows, hull, side):
    found = {name: values[0] for name, values in zigzag_indices(run(rows, side), hull).items()}
    assert found == pytest.approx(
        {
            "initial turning time": 30.0,
            "overshoot 1": 4.0,
            "time to check yaw 1": 15.0,
            "time of overshoot 1": 45.0,
            "overshoot 2": 5.0,
            "time to check yaw 2": 17.0,
            "time of overshoot 2": 107.0,
            "overshoot 3": 6.0,
            "time to check yaw 3": 18.0,
            "time of overshoot 3": 173.0,
            "time of execute 2": 30.0,
            "time of execute 3": 90.0,
            "time of execute 4": 155.0,
            "period": 125.0,
            "reach": 75.0,
            "reach U0/L": 75.0 * 5.0 / 100.0,
        }
    )


def test_heading_before_the_test_is_taken_off(rows, hull):
    shifted = run(rows)
    for values in shifted.mapping.values():
        values[:, 3] += 1.0
    assert zigzag_indices(shifted, hull)["overshoot 2"] == pytest.approx(5.0)


def test_extreme_that_was_not_reached_is_nan(rows, hull):
    early = rows(
        execute_1={"time": 0.0, "psi": 0.0},
        execute_2={"time": 30.0, "psi": 0.17},
        extreme_1={"time": 45.0, "psi": 0.2},
        extreme_2={},
    )
    found = zigzag_indices(early, hull)
    assert np.isfinite(found["overshoot 1"][0])
    assert np.isnan(found["overshoot 2"][0])
    assert np.isnan(found["reach"][0])


def test_events_of_a_turn_are_refused(circle, turn_names, hull):
    with pytest.raises(TowtankError, match="no events of a zig-zag"):
        zigzag_indices(circle().events(turn_names), hull)
