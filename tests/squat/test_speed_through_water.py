"""Speed through the water."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.speed_through_water import current_along, speed_through_water


def test_a_following_current_takes_from_the_speed_over_ground():
    along = current_along(np.radians([90.0, 270.0, 0.0]), 1.5, np.radians(90.0))
    np.testing.assert_allclose(along, [1.5, -1.5, 0.0], atol=1e-12)
    np.testing.assert_allclose(speed_through_water(8.0, along), [6.5, 9.5, 8.0])


def test_signs_and_units_are_checked():
    with pytest.raises(TowtankError, match="a current is negative"):
        current_along(0.0, -1.0, 0.0)
    with pytest.raises(TowtankError, match="speed over ground is negative"):
        speed_through_water([-0.1], 0.0)
    with pytest.raises(TowtankError, match="a current of 150 m/s is impossible"):
        speed_through_water([5.0], [150.0])
