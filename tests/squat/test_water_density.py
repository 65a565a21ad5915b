"""Draught against the density of the water."""

import numpy as np
import pytest

from towtank.core.errors import TowtankError
from towtank.squat.water_density import density_sinkage


def test_weight_is_carried_in_every_water():
    change = density_sinkage(172_000.0, 14_500.0, 1005.0, [1005.0, 1025.0, 1000.0])
    displaced = 172_000.0 + change * 14_500.0
    np.testing.assert_allclose(displaced * np.array([1005.0, 1025.0, 1000.0]), 172_000.0 * 1005.0)
    assert change[0] == 0.0
    assert change[1] < 0.0 < change[2]


@pytest.mark.parametrize(
    ("volume", "reference", "rho", "said"),
    [
        (0.0, 1005.0, 1025.0, "is impossible"),
        (1.0, 1.005, 1025.0, "1.005 kg/m3 is no density of water"),
        (1.0, 1005.0, 1.025, "1.025 kg/m3 is no density"),
        (1.0, 1005.0, np.nan, "nan kg/m3 is no density"),
    ],
)
def test_impossible_water_is_named(volume, reference, rho, said):
    with pytest.raises(TowtankError, match=said):
        density_sinkage(volume, 10.0, reference, rho)
