"""The made voyage."""

import numpy as np

from towtank.squat.virtual_voyage import ANTENNAS, BERTH, virtual_tide, virtual_voyage


def test_the_same_seed_makes_the_same_voyage():
    first, second = (virtual_voyage(step=5.0, seed=7) for _ in range(2))
    for name, values in first.channels.items():
        np.testing.assert_array_equal(values, second.channels[name])
    assert not np.array_equal(first.channels["Z_bow"], virtual_voyage(step=5.0, seed=8).channels["Z_bow"])


def test_the_ship_lies_still_at_the_berth_and_rises_in_the_sea():
    voyage = virtual_voyage(step=5.0, noise=0.0)
    at_berth = voyage.channels["time"] <= BERTH[1]
    for truth in (voyage.sinkage, voyage.trim, voyage.speed, voyage.density):
        np.testing.assert_allclose(truth[at_berth], 0.0, atol=1e-12)
    for name in ANTENNAS:
        fixed = voyage.channels[name][at_berth] - virtual_tide().at(voyage.channels["time"][at_berth])
        assert np.ptp(fixed) < 1e-9
    assert voyage.density[-1] < -0.2
    assert voyage.sinkage.max() > 0.97
